"""A design while it is edited, with its hidden layers and its title."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Literal

from drapery import Banner, DesignError, Layer
from drapery.banner import MAX_LAYERS

MAX_TITLE = 80
MAX_ORIGIN = 1 << 48


@dataclass(frozen=True)
class Stroke:
    """One pattern in one dye. hidden: not drawn."""

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
    """The sketch of a banner."""
    strokes = tuple(Stroke(layer.pattern, layer.dye) for layer in banner.layers)
    return Sketch(banner.base, strokes, banner.kind, title[:MAX_TITLE])


def editor_tree(sketch: Sketch) -> dict[str, Any]:
    """The sketch as the page's editor has it; `edited_sketch` reads it."""
    layers = [{"pattern": s.pattern, "dye": s.dye, "hidden": s.hidden} for s in sketch.strokes]
    whole = {"base": sketch.base, "kind": sketch.kind, "layers": layers}
    return {**whole, "title": sketch.title, "origin": sketch.origin}


def edited_sketch(tree: Any) -> Sketch:
    """The sketch of what the page's editor sends. Raises DesignError for anything else."""
    try:
        strokes = tuple(_strokes(tree["layers"]))
        title, origin = tree["title"], tree["origin"]
        banner = Banner(tree["base"], (), tree["kind"])
    except (TypeError, KeyError):
        raise DesignError("the page has sent no design; reload it") from None
    is_origin = isinstance(origin, int) and 0 <= origin < MAX_ORIGIN
    if not (isinstance(title, str) and is_origin and banner.kind in ("banner", "shield")):
        raise DesignError("the page has sent no design; reload it")
    line = "".join(filter(str.isprintable, title))[:MAX_TITLE].strip()
    return Sketch(banner.base, strokes, banner.kind, line, origin)


def _strokes(layers: Any) -> Iterator[Stroke]:
    if not isinstance(layers, list) or len(layers) > MAX_LAYERS:
        raise DesignError(f"the game shows at most {MAX_LAYERS} layers; remove one first")
    for each in layers:
        layer = Layer(each["pattern"], each["dye"])  # whose names are checked
        yield Stroke(layer.pattern, layer.dye, bool(each.get("hidden")))
