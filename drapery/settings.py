"""The table of options: what a picture may be asked for, once for all ways of asking.

`Settings` holds the values, `OPTIONS` describes them. The command line, HTTP parameters, columns of
manifests, files of cases and the studio's fields are made from the table.
"""
# ruff: noqa: RUF009 (`option_field` returns a dataclass field)

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import wraps
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Literal, Protocol, TypeAlias, TypedDict, Unpack, get_args

from drapery.errors import OptionError, shown
from drapery.option import Effect, Option, Output, Subject, option_field, option_table, within

if TYPE_CHECKING:
    from drapery.arrays import Texels
    from drapery.cloth import Fabric, Force, Solver, Wind
    from drapery.packs import PackLike
    from drapery.render import DrawScene, View

Kind = Literal["auto", "banner", "shield", "cape", "elytra"]
Pose = Literal["cloth", "vanilla"]
Placement = Literal["standing", "wall", "item"]
Facing = Literal["south", "west", "north", "east"]
LayerMode = Literal["stacked", "flat"]
FabricName = Literal["wool", "cotton", "linen", "silk", "canvas", "leather", "felt"]
SolverName = Literal["desbrun", "xpbd", "pbd", "verlet", "provot", "implicit"]
Pins = Literal["none", "top", "corners", "three-corners", "four-corners"]
ViewName = Literal["front", "back", "iso", "gui", "hero"]
Samples = Literal[1, 4, 16]
Contact = Literal["none", "world", "all"]
Lighting = Literal["game", "flat", "studio"]
FinishName = Literal["fabric", "plain"]

MAX_SIDE = 8192
"""The widest and tallest picture [pixels]."""
MAX_GRID = 129
"""The most particles along one side of a flag."""
MAX_WIND = 40.0
"""Beyond a hurricane's [m/s]."""
MAX_GUSTS = 2.0
"""The strongest gusts, over the mean wind speed."""
MAX_FRAMES = 3600
MAX_PIXEL = 64
MAX_LIGHT = 15
"""Light levels as the game counts them."""
ROTATIONS = 16
"""A standing banner turns in steps of a sixteenth."""
MAX_FORMAT = 9999
"""Larger pack formats are a typing error; 26.3 has 97."""


_BY_FILE = ("garment", "player")
"""Subjects whose files describe their cloth."""


class StyleObject(Protocol):
    """What `style` takes in place of a name: a `drapery.styles.Style`."""

    @property
    def steps(self) -> Sequence[Any]:
        """What it does, in order."""

    def settle(self, settings: Settings) -> Settings:
        """The settings with its own where they give none."""


StyleLike: TypeAlias = str | Path | StyleObject
"""A style: its name, its file or the object."""


class Options(TypedDict, total=False):
    """Keyword options of `draw` and `animate`; see `Settings` for what each means."""

    packs: PackLike | Sequence[PackLike]
    format: int | None
    kind: Kind
    texture: str | Path | Texels | None
    pose: Pose
    placement: Placement
    rotation: int
    facing: Facing | None
    view: str | View
    turntable: bool
    size: tuple[int, int]
    grid: tuple[int, int]
    solver: SolverName | Solver
    fabric: FabricName | Fabric
    forces: Sequence[Force]
    pins: Pins | None
    contact: Contact
    wind: float | Wind
    direction: float | None
    gusts: float
    time: float
    seed: int
    layers: LayerMode
    pbr: bool
    style: StyleLike | Sequence[StyleLike]
    finish: FinishName | None
    thickness: float
    background: str
    ground: str | None
    samples: Samples | None
    pixel: int
    light: Lighting | None
    block_light: int
    sky_light: int
    daylight: float
    shadow: bool
    backend: str | DrawScene


def _has(*attributes: str) -> Callable[[object], bool]:
    """A test for objects with all of these attributes, which needs no import of their class."""
    return lambda value: (
        not isinstance(value, type) and all(hasattr(value, name) for name in attributes)
    )


def _is_pack(value: object) -> bool:
    return _has("sheet", "base")(value) or _has("read", "label")(value)


def _is_force(value: object) -> bool:
    return any(_has(name)(value) for name in ("acceleration", "rate", "velocity"))


def _is_style(value: object) -> bool:
    return isinstance(value, Path) or _has("steps", "settle")(value)


def _ground_of(settings: Settings) -> str:
    """The block of the ground or wall where none is given."""
    if settings.is_hero:
        return "stone_bricks" if settings.placement == "wall" else "grass"
    return "none"


def _light_of(settings: Settings) -> str:
    """The light where none is given."""
    return "studio" if settings.is_hero else "game"


def _finish_of(settings: Settings) -> str:
    """The finish where none is given: styles and the game's lights have a look of their own."""
    is_studio = (settings.as_given("light") or _light_of(settings)) == "studio"
    shown = is_studio and settings.pose == "cloth" and settings.backend != "pyrender"
    return "fabric" if shown and not settings.style and not settings.pbr else "plain"


def _with_given(made: Any) -> Any:
    """Let `Settings.given` hold the names in a call; `replace` hands on those of before."""
    fill = made.__init__

    @wraps(fill)
    def init(self: Any, *args: Any, given: frozenset[str] | None = None, **options: Any) -> None:
        fill(self, *args, given=frozenset(options) if given is None else given, **options)

    made.__init__ = init
    return made


@_with_given
@dataclass(frozen=True)
class Settings:
    """Checked options of a picture.

    An option whose default depends on others has the value that counts when it is read; `changed`
    makes it anew unless it was given, and `dataclasses.replace` keeps it.

    given: the names of those that were given, and of all that differ from their default.

    Raises OptionError that names the option and its limits.
    """

    packs: PackLike | Sequence[PackLike] = option_field(
        (),
        Path,
        "Resource packs (folder, zip or jar); where several have a file, the last one counts",
        several=True,
        takes=_is_pack,
        flag="--pack",
        metavar="PATH",
        affects=("surface",),
        not_for=("link",),
    )
    format: int | None = option_field(
        None,
        int,
        "Read packs as the game of this pack format does; 46 is 1.21.4",
        bounds=(1, MAX_FORMAT),
        default_text="newest",
        metavar="N",
        affects=("surface",),
    )
    kind: Kind = option_field(
        "auto",
        str,
        "What is drawn; auto takes it from the design",
        choices=get_args(Kind),
        audience="anyone",
        affects=("motion", "shape"),
        not_for=(*_BY_FILE, "link"),
    )
    texture: str | Path | Texels | None = option_field(
        None,
        Path,
        "Texture of a cape or elytra: a PNG file, 64 x 32 or a multiple",
        takes=_has("shape", "dtype"),
        default_text="elytra.png of the packs",
        metavar="FILE",
        affects=("surface",),
        not_for=("banner", "shield", "player", "face", "link"),
        remedy="for a cape use kind cape, for a player cape",
    )
    pose: Pose = option_field(
        "cloth",
        str,
        "cloth is simulated; vanilla is the game's stiff sway",
        choices=get_args(Pose),
        audience="anyone",
        affects=("motion", "shape"),
        not_for=(*_BY_FILE, "shield", "elytra", "item", "page"),
    )
    placement: Placement = option_field(
        "standing",
        str,
        "On a pole, on a wall, or an item in its slot of the inventory",
        choices=get_args(Placement),
        audience="anyone",
        affects=("motion", "shape", "camera"),
        not_for=_BY_FILE,
    )
    rotation: int = option_field(
        0,
        int,
        "Turn of a standing banner in sixteenths: 0 south, 4 west, 8 north, 12 east",
        bounds=(0, ROTATIONS - 1),
        audience="anyone",
        affects=("shape", "camera"),
        not_for=("wall", "item"),
    )
    facing: Facing | None = option_field(
        None,
        str,
        "Where a banner on a wall looks to",
        choices=get_args(Facing),
        default_text="south",
        audience="anyone",
        affects=("shape",),
        not_for=("standing", "item", *_BY_FILE),
    )
    view: str | View = option_field(
        "front",
        str,
        "Where the camera stands",
        choices=get_args(ViewName),
        takes=_has("azimuth", "elevation", "fov"),
        audience="anyone",
        affects=("camera",),
    )
    turntable: bool = option_field(
        False,
        bool,
        "Let the camera go once around the subject in the time of an animation",
        audience="anyone",
        affects=("camera",),
        not_for=("still", "page", "model"),
    )
    size: tuple[int, int] = option_field(
        (512, 512),
        int,
        "Width and height of the picture",
        bounds=(1, MAX_SIDE),
        unit="pixels",
        parts=("width", "height"),
        audience="anyone",
        affects=("camera", "file"),
    )
    grid: tuple[int, int] = option_field(
        (16, 31),
        int,
        "Particles across and down the cloth",
        bounds=(2, MAX_GRID),
        unit="particles",
        parts=("columns", "rows"),
        audience="anyone",
        affects=("motion",),
        not_for=_BY_FILE,
    )
    solver: SolverName | Solver = option_field(
        "xpbd",
        str,
        "Method that moves the cloth",
        choices=get_args(SolverName),
        takes=_has("init", "step"),
        affects=("motion",),
    )
    fabric: FabricName | Fabric = option_field(
        "wool",
        str,
        "Material of the cloth",
        choices=get_args(FabricName),
        takes=_has("density", "stretch", "bending"),
        audience="anyone",
        affects=("motion", "wind"),
        not_for=_BY_FILE,
    )
    forces: Sequence[Force] = option_field(
        (),
        None,
        "forces on the cloth beside gravity and the wind",
        takes=_is_force,
        several=True,
        audience="python",
        affects=("motion",),
    )
    pins: Pins | None = option_field(
        None,
        str,
        "Where the cloth is held",
        choices=get_args(Pins),
        default_text="as its kind hangs",
        audience="anyone",
        affects=("motion",),
        not_for=_BY_FILE,
    )
    contact: Contact = option_field(
        "all",
        str,
        "What the cloth cannot pass through: nothing, the world around it, or all: itself too",
        choices=get_args(Contact),
        audience="anyone",
        affects=("motion",),
        not_for=_BY_FILE,
    )
    wind: float | Wind = option_field(
        4.0,
        float,
        "Mean wind speed",
        bounds=(0, MAX_WIND),
        unit="m/s",
        takes=_has("velocity", "gusts"),
        audience="anyone",
        affects=("wind",),
    )
    direction: float | None = option_field(
        None,
        float,
        "Where the wind blows to: 0 out of the front, 90 to the viewer's right",
        bounds=(-360, 360),
        unit="degrees",
        default_text="19.3",
        metavar="DEGREES",
        audience="anyone",
        affects=("wind",),
    )
    gusts: float = option_field(
        0.4,
        float,
        "Strength of the gusts: their rms over the mean wind speed",
        bounds=(0, MAX_GUSTS),
        audience="anyone",
        affects=("wind",),
    )
    time: float = option_field(
        3.0,
        float,
        "How long the cloth has hung in the wind when it is drawn",
        bounds=(0, 3600),
        unit="s",
        audience="anyone",
        affects=("motion", "animation"),
        not_for=("loop",),
    )
    seed: int = option_field(
        0,
        int,
        "Number that selects a sequence of gusts",
        bounds=(0, 2**32 - 1),
        audience="anyone",
        affects=("wind",),
    )
    layers: LayerMode = option_field(
        "stacked",
        str,
        "Quads one over the other as in the game, or one composite",
        choices=get_args(LayerMode),
        audience="anyone",
        affects=("surface",),
        not_for=(*_BY_FILE, "cape", "elytra", "page", "model", "face"),
    )
    pbr: bool = option_field(
        False,
        bool,
        "Light by the LabPBR maps of the packs (_n and _s)",
        affects=("surface",),
        not_for=(*_BY_FILE, "cape", "elytra", "page", "model", "face"),
    )
    style: StyleLike | Sequence[StyleLike] = option_field(
        (),
        str,
        "How it looks: the name of a style or a TOML file; several are applied in their order",
        several=True,
        takes=_is_style,
        ending=".toml",
        metavar="NAME|FILE",
        audience="anyone",
        affects=("shape", "surface", "light", "file"),
        not_for=("face",),
    )
    finish: FinishName = option_field(
        None,
        str,
        "The cloth's surface: weave, gloss and fuzz of its fabric, or plain",
        choices=get_args(FinishName),
        default_text="fabric in studio light without a style, else plain",
        audience="anyone",
        affects=("surface",),
        not_for=(
            *("shield", "elytra", "vanilla", "item"),
            *("page", "model", "face", "link"),
        ),
        resolve=_finish_of,
    )
    thickness: float = option_field(
        1.0,
        float,
        "Thickness of the cloth; a texel is 1/24 m, and 0 is a bare sheet",
        bounds=(0, 8),
        unit="texels",
        audience="anyone",
        affects=("motion", "shape"),
        not_for=(*_BY_FILE, "shield", "elytra"),
    )
    background: str = option_field(
        "transparent",
        str,
        "Colour behind the picture: transparent or #rrggbb",
        audience="anyone",
        affects=("file",),
    )
    ground: str = option_field(
        None,
        str,
        "Block below a standing banner, or wall behind one: none, grass, stone or another block",
        default_text="grass or stone_bricks in the hero view, else none",
        metavar="BLOCK",
        affects=("shape",),
        not_for=("item", "model"),
        resolve=_ground_of,
    )
    samples: Samples = option_field(
        None,
        int,
        "Samples of each pixel; 1 gives the hard edges of pixel art",
        choices=get_args(Samples),
        default_text="4 in the hero view, else 1",
        affects=("file",),
        resolve=lambda settings: 4 if settings.is_hero else 1,
    )
    pixel: int = option_field(
        1,
        int,
        "Draw smaller, then enlarge each pixel to a square of this side",
        bounds=(1, MAX_PIXEL),
        unit="pixels",
        affects=("file",),
        not_for=("page",),
    )
    light: Lighting = option_field(
        None,
        str,
        "The game's two lights, the flat colours of the textures, or lights that cast shadows",
        choices=get_args(Lighting),
        default_text="studio in the hero view, else game",
        affects=("light",),
        resolve=_light_of,
    )
    block_light: int = option_field(
        0,
        int,
        "Light level of torches",
        bounds=(0, MAX_LIGHT),
        affects=("light",),
    )
    sky_light: int = option_field(
        MAX_LIGHT,
        int,
        "Light level of the sky",
        bounds=(0, MAX_LIGHT),
        affects=("light",),
    )
    daylight: float = option_field(
        1.0,
        float,
        "1 at noon, 0 at night",
        bounds=(0, 1),
        affects=("light",),
    )
    shadow: bool = option_field(
        False,
        bool,
        "Draw a soft shadow on the floor",
        affects=("light",),
        not_for=("item",),
    )
    backend: str | DrawScene = option_field(
        "auto",
        str,
        "Renderer: auto, soft, pyrender, or one of an installed package",
        takes=callable,
        affects=("file",),
        not_for=("page", "link"),
    )
    given: frozenset[str] = field(default=frozenset(), compare=False, repr=False, kw_only=True)

    def __post_init__(self) -> None:
        changed: set[str] = set()
        for name, option in OPTIONS.items():
            value = getattr(self, name)
            if value is not option.default:
                value = option.check(value)
                object.__setattr__(self, name, value)
                if _differ(value, option.default):
                    changed.add(name)
        unset = {name for name in _RESOLVED if getattr(self, name) is None}
        object.__setattr__(self, "given", (self.given | changed) - unset)
        for name in unset:
            object.__setattr__(self, name, _RESOLVED[name](self))
        background_colour(self.background)
        self._check_turn()
        self._check_ground()
        if self.pbr and self.layers == "flat":
            raise OptionError("pbr needs the maps of each layer; use layers stacked")
        if self.pbr and self.finish == "fabric":
            raise OptionError("pbr has its own light for each texel; use finish plain")
        if self.backend == "pyrender" and self.finish == "fabric":
            raise OptionError("pyrender draws no finish of fabrics; use backend soft")
        if any(side % self.pixel for side in self.size):
            size = OPTIONS["size"].to_text(self.size)
            raise OptionError(f"size {size} is not a multiple of pixel {self.pixel}; use one")

    def __eq__(self, other: object) -> bool:
        return self is other or (isinstance(other, Settings) and self._values == other._values)

    def __hash__(self) -> int:
        return hash(self._values)

    @property
    def _values(self) -> tuple[Any, ...]:
        """All values as they were given: a style or kind may set what was not."""
        unset = _RESOLVED.keys() - self.given
        return tuple([None if name in unset else getattr(self, name) for name in OPTIONS])

    def _check_ground(self) -> None:
        if self.ground == "none":
            return
        if not re.fullmatch(r"([a-z0-9_.-]+:)?[a-z0-9_./-]{1,100}", self.ground):
            raise OptionError(
                f"ground {shown(self.ground)} is not a block; use none, grass, stone or the name"
                " of a block's texture"
            )
        if self.placement == "item":
            raise OptionError(f"ground {self.ground} is not for an item in its slot; leave it out")

    def _check_turn(self) -> None:
        if self.turntable and self.placement == "item":
            raise OptionError("turntable is not for an item in its slot; leave it out")
        if self.facing is not None and self.placement != "wall":
            raise OptionError(
                f"facing {self.facing} applies only to banners on a wall; use rotation"
            )
        if self.rotation and self.placement != "standing":
            remedy = "use facing on a wall" if self.placement == "wall" else "leave it out"
            raise OptionError(
                f"rotation {self.rotation} applies only to standing banners; {remedy}"
            )

    @property
    def given_values(self) -> dict[str, Any]:
        """The options that were given, by name."""
        return {name: getattr(self, name) for name in OPTIONS if name in self.given}

    def changed(self, **options: Unpack[Options]) -> Settings:
        """The settings with other values of some options, which count as given."""
        if not options:
            return self
        values: dict[str, Any] = dict(zip(OPTIONS, self._values, strict=True))
        values.update(options)
        return Settings(**values, given=self.given | options.keys())

    def as_given(self, name: str) -> Any:
        """The value of an option; None where it is not given and depends on others."""
        is_own = name not in _RESOLVED or name in self.given
        return getattr(self, name) if is_own else None

    def subject(self, kind: str = "banner") -> Subject:
        """What is drawn of a design of this kind."""
        return Subject(kind if self.kind == "auto" else self.kind, self.placement, self.pose)

    def only(self, *effects: Effect) -> Settings:
        """The settings with their options that affect one of these; the others have their default.

        Pictures whose cloth moves alike have equal ones of motion and wind.
        """
        kept = (name for name, o in OPTIONS.items() if not set(effects).isdisjoint(o.affects))
        return Settings(**{name: self.as_given(name) for name in kept})

    @property
    def is_hero(self) -> bool:
        """Whether the picture shows its subject in the hero view, which has defaults of its own."""
        return self.view == "hero" and self.placement != "item"

    @property
    def drawn_size(self) -> tuple[int, int]:
        """Width and height [pixels] of the picture before its pixels are enlarged."""
        return self.size[0] // self.pixel, self.size[1] // self.pixel

    @property
    def pack_paths(self) -> tuple[str | Path, ...]:
        """The packs as paths. Raises OptionError for a pack in memory, which no file holds."""
        packs: tuple[PackLike, ...] = OPTIONS["packs"].check(self.packs)
        paths = tuple(pack for pack in packs if isinstance(pack, str | Path))
        if len(paths) < len(packs):
            raise OptionError("packs: one is in memory; save it as a folder or zip, give its path")
        return paths

    @property
    def texture_path(self) -> str | Path | None:
        """The texture as a path. Raises OptionError for an array, which no file holds."""
        if self.texture is None or isinstance(self.texture, str | Path):
            return self.texture
        raise OptionError("texture: it is an array; save it as a PNG file, give its path")

    @property
    def wind_speed(self) -> float:
        """Mean speed of the wind [m/s]."""
        if isinstance(self.wind, int | float):
            return float(self.wind)
        return math.hypot(*self.wind.velocity)

    @property
    def turned(self) -> float:
        """The angle of rotation or facing [degrees]: 0 south, 90 west, 180 north, 270 east."""
        if self.facing is not None:
            return 90.0 * get_args(Facing).index(self.facing)
        return self.rotation * 360.0 / ROTATIONS


OPTIONS = option_table(Settings)
"""The options of a picture by name, in the order in which help lists them."""

_RESOLVED = {name: option.resolve for name, option in OPTIONS.items() if option.resolve}
"""The defaults that depend on other options."""

_OF_THE_WIND = frozenset(n for n, o in OPTIONS.items() if o.affects == ("wind",) and n != "wind")
"""The options that a `Wind` has in itself."""

NAMED_OPTIONS: Mapping[str, Option] = MappingProxyType(
    {name: option for name, option in OPTIONS.items() if option.audience != "python"}
)
"""The options that a text can set, so those of commands, manifests and pages."""

TEXTURED = tuple(kind for kind in get_args(Kind)[1:] if OPTIONS["texture"].applies(Subject(kind)))
"""The kinds that show a texture of the user in place of a design."""

_AS_LOOP = "name an animation such as x.gif, or leave it out"


@dataclass(frozen=True)
class LoopSettings:
    """Checked options that an animation has beside those of its pictures.

    Raises OptionError that names the option and its limits.
    """

    seconds: float = option_field(
        4.0,
        float,
        "Length of the loop",
        bounds=(1 / 120, MAX_FRAMES),
        unit="s",
        audience="anyone",
        affects=("motion", "file"),
        not_for=("still", "page"),
        remedy=_AS_LOOP,
    )
    fps: float = option_field(
        20.0,
        float,
        "Frames per second",
        bounds=(1, 120),
        unit="frames/s",
        audience="anyone",
        affects=("motion", "file"),
        not_for=("still", "page"),
        remedy=_AS_LOOP,
    )

    def __post_init__(self) -> None:
        for name in (name for name in LOOP_OPTIONS if name != "seconds"):
            LOOP_OPTIONS[name].check(getattr(self, name))
        # The bounds of the length depend on the rate.
        least, most = 1 / self.fps, MAX_FRAMES / self.fps
        within("seconds", self.seconds, least, most, f"s at {self.fps:g} frames/s")

    @property
    def count(self) -> int:
        """How many frames the animation has."""
        return max(1, round(self.seconds * self.fps))

    @property
    def length(self) -> float:
        """How long all frames play [s]."""
        return self.count / self.fps


LOOP_OPTIONS = option_table(LoopSettings)
"""The options of an animation by name, in the order in which help lists them."""


def settled(
    settings: Settings,
    subject: Subject,
    output: Output | None = None,
    own: Mapping[str, Any] = MappingProxyType({}),
) -> Settings:
    """The settings of a picture: the subject's own options, and in their place those given.

    own: options by name: those of the subject, or defaults of many subjects. Those that do nothing
    for the subject in the output are left out. An own rotation belongs to its own view: another
    view `front` or `back` shows that side.
    Raises OptionError for a given option that does nothing, unless it is None or as in `own`.
    """
    given = settings.given_values
    wind = given.get("wind", own.get("wind", 0.0))
    in_wind = frozenset() if isinstance(wind, int | float) else _OF_THE_WIND
    for name, value in settings.given_values.items():
        refusal = OPTIONS[name].refusal(subject, output)
        if refusal is None and name in in_wind and _differ(value, OPTIONS[name].default):
            refusal = f"{name} does nothing beside a Wind of your own; set it in that Wind"
        if refusal is None:
            continue
        if value is not None and (name not in own or _differ(value, own[name])):
            raise OptionError(refusal)
        del given[name]
    if not own and len(given) == len(settings.given):
        return settings
    turned = given.get("view") in ("front", "back") and "rotation" not in given
    kept = (name for name in own if not ((turned and name == "rotation") or name in in_wind))
    used = {name: own[name] for name in kept if OPTIONS[name].applies(subject, output)}
    return Settings(**used | given)


def settled_for(
    design: Any, settings: Settings, output: Output, own: Mapping[str, Any] = MappingProxyType({})
) -> Settings:
    """The same for a banner, a garment, or None for a cape, elytra or plain shield.

    own: more of its own options, before those of a garment.
    """
    picture = getattr(design, "picture", None)
    if picture is not None:
        return settled(settings, Subject("garment"), output, {**picture, **own})
    subject = settings.subject(design.kind if design else "banner")
    return settled(settings, subject, output, own)


def _differ(value: object, other: object) -> bool:
    """Whether two values differ; an array differs from all but itself."""
    if value is other:
        return False
    return not isinstance(value, str | int | float | tuple | Path) or value != other


def applicable(subject: Subject | None = None, output: Output | None = None) -> tuple[str, ...]:
    """The names of the options that a text can set and that apply to a subject in an output."""
    return tuple(name for name, o in NAMED_OPTIONS.items() if o.applies(subject, output))


def check_format(number: int | None) -> None:
    """Raise OptionError unless this may be the number of a pack format; None is the newest."""
    OPTIONS["format"].check(number)


def background_colour(text: str) -> tuple[int, int, int, int]:
    """`transparent` or `#rrggbb` as straight-alpha sRGB. Raises OptionError."""
    if text == "transparent":
        return 0, 0, 0, 0
    digits = text.removeprefix("#")
    if len(digits) != 6 or not all(c in "0123456789abcdefABCDEF" for c in digits):
        raise OptionError(f"background {shown(text)} is not a colour; use transparent or #rrggbb")
    red, green, blue = bytes.fromhex(digits)
    return red, green, blue, 255
