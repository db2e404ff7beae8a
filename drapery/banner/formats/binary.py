"""The forms of files as the registry lists them, each with its reader and writer."""

import io
from collections.abc import Callable, Iterator, Sequence
from functools import partial

from drapery.banner.design import Banner
from drapery.banner.formats import blueprint, litematic, mcstructure, region, schem, structure
from drapery.banner.formats.block_box import BlockBox, row_of
from drapery.banner.formats.compression import is_compressed
from drapery.banner.formats.files import find_in_bytes
from drapery.banner.formats.form import BinaryForm
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.item import item_object
from drapery.banner.formats.nbt import is_nbt, read_nbt
from drapery.banner.formats.tree import DataTree
from drapery.banner.formats.write_nbt import encode
from drapery.errors import DesignError

Recognises = Callable[[dict[str, DataTree]], bool]
Find = Callable[[dict[str, DataTree]], Iterator[FoundBanner]]


def _nbt_form(
    name: str,
    title: str,
    suffixes: tuple[str, ...],
    recognises: Recognises,
    find: Find,
    source: str,
    write: Callable[[Banner], bytes] | None = None,
) -> BinaryForm:
    """A form that is recognised by its suffix; a file of another layout is refused."""

    def read(data: bytes) -> Iterator[FoundBanner]:
        tree = read_nbt(data, name)
        if not recognises(tree):
            raise DesignError(f"{name}: the file is NBT but not a {title}; leave the form out")
        return find(tree)

    return BinaryForm(name, title, suffixes, _by_suffix(suffixes), read, write, source)


def _by_suffix(suffixes: tuple[str, ...]) -> Callable[[bytes, str], bool]:
    return lambda head, name: _opens_as_nbt(head) and name.lower().endswith(suffixes)


def _opens_as_nbt(head: bytes) -> bool:
    # Bedrock's header has the length of the whole file, which is unknown here.
    return is_compressed(head) or is_nbt(head) or head[8:9] == b"\n"


def _is_region(head: bytes, name: str) -> bool:
    return name.lower().endswith(".mca") or region.recognises(head, 1 << 40)


def _read_region(data: bytes) -> Iterator[FoundBanner]:
    return region.find(io.BytesIO(data), "", region.NAME)


BOX_WRITERS: dict[str, Callable[[BlockBox], bytes]] = {
    "schem": schem.write,
    "schem3": partial(schem.write, version=3),
    "litematic": litematic.write,
}
"""What writes any blocks as a schematic, by the name of its form."""


def _in_a_row(form: str) -> Callable[[Banner], bytes]:
    return lambda banner: BOX_WRITERS[form](row_of([banner]))


_TABLE = (
    _nbt_form(
        structure.NAME,
        "structure block's file",
        (".nbt",),
        structure.recognises,
        structure.find,
        "https://minecraft.wiki/w/Structure_file",
        lambda banner: structure.write([banner]),
    ),
    _nbt_form(
        schem.NAME,
        "Sponge schematic",
        (".schem",),
        schem.recognises,
        schem.find,
        "https://github.com/SpongePowered/Schematic-Specification",
        _in_a_row("schem"),
    ),
    _nbt_form(
        "schem3",
        "Sponge schematic of version 3",
        (".schem",),
        schem.recognises,
        schem.find,
        "https://github.com/SpongePowered/Schematic-Specification",
        _in_a_row("schem3"),
    ),
    _nbt_form(
        "schematic",
        "MCEdit schematic with numeric ids",
        (".schematic",),
        schem.recognises,
        schem.find,
        "https://minecraft.wiki/w/Schematic_file_format",
    ),
    _nbt_form(
        litematic.NAME,
        "Litematica schematic",
        (".litematic",),
        litematic.recognises,
        litematic.find,
        "https://github.com/maruohon/litematica",
        _in_a_row("litematic"),
    ),
    _nbt_form(
        mcstructure.NAME,
        "Bedrock structure",
        (".mcstructure",),
        mcstructure.recognises,
        mcstructure.find,
        "https://wiki.bedrock.dev/nbt/mcstructure",
        lambda banner: mcstructure.write([banner]),
    ),
    _nbt_form(
        blueprint.NAME,
        "blueprint of Structurize and MineColonies",
        (".blueprint",),
        blueprint.recognises,
        blueprint.find,
        "https://github.com/ldtteam/Structurize",
    ),
    BinaryForm(
        *(region.NAME, "world's region", (".mca",), _is_region, _read_region),
        source="https://minecraft.wiki/w/Region_file_format",
    ),
    BinaryForm(
        "nbt",
        "other NBT: an item, a player, level.dat",
        (".dat", ".nbt"),
        lambda head, name: _opens_as_nbt(head),
        lambda data: find_in_bytes(data, "nbt"),
        lambda banner: encode(item_object(banner)),
        "https://minecraft.wiki/w/NBT_format",
    ),
)

BINARY_FORMS: dict[str, BinaryForm] = {form.name: form for form in _TABLE}
"""Every form of files by name. A file is read by the first form that recognises it."""

BLOCK_WRITERS: dict[str, Callable[[Sequence[Banner]], bytes]] = {
    ".schem": lambda banners: schem.write(row_of(banners)),
    ".litematic": lambda banners: litematic.write(row_of(banners)),
    ".nbt": structure.write,
    ".mcstructure": mcstructure.write,
}
"""What writes standing banners in a row as a file of blocks, by the ending of its name."""
