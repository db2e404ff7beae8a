"""What a comparison found, in words."""

from collections.abc import Sequence

from drapery.comparison.difference import Difference
from drapery.comparison.tolerance import Tolerance
from drapery.errors import counted

_MOST_NAMED = 8
"""The most frames that are named."""


def difference_words(difference: Difference, tolerance: Tolerance) -> str:
    """How two pictures differ, in one line, the same wherever it is told.

    What is beyond the tolerance is told apart from what is within it.

    difference: what was measured.
    tolerance: with which it was measured.
    """
    return "; ".join([*difference.unlike, *difference.exceeded, *_pixels(difference, tolerance)])


def compared_words(
    first: str,
    other: str,
    difference: Difference,
    tolerance: Tolerance,
    cause: str | None = None,
    hidden: Sequence[str] = (),
) -> str:
    """The names of two pictures and how they differ, in one line.

    first: the name of the expected picture.
    other: the name of the other picture.
    difference: how they differ.
    tolerance: what does not count.
    cause: the layer from which on they differ.
    hidden: layers that differ and cannot be seen.
    """
    words = difference_words(difference, tolerance)
    words += f"; from {cause} on" if cause and not difference.same else ""
    words += "".join(f"; {layer}; it cannot be seen" for layer in hidden)
    return f"{first} and {other}{' are' if difference.same else ':'} {words}"


def short_labels(a: str, b: str, length: int = 40) -> tuple[str, str]:
    """Two labels cut to a length so that what differs is seen.

    a: the first label.
    b: the second label.
    length: the most characters of each.
    """
    if max(len(a), len(b)) <= length:
        return a, b
    common = next((n for n, (x, y) in enumerate(zip(a, b, strict=False)) if x != y), 0)
    start = max(0, common - length // 4)
    cut = [("…" if start else "") + label[start:] for label in (a, b)]
    first, second = (each if len(each) <= length else each[: length - 1] + "…" for each in cut)
    return first, second


def named_frames(numbers: Sequence[int]) -> str:
    """The frames of a loop in words: runs are joined, and only the first ones are named."""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][1] + 1:
            runs[-1][1] = number
        else:
            runs.append([number, number])
    words = [str(a) if a == b else f"{a} to {b}" for a, b in runs[:_MOST_NAMED]]
    more = " and more" if len(runs) > _MOST_NAMED else ""
    return f"{'frame' if len(numbers) == 1 else 'frames'} {', '.join(words)}{more}"


def _pixels(difference: Difference, tolerance: Tolerance) -> list[str]:
    if difference.same:
        return _hidden(difference)
    within = difference.changed - difference.beyond - difference.smoothed
    parts = []
    if difference.beyond or not (within or difference.smoothed):
        parts.append(f"{counted(difference.beyond, 'pixel')} {_verb(difference.beyond)}")
    if within:
        parts.append(f"{counted(within, 'pixel')} {_verb(within)} within the limits")
    if difference.smoothed:
        parts.append(f"{counted(difference.smoothed, 'pixel')} of smoothed edges")
    limits = tolerance.limits()
    if limits and (within or difference.beyond):
        parts[-1] += f" ({', '.join(f'{name} {_shown(value)}' for name, value in limits.items())})"
    words = ", ".join(parts) + f", max {difference.max_error:.4g}"
    if difference.frames:
        words += f", in {named_frames(difference.frames)}"
    return [words + _place(difference), *_measures(difference)]


def _hidden(difference: Difference) -> list[str]:
    if difference.unlike:
        return _measures(difference)
    if difference.exact:
        return ["the same to the last bit"]
    parts = []
    if difference.hidden:
        parts.append(
            f"the colour of {counted(difference.hidden, 'pixel')} that cannot be seen differs"
        )
    if difference.ignored:
        verb = "is" if difference.ignored == 1 else "are"
        parts.append(f"{counted(difference.ignored, 'pixel')} {verb} ignored")
    return [f"the same to the eye; {', '.join(parts)}"]


def _place(difference: Difference) -> str:
    if difference.box is None:
        return ""
    left, top, width, height = difference.box
    return f", in columns {left} to {left + width - 1} of rows {top} to {top + height - 1}"


def _measures(difference: Difference) -> list[str]:
    found = {"FLIP": difference.flip, "SSIM": difference.ssim, "CIEDE2000": difference.ciede2000}
    known = [f"{name} {value:.4g}" for name, value in found.items() if value is not None]
    return [", ".join(known)] if known else []


def _verb(pixels: int) -> str:
    return "differs" if pixels == 1 else "differ"


def _shown(value: object) -> str:
    if isinstance(value, tuple):
        return " ".join(",".join(map(str, box)) for box in value)
    return "off" if value is False else str(value)
