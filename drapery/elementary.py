"""Elementary functions of arrays and numbers, whose bits hardly depend on the processor.

NumPy has a sine, an exponential and so on of its own for each set of vector instructions (NEP 38,
https://numpy.org/neps/nep-0038-SIMD-optimizations.html), and their last bits differ. Sine and
cosine here are series of IEEE additions, multiplications and divisions in a fixed order, which are
the same everywhere. The others take the C library's, one number after the other; these may differ
in the last bit where a processor cannot multiply and add at once.
"""

import math
from collections.abc import Callable
from math import pi
from typing import Any

import numpy as np


def sine_of_turns(turns: Any) -> Any:
    """sin(2π turns) of a number or an array, by its Taylor series, with an error below 1e-12."""
    part = turns - np.floor(turns + 0.5)
    part = np.sign(part) * (0.25 - abs(abs(part) - 0.25))
    angle = 2 * np.pi * part
    square = angle * angle
    term = angle
    total = angle
    for n in range(2, 20, 2):
        term = -term * square / (n * (n + 1))
        total = total + term
    return total


def sin(x: Any) -> Any:
    """The sine of angles [radians]."""
    return sine_of_turns(np.asarray(x) / (2 * pi))


def cos(x: Any) -> Any:
    """The cosine of angles [radians]."""
    return sine_of_turns(np.asarray(x) / (2 * pi) + 0.25)


def arccos(x: Any) -> Any:
    """The angle [radians] of cosines."""
    return _each(math.acos, x)


def arctan2(y: Any, x: Any) -> Any:
    """The angle [radians] of directions."""
    return _each(math.atan2, y, x)


def exp(x: Any) -> Any:
    """The exponential."""
    return _each(math.exp, x)


def cbrt(x: Any) -> Any:
    """The cube root."""
    return _each(math.cbrt, x)


def power(base: Any, exponent: Any) -> Any:
    """`base ** exponent` of numbers above 0, or of 0 and an exponent above 0."""
    return _each(math.pow, base, exponent)


def _each(function: Callable[..., float], *values: Any) -> Any:
    return np.asarray(np.frompyfunc(function, len(values), 1)(*values), np.float64)[()]
