"""A page of one file with every kind of scene that the component plays: `drapery web --gallery`."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.banner import Banner
from drapery.errors import OptionError
from drapery.packs import Packs, open_packs
from drapery.render import replacing
from drapery.settings import Settings
from drapery.web.page import kernel_file, picture_of, render_template
from drapery.web.scene_file import scene_bytes

SIZE = (200, 300)
"""Width and height of each element [pixels]."""


@dataclass(frozen=True)
class GalleryItem:
    """An element of the gallery.

    name: of its scene's file. title: what is special. design: shorthand; "" for a cape.
    options: of the picture. attributes: of the element.
    """

    name: str
    title: str
    design: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)

    @property
    def command(self) -> str:
        """The command that writes a page of this scene."""
        given = {**self.options, **self.attributes}.items()
        words = [f"--{option} {value}" for option, value in given]
        shown = f"'{self.design}'" if self.design else "--texture cape.png"
        return " ".join(["drapery web", shown, *words, f"-o {self.name}.html"])


ITEMS = (
    GalleryItem("standing", "A standing banner", "white creeper:lime border:black"),
    GalleryItem("wall", "On a wall", "red per_bend:orange flower:yellow", {"placement": "wall"}),
    GalleryItem("turned", "Turned", "cyan gradient:blue globe:white", {"rotation": 14}),
    GalleryItem("ground", "On grass", "lime stripe_middle:white", {"ground": "grass"}),
    GalleryItem(
        "stones",
        "Before stones",
        "gray skull:white",
        {"placement": "wall", "ground": "stone_bricks"},
    ),
    GalleryItem("cape", "A cape", options={"kind": "cape"}),
    GalleryItem("silk", "Silk", "purple flower:pink", {"fabric": "silk"}),
    GalleryItem("canvas", "Canvas", "brown stripe_center:white", {"fabric": "canvas"}),
    GalleryItem("breeze", "A light breeze", "light_blue rhombus:white", attributes={"wind": "2"}),
    GalleryItem("gale", "A gale", "black bricks:gray skull:white", attributes={"wind": "12"}),
    GalleryItem("iso", "From above", "yellow circle:red", {"view": "iso"}),
)
"""Each kind, placement and view, some fabrics, grounds and winds."""


def gallery_text(settings: Settings, items: Iterable[GalleryItem] = ITEMS) -> str:
    """A page of one file with an element for each item; its own options go before the settings.

    Raises OptionError, PackError, or WasmBuildError where the kernels of a cloth are not built.
    """
    packs = open_packs(settings.packs, format=settings.format)
    texture = _cape_texture() if settings.texture is None else settings.texture
    shown: list[tuple[GalleryItem, dict[str, str], str]] = []
    files: dict[str, bytes] = {}
    for item in items:
        design = Banner.parse(item.design) if item.design else None
        own = replace(settings, size=SIZE, **item.options)
        if design is None:
            own = replace(own, texture=texture)
        files |= _scene_file(item, design, packs, own)
        attributes = {"kind": item.name, "alt": item.title, **item.attributes}
        if item.design:
            attributes["design"] = item.design
        shown.append((item, attributes, picture_of(design, own)))
    return render_template("gallery.html", items=shown, size=SIZE, files=files | kernel_file())


def _cape_texture() -> NDArray[np.uint8]:
    """The texture of a blue cape with gold, shape [32, 64, 4]."""
    texels = np.full((32, 64, 4), (36, 72, 128, 255), np.uint8)
    texels[[2, 14, 15]] = 222, 176, 64, 255
    return texels


def _scene_file(
    item: GalleryItem, design: Banner | None, packs: Packs, settings: Settings
) -> dict[str, bytes]:
    patterns = [layer.pattern for layer in design.layers] if design else []
    try:
        return {f"{item.name}.bin": scene_bytes(design, packs, settings, patterns)}
    except OptionError as error:
        raise OptionError(f"gallery, {item.name}: {error}") from error


def write_gallery(path: Path, settings: Settings) -> None:
    """Write `gallery_text` to a file. Raises OutputError, and the errors of `gallery_text`."""
    with replacing(path) as partial:
        partial.write_text(gallery_text(settings), encoding="utf-8")
