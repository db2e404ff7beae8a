"""Loops that fit where they are posted: `drapery animate --for`."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from PIL import Image

from drapery.errors import OptionError
from drapery.file_formats import DESTINATIONS
from drapery.render import Frame
from drapery.render.encode.fitting import LEAST, RATES, save_for


class Noise:
    """Loops of noise, which no format compresses. drawn: the size and rate of each."""

    def __init__(self, seconds: float, kept: int = 256) -> None:
        self.seconds, self.kept = seconds, kept
        self.drawn: list[tuple[tuple[int, int], float]] = []

    def __call__(self, size: tuple[int, int], fps: float) -> Iterator[Frame]:
        self.drawn.append((size, fps))
        chance = np.random.default_rng(0)
        for _ in range(round(self.seconds * fps)):
            pixels = chance.integers(0, self.kept, (size[1], size[0], 4), np.uint8)
            pixels[..., 3] = 255
            yield Frame(pixels)


@pytest.mark.parametrize("to", DESTINATIONS)
def test_what_is_written_is_within_the_limits(to: str, tmp_path: Path) -> None:
    limits, target = DESTINATIONS[to], tmp_path / f"loop{DESTINATIONS[to].endings[0]}"
    fitted = save_for(to, Noise(0.5, 8), target, seconds=0.5)
    assert target.stat().st_size == fitted.length < limits.max_bytes
    assert fitted.size[0] <= limits.size[0] and fitted.size[1] <= limits.size[1]
    with Image.open(target) as image:
        frames = getattr(image, "n_frames", 1)
        assert image.size == fitted.size and frames == round(0.5 * fitted.fps)
        assert frames * image.width * image.height <= limits.max_samples


def test_a_loop_that_fits_at_once_is_drawn_once(tmp_path: Path) -> None:
    loop = Noise(0.5, 2)
    fitted = save_for("discord-emoji", loop, tmp_path / "loop.webp", seconds=0.5)
    assert loop.drawn == [((96, 128), 20.0)] and fitted.quality is None


def test_a_larger_loop_gets_fewer_frames_then_less_size(tmp_path: Path) -> None:
    loop = Noise(2.0, 4)
    fitted = save_for("discord-emoji", loop, tmp_path / "loop.gif", seconds=2.0)
    sizes = [size for size, _ in loop.drawn]
    assert sizes == sorted(sizes, reverse=True) and fitted.size < (96, 128)
    most = DESTINATIONS["discord-emoji"].max_bytes
    assert fitted.length > 0.4 * most, "not smaller than needed"
    assert len(loop.drawn) < 6, "what is far too large is not drawn"


def test_what_is_given_is_kept(tmp_path: Path) -> None:
    target = tmp_path / "loop.webp"
    fitted = save_for(
        "github", Noise(0.5, 4), target, seconds=0.5, size=(64, 32), fps=7.0, quality=33
    )
    assert (fitted.size, fitted.fps, fitted.quality) == ((64, 32), 7.0, 33)


def test_a_loop_that_cannot_fit_is_refused_and_leaves_no_file(tmp_path: Path) -> None:
    target = tmp_path / "loop.gif"
    target.write_bytes(b"old")
    with pytest.raises(OptionError, match=r"256 kB; leave out size, fps, quality"):
        where, wide = tmp_path / "loop.webp", (128, 128)
        save_for("discord-emoji", Noise(1.0), where, seconds=1.0, size=wide, fps=20.0, quality=100)
    with pytest.raises(OptionError, match="leave out size, or use fewer seconds"):
        save_for("wiki", Noise(4.0), target, seconds=4.0, size=(2000, 2000))
    assert target.read_bytes() == b"old" and [*tmp_path.iterdir()] == [target]


@pytest.mark.parametrize(
    ("to", "name", "line"),
    [
        ("wiki", "loop.webp", "wiki does not play WebP; use .gif"),
        ("forum", "loop.gif", "destination 'forum' is not known"),
    ],
)
def test_destinations_and_formats_that_do_not_fit_are_refused(
    to: str, name: str, line: str, tmp_path: Path
) -> None:
    with pytest.raises(OptionError, match=line):
        save_for(to, Noise(1.0), tmp_path / name, seconds=1.0)


def test_sizes_are_even_and_readable() -> None:
    assert min(min(each.size) for each in DESTINATIONS.values()) >= LEAST
    assert all(rate <= 50 for rate in RATES), "GIF shows at most 50 frames/s"


def test_the_command_says_what_it_chose(drapery: Run, tmp_path: Path) -> None:
    target = tmp_path / "emoji.webp"
    words = ("white creeper:lime", "--for", "discord-emoji", "--seconds", "1", "--grid", "5x9")
    code, _, said = drapery("animate", *words, "-o", str(target))
    assert code == 0
    kilobytes = f"{target.stat().st_size / 1000:.0f} kB"
    assert f"for discord-emoji: 128x128 pixels, 20 frames/s, {kilobytes}" in said
    code, _, said = drapery("animate", *words, "--matte", "#ffffff", "-o", str(tmp_path / "x.gif"))
    assert code == 2 and "matte does nothing with --for" in said
