"""Pages that play live cloth without a server."""

import base64
import gzip
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from drapery import draw
from drapery.banner import PATTERN_NAMES, Banner, alt_text, write_banner
from drapery.errors import DraperyError, OptionError
from drapery.garments import (
    Garment,
    dressed_player,
    find_garment,
    make_wearer,
)
from drapery.option import Subject
from drapery.output_files import make_folder, replacing
from drapery.packs import Packs, open_packs
from drapery.render import webp_bytes
from drapery.settings import Placement, Settings, applicable, settled_for
from drapery.styles import combined_style
from drapery.web.bundle import WEB, bundled_module
from drapery.web.scene_file import called_kernels, fabric_bytes, pictured_scene, scene_bytes
from drapery.web.wasm.module import smallest_module

KERNELS = "cloth.bin"
PLACEMENTS: tuple[Placement, ...] = ("standing", "wall")
"""Where banners of the component are."""
SHIELD: Literal["shield"] = "shield"
Arms = Literal["classic", "slim"]
ARMS: tuple[Arms, ...] = ("classic", "slim")
WORN = ("cape", "elytra")
"""What players of the component wear."""
POSES = {"walk": 1.5, "stand": 0.0, "run": 4.0, "sneak": 0.0}
"""The poses of players that the component shows, with a cape or elytra; how fast they go [m/s]."""
SIZE = (320, 480)
"""Width and height of what the camera of a player frames [pixels]."""
FROM_BEHIND = 7
"""How players are turned, in sixteenths of a turn: cloth on their backs is seen."""
FROM_FRONT = 15
"""The same: cloth on the chest is seen."""
FROM_LEFT = 1
"""The same: a shield in the left hand is seen."""


@dataclass(frozen=True)
class _Shown:
    """What a page shows: the element and its attributes, and the files that it loads."""

    tag: str
    attributes: dict[str, str]
    files: dict[str, bytes]


def page_text(design: Banner | Garment | None, settings: Settings) -> str:
    """A page of one file that shows a design as live cloth; it needs no other file or server.

    design: a banner, a garment with its wearer, or None for a cape. The page begins with
    the picture of these settings, and keeps it where a browser cannot play the cloth.
    A text after `#` in the page's address is shown in place of a banner's design.
    Raises OptionError, PackError, or WasmBuildError where the kernels of the cloth are not built.
    """
    settings = settled_for(design, settings, "page")
    if isinstance(design, Garment):
        shown = _garment_shown(design, settings)
    else:
        shown = _banner_shown(design, settings)
    return render_template(
        "page.html",
        title=shown.attributes["alt"],
        tag=shown.tag,
        attributes=shown.attributes,
        # A style that changes materials needs the layers of the page's own design.
        is_linked="design" in shown.attributes
        and not combined_style(settings.style).has("material"),
        width=settings.size[0],
        height=settings.size[1],
        picture=picture_of(design, settings),
        files=shown.files | kernel_file(shown.files),
    )


def render_template(name: str, *, files: Mapping[str, bytes], **values: object) -> str:
    """A page from a template of this package; it holds the component and these files."""
    from jinja2 import Environment
    from markupsafe import Markup

    template = Environment(autoescape=True).from_string((WEB / name).read_text(encoding="utf-8"))
    texts = {name: _base64(data) for name, data in files.items()}
    page: str = template.render(files=texts, module=Markup(_unpacking(bundled_module())), **values)
    return page


def _unpacking(module: str) -> str:
    """A script that unpacks a module and runs it, which takes half of the module's bytes."""
    data = _base64(gzip.compress(module.encode(), mtime=0))
    return (
        f'const bytes = Uint8Array.from(atob("{data}"), (each) => each.charCodeAt(0));\n'
        'const plain = new Response(bytes).body.pipeThrough(new DecompressionStream("gzip"));\n'
        "const textContent = await new Response(plain).text();\n"
        'const script = document.createElement("script");\n'
        'document.head.append(Object.assign(script, { type: "module", textContent }));\n'
    )


def picture_of(design: Banner | Garment | None, settings: Settings) -> str:
    """The picture for browsers that cannot play the cloth, as the address of an image."""
    return "data:image/webp;base64," + _base64(webp_bytes(draw(design, settings).pixels, 6))


def kernel_file(scenes: Mapping[str, bytes]) -> dict[str, bytes]:
    """The name and content of the compressed WebAssembly module, with what the plans of these
    files call. Raises WasmBuildError."""
    return {KERNELS: gzip.compress(smallest_module(called_kernels(scenes)), mtime=0)}


def _scene(design: Banner | None, packs: Packs, settings: Settings) -> bytes:
    """The scene with all patterns, because the page's address may hold another design.

    Where all patterns are too large or one is damaged, it has only those of the design.
    """
    own = [layer.pattern for layer in design.layers] if design else []
    try:
        return scene_bytes(design, packs, settings, [*PATTERN_NAMES, *own])
    except DraperyError:  # raised again if it is a pattern of the design
        return scene_bytes(design, packs, settings, own)


def _banner_shown(design: Banner | None, settings: Settings) -> _Shown:
    packs = open_packs(settings.packs, format=settings.format)
    kind = settings.placement if design else settings.kind
    attributes = {"kind": kind, "alt": alt_text(design) if design else kind.title()}
    if design:
        attributes["design"] = write_banner(design, "shorthand")
    return _Shown("drapery-banner", attributes, {f"{kind}.bin": _scene(design, packs, settings)})


def _garment_shown(garment: Garment, settings: Settings) -> _Shown:
    packs = open_packs(settings.packs, format=settings.format)
    names = [each.name.replace("-", " ") for each in garment.over]
    title = f"{garment.name.title()} with {' and '.join(names)}" if names else garment.description
    attributes = {"kind": "player", "alt": title or garment.name}
    scene = scene_bytes(garment, packs, settings)
    return _Shown("drapery-player", attributes, {"player.bin": scene})


def write_page(path: Path, design: Banner | Garment | None, settings: Settings) -> None:
    """Write `page_text` to a file. Raises OutputError, and the errors of `page_text`."""
    with replacing(path) as partial:
        partial.write_text(page_text(design, settings), encoding="utf-8")


def check_package(settings: Settings) -> None:
    """Raise OptionError for what a package, which shows any design, cannot show."""
    if settings.rotation or settings.facing is not None:
        raise OptionError(
            "the package shows banners that are not turned; leave out rotation and facing"
        )
    if combined_style(settings.style).has("material"):
        raise OptionError(
            "the package shows any design, and steps of material need the renderer; use a style"
            " without them"
        )


def write_files(folder: Path, files: Iterable[tuple[str, bytes]]) -> None:
    """Write all files, or none where one cannot be made. Raises OutputError."""
    made = list(files)
    make_folder(folder)
    for name, data in made:
        with replacing(folder / name) as partial:
            partial.write_bytes(data)


def banner_files(packs: Packs, settings: Settings) -> Iterator[tuple[str, bytes]]:
    """The names and contents of the scenes of banners in all PLACEMENTS, of their stills and
    fabrics, and of a shield."""
    for placement in PLACEMENTS:
        placed = settings.changed(placement=placement)
        yield from pictured_scene(placement, Banner(), packs, placed).items()
        yield f"{placement}-fabrics.bin", fabric_bytes(packs, placed)
    kept = {n: v for n, v in settings.given_values.items() if n in applicable(Subject(SHIELD))}
    shield = Settings(**{**kept, "kind": SHIELD})
    yield f"{SHIELD}.bin", scene_bytes(Banner(kind=SHIELD), packs, shield)


def posed_player(
    worn: str, pose: str, arms: Arms = "classic", overlay: Literal["flat", "whole"] = "flat"
) -> Garment:
    """A player in one of POSES with a garment, or with a shield in its hand."""
    shield = Banner(kind=SHIELD) if worn == SHIELD else None
    wearer = make_wearer(motion=pose, speed=POSES[pose], arms=arms, shield=shield)
    shown = wearer.model_copy(update={"overlay": overlay})
    return dressed_player(shown, wear=[] if shield else [find_garment(worn)])


def seen_settings(
    garment: Garment, settings: Settings, size: tuple[int, int] = SIZE, rotation: int = FROM_BEHIND
) -> Settings:
    """What a user chose for banners, for a garment that is turned so far; else its own."""
    kept = {n: v for n, v in settings.given_values.items() if n in applicable(Subject("garment"))}
    return garment.settings(**{**kept, "size": size, "rotation": rotation})


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode()
