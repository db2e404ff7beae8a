"""The file from which the component draws: a scene at its start, and the plans of its cloth.

It is one message (see `messages`), compressed with gzip: the fields and arrays of a `scene` and of
its first `moment`, and

aspect: width / height of the picture that the camera frames. sheets: the names of the flag's
sheets of texels in the order of its layers ("" is the bare cloth), None where no design is shown.
turned: the angle of rotation or facing [degrees], see `Settings.turned`.
plan0, plan1, …: the plan of each panel of cloth, see `drapery.web.wasm`; `grip` has the vertices of
each panel in the same order.
"""

import gzip
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from drapery.banner import PATTERN_NAMES, Banner
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.packs import Packs
from drapery.render import Material, TextureLayer
from drapery.scenes import Stager, cloth_at_rest, cloth_spec, floor_under
from drapery.settings import Settings
from drapery.style import Body, MaterialAt, body_of
from drapery.web.messages import MessageEncoder, pack, unpack
from drapery.web.panes import Pane, ViewerState
from drapery.web.wasm.plan import plans_of

SWINGS = np.array(((-0.2, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.0, 0.7)))
"""How far a light wind moves cloth from its rest position: to both sides, to the front [m]."""
MAX_SIDE = 4096
"""The longest side of an atlas that every browser with WebGL 2 takes in practice [texels]."""


def scene_bytes(
    design: Banner | None, packs: Packs, settings: Settings, patterns: Sequence[str] = PATTERN_NAMES
) -> bytes:
    """The file of a body in the wind of the settings.

    design: None for a cape or elytra. patterns: those that designs in the page may have.
    Raises OptionError for what a page cannot show, PackError for textures that cannot be used, and
    WasmBuildError where the kernels of the cloth are not built.
    """
    body = body_of(design, packs, settings)
    stager = Stager(body, settings)
    _check(stager)
    shown, sheets = _with_sheets(body, packs, patterns) if design else (body, None)
    state = _state(stager, shown)
    aspect = stager.settings.size[0] / stager.settings.size[1]
    encoder = MessageEncoder(shape=stager.settings.size, flat=False)
    scene, moment = map(unpack, encoder.messages(state))
    plans = [np.frombuffer(plan, np.uint8) for plan in plans_of(body, stager.settings)]
    extra = {"aspect": aspect, "sheets": sheets, "turned": stager.settings.turned}
    header = {**moment[0], **scene[0], **extra}
    arrays = {**scene[1], **moment[1], **{f"plan{n}": plan for n, plan in enumerate(plans)}}
    if max(header["atlas"]) > MAX_SIDE:
        width, height = header["atlas"]
        raise OptionError(f"the textures fill {width} x {height} texels; use smaller packs")
    return gzip.compress(pack(header, arrays), mtime=0)


def _check(stager: Stager) -> None:
    """Raise OptionError for what a page cannot show."""
    settings, style = stager.settings, stager.style
    if not stager.cloths:
        remedy = "use kind banner, cape or elytra, pose cloth, placement standing or wall"
        raise OptionError(f"a page shows cloth that moves; {remedy}")
    if settings.pbr:
        raise OptionError("pbr needs the renderer; leave it out")
    for kind in ("motion", "shape", "picture"):
        if style.has(kind):
            raise OptionError(
                f"style {style.name} has {kind} steps, which need the renderer; use a style that"
                " has only material steps"
            )


def _with_sheets(body: Body, packs: Packs, patterns: Sequence[str]) -> tuple[Body, list[str]]:
    """The body whose flag has the sheets of all patterns as layers, and the names of these."""
    names = ["", *dict.fromkeys(("base", *patterns))]
    texels = [packs.base_sheet(), *(packs.sheet(name) for name in names[1:])]
    material = Material(tuple(map(TextureLayer, texels)))
    at: MaterialAt = lambda time: material  # noqa: E731
    return replace(body, panels=tuple(replace(p, material_at=at) for p in body.panels)), names


def _state(stager: Stager, shown: Body) -> ViewerState:
    meshes = stager.meshes()
    models = stager.models(meshes, 0.0, shown)
    shadow = None
    if stager.settings.shadow:
        shadow = stager.contact(models, floor_under(meshes))
    framing = partial(stager.camera, [*(mesh.positions for mesh in meshes), *_swings(stager)])
    scene = stager.scene(models, framing(1.0), shadow)
    last = len(scene.models)
    grip = frozenset(range(last - len(stager.body.panels), last))
    return ViewerState((Pane(scene, framing),), grip=grip, live=True)


def _swings(stager: Stager) -> list[Array]:
    """Where light wind moves the cloth [m], each [N, 3]."""
    specs = [cloth_spec(panel, stager.settings) for panel in stager.body.panels]
    rests = [cloth_at_rest(spec).cloth.rest_positions for spec in specs]
    points = [
        rest + panel.origin + swing
        for rest, panel in zip(rests, stager.body.panels, strict=True)
        for swing in SWINGS
    ]
    nothing = np.zeros((0, 3), np.int32)
    return [stager.turned(Mesh(each, each, nothing, each)).positions for each in points]
