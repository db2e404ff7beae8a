"""The public packages, and an extension of griffe that finds the names which they export.

The reference, its index and the tests of what others may import read `PACKAGES`.
"""

from typing import Any

import griffe

PACKAGES = {
    "drapery": "`draw`, `animate`, `Banner`, `Settings`, the errors",
    "drapery.arrays": "the types of arrays in signatures, by their shape",
    "drapery.banner": "designs and the forms in which they are written",
    "drapery.packs": "resource packs",
    "drapery.cloth": "the simulation: cloths, forces, colliders, solvers",
    "drapery.style": "from moving cloth to what is drawn",
    "drapery.styles": "the style toolkit",
    "drapery.render": "pictures of meshes",
    "drapery.garments": "cloth as data: garments, and players who wear them",
    "drapery.scenes": "banners and garments before a camera, and ready-made scenes",
    "drapery.sheets": "many labelled pictures on one",
    "drapery.comparison": "how two pictures differ, and from which layer on",
    "drapery.match": "designs that look like a picture",
    "drapery.batch": "many pictures from a manifest",
    "drapery.testing": "golden images in tests",
}
"""What each package holds from which others may import; all other modules may change."""

LAZY = "import_lazily"


class PublicNames(griffe.Extension):
    """Takes the imports for type checkers of such a package as what it exports."""

    def on_module_members(self, *, mod: griffe.Module, **_: Any) -> None:
        """Set the exports of a package that calls `drapery.lazy.import_lazily`."""
        if LAZY in mod.imports:
            names = (n for n, each in mod.members.items() if each.is_alias and not each.runtime)
            mod.exports = sorted(names, key=lambda name: (_kind(name), name))


def _kind(name: str) -> int:
    """Constants come first, then classes, then functions."""
    return 0 if name.isupper() else 1 if name[0].isupper() else 2
