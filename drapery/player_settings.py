"""The table of a player's options: the command line, HTTP and manifests are made from it."""
# ruff: noqa: RUF009 (`option_field` returns a dataclass field)

from dataclasses import dataclass
from typing import Literal, get_args

from drapery.option import option_field, option_table

ArmsOption = Literal["auto", "classic", "slim"]
OverlayOption = Literal["flat", "voxels", "none"]
ShownOption = Literal["full", "bust", "head"]

MAX_SPEED = 10.0
"""The fastest walk of a wearer [m/s]."""
MOTIONS = (*("walk", "stand", "run", "sneak", "jump", "glide", "swim", "sit", "wave", "point"),)
"""The motions of a player, as help lists them; `garments/motions.toml` describes them."""


@dataclass(frozen=True)
class PlayerSettings:
    """Checked options of a player. `drapery.garments.player_of` makes what is drawn.

    Raises OptionError that names the option and its limits.
    """

    skin: str = option_field(
        "traveller",
        str,
        "Skin: traveller, dancer, or a PNG file, 64 x 64 or 64 x 32 or a multiple; or a profile of"
        " the game as JSON or SNBT, or in such a file, with textures of the packs",
        metavar="FILE|NAME|PROFILE",
        audience="anyone",
    )
    arms: ArmsOption = option_field(
        "auto",
        str,
        "Arms; auto reads them from the skin",
        choices=get_args(ArmsOption),
        audience="anyone",
    )
    overlay: OverlayOption = option_field(
        "flat",
        str,
        "The skin's second layer: flat, its texels as small boxes, or not at all",
        choices=get_args(OverlayOption),
        audience="anyone",
    )
    cape: str | None = option_field(
        None,
        str,
        "A cape: a PNG file, 64 x 32 or a multiple",
        default_text="none",
        metavar="FILE",
        audience="anyone",
    )
    elytra: bool = option_field(
        False, bool, "Wings of cloth, with the texture of the cape", audience="anyone"
    )
    wear: tuple[str, ...] = option_field(
        (),
        str,
        "Garments by name or TOML file, the innermost first",
        several=True,
        metavar="NAME|FILE",
        audience="anyone",
    )
    head: str | None = option_field(
        None,
        str,
        "A banner on the head",
        default_text="none",
        metavar="DESIGN",
        audience="anyone",
    )
    worn_design: str | None = option_field(
        None,
        str,
        "A design on the pieces of cloth that show one, or on all that is worn if none does",
        default_text="none",
        metavar="DESIGN",
        audience="anyone",
    )
    shield: str | None = option_field(
        None,
        str,
        "A shield in the left hand",
        default_text="none",
        metavar="DESIGN",
        audience="anyone",
    )
    armor: str | None = option_field(
        None,
        str,
        "Armour with textures of the packs: a material, or pieces such as helmet:iron,boots:gold",
        default_text="none",
        metavar="MATERIAL",
        audience="anyone",
    )
    trim: str | None = option_field(
        None,
        str,
        "Trim of the armour, such as coast:gold",
        default_text="none",
        metavar="PATTERN:MATERIAL",
        audience="anyone",
    )
    motion: str = option_field(
        "walk",
        str,
        f"{', '.join(MOTIONS)}, a pose in a JSON file, layers such as walk+wave,"
        " or a mean such as walk:0.7,wave:0.3",
        metavar="NAME|FILE",
        audience="anyone",
    )
    speed: float = option_field(
        1.5,
        float,
        "Speed over the ground",
        bounds=(0, MAX_SPEED),
        unit="m/s",
        audience="anyone",
    )
    look: str = option_field(
        "0,0",
        str,
        "How many degrees the head turns to its left and down, or the point at which it looks:"
        " metres to its left, up and ahead",
        metavar="LEFT,DOWN|X,Y,Z",
        audience="anyone",
    )
    shown: ShownOption = option_field(
        "full", str, "What is shown", choices=get_args(ShownOption), audience="anyone"
    )

    def __post_init__(self) -> None:
        for name, option in PLAYER_OPTIONS.items():
            object.__setattr__(self, name, option.check(getattr(self, name)))


PLAYER_OPTIONS = option_table(PlayerSettings)
"""The options of a player by name, in the order in which help lists them."""
