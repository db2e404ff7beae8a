"""The kinds of things that are drawn, each a function from a design or texture to its body."""

from collections.abc import Callable
from dataclasses import dataclass, replace

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.errors import OptionError
from drapery.settings import TEXTURED, Placement, Settings
from drapery.style.body import Body
from drapery.style.ground import ground_of
from drapery.style.kinds import banner, cape, elytra, shield


@dataclass(frozen=True)
class Kind:
    """One kind of thing that is drawn.

    build: makes the body of a design (None for a texture) from packs and settings; raises
        OptionError and PackError.
    placements: where it can be.
    """

    build: Callable[[Banner | None, Packs, Settings], Body]
    placements: tuple[Placement, ...]


KINDS: dict[str, Kind] = {
    "banner": Kind(banner.body, ("standing", "wall", "item")),
    "shield": Kind(shield.body, ("standing", "item")),
    "cape": Kind(cape.body, ("standing",)),
    "elytra": Kind(elytra.body, ("standing",)),
}
"""All kinds by name."""


def body_of(design: Banner | None, packs: Packs, settings: Settings) -> Body:
    """What is to be drawn: a design, or for capes and elytra the texture of the settings.

    design: None for a cape, elytra or plain shield.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the picture.

    Raises OptionError for options that do not fit the kind, and PackError.
    """
    kind = check_kind(design, settings)
    body = kind.build(design, packs, settings)
    # Only banners stand or hang on something unless asked for.
    stands = kind is KINDS["banner"] or "ground" in settings.given
    if settings.ground == "none" or not stands:
        return body
    return replace(body, ground=ground_of(settings.ground, packs, settings.placement))


def check_kind(design: Banner | None, settings: Settings) -> Kind:
    """The kind of the settings; nothing is drawn and no file is read.

    design: None for a cape, elytra or plain shield.
    settings: the options of the picture.

    Raises OptionError where options, or a design, do not fit the kind.
    """
    name = settings.kind
    if name == "auto":
        name = "banner" if design is None else design.kind
    kind = KINDS[name]
    if settings.placement not in kind.placements:
        places = " or ".join(kind.placements)
        raise OptionError(f"placement {settings.placement} is not for a {name}; use {places}")
    if name in TEXTURED and design is not None:
        raise OptionError(f"kind {name} takes no design; give only its texture, a PNG file")
    if name not in TEXTURED and settings.texture is not None:
        raise OptionError("texture is for a cape or elytra; use kind cape, or leave it out")
    return kind
