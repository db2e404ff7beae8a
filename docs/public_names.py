"""An extension of griffe: the public names of packages that import them at their first use."""

from typing import Any

import griffe

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
