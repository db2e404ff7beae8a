"""Loops that fit into the limits of where they are posted."""

import tempfile
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from pathlib import Path
from shutil import copyfile
from types import MappingProxyType

from drapery.arrays import HasPixels
from drapery.errors import OptionError, shown
from drapery.file_formats import DESTINATIONS, Destination, FileFormat
from drapery.output_files import replacing
from drapery.render.encode import check_quality, check_target, save_animation

RATES = (20.0, 15.0, 12.0)
"""Frames/s that are tried, the best first. GIF shows all of them exactly or nearly so."""
QUALITIES = MappingProxyType({None: 1.0, 90: 0.22, 75: 0.14, 60: 0.11})
"""Qualities that are tried, the best first: bytes of a loop over those without loss, measured on
the default banner."""
SHRINK = 0.84
"""Each smaller picture has this share of the width and height of the one before."""
LEAST = 48
"""No smaller picture is tried [pixels]: a design is hard to read there."""
LIKELY = 1.3
"""A loop is tried if it is expected to be up to this multiple of the size that is allowed."""


@dataclass(frozen=True)
class FittedLoop:
    """What was chosen for a destination.

    size: width and height [pixels].
    fps: [frames/s].
    quality: of the format, 1 to 100; None without loss.
    length: of the file [bytes].
    """

    size: tuple[int, int]
    fps: float
    quality: int | None
    length: int


def save_for(
    to: str,
    frames_at: Callable[[tuple[int, int], float], Iterable[HasPixels]],
    path: str | Path,
    *,
    seconds: float,
    size: tuple[int, int] | None = None,
    shape: tuple[int, int] = (3, 4),
    fps: float | None = None,
    quality: int | None = None,
) -> FittedLoop:
    """Write the best loop that a destination takes.

    It is the largest, then the one with the most frames, then the one of the best quality.

    to: a name of `file_formats.DESTINATIONS`.
    frames_at: draws the loop of a size [pixels] and of frames/s.
    path: its ending selects the format.
    seconds: length of the loop [s].
    size: width and height [pixels] where the caller chooses them; None where this does.
    shape: width and height, in proportion, where the size is chosen.
    fps: [frames/s] where the caller chooses them; None where this does.
    quality: of the format, 1 to 100, where the caller chooses it; None where this does.

    Raises OptionError for a destination that is not known or does not play the format, and for a
    loop that does not fit; OutputError for a bad target.
    """
    if to not in DESTINATIONS:
        names = ", ".join(DESTINATIONS)
        raise OptionError(f"destination {shown(to)} is not known; use one of: {names}")
    limits, format = DESTINATIONS[to], check_target(path, "loop")
    if not set(format.endings) & set(limits.endings):
        raise OptionError(f"{to} does not play {format.name}; use {' or '.join(limits.endings)}")
    check_quality(format, quality)
    expected = 0.0  # bytes of a pixel and frame, without loss
    with tempfile.TemporaryDirectory() as folder:
        trial = Path(folder) / f"loop{format.ending}"
        for chosen in _choices(limits, format, seconds, size, shape, fps, quality):
            weight = _weight(chosen, seconds)
            if expected * weight > LIKELY * limits.max_bytes:
                continue
            wide, rate, at = chosen
            save_animation(frames_at(wide, rate), rate, trial, quality=at)
            length = trial.stat().st_size
            if length < limits.max_bytes:
                with replacing(Path(path)) as unfinished:
                    copyfile(trial, unfinished)
                return FittedLoop(wide, rate, at, length)
            expected = length / weight
    raise OptionError(
        f"no loop of {seconds:g} s fits into {to}: {limits.about}; {_remedy(size, fps, quality)}"
    )


def _choices(
    limits: Destination,
    format: FileFormat,
    seconds: float,
    size: tuple[int, int] | None,
    shape: tuple[int, int],
    fps: float | None,
    quality: int | None,
) -> Iterator[tuple[tuple[int, int], float, int | None]]:
    """Size, frames/s and quality of the loops to try, the best first."""
    sizes = [size] if size else [*_sizes(limits.size, shape)]
    rates = (fps,) if fps else RATES
    lossy = format.lossy and quality is None
    for wide in sizes:
        for rate in rates:
            if wide[0] * wide[1] * rate * seconds > limits.max_samples:
                continue
            for at in QUALITIES if lossy else (quality,):
                yield wide, rate, at


def _sizes(most: tuple[int, int], shape: tuple[int, int]) -> Iterator[tuple[int, int]]:
    """Smaller and smaller pictures of a shape, of even sides, which videos need."""
    scale = min(most[0] / shape[0], most[1] / shape[1])
    while min(shape) * scale >= LEAST:
        width, height = (int(side * scale / 2 + 1e-9) * 2 for side in shape)
        yield width, height
        scale *= SHRINK


def _weight(chosen: tuple[tuple[int, int], float, int | None], seconds: float) -> float:
    """Pixels of all frames, over how much smaller their quality makes them."""
    (width, height), rate, quality = chosen
    return width * height * rate * seconds * QUALITIES.get(quality, 1.0)


def _remedy(size: tuple[int, int] | None, fps: float | None, quality: int | None) -> str:
    given = [
        name
        for name, value in (("size", size), ("fps", fps), ("quality", quality))
        if value is not None
    ]
    return f"leave out {', '.join(given)}, or use fewer seconds" if given else "use fewer seconds"
