"""Layers as materials: textured quads stacked on one another, or one composited texture.

`stacked` is the game's way: every layer is tinted and drawn over the one below. `flat` composites
them first and draws one texture; pictures of the two agree within 2/255.
"""

from collections.abc import Callable
from typing import Literal

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.banner.sprites import WHITE, Tinted, composite, flag_layers, shield_layers
from drapery.render.scene import Material, TextureLayer
from drapery.settings import Settings
from drapery.style.maps import Maps, design_maps
from drapery.style.piece import MaterialAt

LayerMode = Literal["stacked", "flat"]


def flag_material(
    banner: Banner, packs: Packs, mode: LayerMode = "stacked", time: float = 0.0
) -> Material:
    """The material of a flag: the cloth, the base dye, then the layers in order.

    banner: the design.
    packs: resource packs, see `drapery.packs.open_packs`.
    mode: `stacked` has a layer for each of the design; `composite` has one for all.
    time: of animated textures [s].

    Raises PackError where a texture cannot be used.
    """
    return _material(flag_layers(banner, packs, time), mode)


def wood_material(packs: Packs) -> Material:
    """The material of pole and bar."""
    return Material((TextureLayer(packs.base_sheet()),))


def flag_material_at(banner: Banner, packs: Packs, settings: Settings) -> MaterialAt:
    """The material of a flag at each time. Raises PackError for an unusable texture."""
    maps = design_maps(banner, packs, "banner") if settings.pbr else ()
    return _material_at(lambda time: flag_layers(banner, packs, time), settings.layers, maps)


def wood_material_at(packs: Packs, settings: Settings) -> MaterialAt:
    """The material of pole and bar at a time. Raises PackError."""
    maps = design_maps(Banner(), packs, "banner")[:1] if settings.pbr else ()
    return _material_at(lambda time: ((packs.base_sheet(time), WHITE),), "stacked", maps)


def plate_material_at(design: Banner | None, packs: Packs, settings: Settings) -> MaterialAt:
    """The material of a shield's plate; None is the shield without a design. Raises PackError."""
    maps = design_maps(design, packs, "shield") if settings.pbr else ()
    return _material_at(lambda time: shield_layers(design, packs, time), settings.layers, maps)


def handle_material_at(design: Banner | None, packs: Packs, settings: Settings) -> MaterialAt:
    """The material of a shield's handle: the lowest sheet alone. Raises PackError."""
    maps = design_maps(design, packs, "shield")[:1] if settings.pbr else ()
    return _material_at(lambda time: shield_layers(design, packs, time)[:1], "stacked", maps)


def textures_period(
    banner: Banner | None, packs: Packs, kind: Literal["banner", "shield"]
) -> float:
    """The longest period of the design's animated textures [s]; 0 where all are still."""
    names = ["base", *(layer.pattern for layer in banner.layers)] if banner else []
    return max((packs.period(name, kind) for name in names), default=0.0)


def _material_at(
    layers: Callable[[float], tuple[Tinted, ...]], mode: LayerMode, maps: tuple[Maps, ...] = ()
) -> MaterialAt:
    # The renderer caches materials by identity, so the same textures must give the same object.
    known: dict[tuple[int, ...], tuple[tuple[Tinted, ...], Material]] = {}

    def at(time: float) -> Material:
        tinted = layers(time)
        key = tuple(id(texels) for texels, _ in tinted)
        if key not in known:
            known[key] = tinted, _material(tinted, mode, maps)
        return known[key][1]

    return at


def _material(layers: tuple[Tinted, ...], mode: LayerMode, maps: tuple[Maps, ...] = ()) -> Material:
    if mode == "flat":
        return Material((TextureLayer(composite(layers)),))
    beside = maps or (Maps(),) * len(layers)
    return Material(
        tuple(TextureLayer(*layer, *found) for layer, found in zip(layers, beside, strict=True))
    )
