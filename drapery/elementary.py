"""Elementary functions of arrays, whose bits do not depend on the processor.

NumPy has a sine, an exponential and so on of its own for each set of vector instructions (NEP 38,
https://numpy.org/neps/nep-0038-SIMD-optimizations.html); their last bits differ, and so would
pictures. These take the C library's, one number after the other, so they are for small arrays.
Angles are in radians. Each returns a float64, or an array of them in the shape of its arguments.
"""

import math
from collections.abc import Callable
from typing import Any

import numpy as np


def sin(x: Any) -> Any:
    return _each(math.sin, x)


def cos(x: Any) -> Any:
    return _each(math.cos, x)


def arccos(x: Any) -> Any:
    return _each(math.acos, x)


def arctan2(y: Any, x: Any) -> Any:
    return _each(math.atan2, y, x)


def exp(x: Any) -> Any:
    return _each(math.exp, x)


def cbrt(x: Any) -> Any:
    return _each(math.cbrt, x)


def power(base: Any, exponent: Any) -> Any:
    """`base ** exponent` of numbers above 0, or of 0 and an exponent above 0."""
    return _each(math.pow, base, exponent)


def _each(function: Callable[..., float], *values: Any) -> Any:
    return np.asarray(np.frompyfunc(function, len(values), 1)(*values), np.float64)[()]
