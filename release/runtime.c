/* What kernels that numba compiled need at run time, without numba: memory, and one check. */

#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

/* numba's block of memory that arrays of a kernel share; the code of a kernel reads its fields. */
struct MemInfo {
  size_t references;
  void *destructor;
  void *destructor_info;
  void *data;
  size_t size;
  void *allocator;
};

void *NRT_MemInfo_alloc_aligned(size_t size, unsigned align) {
  struct MemInfo *block;
  if (size > SIZE_MAX - sizeof(struct MemInfo) - align) return NULL;
  block = calloc(1, sizeof(struct MemInfo) + align + size);
  if (block == NULL) return NULL;
  block->references = 1;
  block->data = (void *)(((uintptr_t)(block + 1) + align - 1) / align * align);
  block->size = size;
  return block;
}

void NRT_MemInfo_call_dtor(struct MemInfo *block) { free(block); }

void *NRT_Allocate(size_t size) { return malloc(size ? size : 1); }

void NRT_Free(void *block) { free(block); }

/* Whether an array can be reshaped without a copy, and its new strides. Only contiguous arrays in
   the order of C can; kernels reshape no others. */
int numba_attempt_nocopy_reshape(ptrdiff_t axes, const ptrdiff_t *shape, const ptrdiff_t *strides,
                                 ptrdiff_t new_axes, const ptrdiff_t *new_shape,
                                 ptrdiff_t *new_strides, ptrdiff_t item, int is_fortran) {
  ptrdiff_t step = item;
  if (is_fortran) return 0;
  for (ptrdiff_t axis = axes - 1; axis >= 0; axis--) {
    if (shape[axis] != 1 && strides[axis] != step) return 0;
    step *= shape[axis];
  }
  step = item;
  for (ptrdiff_t axis = new_axes - 1; axis >= 0; axis--) {
    new_strides[axis] = step;
    step *= new_shape[axis];
  }
  return 1;
}
