"""Our own JSON: `{"base": "red", "layers": [{"pattern": "creeper", "color": "lime"}]}`.

A shield has `"kind": "shield"` as well. Layers may have `colour` or `Color` for `color`.
"""

import json

from drapery.banner.design import Banner
from drapery.banner.formats.leftovers import check_keys, check_literal
from drapery.banner.formats.tree import DataTree, names, read_layers, under
from drapery.banner.names import dye_name, shown
from drapery.errors import DesignError

NAME = "json"
TITLE = "our own JSON"
EXAMPLE = '{"base": "red", "layers": [{"pattern": "creeper", "color": "lime"}]}'
SOURCE = "our own"


def recognises(text: str) -> bool:
    """Whether the text is JSON with this form's keys."""
    return text.lstrip().startswith("{") and any(k in text for k in ('"base"', '"layers"'))


def matches(tree: DataTree) -> bool:
    """Whether a tree is of this form."""
    return isinstance(tree, dict) and ("base" in tree or "layers" in tree) and "id" not in tree


def from_tree(tree: dict[str, DataTree], at: str = "") -> Banner:
    """The banner of the JSON's tree. Raises DesignError naming the place."""
    if "base" not in tree:
        raise DesignError(
            'the JSON has no "base": give its dye, as in {"base": "red", "layers": []}'
        )
    kind = tree.get("kind", "banner")
    if kind not in ("banner", "shield"):
        raise DesignError(f"kind: {shown(kind)} is neither 'banner' nor 'shield'")
    check_literal(tree["base"], under(at, "base"), "base dye")
    layers = read_layers(tree.get("layers"), "layers")
    if not layers:
        check_keys(tree, at, ("layers",))
    return Banner(dye_name(tree["base"], "base"), layers, kind=kind)


def write(banner: Banner) -> str:
    """The JSON; it can hold every banner."""
    tree: dict[str, DataTree] = {"base": banner.base, "layers": names(banner.layers)}
    if banner.kind != "banner":
        tree["kind"] = banner.kind
    return json.dumps(tree)
