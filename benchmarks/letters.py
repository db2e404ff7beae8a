"""Find designs for the glyphs of `letter_glyphs.txt`, and say how well those of `letters` fit.

`python -m benchmarks.letters` prints, for each character, how far its design is from its own glyph
and which glyph comes next. `python -m benchmarks.letters --search AB` prints new designs of at most
five layers below a border, the best first. `--sheet FILE` draws all designs, to look at.

The search has a beam of states, and then descends one layer at a time from its best states with
random kicks: the squared errors of all choices for one layer are a quadratic in its coverage.
"""

import argparse
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

from drapery.banner import (
    FLAG_REGIONS,
    PATTERN_NAMES,
    Banner,
    Layer,
    composite,
    flag_layers,
    letter_banners,
    letter_characters,
)
from drapery.packs import open_packs
from drapery.sheets import PictureSheet, SheetCell

Array = npt.NDArray[np.float64]
Design = tuple[int, tuple[tuple[int, int], ...]]
"""The base, 0 for the ground and 1 for the ink, and (pattern, colour) from the lowest layer."""

LARGE = ("gradient", "gradient_up", "bricks")
CHARGES = ("globe", "creeper", "skull", "flower", "mojang", "piglin", "flow", "guster")
SHAPES = [name for name in PATTERN_NAMES if name not in {"base", "border", *LARGE, *CHARGES}]

LAYERS = 5
COLUMNS = [3, 5, 7, 9, 11, 13, 15, 17]
ROWS = [3, 5.75, 8.5, 11.25, 14, 17, 20, 23, 26, 28.75, 31.5, 34.25, 37]
"""Edges of a glyph's cells [texels], inside the border and where the stripes have theirs."""
UNSURE = 0.05
"""The weight of cells that may be either."""


def glyphs() -> dict[str, list[str]]:
    """The rows of cells of each character."""
    found = {}
    text = Path(__file__).with_name("letter_glyphs.txt").read_text("utf-8")
    for band in text.split("\n\n")[1:]:
        characters, *rows = band.strip("\n").splitlines()
        for number, character in enumerate(characters.split()):
            found[character] = [row[8 * number : 8 * number + 7] for row in rows]
    return found


def target(rows: list[str]) -> tuple[Array, Array]:
    """What a face should be, 0 ground to 1 ink, and the weights, each [800]."""
    y = np.searchsorted(ROWS, np.arange(40) + 0.5) - 1
    x = np.searchsorted(COLUMNS, np.arange(20) + 0.5) - 1
    inside = ((y >= 0) & (y < 12))[:, None] & ((x >= 0) & (x < 7))[None, :]
    cells = np.array([list(row) for row in rows])[y.clip(0, 11)[:, None], x.clip(0, 6)[None, :]]
    wanted = np.select([cells == "#", cells == "."], [1.0, 0.0], 0.5)
    weights = np.where(cells == "?", UNSURE, 1.0) * inside
    return (wanted * inside).ravel(), weights.ravel()


@cache
def coverage(pattern: str) -> Array:
    """How much of each texel a pattern covers in our own art, [800], 0 to 1."""
    return face(Banner("black", (Layer(pattern, "white"),)))


def face(banner: Banner) -> Array:
    """A banner of black and white as numbers, 0 where it is black to 1 where it is white, [800]."""

    def grey(one: Banner) -> Array:
        sheet = composite(flag_layers(one, open_packs(())))
        return FLAG_REGIONS["front"].crop(sheet)[..., :3].astype(np.float64).mean(-1).ravel()

    dark, light = grey(Banner("black")), grey(Banner("white"))
    return np.clip((grey(banner) - dark) / (light - dark), 0, 1)


class GlyphSearch:
    """Looks for the designs of one glyph; `found` has every design that it met, with its error."""

    def __init__(self, rows: list[str], seed: int = 19) -> None:
        self.rng = np.random.default_rng(seed)
        self.masks = np.stack([coverage(name) for name in SHAPES])
        self.wanted, self.weights = target(rows)
        self.found: dict[Design, float] = {}

    def picture(self, base: int, layers: tuple[tuple[int, int], ...]) -> Array:
        """The face of a design, [800], 0 ground to 1 ink."""
        value = np.full(800, float(base))
        for pattern, colour in layers:
            value = value + self.masks[pattern] * (colour - value)
        return value

    def error(self, value: Array) -> float:
        """The weighted squared error of a face."""
        return float((((value - self.wanted) ** 2) * self.weights).sum())

    def beam(self, width: int) -> None:
        """Add layer after layer to the best `width` states."""
        states: list[Design] = [(0, ()), (1, ())]
        for _ in range(LAYERS):
            values = np.stack([self.picture(*state) for state in states])
            errors = np.stack([self._added(values, colour) for colour in (0, 1)], axis=-1)
            order = np.argsort(errors, axis=None, kind="stable")[: 6 * width]
            seen: dict[float, Design] = {}
            for index in order:
                state, pattern, colour = (int(n) for n in np.unravel_index(index, errors.shape))
                base, layers = states[state]
                seen.setdefault(
                    round(float(errors.flat[index]), 4), (base, (*layers, (pattern, colour)))
                )
            best = list(seen.items())[:width]
            self.found |= {state: error for error, state in best[:100]}
            states = [state for _, state in best]

    def _added(self, values: Array, colour: int) -> Array:
        """Errors of every state with every pattern in a colour on top, [states, patterns]."""
        rest, step = values - self.wanted, colour - values
        linear = (rest * step * self.weights) @ self.masks.T
        square = (step * step * self.weights) @ (self.masks**2).T
        return ((rest**2) @ self.weights)[:, None] + 2 * linear + square

    def kick(self, start: Design, rounds: int) -> None:
        """Descend from a design, and again and again after random changes."""
        now = self._descend(start)
        for _ in range(rounds):
            base, layers = now[1][0], list(now[1][1])
            for _ in range(int(self.rng.integers(1, 4))):
                place = int(self.rng.integers(len(layers) + 1))
                layer = (int(self.rng.integers(len(SHAPES))), int(self.rng.integers(2)))
                layers[place : place + int(self.rng.integers(2))] = [layer]
            found = self._descend((base, tuple(layers[:LAYERS])))
            if found[0] <= 1.05 * now[0]:
                now = found

    def _descend(self, design: Design) -> tuple[float, Design]:
        base, layers = design[0], list(design[1])
        error = self.error(self.picture(base, tuple(layers)))
        while True:
            before = error
            for place in range(len(layers)):
                layers[place], error = self._best_layer(base, layers, place)
            if error > before - 0.1:
                break
        self.found[base, tuple(layers)] = error
        return error, (base, tuple(layers))

    def _best_layer(
        self, base: int, layers: list[tuple[int, int]], place: int
    ) -> tuple[tuple[int, int], float]:
        below = self.picture(base, tuple(layers[:place]))
        # What is above is a linear function of what is below: value * shows + added.
        added = self.picture(0, tuple(layers)[place + 1 :])
        shows = self.picture(1, tuple(layers)[place + 1 :]) - added
        rest = below * shows + added - self.wanted
        choices = []
        for colour in (0, 1):
            step = shows * (colour - below)
            errors = 2 * self.masks @ (rest * step * self.weights)
            errors += (self.masks**2) @ (step * step * self.weights)
            pattern = int(errors.argmin())
            choices.append((float(errors[pattern]), (pattern, colour)))
        gain, best = min(choices)
        return best, gain + self.error(below * shows + added)


def searched(rows: list[str], count: int = 4) -> list[str]:
    """The designs of least error, with a small cost for each layer, as lines of `letters.txt`."""
    search = GlyphSearch(rows)
    search.beam(400)
    for start in sorted(search.found, key=lambda one: search.found[one])[:40:20]:
        search.kick(start, 150)
    best = sorted(search.found, key=lambda one: search.found[one] + 2.0 * len(one[1]))
    words = ("ground", "ink")
    return [
        " ".join([words[base], *(f"{SHAPES[pattern]}:{words[c]}" for pattern, c in layers)])
        for base, layers in best[:count]
    ]


def distances() -> dict[str, dict[str, float]]:
    """Of each character's design to each glyph: the mean weighted squared error."""
    wanted = {character: target(rows) for character, rows in glyphs().items()}
    found = {}
    for character in letter_characters():
        (banner,) = letter_banners(character, ink="white", ground="black")
        value = face(banner)
        found[character] = {
            other: float((((value - wish) ** 2) * weights).sum() / weights.sum())
            for other, (wish, weights) in wanted.items()
        }
    return found


def main() -> None:
    """Print the table, or search."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--search", default="", metavar="CHARACTERS")
    parser.add_argument("--sheet", type=Path)
    chosen = parser.parse_args()
    for character in chosen.search:
        for line in searched(glyphs()[character]):
            print(character, line)
    if chosen.sheet is not None:
        cells = []
        for character in letter_characters():
            (banner,) = letter_banners(character)
            sheet = composite(flag_layers(banner, open_packs(())))
            cells.append(SheetCell(character, FLAG_REGIONS["front"].sample(sheet, 4)))
        PictureSheet("Letters", tuple(cells), 14).save(chosen.sheet)
    if chosen.search or chosen.sheet:
        return
    right, layers = 0, 0
    for character, row in distances().items():
        first, second = sorted(row, key=lambda other: row[other])[:2]
        right += first == character
        layers += len(letter_banners(character, border="none")[0].layers)
        nearest = second if first == character else first
        print(f"{character}  own {row[character]:.3f}  next {nearest} {row[nearest]:.3f}")
    count = len(letter_characters())
    print(f"{right} of {count} are nearest to their own glyph; {layers / count:.1f} layers each")


if __name__ == "__main__":
    main()
