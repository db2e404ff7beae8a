"""Find designs for the glyphs of `letter_glyphs.txt`, and say how well those of `letters` fit.

`python -m benchmarks.letters` prints, for each character, how far its design is from its own glyph
and which glyph comes next. `python -m benchmarks.letters --search AB` prints the designs of at most
five layers below a border that `drapery match` finds, and the one of the file, each with its error.
`--sheet FILE` draws all designs, to look at; with `--search`, those found beside those of the file.
"""

import argparse
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import numpy.typing as npt

from benchmarks.quick import add_quick
from drapery.banner import (
    DYES,
    FLAG_REGIONS,
    PATTERN_NAMES,
    Banner,
    Layer,
    composite,
    flag_layers,
    letter_banners,
    letter_characters,
)
from drapery.banner.letters import NO_BORDER
from drapery.match.art import Stack, read_art
from drapery.match.colours import UNIT
from drapery.match.nearest import Goal, NearestSearch
from drapery.match.search import nearest_stacks
from drapery.packs import open_packs
from drapery.sheets import PictureSheet, SheetCell

Array = npt.NDArray[np.float64]

LARGE = ("gradient", "gradient_up", "bricks")
CHARGES = ("globe", "creeper", "skull", "flower", "mojang", "piglin", "flow", "guster")
SHAPES = [name for name in PATTERN_NAMES if name not in {"base", "border", *LARGE, *CHARGES}]

LAYERS, EFFORT = 5, 60
LAYER = 0.004
"""What a layer costs when the best of the designs that were found is chosen."""
WORDS = {"white": "ground", "black": "ink"}
"""The dyes in which designs are searched, and their words in `letters.txt`."""
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


def face(banner: Banner) -> Array:
    """A banner of black and white as numbers, 0 where it is black to 1 where it is white, [800]."""

    def grey(one: Banner) -> Array:
        sheet = composite(flag_layers(one, open_packs(())))
        return FLAG_REGIONS["front"].crop(sheet)[..., :3].astype(np.float64).mean(-1).ravel()

    dark, light = grey(Banner("black")), grey(Banner("white"))
    return np.clip((grey(banner) - dark) / (light - dark), 0, 1)


@cache
def two_dyes() -> NearestSearch:
    """The search in an art of white, which is ground, and black, which is ink."""
    art = read_art(open_packs(()), SHAPES)
    chosen = [DYES[name].number for name in WORDS]
    dyed = art.dyed[:, chosen]
    return NearestSearch(replace(art, bases=art.bases[chosen], dyed=dyed))


def goal_of(rows: list[str]) -> Goal:
    """What is searched for: a glyph as a face. Ink and ground count alike, however thin one is."""
    wanted, weights = target(rows)
    ink = (weights * wanted).sum() / weights.sum()
    weights = weights * np.where(wanted > 0.5, 0.5 / ink, 0.5 / (1 - ink))
    search = two_dyes()
    ground, black = search.art.bases.reshape(2, -1, 3)
    face = ground + wanted[:, None] * (black - ground)
    whole = np.rint(weights / weights.max() * 1000)
    return search.goal(np.rint(face).astype(np.int32), whole)


def written(stack: Stack) -> str:
    """A design as in `letters.txt`."""
    words, patterns = list(WORDS.values()), two_dyes().art.patterns
    base, layers = stack
    return " ".join([words[base], *(f"{patterns[p]}:{words[dye]}" for p, dye in layers)])


def composed(character: str) -> Stack:
    """The design of `letters.txt`."""
    (banner,) = letter_banners(character, ink="black", ground="white", border=NO_BORDER)
    dyes, patterns = list(WORDS), two_dyes().art.patterns
    layers = tuple((patterns.index(one.pattern), dyes.index(one.dye)) for one in banner.layers)
    return dyes.index(banner.base), layers


def searched(rows: list[str], count: int = 3, effort: int = EFFORT) -> list[Stack]:
    """The designs that are nearest to a glyph, best first."""
    return nearest_stacks(goal_of(rows), LAYERS, count, effort)


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
    add_quick(parser)
    chosen = parser.parse_args()
    faces = [(character, letter_banners(character)[0]) for character in letter_characters()]
    if chosen.search:
        faces = []
        for character in chosen.search:
            goal = goal_of(glyphs()[character])
            stacks = [composed(character), *searched(glyphs()[character])]
            errors = [goal.error(stack) / int(goal.weights.sum()) / UNIT for stack in stacks]
            for number, (stack, error) in enumerate(zip(stacks, errors, strict=True)):
                print(character, f"{error:.4f}", written(stack), "" if number else "(file)")
            costs = [e + LAYER * len(stack[1]) for e, stack in zip(errors, stacks, strict=True)]
            best = stacks[1:][int(np.argmin(costs[1:]))]
            for name, stack in ((character, stacks[0]), (f"{character} found", best)):
                made = Banner.parse(
                    written(stack).replace("ground", "white").replace("ink", "black")
                )
                faces.append((name, Banner(made.base, (*made.layers, Layer("border", "white")))))
    if chosen.sheet is not None:
        cells = []
        for name, banner in faces:
            sheet = composite(flag_layers(banner, open_packs(())))
            cells.append(SheetCell(name, FLAG_REGIONS["front"].sample(sheet, 4)))
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
