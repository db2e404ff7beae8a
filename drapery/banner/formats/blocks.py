"""Helpers for files of placed blocks: they read their parts, and the banners of blocks."""

from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drapery.banner.formats.found import FoundBanner, find_banners
from drapery.banner.formats.nbt import Numbers
from drapery.banner.formats.rows import Rows
from drapery.banner.formats.tree import (
    DataTree,
    banner_from_block_entity,
    base_of,
    is_banner_id,
    state_id,
)
from drapery.banner.names import shown
from drapery.errors import DesignError

OnError: TypeAlias = Callable[[DesignError], None]
"""Called with the error of one broken banner or part, after which the search continues."""

Spot: TypeAlias = tuple[int, int, int]
"""A block's x, y, z."""


def raise_error(error: DesignError) -> None:
    """An OnError that ends the search at the first error."""
    raise error


def compounds(tree: dict[str, DataTree], where: str, *keys: str) -> list[dict[str, DataTree]]:
    """The list of compounds under the first of the keys that exists; empty if none exists.

    Rows, which are compounds of nothing but numbers, are left out: no part of a file is one.

    Raises DesignError for a value of another kind.
    """
    for key in keys:
        if key in tree:
            items = tree[key]
            if isinstance(items, list):
                items = [item for item in items if not isinstance(item, Rows)]
            if not isinstance(items, list) or not all(isinstance(item, dict) for item in items):
                raise DesignError(f"{where}: {key} is not a list of compounds; save the file again")
            return items
    return []


def compound(tree: dict[str, DataTree], where: str, key: str) -> dict[str, DataTree]:
    """The compound under a key; empty if there is none. Raises DesignError for another value."""
    value = tree.get(key, {})
    if not isinstance(value, dict):
        raise DesignError(f"{where}: {key} is {shown(value)}, not a compound; save the file again")
    return value


def palette_ids(tree: dict[str, DataTree], where: str, *keys: str) -> list[str]:
    """The ids of a palette of block states, under the first of the keys that exists.

    Raises DesignError for an entry that is not a block's state.
    """
    key = next((key for key in keys if key in tree), None)
    states = [] if key is None else tree[key]
    if not isinstance(states, list):
        raise DesignError(f"{where}: {key} is not a list of block states; save the file again")
    ids: list[str] = []
    for number, state in enumerate(states):
        name = state_id(state)
        if name is None:
            raise DesignError(
                f"{where}: {key}[{number}] is {shown(state)}, not a block's state such as"
                ' {Name:"minecraft:stone"}; save the file again'
            )
        ids.append(name)
    return ids


def spot(value: DataTree, where: str) -> Spot:
    """A position [blocks] from three numbers, or from a compound with x, y and z.

    Raises DesignError for anything else.
    """
    if isinstance(value, dict):
        value = [value.get(axis) for axis in "xyz"]
    if not isinstance(value, list) or len(value) != 3 or not all(map(_is_finite, value)):
        raise DesignError(f"{where}: {shown(value)} is not a position of three numbers")
    return int(value[0] // 1), int(value[1] // 1), int(value[2] // 1)


def _is_finite(value: Any) -> bool:
    return isinstance(value, int | float) and abs(value) < 2**63


def longs(value: DataTree, where: str) -> NDArray[np.int64]:
    """The numbers of a long array; empty for None. Raises DesignError for another value."""
    if isinstance(value, Numbers) and value.dtype.endswith("i8"):
        return value.array().astype(np.int64)
    if value is None or (isinstance(value, list) and all(isinstance(n, int) for n in value)):
        return np.array(value or (), np.int64)
    raise DesignError(f"{where}: {shown(value)} is not an array of longs; save the file again")


def at_block(where: str, place: Spot) -> str:
    """`hill.nbt block 48,71,-9`."""
    return f"{where} block {place[0]},{place[1]},{place[2]}"


def banners_of_block(
    entity: dict[str, DataTree], block: str | None, where: str, on_error: OnError
) -> Iterator[FoundBanner]:
    """The banner of a block entity that is one, otherwise the banners that it contains.

    block: the block's id, which names the base dye since 1.13, or None if it is unknown.
    """
    if is_banner_id(block) or is_banner_id(entity.get("id", entity.get("Id"))):
        try:
            yield FoundBanner(banner_from_block_entity(entity, where, block=block), where)
        except DesignError as error:
            on_error(error)
    else:
        yield from find_banners(entity, where, on_error=on_error)


def plain_banners(blocks: dict[Spot, str], where: str) -> Iterator[FoundBanner]:
    """Banners without a block entity, which the game shows without layers."""
    for place, block in blocks.items():
        if base_of(block) is not None:
            at = at_block(where, place)
            yield FoundBanner(banner_from_block_entity({}, at, block=block), at)


def banners_of_entities(
    entities: list[dict[str, DataTree]], where: str, on_error: OnError
) -> Iterator[FoundBanner]:
    """The banners of entities: on mobs, in item frames, in minecarts."""
    for entity in entities:
        inner = entity.get("nbt", entity.get("Data", entity))
        inner = inner if isinstance(inner, dict) else entity
        name = state_id(inner.get("id", entity.get("Id"))) or "entity"
        position = entity.get("Pos", inner.get("Pos", entity.get("pos")))
        yield from find_banners(inner, _at_entity(where, name, position), on_error=on_error)


def _at_entity(where: str, name: str, position: DataTree) -> str:
    label = f"{where} {name.removeprefix('minecraft:')[:60]}"
    try:
        x, y, z = spot(position, where)
    except DesignError:
        return label
    return f"{label} at {x},{y},{z}"
