"""The tolerance of a comparison from the values of its options."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery.comparison.limits import LIMIT_OPTIONS, Box
from drapery.comparison.tolerance import Tolerance
from drapery.errors import OptionError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


def read_tolerance(given: Mapping[str, Any], folder: Path | None = None) -> Tolerance:
    """The tolerance of options by their names.

    given: texts, or values of Python, JSON, TOML or YAML; None leaves a default.
    folder: the path of a mask starts here; by default in the present one.

    Raises OptionError for an unknown option and a value out of range.
    """
    values = {
        name: LIMIT_OPTIONS[name].parse(value, folder)
        for name, value in given.items()
        if value is not None
    }
    if "tolerance" in values:
        values["channel"] = values.pop("tolerance")
    if "ignore" in values:
        values["ignore"] = tuple(map(_box, values["ignore"]))
    if "mask" in values:
        values["mask"] = _mask(values["mask"])
    return Tolerance(**values)


def _box(value: Any) -> Box:
    """Four numbers, or a text of them. Raises OptionError."""
    if not isinstance(value, str):
        left, top, width, height = value
        return left, top, width, height
    parts = [part.strip() for part in value.split(",")]
    if len(parts) != 4 or not all(part.isdecimal() and len(part) < 8 for part in parts):
        raise OptionError(f"ignore {value[:40]!r} is not a box; write it like 10,20,64,32")
    left, top, width, height = map(int, parts)
    return left, top, width, height


def _mask(source: Any) -> "NDArray[np.bool_]":
    """The pixels that a picture leaves out. Raises OptionError."""
    # Imported here: the other limits need no numpy.
    from drapery.comparison.ignored import painted
    from drapery.comparison.metrics import eight_bits
    from drapery.comparison.picture import as_picture

    frames = as_picture(source).frames
    if len(frames) > 1:
        raise OptionError(f"the mask is a loop of {len(frames)} frames; use a still picture")
    return painted(eight_bits(frames[0]))
