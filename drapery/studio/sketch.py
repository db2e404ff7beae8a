"""A design while it is edited: a move does not change a stroke's number."""

import random
from dataclasses import dataclass, replace
from typing import Any, Literal

from drapery import Banner, DesignError, Layer
from drapery.banner import DYE_NAMES, LOOM_LAYERS, MAX_LAYERS, PATTERN_NAMES

MAX_TITLE = 80


@dataclass(frozen=True)
class Stroke:
    """One pattern in one dye.

    number: identifies the stroke in its sketch, wherever it moves. hidden: not drawn.
    """

    number: int
    pattern: str
    dye: str
    hidden: bool = False


@dataclass(frozen=True)
class Sketch:
    """A design in the editor: the dye of its field, and its strokes, lowest first.

    origin: a number that all edits of one design share, and that no other design of a tab has.
    """

    base: str = "white"
    strokes: tuple[Stroke, ...] = ()
    kind: Literal["banner", "shield"] = "banner"
    title: str = ""
    origin: int = 0


def banner_of(sketch: Sketch) -> Banner:
    """The banner that the sketch shows; hidden strokes are left out. Raises DesignError."""
    shown = (stroke for stroke in sketch.strokes if not stroke.hidden)
    layers = tuple(Layer(stroke.pattern, stroke.dye) for stroke in shown)
    return Banner(sketch.base, layers, sketch.kind)


def sketch_of(banner: Banner, title: str = "") -> Sketch:
    """The sketch of a banner, its strokes numbered from 1."""
    layers = enumerate(banner.layers, 1)
    strokes = tuple(Stroke(number, layer.pattern, layer.dye) for number, layer in layers)
    return Sketch(banner.base, strokes, banner.kind, title[:MAX_TITLE])


def add(sketch: Sketch, pattern: str, dye: str) -> Sketch:
    """Add a stroke on top. Raises DesignError for unknown names, or if there are sixteen."""
    layer = Layer(pattern, dye)
    return _insert(sketch, len(sketch.strokes), layer.pattern, layer.dye)


def duplicate(sketch: Sketch, number: int) -> Sketch:
    """Add a copy of a stroke on top of it. Raises DesignError."""
    place = place_of(sketch, number)
    stroke = sketch.strokes[place]
    return _insert(sketch, place + 1, stroke.pattern, stroke.dye, stroke.hidden)


def move(sketch: Sketch, number: int, place: int) -> Sketch:
    """Move a stroke to a place, counted from 0 at the bottom; larger places mean the top.

    Raises DesignError.
    """
    stroke = sketch.strokes[place_of(sketch, number)]
    rest = [each for each in sketch.strokes if each != stroke]
    rest.insert(max(0, place), stroke)
    return replace(sketch, strokes=tuple(rest))


def recolour(sketch: Sketch, number: int, dye: str) -> Sketch:
    """Give a stroke another dye. Raises DesignError."""
    return _changed(sketch, number, dye=dye)


def repattern(sketch: Sketch, number: int, pattern: str) -> Sketch:
    """Give a stroke another pattern. Raises DesignError."""
    return _changed(sketch, number, pattern=pattern)


def hide(sketch: Sketch, number: int) -> Sketch:
    """Hide a stroke, or show a hidden one. Raises DesignError."""
    return _changed(sketch, number, hidden=not sketch.strokes[place_of(sketch, number)].hidden)


def remove(sketch: Sketch, number: int) -> Sketch:
    """Remove a stroke. Raises DesignError."""
    place = place_of(sketch, number)
    return replace(sketch, strokes=sketch.strokes[:place] + sketch.strokes[place + 1 :])


def clear(sketch: Sketch) -> Sketch:
    """Remove all strokes."""
    return replace(sketch, strokes=())


def dye_field(sketch: Sketch, dye: str) -> Sketch:
    """Give the field another dye. Raises DesignError."""
    return replace(sketch, base=Banner(dye).base)


def random_sketch(seed: int) -> Sketch:
    """A random design, the same for the same seed: two to six patterns in a few dyes."""
    chance = random.Random(seed)
    dyes = chance.sample(DYE_NAMES, 3)
    patterns = chance.sample(PATTERN_NAMES[1:], chance.randint(2, LOOM_LAYERS))
    # Adjacent layers differ in their dye; otherwise their overlap would not be visible.
    layers: list[Layer] = []
    for pattern in patterns:
        below = layers[-1].dye if layers else dyes[0]
        layers.append(Layer(pattern, chance.choice([dye for dye in dyes if dye != below])))
    return sketch_of(Banner(dyes[0], tuple(layers)))


def place_of(sketch: Sketch, number: int) -> int:
    """The place of a stroke, from 0 at the bottom. Raises DesignError."""
    for place, stroke in enumerate(sketch.strokes):
        if stroke.number == number:
            return place
    raise DesignError(f"layer {number} does not exist any more; choose one of the list")


def _insert(sketch: Sketch, place: int, pattern: str, dye: str, hidden: bool = False) -> Sketch:
    if len(sketch.strokes) >= MAX_LAYERS:
        raise DesignError(f"the game shows at most {MAX_LAYERS} layers; remove one first")
    number = 1 + max((stroke.number for stroke in sketch.strokes), default=0)
    stroke = Stroke(number, pattern, dye, hidden)
    return replace(sketch, strokes=(*sketch.strokes[:place], stroke, *sketch.strokes[place:]))


def _changed(sketch: Sketch, number: int, **changes: Any) -> Sketch:
    place = place_of(sketch, number)
    stroke = replace(sketch.strokes[place], **changes)
    layer = Layer(stroke.pattern, stroke.dye)  # whose names are checked
    stroke = replace(stroke, pattern=layer.pattern, dye=layer.dye)
    strokes = (*sketch.strokes[:place], stroke, *sketch.strokes[place + 1 :])
    return replace(sketch, strokes=strokes)
