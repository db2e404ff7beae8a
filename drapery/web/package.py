"""The package of the elements, for npm and any bundler: `drapery web --component`."""

import json
from collections.abc import Iterator
from itertools import product
from pathlib import Path

from drapery import __version__
from drapery.packs import Packs, open_packs
from drapery.settings import Settings
from drapery.web import designer_page
from drapery.web.bundle import (
    DESIGNER_ENTRY,
    DESIGNER_PUBLIC,
    WEB,
    beside,
    bundled_module,
    within,
)
from drapery.web.page import (
    ARMS,
    POSES,
    WORN,
    banner_files,
    check_package,
    kernel_file,
    posed_player,
    seen_settings,
    write_files,
)
from drapery.web.scene_file import scene_bytes

MODULE = "drapery-banner.js"
INLINE = "drapery-inline.js"
"""The module that holds all files of banners and the designer, for bundlers that copy none."""
ENTRIES = {
    ".": (designer_page.BANNER_TYPES, MODULE),
    "./" + designer_page.MODULE: (designer_page.TYPES, designer_page.MODULE),
    "./" + INLINE: ("drapery-inline.d.ts", INLINE),
}
"""The types and the module of each name that can be imported."""
README = "README.md"


def write_component(folder: Path, settings: Settings) -> None:
    """Write the package of the elements: their modules, types, kernels, scenes and README.

    Raises OutputError, and the errors of `scene_bytes`.
    """
    check_package(settings)
    write_files(folder, _files(settings))


def _files(settings: Settings) -> Iterator[tuple[str, bytes]]:
    packs = open_packs(settings.packs, format=settings.format)
    scenes, players = dict(banner_files(packs, settings)), dict(_players(packs, settings))
    players |= designer_page.wearers(packs, settings)
    own = designer_page.designer_files(scenes)  # inline, without what is loaded for a skin alone
    files = own | players | kernel_file(scenes | players)
    yield from files.items()
    yield MODULE, bundled_module(places=beside(files)).encode()
    yield from designer_page.module_files(files)
    yield INLINE, bundled_module(DESIGNER_ENTRY, DESIGNER_PUBLIC, within(own)).encode()
    yield README, (WEB / "component" / README).read_bytes()
    yield ENTRIES["./" + INLINE][0], b'export * from "./drapery-designer.js";\n'
    yield "package.json", (json.dumps(_described(), indent=2) + "\n").encode()


def _players(packs: Packs, settings: Settings) -> Iterator[tuple[str, bytes]]:
    """The scenes of players with each garment, in each pose and with both arms."""
    for worn, pose, arms in product(WORN, POSES, ARMS):
        garment = posed_player(worn, pose, arms, overlay="whole")  # its skin can be replaced
        name = f"{worn}-{pose}{'-slim' if arms == 'slim' else ''}"
        yield f"{name}.bin", scene_bytes(garment, packs, seen_settings(garment, settings))


def _described() -> dict[str, object]:
    entries = {
        name: {"types": f"./{types}", "default": f"./{module}"}
        for name, (types, module) in ENTRIES.items()
    }
    return {
        "name": "drapery-banner",
        "version": __version__,
        "description": "Minecraft banners of live cloth as custom elements, and their designer.",
        "license": "MIT AND CC0-1.0",
        "type": "module",
        "main": MODULE,
        "types": designer_page.BANNER_TYPES,
        "exports": {**entries, "./*.bin": "./*.bin"},
        "files": ["*.bin", *(name for entry in ENTRIES.values() for name in reversed(entry))],
        "sideEffects": True,
    }
