/* Memory for the kernels, in place of numba's runtime for Python.

   Cloths are reserved once, from the end of the module's own data upwards. The arrays that kernels
   make lie above them until the next call of the module. */

typedef unsigned long size;

struct info { /* numba's MemInfo with 32-bit pointers */
  long long references;
  void *destructor, *destructor_data, *data;
};

extern unsigned char __heap_base;
static size reserved, top;

static size aligned(size place) { return (place + 63) & ~(size)63; }

static int grown(size end) {
  size have = __builtin_wasm_memory_size(0) << 16;
  if (end <= have) return 1;
  return __builtin_wasm_memory_grow(0, (end - have + 0xffff) >> 16) != (size)-1;
}

/* The place of so many bytes that stay in use; 0 where there is no memory. */
__attribute__((export_name("reserve"))) size reserve(size bytes) {
  size place = aligned(reserved ? reserved : (size)&__heap_base);
  if (!grown(place + bytes)) return 0;
  reserved = place + bytes;
  return place;
}

struct info *NRT_MemInfo_alloc_aligned(unsigned long long bytes, unsigned align) {
  size place = aligned(top), data = aligned(place + sizeof(struct info));
  if (!grown(data + (size)bytes + 64)) __builtin_trap();
  struct info *made = (struct info *)place;
  made->data = (void *)data;
  top = data + (size)bytes;
  return made;
}

/* Kernels call this before they make arrays: none of the last call is in use. */
void rewind(void) { top = reserved; }

void *NRT_Allocate(unsigned long long bytes) {
  size place = aligned(top);
  if (!grown(place + (size)bytes + 64)) __builtin_trap();
  top = place + (size)bytes;
  return (void *)place;
}

/* All of a call is freed at once. */
void NRT_Free(void *place) { (void)place; }

/* What was made after a mark is no longer in use. */
size mark(void) { return top; }
void release(size place) { top = place; }

/* Only rows that follow one another are reshaped. */
int numba_attempt_nocopy_reshape(
    long long axes, const long long *shape, const long long *strides, long long new_axes,
    const long long *new_shape, long long *new_strides, long long item, int by_columns) {
  for (long long axis = new_axes - 1; axis >= 0; axis--) {
    new_strides[axis] = item;
    item *= new_shape[axis];
  }
  return 1;
}

void *memset(void *to, int value, size bytes) {
  for (size i = 0; i < bytes; i++) ((volatile unsigned char *)to)[i] = value;
  return to;
}

/* The product of 128-bit numbers, for checks of sizes. */
__int128 __multi3(__int128 a, __int128 b) {
  unsigned long long x = a, y = b, low = x & 0xffffffff, high = x >> 32;
  unsigned long long p = low * (y & 0xffffffff), q = high * (y & 0xffffffff) + (p >> 32);
  unsigned long long r = low * (y >> 32) + (q & 0xffffffff);
  unsigned long long top_half = high * (y >> 32) + (q >> 32) + (r >> 32);
  top_half += (unsigned long long)(a >> 64) * y + x * (unsigned long long)(b >> 64);
  return (__int128)(((unsigned __int128)top_half << 64) | (r << 32) | (p & 0xffffffff));
}
