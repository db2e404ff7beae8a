"""All banners in a tree: items in containers, blocks, and what entities hold."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial, reduce
from typing import TypeAlias

from drapery.banner.design import Banner
from drapery.banner.formats.item_details import ItemDetails, details_of_item
from drapery.banner.formats.rows import Rows
from drapery.banner.formats.tree import (
    DataTree,
    banner_from_block_entity,
    banner_from_item,
    bare,
    base_of,
    get,
    is_banner_id,
    is_shield_id,
    state_id,
    under,
)
from drapery.errors import DesignError

BlockOf = Callable[[dict[str, DataTree]], str | None]
"""The id of the block that a block entity belongs to, or None if it is unknown."""

Path: TypeAlias = tuple["Path | None", str | int]
"""A place in a tree: its parent's path and its key. Only the path of a banner becomes a text,
since a hostile file can have many long paths."""

_MOST_STEPS = 16
_LONGEST_STEP = 200


@dataclass(frozen=True)
class FoundBanner:
    """A banner and its place: a path in a tree, after the position of a block or a name.

    banner: the design.
    where: such as `tower.nbt block 1,2,3` or `Items[0]`; empty if the text is only the banner.
    details: what the text says of the item beside its design, or None; it does not count in
        comparisons.
    """

    banner: Banner
    where: str = ""
    details: ItemDetails | None = field(default=None, compare=False, repr=False)


def find_banners(
    tree: DataTree,
    where: str = "",
    *,
    block_of: BlockOf | None = None,
    on_error: Callable[[DesignError], None] | None = None,
    details: bool = False,
) -> Iterator[FoundBanner]:
    """Every banner and patterned shield in a tree, in the order of the text.

    Every mapping and list is searched: containers, shulker boxes, bundles, equipment, frames. Plain
    shields have no design and are skipped. The search does not recurse, so its depth is not
    limited.

    tree: mappings, lists, numbers and texts, as of NBT.
    where: the start of every path, such as a block's position.
    block_of: gives the block of a block entity, whose id names the base dye since 1.13.
    on_error: called with the error of one broken banner, after which the search continues; without
        it, the error is raised.
    details: keep what an item says beside its design, such as its name; this takes memory.

    Raises DesignError for a broken banner, unless `on_error` is given.
    """
    open_nodes: list[Iterator[tuple[Path, DataTree]]] = [iter([((None, where), tree)])]
    while open_nodes:
        step = next(open_nodes[-1], None)
        if step is None:
            open_nodes.pop()
            continue
        path, node = step
        read = reader_of(node, block_of)
        if read is None:
            open_nodes.append(children_of(path, node))
            if (key := shown_block(node)) is None:
                continue
            path, read = (path, key), partial(read_shown, key)
        at = path_text(path)
        try:
            kept = details_of_item(node) if details and read is banner_from_item else None
            yield FoundBanner(read(node, at), at, kept)
        except DesignError as error:
            if on_error is None:
                raise
            on_error(error)


_STATES = frozenset(
    {"Block", "BlockState", "DisplayState", "blockState", "block_state", "carriedBlockState"}
)
"""Keys of the state of a block that an entity shows, carries or falls as."""

_ENTITY_DATA = "TileEntityData"
"""The key of the block entity of a falling block."""


def shown_block(node: DataTree) -> str | None:
    """The key of the state of a banner that an entity shows, carries or falls as, or None."""
    if not isinstance(node, dict) or _STATES.isdisjoint(node):
        return None
    keys = sorted(_STATES.intersection(node))
    return next((key for key in keys if is_banner_id(state_id(node[key]))), None)


def read_shown(key: str, node: dict[str, DataTree], at: str) -> Banner:
    """The banner that is shown as a block, whose state is under the key."""
    return banner_from_block_entity(node.get(_ENTITY_DATA), at, block=state_id(node[key]))


def children_of(path: Path, node: DataTree) -> Iterator[tuple[Path, DataTree]]:
    """The compounds and lists in a compound or list, each with its path.

    A banner that is shown as a block, and its block entity, are left out: `read_shown` reads them.
    """
    pairs = node.items() if isinstance(node, dict) else _numbered(node)
    if (state := shown_block(node)) is not None:
        pairs = ((key, child) for key, child in pairs if key not in (state, _ENTITY_DATA))
    return (
        ((path, key), child) for key, child in pairs if isinstance(child, (dict, list)) and child
    )


def _numbered(node: DataTree) -> Iterator[tuple[int, DataTree]]:
    """The entries of a list with their numbers. Rows, which hold only numbers, count as many."""
    number = 0
    for child in node if isinstance(node, list) else ():
        yield number, child
        number += len(child) if isinstance(child, Rows) else 1


def path_text(path: Path) -> str:
    """A path as a text. A very long one keeps its first and last steps."""
    keys: list[str | int] = []
    step: Path | None = path
    while step is not None:
        step, key = step
        keys.append(key)
    where = str(keys.pop())
    keys.reverse()
    if len(keys) > _MOST_STEPS:
        keys[_MOST_STEPS // 2 : -_MOST_STEPS // 2] = ["…"]
    return reduce(
        under, (key[:_LONGEST_STEP] if isinstance(key, str) else key for key in keys), where
    )


def reader_of(node: DataTree, block_of: BlockOf | None) -> Callable[[DataTree, str], Banner] | None:
    """The function that reads this node as a banner, or None if it is not a banner."""
    if not isinstance(node, dict):
        return None
    if _is_block_entity(node):
        block = block_of(node) if block_of else None
        return lambda entity, at: banner_from_block_entity(entity, at, block=block)
    return banner_from_item if _is_item(node) else None


def _is_block_entity(node: dict[str, DataTree]) -> bool:
    """Whether a node is a banner's block entity. Its id is `banner`, as old items' is."""
    identifier = node.get("id", node.get("Id"))
    if not isinstance(identifier, str) or bare(identifier) != "banner":
        return False
    return not _ITEM_KEYS.intersection(node)


_ITEM_KEYS = frozenset({"count", "Count", "Damage", "components", "tag"})


def _is_item(node: dict[str, DataTree]) -> bool:
    identifier = node.get("id")
    if identifier is None and _ITEM_KEYS.intersection(node):
        # Bedrock's key, which a state of a palette in Java has too; the key of icons and of mods.
        identifier = node.get("Name", node.get("item") if "components" in node else None)
    if is_shield_id(identifier):
        return _is_patterned_shield(node)
    if not isinstance(identifier, str) or not is_banner_id(identifier):
        return _has_layers(node)
    is_item = bool(_ITEM_KEYS.intersection(node))
    return is_item or (base_of(identifier) is not None and "properties" not in node)


def _has_layers(node: dict[str, DataTree]) -> bool:
    """Whether an item of an unknown id has a banner's layers; the reader then names that id."""
    components, tag = node.get("components"), node.get("tag")
    if isinstance(components, dict) and isinstance(get(components, "banner_patterns")[1], list):
        return bool(get(components, "banner_patterns")[1])
    entity = get(tag, "BlockEntityTag")[1] if isinstance(tag, dict) else None
    return isinstance(entity, dict) and bool(get(entity, "Patterns", "patterns")[1])


def _is_patterned_shield(node: dict[str, DataTree]) -> bool:
    components, tag = node.get("components"), node.get("tag")
    if isinstance(components, dict):
        return any(get(components, key)[1] is not None for key in ("banner_patterns", "base_color"))
    entity = get(tag, "BlockEntityTag")[1] if isinstance(tag, dict) else None
    return isinstance(entity, dict) and ("Base" in entity or bool(entity.get("Patterns")))
