"""Cloth as data: the pieces of a garment, its seams, pins, fabric and wearer.

A file of TOML and a program in Python make the same objects. Lengths are in texels: 1/16 m, and
15/16 of that on a wearer, as the game draws its players. A piece is made in a frame of its own, x
to the right, y up, its front towards +z; `turn` and `place` then move it. A wearer stands at the
origin, its feet on y = 0, and looks to +z.
"""

import math
from collections.abc import Callable, Iterator, Sequence, Set
from inspect import Parameter, Signature
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, Self, get_type_hints

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Discriminator,
    Field,
    Tag,
    field_validator,
    model_validator,
)
from pydantic_core import PydanticCustomError

from drapery.banner.design import Banner
from drapery.banner.dyes import DYE_NAMES
from drapery.cloth import FABRICS, Fabric
from drapery.cloth.gathering import fold_count
from drapery.errors import DraperyError, OptionError, counted, shown
from drapery.garments.blends import POSE_ENDING, read_blend
from drapery.garments.loading import load_tables
from drapery.garments.profiles import is_profile_file
from drapery.mesh_file import MESH_ENDINGS
from drapery.option import Subject
from drapery.option_checks import unknown_names
from drapery.player_settings import MAX_SPEED
from drapery.settings import NAMED_OPTIONS, OPTIONS, Settings, applicable, settled
from drapery.style.equipment import SOLIDS, parse_armor, parse_trim
from drapery.style.figure import WING_JOINTS
from drapery.toml_text import Place

MAX_LENGTH = 1024
"""The longest length and the farthest place [texels]."""
MAX_PIECES = 64
"""The most pieces, pins, seams, poles and blocks of a garment, each."""
MAX_MESHES = 8
"""The most 3-D files of a garment."""
MAX_PARTICLES = 65
"""The most particles along one side of a piece."""
MAX_POINTS = 16_384
"""The most particles of all pieces of a garment, and of those over it."""
MIN_CELL = 0.1
"""The least distance between particles along the longest rows of a piece [texels]; cloth is much
thicker, so that finer cells only cover each other."""
NO_BONE = "fixed"
"""What a pin is fastened to if it does not move."""

BONES = {
    "player": ("head", "body", "right_arm", "left_arm", "right_leg", "left_leg"),
    "horse": ("head", "body", "right_arm", "left_arm", "right_leg", "left_leg"),
}
"""The bones of each wearer. The arms of a horse are its front legs."""
PIN_BONES = {"player": (*BONES["player"], *WING_JOINTS), "horse": BONES["horse"]}
"""What pins may be fastened to on each wearer; nothing but pins has the wings of a player."""

Length = Annotated[float, Field(strict=True, ge=-MAX_LENGTH, le=MAX_LENGTH)]
Extent = Annotated[float, Field(strict=True, ge=0.01, le=MAX_LENGTH)]
Angle = Annotated[float, Field(strict=True, ge=-360, le=360)]
Count = Annotated[int, Field(strict=True, ge=2, le=MAX_PARTICLES)]
Spot = tuple[Length, Length]
Point = tuple[Length, Length, Length]
Name = Annotated[str, Field(pattern=r"^[a-z][a-z0-9_-]{0,31}$")]
DyeName = Literal[DYE_NAMES]  # type: ignore[valid-type]
Area = tuple[Length, Length, Extent, Extent]


def _said(make: Callable[[Any], Any]) -> Callable[[Any], Any]:
    """A function whose errors pydantic reports with the place of the value."""

    def checked(value: Any) -> Any:
        try:
            return make(value)
        except DraperyError as error:
            raise ValueError(str(error)) from None
        except TypeError:
            raise ValueError(f"{shown(value)} cannot be used; give numbers") from None

    return checked


def _as_banner(value: str | Banner) -> Banner:
    return value if isinstance(value, Banner) else Banner.parse(value)


def _checked_armor(text: str) -> str:
    parse_armor(text)
    return text


def _checked_trim(text: str) -> str:
    parse_trim(text)
    return text


def _as_fabric(value: Any) -> Fabric:
    """A fabric, the name of a preset, or a mapping of its fields. Raises OptionError."""
    if isinstance(value, Fabric):
        return value
    if isinstance(value, str):
        if value not in FABRICS:
            known = ", ".join(FABRICS)
            raise OptionError(f"fabric {shown(value)} is not known; use one of: {known}")
        return FABRICS[value]
    names = Fabric.__dataclass_fields__
    if unknown := sorted(set(value) - set(names)):
        raise OptionError(f"fabric has no {unknown[0]}; use some of: {', '.join(names)}")
    return Fabric(**value)


def _as_options(given: Any) -> dict[str, Any]:
    """Options of pictures by name, checked. Raises OptionError."""
    if not isinstance(given, dict):
        raise OptionError(f"picture {shown(given)} is not a table; write picture = {{ wind = 3 }}")
    # A garment's pieces have their own textures, as a player has its cape's.
    usable = frozenset(applicable(Subject("player")))
    if strange := unknown_names(given, usable):
        raise OptionError(strange[0])
    return {name: NAMED_OPTIONS[name].parse(value) for name, value in given.items()}


def _as_mesh_file(file: Path) -> Path:
    if file.suffix.lower() not in MESH_ENDINGS:
        known = ", ".join(MESH_ENDINGS)
        raise OptionError(f"file {shown(file.name)} is not a 3-D file; use one of: {known}")
    return file


_ModelType: Any = type(BaseModel)


class Described(_ModelType):  # type: ignore[misc]
    """Models whose `help` shows what they have themselves, and the plain types of their fields."""

    def __init__(self, *given: Any, **options: Any) -> None:
        super().__init__(*given, **options)
        types = get_type_hints(self, localns={self.__name__: self})
        self.__signature__ = Signature(
            [
                Parameter(
                    name,
                    Parameter.KEYWORD_ONLY,
                    default=Parameter.empty if field.is_required() else field.default,
                    annotation=types[name],
                )
                for name, field in self.model_fields.items()
            ]
        )

    def __dir__(self) -> list[str]:
        own = set(super().__dir__()).difference(_OF_EVERY_MODEL)
        return [name for name in own if not name.startswith("__")]


_OF_EVERY_MODEL = frozenset(dir(BaseModel))


if TYPE_CHECKING:
    DescribedModel = BaseModel
else:

    class DescribedModel(BaseModel, metaclass=Described):
        """What has this kind of `help`."""


class GarmentTable(DescribedModel):
    """A table of a garment's file; it has no other fields, and never changes."""

    model_config = ConfigDict(extra="forbid", frozen=True, arbitrary_types_allowed=True)


class ClothTexture(GarmentTable):
    """What is drawn on a piece: a block, a banner's design, a file or a texture of the packs.

    block: the name of a block's texture, tiled.
    dye: multiplies it; None leaves it as it is.
    stripes: dyes that follow `dye` in turn, from left to right.
    bands: dyes that follow `dye` in turn, downwards.
    width: of each stripe or band [texels].
    trim: the dye of the lowest texels.
    trim_width: how high they are [texels].
    design: of a banner, as a text.
    file: a PNG file, relative to the garment's file.
    pack: the name of a texture of the packs, such as `entity/player/cape`.
    box: where a model's box lies on the texture, unfolded: left, top, width, height, depth
        [texels].
    front: the part on the front: left, top, width, height [texels]; the whole unless given.
    back: the part on the back, as `front`; the same as the front unless given.
    sheet: width and height of the texture in these units [texels].
    """

    block: Annotated[str, Field(pattern=r"^[a-z0-9_/.-]{1,64}$")] | None = None
    dye: DyeName | None = None
    stripes: tuple[DyeName, ...] = ()
    bands: tuple[DyeName, ...] = ()
    width: Annotated[int, Field(strict=True, ge=1, le=64)] = 4
    trim: DyeName | None = None
    trim_width: Annotated[int, Field(strict=True, ge=1, le=64)] = 1
    design: Annotated[Banner, BeforeValidator(_said(_as_banner))] | None = None
    file: Path | None = None
    pack: Annotated[str, Field(pattern=r"^[a-z0-9_/.:-]{1,128}$")] | None = None
    box: tuple[Length, Length, Extent, Extent, Extent] | None = None
    front: Area | None = None
    back: Area | None = None
    sheet: tuple[Extent, Extent] | None = None

    @property
    def source(self) -> Literal["block", "design", "file", "pack"]:
        """Which of the four it is; `block` if none is named."""
        given = [name for name in ("design", "file", "pack") if getattr(self, name) is not None]
        return given[0] if given else "block"  # type: ignore[return-value]

    @model_validator(mode="after")
    def _one_source(self) -> Self:
        names = ("block", "design", "file", "pack")
        given = [name for name in names if getattr(self, name) is not None]
        if len(given) > 1:
            raise ValueError(f"texture has both {given[0]} and {given[1]}; leave one out")
        if self.box and (self.front or self.back):
            raise ValueError("texture has both box and front or back; leave one out")
        return self


class GarmentPiece(GarmentTable):
    """What all pieces have.

    name: by which seams and pins name it.
    place: where its origin is [texels].
    turn: angles about x, then y, then z through its origin [degrees].
    mirror: the name of a second piece, this one mirrored at x = 0.
    layer: cloth of a higher layer stays outside cloth of lower ones.
    texture: by default the garment's.
    """

    name: Name
    place: Point = (0.0, 0.0, 0.0)
    turn: tuple[Angle, Angle, Angle] = (0.0, 0.0, 0.0)
    mirror: Name | None = None
    layer: Annotated[int, Field(strict=True, ge=0, le=8)] = 0
    texture: ClothTexture | None = None


class GridPiece(GarmentPiece):
    """A rectangle or trapezoid that hangs down from the middle of its upper edge.

    shape: "grid".
    size: width and height [texels].
    points: particles across and down.
    hem: the width of its lower edge [texels], if another.
    slack: the part of its size between its places at rest; below 1 it is loose.
    fullness: how much wider the cloth is than `size`, to which it begins gathered in folds, 0 to 1;
        only with 11 points across or more, and without `hem`.

    `GarmentPiece` has its other fields. Edges: top, bottom, left, right, the corners of two of them
    such as top-left, and corners.
    """

    shape: Literal["grid"] = "grid"
    size: tuple[Extent, Extent]
    points: tuple[Count, Count]
    hem: Extent | None = None
    slack: Annotated[float, Field(strict=True, ge=0.1, le=1)] = 1.0
    fullness: Annotated[float, Field(strict=True, ge=0, le=1)] = 0.0

    @model_validator(mode="after")
    def _one_width(self) -> Self:
        if self.fullness and self.hem is not None:
            raise ValueError("grid has both fullness and hem; leave one out")
        if self.fullness and not fold_count(self.points[0]):
            raise ValueError(
                f"fullness does nothing where points across are {self.points[0]};"
                " use 11 or more, or leave it out"
            )
        return self

    @property
    def particles(self) -> int:
        """How many particles it has, without those of its mirrored piece."""
        return self.points[0] * self.points[1]

    @property
    def cell(self) -> tuple[str, float]:
        """See `StripPiece.cell`; along its longer edge."""
        width, height = max(self.size[0], self.hem or 0), self.size[1]
        return "points", min(width / (self.points[0] - 1), height / (self.points[1] - 1))


class StripPiece(GarmentPiece):
    """A rope or ribbon from one place to another.

    shape: "strip".
    ends: where it starts and ends [texels].
    length: at least their distance [texels]; longer ones sag.
    width: across [texels].
    points: particles along it.

    `GarmentPiece` has its other fields. Edges: start, end.
    """

    shape: Literal["strip"]
    ends: tuple[Point, Point]
    length: Extent
    width: Extent = 1.0
    points: Count

    @property
    def particles(self) -> int:
        """How many particles it has, without those of its mirrored piece."""
        return 2 * self.points

    @property
    def cell(self) -> tuple[str, float]:
        """The field that sets how close its particles are, and their least distance [texels]."""
        return "points", self.length / (self.points - 1)

    @model_validator(mode="after")
    def _reaches(self) -> Self:
        (a, b), square = self.ends, 0.0
        for start, end in zip(a, b, strict=True):
            square += (end - start) ** 2
        if square == 0:
            raise ValueError("strip has both ends at one place; move one of them")
        if square**0.5 > self.length * (1 + 1e-9):
            raise ValueError(
                f"strip is {counted(self.length, 'texel')} long, its ends are {square**0.5:g}"
                " apart; make it longer"
            )
        return self


class RingPiece(GarmentPiece):
    """A tube about the y axis, such as a skirt, coat or tent.

    shape: "ring".
    profile: of rings from the top down: height, half width, half depth [texels].
    points: particles around and down.
    square: 2 is an ellipse, higher numbers are squarer.
    open: the angle of a gap at its front [degrees]; 0 closes it.

    `GarmentPiece` has its other fields. Edges: top, bottom, and of open ones left, right.
    """

    shape: Literal["ring"]
    profile: Annotated[
        tuple[tuple[Length, Extent, Extent], ...], Field(min_length=2, max_length=16)
    ]
    points: tuple[Annotated[int, Field(strict=True, ge=4, le=MAX_PARTICLES)], Count]
    square: Annotated[float, Field(strict=True, ge=1, le=16)] = 2.0
    open: Annotated[float, Field(strict=True, ge=0, le=300)] = 0.0

    @property
    def particles(self) -> int:
        """How many particles it has, without those of its mirrored piece."""
        return (self.points[0] + (self.open > 0)) * self.points[1]

    @property
    def cell(self) -> tuple[str, float]:
        """See `StripPiece.cell`; around its widest ring."""
        around = max(4 * math.hypot(wide, deep) for _, wide, deep in self.profile)
        around *= 1 - self.open / 360
        down = sum(map(math.dist, self.profile, self.profile[1:]))
        return "points", min(around / self.points[0], down / (self.points[1] - 1))


class DiscPiece(GarmentPiece):
    """A round cloth that lies level and faces up.

    shape: "disc".
    radius: [texels].
    rings: of particles.

    `GarmentPiece` has its other fields. Edges: rim, middle.
    """

    shape: Literal["disc"]
    radius: Extent
    rings: Annotated[int, Field(strict=True, ge=1, le=32)]

    @property
    def particles(self) -> int:
        """How many particles it has, without those of its mirrored piece."""
        return 1 + 3 * self.rings * (self.rings + 1)

    @property
    def cell(self) -> tuple[str, float]:
        """The field that sets how close its particles are, and their least distance [texels]."""
        return "rings", self.radius / self.rings


class PolygonPiece(GarmentPiece):
    """A flat piece of any outline.

    shape: "polygon".
    corners: x and y of each, counter-clockwise seen from the front [texels].
    spacing: between particles [texels].

    `GarmentPiece` has its other fields. Edges: rim, top, bottom, left, right, and side-1, side-2
    and so on, the first from corner 1 to corner 2.
    """

    shape: Literal["polygon"]
    corners: Annotated[tuple[Spot, ...], Field(min_length=3, max_length=64)]
    spacing: Extent

    @property
    def particles(self) -> int:
        """About how many particles it has."""
        around = area = 0.0
        for a, b in zip(self.corners, (*self.corners[1:], self.corners[0]), strict=True):
            around += math.dist(a, b)
            area += (a[0] * b[1] - b[0] * a[1]) / 2
        return round(around / 2 / self.spacing + area / (math.sqrt(0.75) * self.spacing**2))

    @property
    def cell(self) -> tuple[str, float]:
        """The field that sets how close its particles are, and their least distance [texels]."""
        return "spacing", self.spacing

    @field_validator("corners")
    @classmethod
    def _is_simple(cls, corners: tuple[Spot, ...]) -> tuple[Spot, ...]:
        following = (*corners[1:], corners[0])
        doubled = sum(a[0] * b[1] - b[0] * a[1] for a, b in zip(corners, following, strict=True))
        if doubled <= 0:
            raise ValueError("corners do not go round counter-clockwise; reverse them")
        return corners


def _shape_of(piece: Any) -> str:
    if isinstance(piece, dict):
        return str(piece.get("shape", "grid"))
    return str(getattr(piece, "shape", "grid"))


AnyPiece = Annotated[
    Annotated[GridPiece, Tag("grid")]
    | Annotated[StripPiece, Tag("strip")]
    | Annotated[RingPiece, Tag("ring")]
    | Annotated[DiscPiece, Tag("disc")]
    | Annotated[PolygonPiece, Tag("polygon")],
    Discriminator(_shape_of),
]


class GarmentPin(GarmentTable):
    """Particles that are held.

    piece: its name.
    at: an edge of it, or places in its own frame [texels], each of which holds the nearest
        particle.
    to: a bone of the wearer, or `fixed`.
    """

    piece: Name
    at: str | Annotated[tuple[Spot, ...], Field(min_length=1, max_length=64)]
    to: str = NO_BONE


class GarmentSeam(GarmentTable):
    """Two edges with as many particles each, which are sewn.

    join: a piece and its edge, such as `front.left`, twice.
    """

    join: tuple[str, str]

    @field_validator("join")
    @classmethod
    def _names_edges(cls, join: tuple[str, str]) -> tuple[str, str]:
        for side in join:
            if side.count(".") != 1:
                raise ValueError(f"join {shown(side)} is not a piece and an edge; write front.left")
        return join


class GarmentPole(GarmentTable):
    """A square pole of wood.

    start: the middle of its one end [texels].
    end: the middle of its other end [texels].
    half: half its width [texels].
    """

    start: Point
    end: Point
    half: Annotated[float, Field(strict=True, ge=0.1, le=16)] = 1.0

    @model_validator(mode="after")
    def _has_length(self) -> Self:
        if self.start == self.end:
            raise ValueError("pole starts where it ends; move its end")
        return self


class GarmentBlock(GarmentTable):
    """Blocks.

    cell: the lowest x, y and z of the first [blocks].
    size: how many along x, y and z.
    kind: the name of the block's texture, `grass`, or a dye for its wool.
    """

    cell: tuple[
        Annotated[int, Field(strict=True, ge=-64, le=64)],
        Annotated[int, Field(strict=True, ge=-64, le=64)],
        Annotated[int, Field(strict=True, ge=-64, le=64)],
    ]
    size: tuple[
        Annotated[int, Field(strict=True, ge=1, le=32)],
        Annotated[int, Field(strict=True, ge=1, le=32)],
        Annotated[int, Field(strict=True, ge=1, le=32)],
    ] = (1, 1, 1)
    kind: Annotated[str, Field(pattern=r"^[a-z0-9_/.-]{1,64}$")] = "stone"


class GarmentMesh(GarmentTable):
    """A stiff body of a 3-D file, which stops cloth.

    file: .glb, .obj, .ply or .stl, relative to the garment's file.
    place: where its origin is [texels].
    turn: angles about x, then y, then z through it [degrees].
    scale: the length of the file's unit [texels]; 16 for files in metres.
    """

    file: Annotated[Path, AfterValidator(_said(_as_mesh_file))]
    place: Point = (0.0, 0.0, 0.0)
    turn: tuple[Angle, Angle, Angle] = (0.0, 0.0, 0.0)
    scale: Extent = 16.0


class GarmentWearer(GarmentTable):
    """Who wears it.

    kind: player or horse.
    skin: of a player, `traveller` or `dancer`, or a PNG file of 64 x 64 or 64 x 32 texels, relative
        to the garment's file, or a profile of the game, as text or as a file, whose texture a pack
        has.
    speed: over the ground [m/s], the speed of the air from ahead; a walk of 0 stands.
    arms: slim, classic, or auto, which reads it from the skin.
    overlay: how the skin's second layer is drawn: flat, its texels as small boxes, or not at all.
    motion: `walk`, another motion of a player, or a pose in a JSON file; see `motion_names`.
        Several are layered by `walk+wave`, or averaged by `walk:0.7,wave:0.3`.
    look: how far a player's head turns to its left and downwards [degrees], or the point that it
        looks at: to its left, upwards from the ground, and ahead [m].
    shown: what the picture shows: full, bust or head.
    solid: the bones that stop its cloth; all of them unless given. `pole` and `bar` are those of a
        banner on the head, `armor` adds the armour on the bones.
    head: the design of a banner on a player's head.
    shield: the design of a shield in the left hand.
    armor: a material such as `diamond`, or pieces such as `helmet:iron,boots:gold`; the packs have
        their textures.
    trim: of the armour, such as `coast:gold`.
    """

    kind: Literal["player", "horse"] = "player"
    skin: str = "traveller"
    speed: Annotated[float, Field(strict=True, ge=0, le=MAX_SPEED)] = 0.0
    arms: Literal["auto", "classic", "slim"] = "auto"
    overlay: Literal["flat", "voxels", "none"] = "flat"
    motion: Annotated[str, Field(min_length=1, max_length=200)] = "walk"
    look: tuple[Angle, Angle] | Point = (0.0, 0.0)
    shown: Literal["full", "bust", "head"] = "full"
    solid: tuple[str, ...] | None = None
    head: Annotated[Banner, BeforeValidator(_said(_as_banner))] | None = None
    shield: Annotated[Banner, BeforeValidator(_said(_as_banner))] | None = None
    armor: Annotated[str, Field(max_length=200), AfterValidator(_said(_checked_armor))] | None = (
        None
    )
    trim: Annotated[str, Field(max_length=100), AfterValidator(_said(_checked_trim))] | None = None

    @model_validator(mode="after")
    def _is_for_players(self) -> Self:
        given = [n for n in ("head", "shield", "armor") if getattr(self, n) is not None]
        if self.kind == "horse" and given:
            raise ValueError(f"{given[0]} is for players; leave it out for a horse")
        if self.trim is not None and self.armor is None:
            raise ValueError(f'trim {self.trim} has no armor; add one, such as armor = "iron"')
        return self

    @model_validator(mode="after")
    def _knows_its_bones(self) -> Self:
        for bone in self.solid or ():
            if bone not in (*BONES[self.kind], *SOLIDS):
                known = ", ".join(BONES[self.kind])
                raise ValueError(f"solid {shown(bone)} is not a bone; use some of: {known}")
        if self.kind == "horse" and self.motion != "walk":
            raise ValueError(f"motion {shown(self.motion)} is for players; a horse walks")
        return self


class Garment(GarmentTable):
    """Cloth as data.

    name: shown in lists; the name of its file.
    description: one line about it.
    fabric: the name of a preset, or a table of the fields of `Fabric`.
    thickness: of the cloth, 0.05 to 16 [texels].
    collisions: what its cloth does not pass through: `none`, `world` (wearer, poles, blocks,
        meshes, ground), or `all` (itself too).
    resolution: texels to a block, 1 to 256.
    texture: of the pieces that have none of their own.
    folder: where relative paths of its textures start.
    picture: options of its pictures by name, unless the picture gives them; see `Settings`.
    wearer: a player or horse, which stands at the origin; without one, nobody wears it.
    piece: at most 64 pieces of cloth.
    pin: where they are held.
    seam: which of their edges are sewn together.
    pole: poles of wood; they and the other stiff bodies are drawn and stop cloth.
    block: blocks of the game.
    mesh: meshes of files.
    over: garments that its wearer wears over it; only their cloth counts.

    A program that makes one of wrong values gets pydantic's ValidationError, `load` an OptionError.
    """

    name: str = "garment"
    description: Annotated[str, Field(max_length=200)] = ""
    fabric: Annotated[Fabric, BeforeValidator(_said(_as_fabric))] = FABRICS["wool"]
    thickness: Annotated[float, Field(strict=True, ge=0.05, le=16)] = 1.0
    collisions: Literal["none", "world", "all"] = "world"
    resolution: Annotated[int, Field(strict=True, ge=1, le=256)] = 16
    texture: ClothTexture = ClothTexture()
    folder: Path = Path()
    picture: Annotated[dict[str, Any], BeforeValidator(_said(_as_options))] = {}
    wearer: GarmentWearer | None = None
    piece: Annotated[tuple[AnyPiece, ...], Field(max_length=MAX_PIECES)]
    pin: Annotated[tuple[GarmentPin, ...], Field(max_length=MAX_PIECES)] = ()
    seam: Annotated[tuple[GarmentSeam, ...], Field(max_length=MAX_PIECES)] = ()
    pole: Annotated[tuple[GarmentPole, ...], Field(max_length=MAX_PIECES)] = ()
    block: Annotated[tuple[GarmentBlock, ...], Field(max_length=MAX_PIECES)] = ()
    mesh: Annotated[tuple[GarmentMesh, ...], Field(max_length=MAX_MESHES)] = ()
    over: tuple["Garment", ...] = ()

    @model_validator(mode="after")
    def _names_fit(self) -> Self:
        for place, message in self._faults():
            raise PydanticCustomError("garment", "{said}", {"said": message, "place": place})
        return self

    def _faults(self) -> Iterator[tuple[Place, str]]:
        """What does not fit together: where, and a message."""
        if not self.piece and self.wearer is None:
            yield ("piece",), "piece is empty; give a garment at least one, or a wearer"
        yield from self._sizes_out_of_bounds()
        names: list[str] = []
        for number, piece in enumerate(self.piece):
            for field in ("name", "mirror"):
                name = getattr(piece, field)
                if name is None:
                    continue
                if name in names:
                    where = ("piece", number, field)
                    yield where, f"{field} {shown(name)} is taken; give each piece its own"
                names.append(name)
        known = ", ".join(names)
        for number, pin in enumerate(self.pin):
            if pin.piece not in names:
                message = f"piece {shown(pin.piece)} is not known; use one of: {known}"
                yield ("pin", number, "piece"), message
            if pin.to not in self.bones:
                bones = ", ".join(self.bones)
                remedy = f"use one of: {bones}" if self.wearer else "add a [wearer], or use fixed"
                yield ("pin", number, "to"), f"to {shown(pin.to)} is not known; {remedy}"
        if self.wearer is not None:
            try:
                read_blend(self.wearer.motion, self.folder)
            except OptionError as error:
                yield ("wearer", "motion"), str(error)
        for number, seam in enumerate(self.seam):
            for side in seam.join:
                if side.split(".")[0] not in names:
                    message = f"join {shown(side)} names no piece; use one of: {known}"
                    yield ("seam", number, "join"), message

    def _sizes_out_of_bounds(self) -> Iterator[tuple[Place, str]]:
        """Pieces whose cells are too small, and the piece with which it has too many particles."""
        count = sum(each.particles for each in self.over)
        if count > MAX_POINTS:
            most = max(self.over, key=lambda each: each.particles)
            yield (
                ("over",),
                f"over has {count} particles, {most.particles} of them in {most.name}; at most"
                f" {MAX_POINTS} are drawn: leave garments out, or give them fewer points",
            )
        for number, piece in enumerate(self.piece):
            field, cell = piece.cell
            if cell < MIN_CELL:
                fewer = "use a wider spacing" if field == "spacing" else f"use fewer {field}"
                yield (
                    ("piece", number, field),
                    f"{field} of piece {piece.name} puts particles {cell:.2g} texels apart, and"
                    f" the least is {MIN_CELL:g}; {fewer} or a larger piece",
                )
            before, count = count, count + piece.particles * (1 if piece.mirror is None else 2)
            if before <= MAX_POINTS < count:
                yield (
                    ("piece", number, field),
                    f"with piece {piece.name} the garment has {count} particles; at most"
                    f" {MAX_POINTS} are drawn: give its pieces fewer, or leave some out",
                )

    @property
    def particles(self) -> int:
        """How many particles its cloth has, with that over it; see `GarmentPiece.particles`."""
        own = sum(each.particles * (1 if each.mirror is None else 2) for each in self.piece)
        return own + sum(each.particles for each in self.over)

    @property
    def texel(self) -> float:
        """The length of a texel [m]."""
        return (1 if self.wearer is None else 15 / 16) / self.resolution

    @property
    def bones(self) -> tuple[str, ...]:
        """What pins may be fastened to."""
        return (NO_BONE, *(PIN_BONES[self.wearer.kind] if self.wearer else ()))

    @classmethod
    def load(cls, path: str | Path) -> "Garment":
        """The garment of a TOML file, named after it.

        Raises OptionError that names the file, the line, the field and the remedy.
        """
        target = Path(path)
        given = {"name": target.stem, "folder": target.parent}
        return load_tables(cls, target, given, TABLES)

    @property
    def shows_design(self) -> bool:
        """Whether a piece shows a banner's design."""
        return any((each.texture or self.texture).source == "design" for each in self.piece)

    def settings(self, **options: Any) -> Settings:
        """The settings of its picture. options: those that replace its own.

        Raises OptionError.
        """
        return settled(Settings(**options), Subject("garment"), own=self.picture)

    @property
    def paths(self) -> tuple[Path, ...]:
        """The files that it reads when it is drawn: textures, 3-D files, a skin and a pose."""
        textures = [each.texture or self.texture for each in self.piece]
        names: list[str | Path] = [each.file for each in textures if each.file is not None]
        names += [each.file for each in self.mesh]
        if self.wearer is not None:
            skin = self.wearer.skin
            is_file = skin.lower().endswith(".png") or is_profile_file(skin)
            names += [skin] if is_file else []
            names += read_blend(self.wearer.motion, self.folder).files
        own = (self.folder / name for name in names)
        return (*dict.fromkeys(own), *(path for each in self.over for path in each.paths))

    @property
    def named_paths(self) -> tuple[str, ...]:
        """All files and folders that it names, as it names them, whether they are read or not:
        the `paths`, and the packs, styles and textures of its pictures."""
        named = [str(path) for path in _paths_in(self)]
        if self.wearer is not None:
            skin = self.wearer.skin
            named += [skin] if skin.lower().endswith(".png") or is_profile_file(skin) else []
            named += [self.wearer.motion] if POSE_ENDING in self.wearer.motion.lower() else []
        for name, value in self.picture.items():
            values = value if isinstance(value, tuple) else (value,)
            named += [str(each) for each in values if OPTIONS[name].is_path(each)]
        return tuple(dict.fromkeys(named))

    def with_design(self, design: str | Banner) -> "Garment":
        """The garment with another design on the pieces that have one, or on all if none has,
        also on those of garments over it.

        Raises DesignError, and OptionError for a garment without cloth.
        """
        return self._with_source(("design",), ClothTexture(design=_as_banner(design)))

    def with_texture(self, texture: str | Path | ClothTexture) -> "Garment":
        """The garment with another texture, or a PNG file's, on the pieces that have a file
        or a texture of the packs, or on all if none has; their regions stay. Those of garments over
        it count too.

        Raises OptionError for a garment without cloth.
        """
        if not isinstance(texture, ClothTexture):
            texture = ClothTexture(file=Path(texture).absolute())
        return self._with_source(("file", "pack"), texture)

    def _with_source(self, sources: Sequence[str], new: ClothTexture) -> "Garment":
        found = {texture.source for texture in self._textures()}
        if not found:
            raise OptionError(f"garment {self.name} has no cloth to show it; give it a cape")
        return self._with_textures(found.intersection(sources), new)

    def _textures(self) -> Iterator[ClothTexture]:
        """Those of its pieces, then those of the garments over it."""
        yield from (each.texture or self.texture for each in self.piece)
        for each in self.over:
            yield from each._textures()

    def _with_textures(self, sources: Set[str], new: ClothTexture) -> "Garment":
        """With a new texture on the pieces of these sources, whose regions stay; none is all."""
        pieces = []
        for each in self.piece:
            texture = each.texture or self.texture
            if texture.source in sources:
                same = {name: getattr(texture, name) for name in ("box", "front", "back", "sheet")}
                pieces.append(each.model_copy(update={"texture": new.model_copy(update=same)}))
            else:
                pieces.append(each if sources else each.model_copy(update={"texture": new}))
        over = tuple(each._with_textures(sources, new) for each in self.over)
        return self.model_copy(update={"piece": tuple(pieces), "over": over})


def _paths_in(value: object) -> Iterator[Path]:
    """The paths in a table and those inside it; where a garment's relative paths start is none."""
    if isinstance(value, Path):
        yield value
    elif isinstance(value, GarmentTable):
        for name in type(value).model_fields:
            if name != "folder":
                yield from _paths_in(getattr(value, name))
    elif isinstance(value, tuple):
        for each in value:
            yield from _paths_in(each)


TABLES: dict[str, type[BaseModel]] = {
    "grid": GridPiece,
    "strip": StripPiece,
    "ring": RingPiece,
    "disc": DiscPiece,
    "polygon": PolygonPiece,
    "texture": ClothTexture,
    "wearer": GarmentWearer,
    "pin": GarmentPin,
    "seam": GarmentSeam,
    "pole": GarmentPole,
    "block": GarmentBlock,
    "mesh": GarmentMesh,
}
"""The tables of a file by name, those of pieces by their shape."""
