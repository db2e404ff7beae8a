"""Ids of textures and patterns: `namespace:path`; the default namespace is `minecraft`."""

import re

from drapery.errors import PackError

MAX_ID = 128

_ID = re.compile(r"[a-z0-9_.-]+:[a-z0-9_./-]+", re.A)


def is_id(text: str) -> bool:
    """Whether this is an id with namespace whose file lies inside a pack."""
    fits = len(text) <= MAX_ID and _ID.fullmatch(text) is not None
    return fits and ".." not in re.split("[:/]", text)


def full_id(text: str, place: str = "pattern or texture") -> str:
    """The id with its namespace. Raises PackError naming the place."""
    name = text if ":" in text else f"minecraft:{text}"
    if not is_id(name):
        raise PackError(
            f"{place}: {text[:80]!r} is not an id: write namespace:path in a-z, 0-9, _./-"
        )
    return name


def split_id(name: str) -> tuple[str, str]:
    """Namespace and path of a full id."""
    namespace, _, path = name.partition(":")
    return namespace, path


def texture_file(name: str) -> str:
    """The file of a texture inside a pack, from its full id."""
    namespace, path = split_id(name)
    return f"assets/{namespace}/textures/{path}.png"
