"""What one may ask of a picture: the options of the commands and of `draw`, by the same names."""

import math
from dataclasses import dataclass
from numbers import Integral, Real
from pathlib import Path
from typing import Literal, TypedDict, get_args

from drapery.errors import OptionError

Kind = Literal["auto", "banner", "shield", "cape", "elytra"]
Pose = Literal["cloth", "vanilla"]
Placement = Literal["standing", "wall", "item"]
Facing = Literal["south", "west", "north", "east"]
LayerMode = Literal["stacked", "flat"]
SolverName = Literal["desbrun", "xpbd", "pbd", "verlet", "provot", "implicit"]
Pins = Literal["none", "top", "corners", "three-corners", "four-corners"]
Samples = Literal[1, 4, 16]
Lighting = Literal["game", "flat"]

MAX_SIDE = 8192
"""The widest and tallest picture [pixels]."""
MAX_GRID = 129
"""The most particles along one side of a flag."""
MAX_WIND = 40.0
"""Beyond a hurricane's [m/s]."""
MAX_FRAMES = 3600
MAX_PIXEL = 64
MAX_LIGHT = 15
"""Light levels as the game counts them."""
ROTATIONS = 16
"""A standing banner turns in steps of a sixteenth."""
MAX_FORMAT = 9999
"""Pack formats beyond this are a slip of the finger; 1.21.11 has 75."""


class Options(TypedDict, total=False):
    """Keyword options of `draw` and `animate`; see `Settings` for what each means."""

    packs: tuple[str | Path, ...] | list[str | Path]
    format: int | None
    kind: Kind
    texture: str | Path | None
    pose: Pose
    placement: Placement
    rotation: int
    facing: Facing | None
    view: str
    size: tuple[int, int]
    grid: tuple[int, int]
    solver: SolverName
    pins: Pins | None
    wind: float
    direction: float | None
    gusts: float
    time: float
    seed: int
    layers: LayerMode
    pbr: bool
    thickness: float
    background: str
    samples: Samples
    pixel: int
    light: Lighting
    block_light: int
    sky_light: int
    daylight: float
    shadow: bool
    backend: str


@dataclass(frozen=True)
class Settings:
    """Checked options. Raises OptionError, naming the option and what it may be.

    packs: resource packs (folder, zip or jar) laid over our own art; later ones win.
    format: the pack format of the game to be (46 is 1.21.4); None reads each pack as its newest.
    kind: what is drawn: `banner`, `shield`, `cape` or `elytra`; `auto` is what the design is of.
    texture: the picture that a cape or elytra wears, as players have it: 64 x 32, or a multiple.
    pose: `cloth` is simulated; `vanilla` is the game's own stiff board.
    placement: `standing` on a pole, hung on a `wall`, or an `item` in its slot of the inventory.
    rotation: which way what stands is turned, in sixteenths: 0 south, 4 west, 8 north, 12 east.
    facing: which way a banner on a wall looks; south where none is given.
    view: a named view of `drapery.render.views`: front, back, iso, gui, hero.
    size: width and height of the picture [pixels].
    grid: particles across and down the cloth.
    solver: the method that moves it; docs/solvers.md says which is for what.
    pins: where the cloth is held; None is as its kind hangs, a banner's by its top row.
    wind: mean wind speed [m/s].
    direction: where the wind blows to [degrees]: 0 is straight out of the front, 90 to the right
        of one who looks at it; None is out of the front and a little to the right.
    gusts: their rms over the mean speed of the wind.
    time: how long the cloth has hung in the wind when the picture is taken [s].
    seed: which gusts blow.
    layers: `stacked` quads, as in the game, or one `flat` composite.
    pbr: whether the packs' LabPBR maps count. `soft` lights every texel by its own normal,
        `pyrender` by roughness, metal and glow as well.
    thickness: of the cloth, in texels of the flag (1/24 m); 0 is a bare sheet.
    background: `transparent` or `#rrggbb`.
    samples: 1, 4 or 16 for each pixel; 1 is pixel art's hard edge.
    pixel: the picture is drawn smaller by this and every pixel enlarged to a square of it.
    light: the `game`'s two lights, or `flat`, the plain colours of the textures.
    block_light, sky_light: levels 0..15 of torches and of the sky where the banner hangs.
    daylight: 1 at noon, 0 at night.
    shadow: a soft shadow on the floor beneath.
    backend: `auto`, `soft`, `pyrender`, or one that an installed package adds.
    """

    packs: tuple[str | Path, ...] | list[str | Path] = ()
    format: int | None = None
    kind: Kind = "auto"
    texture: str | Path | None = None
    pose: Pose = "cloth"
    placement: Placement = "standing"
    rotation: int = 0
    facing: Facing | None = None
    view: str = "front"
    size: tuple[int, int] = (512, 512)
    grid: tuple[int, int] = (5, 9)
    solver: SolverName = "desbrun"
    pins: Pins | None = None
    wind: float = 4.0
    direction: float | None = None
    gusts: float = 0.4
    time: float = 3.0
    seed: int = 0
    layers: LayerMode = "stacked"
    pbr: bool = False
    thickness: float = 1.0
    background: str = "transparent"
    samples: Samples = 1
    pixel: int = 1
    light: Lighting = "game"
    block_light: int = 0
    sky_light: int = MAX_LIGHT
    daylight: float = 1.0
    shadow: bool = False
    backend: str = "auto"

    def __post_init__(self) -> None:
        object.__setattr__(self, "packs", _paths(self.packs))
        check_format(self.format)
        one_of("kind", self.kind, get_args(Kind))
        one_of("pose", self.pose, get_args(Pose))
        one_of("placement", self.placement, get_args(Placement))
        self._check_turn()
        one_of("layers", self.layers, get_args(LayerMode))
        one_of("solver", self.solver, get_args(SolverName))
        if self.pbr and self.layers == "flat":
            raise OptionError("pbr needs each layer's own maps; use layers stacked")
        for side, pixels in zip(("width", "height"), _two("size", self.size), strict=True):
            whole(f"size ({side})", pixels, 1, MAX_SIDE, "pixels")
        for side, count in zip(("columns", "rows"), _two("grid", self.grid), strict=True):
            whole(f"grid ({side})", count, 2, MAX_GRID, "particles")
        if self.pins is not None:
            one_of("pins", self.pins, get_args(Pins))
        within("wind", self.wind, 0, MAX_WIND, "m/s")
        if self.direction is not None:
            within("direction", self.direction, -360, 360, "degrees")
        within("gusts", self.gusts, 0, 2)
        within("time", self.time, 0, 3600, "s")
        whole("seed", self.seed, 0, 2**32 - 1)
        within("thickness", self.thickness, 0, 8, "texels")
        background_colour(self.background)
        self._check_picture()

    def _check_picture(self) -> None:
        if self.samples not in get_args(Samples):
            raise OptionError(f"samples {self.samples} is not known; use one of: 1, 4, 16")
        whole("pixel", self.pixel, 1, MAX_PIXEL)
        if any(side % self.pixel for side in self.size):
            width, height = self.size
            raise OptionError(
                f"size {width}x{height} is not whole in pixels of {self.pixel}; use a multiple"
            )
        one_of("light", self.light, get_args(Lighting))
        whole("block_light", self.block_light, 0, MAX_LIGHT)
        whole("sky_light", self.sky_light, 0, MAX_LIGHT)
        within("daylight", self.daylight, 0, 1)

    def _check_turn(self) -> None:
        whole("rotation", self.rotation, 0, ROTATIONS - 1)
        if self.facing is not None:
            one_of("facing", self.facing, get_args(Facing))
            if self.placement != "wall":
                raise OptionError(f"facing {self.facing} is of banners on a wall; use rotation")
        if self.rotation and self.placement != "standing":
            remedy = "use facing on a wall" if self.placement == "wall" else "leave it out"
            raise OptionError(f"rotation {self.rotation} is of what stands; {remedy}")

    @property
    def drawn_size(self) -> tuple[int, int]:
        """Width and height [pixels] of the picture before its pixels are enlarged."""
        return self.size[0] // self.pixel, self.size[1] // self.pixel

    @property
    def turned(self) -> float:
        """The angle of rotation or facing [degrees]: 0 south, 90 west, 180 north, 270 east."""
        if self.facing is not None:
            return 90.0 * get_args(Facing).index(self.facing)
        return self.rotation * 360.0 / ROTATIONS


def one_of(option: str, value: str, allowed: tuple[str, ...]) -> None:
    """Raise OptionError unless the value is one of those allowed."""
    if value not in allowed:
        raise OptionError(f"{option} {value!r} is not known; use one of: {', '.join(allowed)}")


def within(option: str, value: float, least: float, most: float, unit: str = "") -> None:
    """Raise OptionError unless the value is a finite number between two bounds."""
    limits = f"{least:g} to {most:g} {unit}".strip()
    if not _is(value, Real):
        raise OptionError(f"{option} {value!r} is no number; use {limits}")
    if not (math.isfinite(value) and least <= value <= most):
        raise OptionError(f"{option} {value:g} is out of range; use {limits}")


def whole(option: str, value: int, least: int, most: int, unit: str = "") -> None:
    """Raise OptionError unless the value is a whole number between two bounds."""
    within(option, value, least, most, unit)
    if not _is(value, Integral):
        raise OptionError(f"{option} {value:g} is no whole number; round it")


def _is(value: object, kind: type) -> bool:
    return isinstance(value, kind)


def check_format(number: int | None) -> None:
    """Raise OptionError unless this may be the number of a pack format; None is the newest."""
    if number is not None:
        whole("format", number, 1, MAX_FORMAT)


def _paths(packs: object) -> tuple[str | Path, ...]:
    # A text is a sequence too, of letters.
    if not isinstance(packs, tuple | list):
        raise OptionError(f"packs {str(packs)!r} is no list; put it in brackets: [{str(packs)!r}]")
    return tuple(packs)


def _two(option: str, value: object) -> tuple[int, int]:
    if not isinstance(value, tuple | list) or len(value) != 2:
        raise OptionError(f"{option} {value!r} is not a pair of whole numbers; write it (512, 512)")
    first, second = value
    return first, second


def background_colour(text: str) -> tuple[int, int, int, int]:
    """`transparent` or `#rrggbb` as straight-alpha sRGB. Raises OptionError."""
    if text == "transparent":
        return 0, 0, 0, 0
    digits = str(text).removeprefix("#")
    if len(digits) != 6 or not all(c in "0123456789abcdefABCDEF" for c in digits):
        raise OptionError(f"background {text!r} is not a colour; use transparent or #rrggbb")
    red, green, blue = bytes.fromhex(digits)
    return red, green, blue, 255


def pair(option: str, text: str) -> tuple[int, int]:
    """Two whole numbers written `512x512`. Raises OptionError."""
    first, cross, second = text.lower().partition("x")
    if not (
        cross
        and first.isascii()
        and first.isdigit()
        and second.isascii()
        and second.isdigit()
        and len(text) < 16
    ):
        raise OptionError(f"{option} {text!r} is not two whole numbers; write it like 512x512")
    return int(first), int(second)
