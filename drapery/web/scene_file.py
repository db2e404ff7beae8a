"""The file from which the component draws: a scene at its start, and the plans of its cloth.

It is one message (see `messages`), compressed with gzip: what `scene_message` gives, and

aspect: width / height of the picture that the camera frames. sheets: the names of the sheets of
texels of what shows the design, in the order of its layers ("" is the bare one), None where no
other design can be shown. flag: a vertex of what shows it. views: cameras by the names of views.
daylights: the tints of the light at DAYLIGHTS. own: fabric, view and daylight of the
settings, where they have names. turned: the angle of rotation or facing [degrees], see
`Settings.turned`.
textures: those of a player, by name: the layers that show one, and which part they show of one 64
texels wide.
plan0, plan1, …: the plan of each panel of cloth, see `drapery.web.wasm`; `grip` has the vertices of
each panel in the same order.
moving: the number of a plan, the first of the vertices that it moves and their count, and the names
of its arrays with their places and their light.
still: the name of a file with a plan that also draws the still of the settings. Its materials,
layers and atlas are those of the scene, and its atlas is left empty. Without one, noPicture says
why.
"""

import gzip
from collections.abc import Callable, Mapping, Sequence
from dataclasses import astuple, replace
from functools import partial
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from drapery.banner import PATTERN_NAMES, Banner
from drapery.errors import OptionError
from drapery.garments import Garment
from drapery.mesh import Array, Mesh
from drapery.option import Subject
from drapery.packs import Packs
from drapery.render import VIEWS, Camera, Material, Scene, TextureLayer, frame_view
from drapery.scenes import (
    Dressed,
    PlayedSubject,
    StagedBody,
    Staging,
    first_scene,
    floor_under,
    live_picture,
    played_body,
    played_garment,
    repeating_garment,
    texture_areas,
)
from drapery.settings import FabricName, Settings, settled
from drapery.style import Body, MaterialAt, body_of
from drapery.styles import Style
from drapery.web.face_file import UNITS
from drapery.web.messages import pack, scene_message, unpack
from drapery.web.wasm.module import module_info, read_module
from drapery.web.wasm.plan import LANES, kernels_of, plans_of, write_plan

DAYLIGHTS = tuple(step / 10 for step in range(11))
SWINGS = np.array(((-0.2, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.0, 0.7)))
"""How far a light wind moves cloth from its rest position: to both sides, to the front [m]."""
MAX_SIDE = 4096
"""The longest side of an atlas that every browser with WebGL 2 takes in practice [texels]."""
NO_PICTURE = (
    "a page of one file holds no pictures; use an element of the package (drapery web --component)"
)

_Message = tuple[dict[str, Any], dict[str, NDArray[Any]]]


def scene_bytes(
    subject: Banner | Garment | None,
    packs: Packs,
    settings: Settings,
    patterns: Sequence[str] = PATTERN_NAMES,
) -> bytes:
    """The file of a banner, a cape (None) or a garment on its wearer, in the wind of the settings.

    patterns: those that designs in the page may have.
    Raises OptionError for what a page cannot show, PackError for textures that cannot be used, and
    WasmBuildError where the kernels of the cloth are not built.
    """
    if isinstance(subject, Garment):
        worn = repeating_garment(subject, packs, _settled(subject, settings))
        return _packed(_worn_scene(worn), plans_of(played_garment(worn)))
    scene, played, _ = _body_scene(subject, packs, settings, patterns)
    scene[0]["noPicture"] = NO_PICTURE
    return _packed(scene, plans_of(played))


def still_player_bytes(player: Garment, packs: Packs, settings: Settings) -> bytes:
    """The file of a player without cloth, who stands still and may hold a shield.

    Raises OptionError for what a page cannot show, and PackError for textures that cannot be used.
    """
    return _packed(_worn_scene(Dressed(player, packs, _settled(player, settings))), ())


def pictured_scene(
    name: str, subject: Banner | None, packs: Packs, settings: Settings
) -> dict[str, bytes]:
    """The files `NAME.bin`, what `scene_bytes` makes, and `NAME-still.bin`, which only pictures
    need; the first says why there is no picture where the second is missing."""
    scene, played, shown = _body_scene(subject, packs, settings, PATTERN_NAMES)
    files = {}
    try:
        files[f"{name}-still.bin"] = gzip.compress(_still(shown, settings), mtime=0)
        scene[0]["still"] = f"{name}-still.bin"
    except OptionError as error:
        scene[0]["noPicture"] = f"the picture cannot be drawn in a page: {error}"
    return {f"{name}.bin": _packed(scene, plans_of(played)), **files}


def called_kernels(files: Mapping[str, bytes]) -> set[str]:
    """The names of the kernels that the plans in these files call."""
    found = set()
    for name, file in files.items():
        data = gzip.decompress(file)
        if name.endswith("-still.bin"):
            found |= kernels_of(data)
            continue
        for part, array in unpack(data)[1].items():
            if part.startswith("plan"):
                found |= kernels_of(array.tobytes())
    return found


def fabric_bytes(packs: Packs, settings: Settings) -> bytes:
    """The file of a banner's plans in all fabrics: a message with an array for each.

    A byte is the one of the fabric's plan, exclusive or the byte of the scene's own plan. Raises as
    `scene_bytes` does.
    """

    def plan_of(asked: Settings) -> bytes:
        (plan,) = plans_of(played_body(body_of(Banner(), packs, asked), asked))
        return plan

    own, found = plan_of(settings), {}
    for name in get_args(FabricName):
        plan = plan_of(settings.changed(fabric=name))
        pair = [np.frombuffer(each, np.uint8) for each in (own, plan)]
        longest = max(map(len, pair))
        one, other = (np.pad(each, (0, longest - len(each))) for each in pair)
        found[name] = one ^ other
    return gzip.compress(pack({}, found), mtime=0)


def _body_scene(
    design: Banner | None, packs: Packs, settings: Settings, patterns: Sequence[str]
) -> tuple[_Message, PlayedSubject, Body]:
    """The scene, what plays in it, and what it shows."""
    body = body_of(design, packs, settings)
    staged = StagedBody(body, settings, curves=False)
    staging = staged.staging
    _check(staging.settings, staging.style, bool(staged.drapes) or settings.kind == "shield")
    styled = staging.style.has("material")  # its steps need all layers of one design
    shown, sheets = (body, None) if styled or not design else _with_sheets(body, packs, patterns)
    settings = staging.settings
    scene = _first_message(*_start(staged, shown), settings)
    points, aspect = staging.framed(_framed(staged)), settings.size[0] / settings.size[1]
    views = {name: astuple(frame_view(name, points, aspect)) for name in VIEWS}
    flag = scene[0]["runs"][-len(body.panels or body.parts)][0]
    tints = _tints(settings, partial(Staging, light=body.light))
    given = {name: getattr(settings, name) for name in ("fabric", "view", "daylight")}
    own = {name: value for name, value in given.items() if isinstance(value, str | float | int)}
    scene[0].update(sheets=sheets, turned=settings.turned, flag=flag)
    scene[0].update(views=views, daylights=tints, own=own)
    return scene, played_body(body, settings), shown


def _settled(garment: Garment, settings: Settings) -> Settings:
    """The settings of a garment's scene. Raises OptionError for what a page cannot show."""
    settings = settled(settings, Subject("garment"), own=garment.picture)
    staging = Staging(settings)
    _check(staging.settings, staging.style, True)
    return settings


def _worn_scene(worn: Dressed) -> _Message:
    staging = Staging(worn.settings)
    first, cloths = first_scene(worn), len(worn.cloths)
    last, figures = len(first.models) - cloths, len(worn.figures())
    grip = range(last, len(first.models))
    scene = _first_message(first, grip, staging.settings)
    header, _ = scene
    header.update(sheets=None, turned=staging.settings.turned)
    header["views"] = {name: astuple(_seen(worn, name)) for name in VIEWS}
    header["daylights"] = _tints(staging.settings, Staging)
    header["noPicture"] = "pictures of players and garments need Python"
    if figures:
        _add_figures(scene, figures, worn)
    return scene


def _add_figures(scene: _Message, count: int, worn: Dressed) -> None:
    """Say which vertices the wearer has, and what shows a texture.

    count: of its models, which come directly before those of the cloths; the first one is its body.
    """
    header, arrays = scene
    cloths = len(worn.cloths)
    last = len(header["runs"]) - cloths
    runs = header["runs"][last - count : last]
    if cloths:
        size = sum(vertices for _, vertices in runs)
        header["moving"].append([0, runs[0][0], size, "figure", "figureLight"])
    materials = arrays["materials"].reshape(-1, 4)[arrays["vertexMaterials"], :2].tolist()

    def layers(start: int) -> range:
        first, size = materials[start]
        return range(first, first + size)

    whole = [0, 0, UNITS, UNITS]
    header["textures"] = {"skin": {"shown": [*layers(runs[0][0])], "area": whole}}
    if cloths:
        shown = [layer for start, _ in header["grip"] for layer in layers(start)]
        header["textures"]["cape"] = {"shown": shown, "area": texture_areas(worn)[1]}
    elif count > 1:  # a shield: its plate, whose last layer lies on the front, and its handle
        *bare, front = layers(runs[1][0])
        bare += [layer for start, _ in runs[2:] for layer in layers(start)]
        header["textures"]["shield"] = {"shown": [front], "area": whole}
        header["textures"]["shieldBase"] = {"shown": bare, "area": whole}


def _first_message(scene: Scene, cloths: range, settings: Settings) -> _Message:
    """The scene at its start, and what moves in it."""
    header, arrays = scene_message(scene, cloths)
    moving = [[n, *run, "vertices", "light"] for n, run in enumerate(header["grip"])]
    return {**header, "aspect": settings.size[0] / settings.size[1], "moving": moving}, arrays


def _packed(scene: _Message, plans: Sequence[bytes]) -> bytes:
    header, arrays = scene
    for number, plan in enumerate(plans):
        arrays[f"plan{number}"] = np.frombuffer(plan, np.uint8)
    if max(header["atlas"]) > MAX_SIDE:
        width, height = header["atlas"]
        raise OptionError(f"the textures fill {width} x {height} texels; use smaller packs")
    return gzip.compress(pack(header, arrays), mtime=0)


def _still(body: Body, settings: Settings) -> bytes:
    """The plan of a picture, without its atlas. Raises OptionError for what needs Python."""
    if body.period:
        raise OptionError("animated textures need Python; use packs without them")
    panel = live_picture(body, settings, LANES)
    panel.arrays["atlas"][:] = 0
    return write_plan(panel, module_info(read_module()))


def _seen(worn: Dressed, view: str) -> Camera:
    """The camera of a view of a garment."""
    return first_scene(replace(worn, settings=worn.settings.changed(view=view))).camera


def _tints(
    settings: Settings, stage: Callable[[Settings], Staging]
) -> list[tuple[float, float, float]]:
    return [stage(settings.changed(daylight=daylight)).light.tint for daylight in DAYLIGHTS]


def _check(settings: Settings, style: Style, moves: bool) -> None:
    """Raise OptionError for what a page cannot show."""
    if not moves:
        remedy = "use kind banner or cape, pose cloth, placement standing or wall"
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
    """The body whose flag, or the plate of a shield, has the sheets of all patterns as layers, and
    the names of these."""
    names = ["", *dict.fromkeys(("base", *patterns))]
    kind: Literal["banner", "shield"] = "banner" if body.panels else "shield"
    bare = packs.base_sheet() if body.panels else packs.base("shield_base")
    texels = [bare, *(packs.sheet(name, kind) for name in names[1:])]
    material = Material(tuple(map(TextureLayer, texels)))
    at: MaterialAt = lambda time: material  # noqa: E731
    if not body.panels:
        plate, *others = body.parts
        return replace(body, parts=(replace(plate, material_at=at), *others)), names
    panels = (replace(p, piece=replace(p.piece, material_at=at)) for p in body.panels)
    return replace(body, panels=tuple(panels)), names


def _start(staged: StagedBody, shown: Body) -> tuple[Scene, range]:
    """The scene at its start, and the numbers of the models that are cloth."""
    staging, meshes = staged.staging, staged.at_rest()
    models = staged.models(meshes, 0.0, shown)
    shadow = None
    if staging.settings.shadow:
        shadow = staging.contact(models, floor_under(meshes))
    scene = staging.scene(models, staging.camera(_framed(staged), staging.aspect), shadow)
    last = len(scene.models)
    return scene, range(last - len(staged.body.panels), last)


def _framed(staged: StagedBody) -> list[Array]:
    """What cameras frame [m], each [N, 3]."""
    return [*(mesh.positions for mesh in staged.at_rest()), *_swings(staged)]


def _swings(staged: StagedBody) -> list[Array]:
    """Where light wind moves the cloth [m], each [N, 3]."""
    points = [
        panel.cloth.make_cloth().rest_positions + panel.origin + swing
        for panel in staged.body.panels
        for swing in SWINGS
    ]
    nothing = np.zeros((0, 3), np.int32)
    return [staged.staging.turned(Mesh(each, each, nothing, each)).positions for each in points]
