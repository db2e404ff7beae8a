"""A player with what it wears, as one garment."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from drapery.banner.packs.png_file import read_png_file
from drapery.errors import OptionError, shown
from drapery.garments.catalogue import ENDING, find_garment
from drapery.garments.loading import complaint_of
from drapery.garments.model import (
    BONES,
    ClothTexture,
    Garment,
    GarmentPin,
    GarmentWearer,
    GridPiece,
    RingPiece,
)
from drapery.garments.profiles import Profile, profile_of
from drapery.player_settings import PlayerSettings
from drapery.style.equipment import ARMOR_SOLID, BANNER_TEXEL, FLAG_TOP, POLES, parse_armor
from drapery.style.figure import SKINS
from drapery.style.skins import read_skin

PICTURE = {"view": "hero", "wind": 0.5, "direction": 180.0, "gusts": 0.2}
"""Options of a player's picture unless others are given: a light wind from ahead."""
SEEN_BEHIND = {**PICTURE, "rotation": 5}
"""The same where something hangs behind the shoulders: from three quarters behind."""
BEHIND = ("cape", "elytra")
"""Garments that hang from the shoulders, behind a chestplate."""
NECK = 24
"""Rings that are pinned by an edge above this height are around the neck [texels]."""
CHESTPLATE = (0.85, 1.1)
"""How far a chestplate moves them up and back [texels]."""
WING = {"front": (24.0, 2.0, 10.0, 20.0), "back": (36.0, 2.0, 10.0, 20.0), "sheet": (64.0, 32.0)}
"""Where a wing lies on the texture of a cape."""


def make_wearer(**fields: Any) -> GarmentWearer:
    """A wearer of these fields.

    Raises OptionError.
    """
    try:
        return GarmentWearer(**fields)
    except ValidationError as error:
        raise OptionError(complaint_of(error, GarmentWearer)) from None


def dressed_player(
    wearer: GarmentWearer,
    *,
    cape: str | Path | None = None,
    elytra: bool = False,
    wear: Sequence[str | Path | Garment] = (),
    folder: Path = Path(),
) -> Garment:
    """A player that wears garments.

    What hangs behind the shoulders lies over all of them but those around the neck.

    wearer: the player.
    cape: the PNG file of a cape, 64 x 32 or a multiple; unless given, the cape of the profile that
        is the wearer's skin.
    elytra: wings of cloth in place of the cape, with the texture of `cape` if there is one.
    wear: garments, or their names or files, the first of them innermost.
    folder: where relative paths of the wearer and of a profile start.

    Raises OptionError for garments, profiles and motions that cannot be used.
    """
    texture = _texture_behind(cape, elytra, profile_of(wearer.skin, folder))
    worn = [each if isinstance(each, Garment) else find_garment(each) for each in wear]
    for each in worn:
        if each.wearer is not None and each.wearer.kind != wearer.kind:
            raise OptionError(
                f"garment {each.name} is for a {each.wearer.kind}, not for a {wearer.kind}; "
                "wear another one, such as coat"
            )
    behind = []
    if elytra:
        wings = find_garment("elytra")
        if texture is not None:
            wing: dict[str, Any] = {**WING, **texture}
            dressed = {"texture": ClothTexture(**wing)}
            pieces = [each.model_copy(update=dressed) for each in wings.piece]
            wings = wings.model_copy(update={"piece": tuple(pieces)})
        behind = [wings]
    elif texture is not None:
        behind = [find_garment("cape").with_texture(ClothTexture(**texture))]
    if behind:
        outer = [_is_around_neck(each) for each in worn]
        worn = [
            *(each for each, last in zip(worn, outer, strict=True) if not last),
            *behind,
            *(each for each, last in zip(worn, outer, strict=True) if last),
        ]
    if wearer.armor is not None and "chestplate" in parse_armor(wearer.armor):
        worn = [_over_chestplate(each) if each.name in BEHIND else each for each in worn]
    picture = SEEN_BEHIND if any(each.name in BEHIND for each in worn) else PICTURE
    given: dict[str, Any] = {"name": "player", "piece": (), "picture": picture, "folder": folder}
    try:
        return Garment(**given, wearer=wearer, over=tuple(worn))
    except ValidationError as error:
        raise OptionError(complaint_of(error, Garment)) from None


def _texture_behind(
    cape: str | Path | None, elytra: bool, profile: Profile | None
) -> dict[str, Any] | None:
    """The source of the texture of a cape or of wings, as ClothTexture has it, or None."""
    if cape is not None:
        return {"file": Path(cape).absolute()}
    if profile is None:
        return None
    own = (profile.elytra or profile.cape) if elytra else profile.cape
    return None if own is None else {"pack": own}


def _is_around_neck(garment: Garment) -> bool:
    """Whether a ring of it is pinned above the shoulders, so that it lies over a cape."""
    rings = [
        each.name
        for each in garment.piece
        if isinstance(each, RingPiece) and each.place[1] + each.profile[0][0] > NECK
    ]
    return any(pin.piece in rings and isinstance(pin.at, str) for pin in garment.pin)


def _over_chestplate(garment: Garment) -> Garment:
    """A cape or wings outside the armour, as far up and back as in the game."""
    up, back = CHESTPLATE
    who = garment.wearer or GarmentWearer()
    solid = (*(BONES[who.kind] if who.solid is None else who.solid), ARMOR_SOLID)
    pieces = []
    for piece in garment.piece:
        x, y, z = piece.place
        pieces.append(piece.model_copy(update={"place": (x, y + up, z - back)}))
    outside = who.model_copy(update={"solid": solid})
    return garment.model_copy(update={"piece": tuple(pieces), "wearer": outside})


def player_of(settings: PlayerSettings, folder: Path = Path()) -> Garment:
    """A player with all that it wears.

    settings: its options.
    folder: relative paths start here.

    Raises OptionError for options that do not fit together, and DesignError for designs that cannot
    be read.
    """
    same = ("skin", "arms", "overlay", "motion", "speed", "shown", "head", "shield", "armor")
    given = {name: getattr(settings, name) for name in (*same, "trim")}
    wearer = make_wearer(look=_look_of(settings.look), **given)
    cape = None if settings.cape is None else folder / settings.cape
    wear = [folder / name if name.endswith(ENDING) else name for name in settings.wear]
    player = dressed_player(wearer, cape=cape, elytra=settings.elytra, wear=wear, folder=folder)
    return player if settings.worn_design is None else player.with_design(settings.worn_design)


def _look_of(text: str) -> tuple[float, ...]:
    """Two angles [degrees] or a point [m] as numbers. Raises OptionError."""
    try:
        numbers = tuple(float(number) for number in text.split(","))
    except ValueError:
        numbers = ()
    if len(numbers) not in (2, 3):
        raise OptionError(
            f"look {shown(text)} is not two angles or a point; write it like 30,10 or 1,1.6,3"
        )
    return numbers


def skin_names() -> tuple[str, ...]:
    """The names of the built-in skins."""
    return SKINS


def check_skin(path: Path, widest: int) -> None:
    """Check that a file is a skin.

    path: a PNG file.
    widest: the largest width [px].

    Raises OptionError for other sizes, PackError for a file that is no PNG.
    """
    texels = read_png_file(path, "skin")
    if texels.shape[1] > widest:
        raise OptionError(f"skin is {texels.shape[1]} px wide; use at most {widest} px")
    read_skin(texels)


def with_head_banner(garment: Garment) -> Garment:
    """A garment over which its wearer has the flag of the banner on its head, if it has one."""
    who = garment.wearer
    if who is None or who.head is None:
        return garment
    flag = GridPiece(
        name="head-flag",
        size=(20 * BANNER_TEXEL, 40 * BANNER_TEXEL),
        points=(9, 17),
        place=FLAG_TOP,
        texture=ClothTexture(design=who.head),
    )
    banner = Garment(
        name="head-banner",
        piece=(flag,),
        pin=(GarmentPin(piece="head-flag", at="top", to="head"),),
        thickness=BANNER_TEXEL,
        wearer=who.model_copy(update={"solid": ("head", *POLES)}),
    )
    return garment.model_copy(update={"over": (*garment.over, banner)})
