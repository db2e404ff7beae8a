"""An inverse with the same bits on every machine; LAPACK's kernels depend on the processor."""

import numpy as np

from drapery.mesh import Array


def inverse(A: Array) -> Array:
    """Inverse of a diagonally dominant matrix [N, N], by Gauss-Jordan without pivoting."""
    A = A.astype(np.float64)
    B = np.eye(len(A))
    for pivot in range(len(A)):
        B[pivot] /= A[pivot, pivot]
        A[pivot] /= A[pivot, pivot]
        factors = A[:, pivot].copy()
        factors[pivot] = 0.0
        B -= factors[:, None] * B[pivot]
        A -= factors[:, None] * A[pivot]
    return B
