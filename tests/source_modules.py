"""The sources of the package, for tests that read them."""

import ast
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parent.parent
FOLDERS = {
    "drapery": ROOT / "drapery",
    "drapery.render": ROOT / "render",
    "drapery.assets": ROOT / "assets",
}
NOT_INSTALLED = ROOT / "assets" / "drawing"


@cache
def modules() -> dict[str, Path]:
    found = {}
    for package, folder in FOLDERS.items():
        for path in sorted(folder.rglob("*.py")):
            if NOT_INSTALLED in path.parents:
                continue
            parts = path.relative_to(folder).with_suffix("").parts
            name = ".".join((package, *parts)).removesuffix(".__init__")
            found[name] = path
    return found


def names_of(node: ast.expr | None) -> set[str]:
    """The last names of the classes of errors; those of a handler without one are all."""
    if node is None:
        return {"BaseException"}
    parts = node.elts if isinstance(node, ast.Tuple) else [node]
    return {part.attr if isinstance(part, ast.Attribute) else ast.unparse(part) for part in parts}
