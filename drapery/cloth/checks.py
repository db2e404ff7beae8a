"""Checks of arguments. Each raises OptionError with one line: the name and the remedy."""

from typing import Any

import numpy as np

from drapery.errors import OptionError, shown


def check_number(name: str, value: object, minimum: float, maximum: float, unit: str = "") -> float:
    """The value as a float. Raises OptionError unless it is a number from minimum to maximum."""
    number = _float(value)
    if not minimum <= number <= maximum:
        bounds = f"{minimum:g} to {maximum:g} {unit}".rstrip()
        raise OptionError(f"{name} {shown(value)} is out of range; use a number {bounds}")
    return number


def check_count(name: str, value: object, minimum: int, maximum: int) -> int:
    """The value as an int. Raises OptionError unless it is a whole number in these bounds."""
    whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if not (whole and minimum <= value <= maximum):  # type: ignore[operator]
        raise OptionError(
            f"{name} {shown(value)} is out of range; use a whole number {minimum} to {maximum}"
        )
    return int(value)  # type: ignore[call-overload, no-any-return]


def check_choice(name: str, value: object, known: tuple[str, ...]) -> None:
    """Raises OptionError unless the value is one of the known words."""
    if not (isinstance(value, str) and value in known):
        raise OptionError(f"{name} {shown(value)} is not known; use one of: {', '.join(known)}")


def check_three(name: str, value: object) -> None:
    """Raises OptionError unless the value is a tuple or list of three."""
    if not (isinstance(value, tuple | list) and len(value) == 3):
        raise OptionError(
            f"{name} {shown(value)} must be three numbers: structural, shear and flexion springs"
        )


def check_flag(name: str, value: object) -> None:
    """Raises OptionError unless the value is True or False."""
    if not isinstance(value, bool | np.bool_):
        raise OptionError(f"{name} {shown(value)} is not a truth value; use True or False")


def vector3(name: str, value: object, maximum: float, unit: str) -> np.ndarray[Any, Any]:
    """Three numbers as an array, shape [3]; each from -maximum to maximum. Raises OptionError."""
    try:
        vector = np.asarray(value, float)
    except (TypeError, ValueError, OverflowError):
        vector = np.empty(0)
    if vector.shape != (3,) or not (np.abs(vector) <= maximum).all():
        raise OptionError(
            f"{name} {shown(value)} is not a vector in range; "
            f"give three numbers from -{maximum:g} to {maximum:g} {unit}"
        )
    return vector


def _float(value: object) -> float:
    """The value as a float; NaN for anything that is not one real number."""
    if isinstance(value, bool) or not isinstance(value, int | float | np.integer | np.floating):
        return float("nan")
    try:
        return float(value)
    except OverflowError:
        return float("nan")
