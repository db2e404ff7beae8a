"""How compiled kernels are called without numba, and those that were compiled ahead of time (AOT),
when a wheel was built.

`arguments` packs the arguments of a call, `compiled` calls a kernel with them, and `library` finds
the kernels of the wheel; `drapery.jit_cache` has those that this installation compiled.

A wheel for a platform holds one shared library with the kernels of the usual pictures, so that the
first picture does not wait for a compiler, and no command waits for the import of numba. The code
comes from the same source as numba's own, in strict IEEE arithmetic, so it gives the same bits.
`python -m release.kernels` in a checkout builds the library. Without a library, or if it was built
from other sources, numba compiles every kernel when it is first called, and it is stored.
"""
