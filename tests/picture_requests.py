"""Requests for pictures of everything, drawn at random from a seed, and the hash of each.

`benchmarks/same_pictures.py` compares many of them before and after a change;
`test_same_pictures.py` keeps a few. A request is data, so that its line in a file says what was
drawn, and the same number gives the same request for ever, so nothing here changes. Garments and
styles that are in none of its lists have requests of their own, `added`.
"""

import hashlib
import json
import tempfile
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery import Banner, Frame, OptionError, Settings, animate, draw, draw_face, save_model
from drapery.banner import DYES, PATTERN_NAMES
from drapery.garments import Garment, PlayerSettings, find_garment, garment_names, player_of
from drapery.option import Output, Subject
from drapery.packs import MemoryPack, open_packs
from drapery.render import draw_scene
from drapery.scenes import STEP, StagedBody, first_scene, repeating_garment
from drapery.settings import OPTIONS
from drapery.style import body_of
from drapery.styles import style_names

Options = dict[str, Any]

TIMES = (0.0, 0.2, 1.0, 2.05, 3.0, 8.3, 16.1)
"""Moments [s]; tenths are no multiples of a time step in binary."""
RATES = ((0.3, 10.0), (0.25, 12.5), (0.5, 8.0), (0.2, 20.0), (0.1, 29.97))
"""Lengths [s] and rates [frames/s] of loops."""
MOTIONS = ("walk", "stand", "run", "sneak", "jump", "glide", "swim", "sit", "wave", "walk+point")
WORN = ("scarf", "skirt", "poncho", "hood", "tabard", "dress", "coat")
GARMENTS = (
    *("awning", "banner", "caparison", "cape", "coat", "corners", "curtain", "drape", "dress"),
    *("elytra", "flag", "freefall", "hammock", "hood", "leash", "pennants", "pennon", "poncho"),
    *("sail", "scarf", "skirt", "swallow-tail", "tabard", "tent", "wall-banner"),
)
STYLES = (
    *("game", "few-bends", "boards", "voxel", "low-poly", "tattered", "woven", "felt"),
    *("embroidered", "hatched", "stained-glass", "pixel-art", "cel", "ink", "blueprint"),
)
MODELS = (".glb", ".obj", ".ply", ".bbmodel", ".geo.json")
TICKS = 90
"""Time steps of live cloth."""


@dataclass(frozen=True)
class Request:
    """subject: a name of `SUBJECTS`. what: its own words. options: of the picture."""

    subject: str
    what: Options
    options: Options

    @property
    def text(self) -> str:
        """The request as a line of JSON."""
        return json.dumps([self.subject, self.what, self.options], separators=(",", ":"))


def requests(count: int, seed: int = 1) -> Iterator[Request]:
    """Requests that the same count and seed give again, each subject in turn."""
    names = list(SUBJECTS)
    for number in range(count):
        random = Random(f"{seed} {number}")
        name = names[number % len(names)]
        yield SUBJECTS[name][0](name, random)


def added() -> Iterator[Request]:
    """A request of each garment and style that came after the lists here."""
    size = {"size": (48, 64)}
    for name in garment_names():
        if name not in GARMENTS:
            yield Request("garment", {"garment": name}, size)
    for name in style_names():
        if name not in STYLES:
            yield Request("banner", {"design": "white creeper:lime"}, {**size, "style": [name]})


def digest(request: Request) -> str:
    """The hash of what a request draws, or what it is refused with."""
    try:
        return hashlib.sha256(SUBJECTS[request.subject][1](request)).hexdigest()[:32]
    except OptionError as error:
        return f"refused: {error}"


def _banner(name: str, random: Random) -> Request:
    return Request(name, {"design": _design(random)}, _any_options(random))


def _loop(name: str, random: Random) -> Request:
    seconds, fps = random.choice(RATES)
    what = {"design": _design(random), "seconds": seconds, "fps": fps}
    more = {"turntable": True} if random.random() < 0.2 else {}
    return Request(name, what, {**_any_options(random, standing=True), **more})


def _cape(name: str, random: Random) -> Request:
    kind, seed = random.choice(("cape", "elytra")), random.randrange(1000)
    options = {**_any_options(random, standing=True), "kind": kind}
    return Request(name, {"seed": seed}, {key: options[key] for key in options if key != "pbr"})


def _garment(name: str, random: Random) -> Request:
    what: Options = {"garment": random.choice(GARMENTS)}
    if random.random() < 0.3:
        what |= {"seconds": 0.2, "fps": 10.0}
    if random.random() < 0.3:
        return Request(name, what, {})
    return Request(name, what, {**_some(random, LOOK), **_some(random, AIR), **_size(random)})


def _player(name: str, random: Random) -> Request:
    what = _some(random, PLAYER)
    if random.random() < 0.4:
        what["wear"] = [random.choice(WORN)]
    if random.random() < 0.3:
        what |= {"seconds": 0.2, "fps": 10.0}
    options = {**_some(random, LOOK), **_some(random, AIR), **_size(random)}
    return Request(name, what, {**options, "time": random.choice(TIMES)})


def _live(name: str, random: Random) -> Request:
    options = {**_some(random, CLOTH), **_some(random, AIR), **_some(random, PLACE)}
    return Request(name, {"design": _design(random)}, {**options, "grid": (7, 13)})


def _played(name: str, random: Random) -> Request:
    what = {"elytra": random.random() < 0.4, "motion": random.choice(MOTIONS)}
    return Request(name, what, {**_some(random, LOOK), **_some(random, AIR), **_size(random)})


def _model(name: str, random: Random) -> Request:
    what: Options = {"design": _design(random), "ending": random.choice(MODELS)}
    if random.random() < 0.3:
        what = {"garment": random.choice(("cape", "flag", "tabard")), "ending": ".glb"}
    options = {**_some(random, AIR), "time": random.choice(TIMES)}
    if "design" in what:
        options |= {**_some(random, CLOTH), "grid": (5, 9)}
    return Request(name, what, options)


def _pack(name: str, random: Random) -> Request:
    what = {"design": _design(random), "seed": random.randrange(1000)}
    return Request(name, what, _any_options(random))


def _face(name: str, random: Random) -> Request:
    side, scale = random.choice(("front", "back")), random.choice((1, 3))
    what = {"design": _design(random), "side": side, "scale": scale}
    return Request(name, {**what, "kind": random.choice(("banner", "shield"))}, {})


PLACE: dict[str, tuple[Any, ...]] = {
    "placement": ("standing", "wall"),
    "kind": ("banner", "banner", "shield"),
}
LOOK: dict[str, tuple[Any, ...]] = {
    "view": ("front", "back", "iso", "hero", "gui"),
    "light": ("game", "flat", "studio"),
    "samples": (1, 4),
    "shadow": (True,),
    "background": ("#204060",),
    "block_light": (0, 9),
    "sky_light": (4, 15),
    "daylight": (0.0, 0.5),
    "pixel": (2,),
    "ground": ("none", "grass", "stone"),
    "style": tuple([name] for name in STYLES),
}
AIR: dict[str, tuple[Any, ...]] = {
    "wind": (0.0, 2.5, 4.0, 9.0),
    "direction": (-70.0, 0.0, 45.5, 180.0),
    "gusts": (0.0, 0.8),
    "seed": (1, 2, 77),
}
CLOTH: dict[str, tuple[Any, ...]] = {
    "solver": ("xpbd", "desbrun", "verlet", "provot", "pbd", "implicit"),
    "fabric": ("wool", "cotton", "linen", "silk", "canvas", "leather", "felt"),
    "pins": ("top", "corners", "three-corners"),
    "contact": ("none", "world", "all"),
    "thickness": (0.0, 0.5, 2.0),
}
RARE: tuple[Options, ...] = (
    *({"layers": "flat"}, {"pose": "vanilla"}, {"pbr": True}),
    *({} for _ in range(9)),
)
PLAYER: dict[str, tuple[Any, ...]] = {
    "skin": ("traveller", "dancer"),
    "arms": ("classic", "slim"),
    "overlay": ("flat", "voxels", "none"),
    "elytra": (True,),
    "motion": MOTIONS,
    "speed": (0.5, 3.0),
    "look": ("30,10", "1,1.6,3"),
    "head": ("red skull:white",),
    "shield": ("blue cross:yellow",),
    "shown": ("full", "bust", "head"),
}


def _some(random: Random, table: dict[str, tuple[Any, ...]]) -> Options:
    """Each option of a table with a chance of 35 %, at one of its values."""
    return {name: random.choice(values) for name, values in table.items() if random.random() < 0.35}


def _size(random: Random) -> Options:
    return {"size": random.choice(((48, 64), (64, 64), (80, 48)))}


def _design(random: Random) -> str:
    layers = random.choices(PATTERN_NAMES, k=random.choice((0, 1, 2, 6)))
    words = [f"{pattern}:{random.choice(list(DYES))}" for pattern in layers]
    return " ".join([random.choice(list(DYES)), *words])


def _any_options(random: Random, *, standing: bool = False) -> Options:
    options = {**_some(random, LOOK), **_size(random), "time": random.choice(TIMES)}
    if not standing and random.random() < 0.1:
        stiff = ("view", "shadow", "ground")
        kept = {name: value for name, value in options.items() if name not in stiff}
        return {**kept, "placement": "item"}
    options |= {**_some(random, CLOTH), **_some(random, AIR), **_some(random, PLACE)}
    if standing:
        options.pop("placement", None)
    options["grid"] = random.choice(((5, 9), (8, 15), (16, 31)))
    if options.get("placement") == "wall":
        options["facing"] = random.choice(("south", "west", "north", "east"))
    elif random.random() < 0.3:
        options["rotation"] = random.randrange(16)
    return {**options, **random.choice(RARE)}


def _used(design: Any, options: Options, *outputs: Output) -> Options:
    """The options without those that do nothing, which are refused; the pictures are the same."""
    subject = Subject("garment")
    if design is None or isinstance(design, Banner):
        subject = Settings(**options).subject(design.kind if design else "banner")
    return {
        name: value
        for name, value in options.items()
        if all(OPTIONS[name].applies(subject, output) for output in outputs)
    }


def _drawn(subject: Any, options: Options) -> bytes:
    return _bytes(draw(subject, **_used(subject, options, "still")))


def _draw_banner(request: Request) -> bytes:
    return _drawn(Banner.parse(request.what["design"]), request.options)


def _draw_loop(request: Request) -> bytes:
    what = request.what
    return _loop_bytes(Banner.parse(what["design"]), what, request.options)


def _draw_cape(request: Request) -> bytes:
    texture = _texels(request)[:32]
    return _drawn(None, {"texture": texture, **request.options})


def _draw_garment(request: Request) -> bytes:
    return _garment_bytes(find_garment(request.what["garment"]), request)


def _draw_player(request: Request) -> bytes:
    words = {n: v for n, v in request.what.items() if n not in ("seconds", "fps")}
    return _garment_bytes(player_of(PlayerSettings(**words)), request)


def _garment_bytes(garment: Garment, request: Request) -> bytes:
    if "seconds" in request.what:
        return _loop_bytes(garment, request.what, request.options)
    return _drawn(garment, request.options)


def _move_live(request: Request) -> bytes:
    settings = Settings(**request.options)
    body = body_of(Banner.parse(request.what["design"]), open_packs(()), settings)
    staged = StagedBody(body, settings, curves=False)
    moved = [each.begin(STEP).advance(each.forces(None), TICKS) for each in staged.drapes]
    meshes = staged.soft([each.state.positions[0] for each in moved])
    return b"".join(mesh.positions.tobytes() for mesh in meshes)


def _draw_played(request: Request) -> bytes:
    player = player_of(
        PlayerSettings(**request.what, wear=() if request.what["elytra"] else ("cape",))
    )
    settings = player.settings(**request.options)
    return _bytes(draw_scene(first_scene(repeating_garment(player, open_packs(()), settings))))


def _save_model(request: Request) -> bytes:
    what = request.what
    subject = find_garment(what["garment"]) if "garment" in what else Banner.parse(what["design"])
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "model" + what["ending"])
        outputs: tuple[Output, ...] = ("model", "loop") if path.suffix == ".glb" else ("model",)
        options = _used(subject, request.options, *outputs)
        save_model(subject, path, seconds=0.2, fps=10.0, **options)
        written = sorted(Path(folder).iterdir())
        return b"".join(each.name.encode() + each.read_bytes() for each in written)


def _draw_pack(request: Request) -> bytes:
    texels = _texels(request)
    opaque = texels[:, ::-1] | np.array((0, 0, 0, 255), np.uint8)
    pack = MemoryPack(
        patterns={"creeper": texels, "cross": texels[::-1]},
        textures={"minecraft:entity/banner/banner_base": opaque},
    )
    return _drawn(Banner.parse(request.what["design"]), {"packs": [pack], **request.options})


def _texels(request: Request) -> NDArray[np.uint8]:
    """Texels [64, 64, 4] of noise."""
    noise = np.random.default_rng(request.what["seed"])
    return noise.integers(0, 256, (64, 64, 4), np.uint8)


def _draw_face(request: Request) -> bytes:
    words = {name: value for name, value in request.what.items() if name != "design"}
    return _bytes(draw_face(Banner.parse(request.what["design"]), **words))


def _loop_bytes(subject: Any, what: Options, options: Options) -> bytes:
    times = {name: what[name] for name in ("seconds", "fps")}
    frames = animate(subject, **times, **_used(subject, options, "loop")).frames
    return b"".join(map(_bytes, frames))


def _bytes(frame: Frame) -> bytes:
    return str(frame.pixels.shape).encode() + frame.pixels.tobytes()


SUBJECTS: dict[str, tuple[Callable[[str, Random], Request], Callable[[Request], bytes]]] = {
    "banner": (_banner, _draw_banner),
    "loop": (_loop, _draw_loop),
    "garment": (_garment, _draw_garment),
    "player": (_player, _draw_player),
    "live": (_live, _move_live),
    "model": (_model, _save_model),
    "cape": (_cape, _draw_cape),
    "pack": (_pack, _draw_pack),
    "played": (_played, _draw_played),
    "face": (_face, _draw_face),
}
"""By name: what makes a request, and what draws it."""
