"""LabPBR maps of a design's sheets, in the order of its layers."""

from typing import NamedTuple

from drapery.arrays import Texels
from drapery.banner.design import Banner
from drapery.banner.packs.stack import Base, Kind, Packs


class Maps(NamedTuple):
    """The maps beside one sheet, each None where the packs have none."""

    normal: Texels | None = None
    specular: Texels | None = None


def design_maps(design: Banner | None, packs: Packs, kind: Kind) -> tuple[Maps, ...]:
    """One for each sheet of `flag_layers` or `shield_layers`. Raises PackError."""
    if design is None:
        return (_base_maps(packs, "shield_base_nopattern"),)
    base: Base = "banner_base" if kind == "banner" else "shield_base"
    names = ["base", *(layer.pattern for layer in design.layers)]
    return _base_maps(packs, base), *(_sheet_maps(packs, name, kind) for name in names)


def _base_maps(packs: Packs, base: Base) -> Maps:
    return Maps(_still(packs.base_normal_map(base)), _still(packs.base_specular_map(base)))


def _sheet_maps(packs: Packs, pattern: str, kind: Kind) -> Maps:
    normal, specular = packs.normal_map(pattern, kind), packs.specular_map(pattern, kind)
    return Maps(_still(normal), _still(specular))


def _still(texels: Texels | None) -> Texels | None:
    """The first frame of a map; sheets are square, so more than that are frames below it."""
    return None if texels is None else texels[: texels.shape[1]]
