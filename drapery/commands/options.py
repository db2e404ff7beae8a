"""The options that several commands share."""

import inspect
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, TypeVar, cast

import typer

from drapery.settings import Options, pair

if TYPE_CHECKING:
    from drapery.banner.design import Banner

DesignArgument = Annotated[
    str,
    typer.Argument(
        metavar="DESIGN",
        help="A banner: a /give command, an item, JSON, a URL, 'white creeper:lime', a file, or -.",
        show_default=False,
    ),
]
OptionalDesign = Annotated[
    str | None,
    typer.Argument(
        metavar="DESIGN",
        help="A banner or shield: a /give command, an item, JSON, a URL, 'white creeper:lime',"
        " a file, or -. None for a cape, elytra or plain shield.",
        show_default=False,
    ),
]
FromOption = Annotated[
    str | None,
    typer.Option("--from", metavar="FORM", help="The form of DESIGN; it is told by itself."),
]
NumberOption = Annotated[
    int | None,
    typer.Option(metavar="N", help="Which banner, from 1, where DESIGN holds several."),
]
PackOption = Annotated[
    list[Path] | None,
    typer.Option("--pack", metavar="PATH", help="Resource pack (folder, zip, jar); later wins."),
]
FormatOption = Annotated[
    int | None,
    typer.Option(
        "--format",
        metavar="N",
        help="Read packs as the game of this pack format does (46 is 1.21.4).",
        show_default="newest",
    ),
]
KindOption = Annotated[
    str, typer.Option(help="banner, shield, cape or elytra; auto is what the design is of.")
]
TextureOption = Annotated[
    Path | None,
    typer.Option(metavar="FILE", help="What a cape or elytra wears: a PNG, 64 x 32 or larger."),
]
PoseOption = Annotated[
    str, typer.Option(help="cloth (simulated) or vanilla (the game's stiff sway).")
]
PlacementOption = Annotated[
    str, typer.Option(help="standing, wall, or item (as in the inventory).")
]
RotationOption = Annotated[
    int, typer.Option(help="Turned by sixteenths: 0 south, 4 west, 8 north, 12 east.")
]
FacingOption = Annotated[
    str | None,
    typer.Option(help="On a wall: south, west, north or east.", show_default="south"),
]
ViewOption = Annotated[str, typer.Option(help="front, back, iso, gui or hero.")]
SizeOption = Annotated[str, typer.Option(help="Width and height in pixels.")]
GridOption = Annotated[str, typer.Option(help="Particles across and down the cloth.")]
SolverOption = Annotated[str, typer.Option(help="desbrun, xpbd, pbd, verlet, provot or implicit.")]
WindOption = Annotated[float, typer.Option(help="Mean wind speed in m/s.")]
DirectionOption = Annotated[
    float | None,
    typer.Option(
        metavar="DEGREES",
        help="Where the wind blows to: 0 out of the front, 90 to the right.",
        show_default="19.3",
    ),
]
GustsOption = Annotated[float, typer.Option(help="Rms of gusts over the wind's mean speed.")]
PinsOption = Annotated[
    str | None,
    typer.Option(
        help="Where the cloth is held: top, corners, three-corners, four-corners or none.",
        show_default="as its kind hangs",
    ),
]
TimeOption = Annotated[float, typer.Option(help="Seconds the cloth has hung in the wind.")]
SeedOption = Annotated[int, typer.Option(help="Which gusts blow.")]
LayersOption = Annotated[str, typer.Option(help="stacked (as in the game) or flat (composited).")]
PbrOption = Annotated[
    bool, typer.Option("--pbr", help="Light by the packs' LabPBR maps (_n and _s).")
]
ThicknessOption = Annotated[float, typer.Option(help="Thickness of the cloth in texels.")]
BackgroundOption = Annotated[str, typer.Option(help="transparent or #rrggbb.")]
SamplesOption = Annotated[int, typer.Option(help="1, 4 or 16 samples a pixel.")]
PixelOption = Annotated[int, typer.Option(help="Draw smaller, each pixel a square of N.")]
LightOption = Annotated[str, typer.Option(help="game (its two lights) or flat (plain colours).")]
BlockLightOption = Annotated[int, typer.Option(help="Light level of torches, 0 to 15.")]
SkyLightOption = Annotated[int, typer.Option(help="Light level of the sky, 0 to 15.")]
DaylightOption = Annotated[float, typer.Option(help="1 at noon, 0 at night.")]
ShadowOption = Annotated[bool, typer.Option("--shadow", help="A soft shadow on the floor.")]
BackendOption = Annotated[str, typer.Option(help="auto, soft or pyrender.")]


Command = TypeVar("Command", bound=Callable[..., None])


def picture(
    design: OptionalDesign = None,
    form: FromOption = None,
    number: NumberOption = None,
    pack: PackOption = None,
    format: FormatOption = None,
    kind: KindOption = "auto",
    texture: TextureOption = None,
    pose: PoseOption = "cloth",
    placement: PlacementOption = "standing",
    rotation: RotationOption = 0,
    facing: FacingOption = None,
    view: ViewOption = "front",
    size: SizeOption = "512x512",
    grid: GridOption = "5x9",
    solver: SolverOption = "desbrun",
    pins: PinsOption = None,
    wind: WindOption = 4.0,
    direction: DirectionOption = None,
    gusts: GustsOption = 0.4,
    time: TimeOption = 3.0,
    seed: SeedOption = 0,
    layers: LayersOption = "stacked",
    pbr: PbrOption = False,
    thickness: ThicknessOption = 1.0,
    background: BackgroundOption = "transparent",
    samples: SamplesOption = 1,
    pixel: PixelOption = 1,
    light: LightOption = "game",
    block_light: BlockLightOption = 0,
    sky_light: SkyLightOption = 15,
    daylight: DaylightOption = 1.0,
    shadow: ShadowOption = False,
    backend: BackendOption = "auto",
) -> None:
    """The options of a picture, in the order in which help lists them."""


def pictured(*without: str) -> Callable[[Command], Command]:
    """Give a command that takes any words the options of `picture` after its own.

    without: those that it has no use for. One that it declares itself stays its own.
    """

    def extend(command: Command) -> Command:
        own = dict(inspect.signature(command).parameters)
        del own["words"]
        shared = inspect.signature(picture).parameters
        added = {n: p for n, p in shared.items() if n not in own and n not in without}
        every = [p.replace(kind=p.KEYWORD_ONLY) for p in (own | added).values()]
        command.__signature__ = inspect.Signature(every)  # type: ignore[attr-defined]
        command.__annotations__ |= {name: p.annotation for name, p in added.items()}
        return command

    return extend


def options_of(words: Mapping[str, Any]) -> Options:
    """The picture options among a command's words, as `draw` takes them. Raises OptionError."""
    names = Options.__optional_keys__ - {"packs"}
    chosen = {name: value for name, value in words.items() if name in names}
    chosen |= {name: pair(name, words[name]) for name in ("size", "grid")}
    return cast(Options, chosen | {"packs": tuple(words["pack"] or ())})


def design_of(words: Mapping[str, Any]) -> "Banner | None":
    """The design that a command is given, if it is given any. Raises DesignError."""
    from drapery.banner.formats import read_design

    text = words["design"]
    if text is None:
        return None
    return read_design(text, form=words["form"], number=words["number"])
