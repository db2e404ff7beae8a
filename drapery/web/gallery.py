"""A page of one file with every kind of scene that the component plays: `drapery web --gallery`."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.banner import Banner
from drapery.errors import OptionError
from drapery.garments import Garment
from drapery.output_files import replacing
from drapery.packs import Packs, open_packs
from drapery.settings import Settings
from drapery.web.page import (
    FROM_BEHIND,
    POSES,
    kernel_file,
    picture_of,
    posed_player,
    render_template,
    seen_settings,
)
from drapery.web.scene_file import scene_bytes

SIZE = (200, 300)
"""Width and height of each element [pixels]."""
WORN = {"cape": "--cape cape.png", "elytra": "--elytra"}
"""What players of the gallery wear, and the option for it."""


@dataclass(frozen=True)
class GalleryItem:
    """An element of the gallery.

    name: of its scene's file. title: what is special. design: shorthand; "" for a cape.
    options: of the picture. attributes: of the element. worn: a cape or elytra on a player in the
    pose of the attributes; "" for other items.
    """

    name: str
    title: str
    design: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)
    attributes: Mapping[str, str] = field(default_factory=dict)
    worn: str = ""

    @property
    def garment(self) -> Garment | None:
        """The player of the item, if it shows one."""
        return posed_player(self.worn, self.attributes["pose"]) if self.worn else None

    @property
    def element(self) -> str:
        """The name of its element."""
        return f"drapery-{self.worn or 'banner'}"

    @property
    def command(self) -> str:
        """The command that writes a page of this scene, for any shell."""
        if self.worn:
            worn, pose = WORN[self.worn], self.attributes["pose"]
            moves = f"--motion {pose} --speed {POSES[pose]:g} --rotation {FROM_BEHIND}"
            return f"drapery player {worn} {moves} -o {self.name}.html"
        given = {**self.options, **self.attributes}.items()
        words = [f"--{option} {value}" for option, value in given]
        shown = f'"{self.design}"' if self.design else "--texture cape.png"
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
    *(
        GalleryItem(f"{worn}-{pose}", title, attributes={"pose": pose}, worn=worn)
        for worn, pose, title in (
            ("cape", "walk", "A cape on a walking player"),
            ("cape", "run", "A cape on a running player"),
            ("elytra", "stand", "Elytra on a standing player"),
            ("elytra", "sneak", "Elytra on a sneaking player"),
        )
    ),
)
"""Each kind, placement and view, some fabrics, grounds and winds, and players in each pose."""


def gallery_text(settings: Settings, items: Iterable[GalleryItem] = ITEMS) -> str:
    """A page of one file with an element for each item; its own options go before the settings.

    Raises OptionError, PackError, or WasmBuildError where the kernels of a cloth are not built.
    """
    packs = open_packs(settings.packs, format=settings.format)
    texture = _cape_texture() if settings.texture is None else settings.texture
    shown: list[tuple[GalleryItem, dict[str, str], str]] = []
    files: dict[str, bytes] = {}
    for item in items:
        subject = item.garment or (Banner.parse(item.design) if item.design else None)
        own = settings.changed(size=SIZE, **item.options)
        if isinstance(subject, Garment):
            own = seen_settings(subject, settings, SIZE)
        elif subject is None:
            own = own.changed(texture=texture)
        files |= _scene_file(item, subject, packs, own)
        attributes = {} if item.worn else {"kind": item.name}
        attributes |= {"alt": item.title, **item.attributes}
        if item.design:
            attributes["design"] = item.design
        shown.append((item, attributes, picture_of(subject, own)))
    return render_template("gallery.html", items=shown, size=SIZE, files=files | kernel_file(files))


def _cape_texture() -> NDArray[np.uint8]:
    """The texture of a blue cape with gold, shape [32, 64, 4]."""
    texels = np.full((32, 64, 4), (36, 72, 128, 255), np.uint8)
    texels[[2, 14, 15]] = 222, 176, 64, 255
    return texels


def _scene_file(
    item: GalleryItem, subject: Banner | Garment | None, packs: Packs, settings: Settings
) -> dict[str, bytes]:
    try:
        patterns = [each.pattern for each in subject.layers] if isinstance(subject, Banner) else []
        scene = scene_bytes(subject, packs, settings, patterns)
    except OptionError as error:
        raise OptionError(f"gallery, {item.name}: {error}") from error
    return {f"{item.name}.bin": scene}


def write_gallery(path: Path, settings: Settings) -> None:
    """Write `gallery_text` to a file. Raises OutputError, and the errors of `gallery_text`."""
    with replacing(path) as partial:
        partial.write_text(gallery_text(settings), encoding="utf-8")
