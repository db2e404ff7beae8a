"""The reader of binary NBT: it agrees with nbtlib on sound files and refuses the others soon."""

import gzip
import io
import struct
import tracemalloc
import zlib
from collections.abc import Callable

import nbtlib
import numpy as np
import pytest
from cost import limited_cost
from hypothesis import given, settings, strategies as st
from tracing import untraced

from drapery.banner.formats.files import find_in_bytes
from drapery.banner.formats.nbt import MAX_DEPTH, MAX_MEMORY, Numbers, is_nbt, read_nbt
from drapery.banner.formats.rows import Rows
from drapery.errors import DesignError

ORDERS = ["big", "little"]
WRAPPINGS = {"raw": bytes, "gzip": gzip.compress, "zlib": zlib.compress}
HEAD = b"\x0a\0\0"


def encode(root: nbtlib.Compound, order: str = "big", name: str = "") -> bytes:
    out = io.BytesIO()
    # A file is the one entry of a compound, without the tag that would close the compound.
    nbtlib.Compound({name: root}).write(out, order)
    return out.getvalue()[:-1]


def plain(tree):
    """A tree as nothing but Python, so that ours and nbtlib's compare."""
    if isinstance(tree, dict):
        return {str(key): plain(value) for key, value in tree.items()}
    if isinstance(tree, bytes):
        return list(np.frombuffer(tree, np.int8))
    if isinstance(tree, Numbers):
        return plain(tree.array().tolist())
    if isinstance(tree, np.ndarray):
        return plain(tree.tolist())
    if isinstance(tree, list):
        return [
            row
            for value in tree
            for row in (rows(value) if isinstance(value, Rows) else [plain(value)])
        ]
    return tree if isinstance(tree, str) else float(tree) if tree % 1 else int(tree)


def rows(found: Rows):
    columns = {name: found.column(name).tolist() for name in found.fields}
    return [
        {
            name: plain(column[n] if len(column[n]) != 1 else column[n][0])
            for name, column in columns.items()
        }
        for n in range(len(found))
    ]


def integers(bits: int):
    return st.integers(-(2 ** (bits - 1)), 2 ** (bits - 1) - 1)


def lists(tag, values):
    return st.lists(values, max_size=9).map(lambda items: nbtlib.List[tag](items))


TEXTS = st.text(st.characters(codec="utf-8"), max_size=9)
SCALARS = [
    (nbtlib.Byte, integers(8)),
    (nbtlib.Short, integers(16)),
    (nbtlib.Int, integers(32)),
    (nbtlib.Long, integers(64)),
    (nbtlib.Float, st.floats(width=32, allow_nan=False, allow_infinity=False)),
    (nbtlib.Double, st.floats(allow_nan=False, allow_infinity=False)),
    (nbtlib.String, TEXTS),
]
ARRAYS = [(nbtlib.ByteArray, 8), (nbtlib.IntArray, 32), (nbtlib.LongArray, 64)]
LEAVES = st.one_of(
    *(values.map(tag) for tag, values in SCALARS),
    *(lists(tag, values.map(tag)) for tag, values in SCALARS),
    *(st.lists(integers(bits), max_size=9).map(tag) for tag, bits in ARRAYS),
)


def compounds(children):
    return st.dictionaries(TEXTS, children, max_size=4).map(nbtlib.Compound)


TREES = compounds(
    st.recursive(
        LEAVES,
        lambda children: compounds(children) | lists(nbtlib.Compound, compounds(children)),
        max_leaves=12,
    )
)


@settings(max_examples=40)
@given(TREES, st.sampled_from(ORDERS), st.sampled_from(sorted(WRAPPINGS)), TEXTS)
def test_it_reads_what_nbtlib_writes(root, order: str, wrapping: str, name: str):
    data = WRAPPINGS[wrapping](encode(root, order, name))
    assert plain(read_nbt(data, "f", order)) == plain(root)


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("name", ["", "Schematic"])
def test_the_byte_order_is_found_out(order: str, name: str):
    root = nbtlib.Compound({"DataVersion": nbtlib.Int(3953)})
    assert read_nbt(encode(root, order, name), "f") == {"DataVersion": 3953}
    assert read_nbt(encode(nbtlib.Compound(), order, name), "f") == {}


@pytest.mark.parametrize("version", [1, 10, 2560])
def test_bedrocks_header_is_passed_over(version: int):
    body = encode(nbtlib.Compound({"LevelName": nbtlib.String("hill")}), "little")
    data = struct.pack("<II", version, len(body)) + body
    assert is_nbt(data) and read_nbt(data, "f") == {"LevelName": "hill"}


def test_text_is_javas_own_utf8():
    rare = b"\xed\xa0\xbd\xed\xb8\x80"  # U+1F600 as two surrogates of three bytes
    payload = b"a\xc0\x80" + rare
    data = HEAD + b"\x08\0\x01t" + struct.pack(">H", len(payload)) + payload + b"\0"
    assert read_nbt(data, "f") == {"t": "a\0\U0001f600"}
    assert read_nbt(data.replace(b"\xed\xa0", b"\xff\xa0"), "f")["t"].startswith("a")


def test_every_cut_of_a_file_is_refused_with_its_place():
    root = nbtlib.Compound(
        {"a": nbtlib.List[nbtlib.Int](range(9)), "b": nbtlib.Compound({"c": nbtlib.String("xy")})}
    )
    data = encode(root)
    for size in range(len(data)):
        with pytest.raises(DesignError, match=r"hill\.nbt: .*byte \d+"):
            read_nbt(data[:size], "hill.nbt")
    for size in range(len(packed := gzip.compress(data))):
        with pytest.raises(DesignError, match=r"hill\.nbt: .*byte \d+"):
            read_nbt(packed[:size], "hill.nbt")


def deep(kind: str, depth: int) -> bytes:
    if kind == "compounds":
        return HEAD + b"\x0a\0\x01a" * depth + b"\0" * (depth + 1)
    return HEAD + b"\x09\0\x01a" + b"\x09\0\0\0\x01" * (depth - 1) + b"\0\0\0\0\0" + b"\0"


@pytest.mark.parametrize("kind", ["compounds", "lists"])
def test_the_depth_ends_where_the_games_does(kind: str):
    read_nbt(deep(kind, MAX_DEPTH - 1), "f")
    for depth in (MAX_DEPTH, 10_000):
        with pytest.raises(DesignError, match=f"nested over {MAX_DEPTH} deep at byte"):
            read_nbt(deep(kind, depth), "f")


def list_of(kind: int, length: int, rest: bytes) -> bytes:
    return HEAD + b"\x09\0\x01a" + struct.pack(">bi", kind, length) + rest + b"\0"


def gigabyte() -> bytes:
    """A gigabyte of zeros, compressed; only one part of 64 is, for the others are equal."""
    packer = zlib.compressobj(1, wbits=31)
    head, part = (packer.compress(bytes(2**24)) + packer.flush(zlib.Z_FULL_FLUSH) for _ in range(2))
    return head + 63 * part + packer.flush()


BIG = 10**6
HOSTILE: dict[str, tuple[Callable[[], bytes], str]] = {
    "a million small compounds": (
        lambda: list_of(10, BIG, b"\1\0\1a\1\0\1\0\1b\1\0" * (BIG // 2)),
        "tags",
    ),
    "a million compounds in short rows": (
        lambda: list_of(10, BIG, (b"\0" * 63 + b"\1\0\1a\1\0") * (BIG // 64)),
        "tags",
    ),
    "a million compounds in rows": (
        lambda: list_of(10, BIG, (b"\1\0\1a\1\0" * 64 + b"\x08\0\1b\0\0\0") * (BIG // 65)),
        "longer than the rest|cut off",
    ),
    "a million empty lists": (lambda: list_of(9, BIG, bytes(5 * BIG)), "tags"),
    "a million empty strings": (lambda: list_of(8, BIG, bytes(2 * BIG)), "tags"),
    "a million names": (
        lambda: HEAD + b"".join(b"\x01\0\x07%07d\0" % n for n in range(BIG)) + b"\0",
        "tags",
    ),
    "a length without a body": (lambda: list_of(10, 2**31 - 1, b""), "longer than the rest"),
    "numbers without a body": (
        lambda: list_of(4, 2**28, bytes(2**28 // 64)),
        "longer than the rest",
    ),
    "an array without a body": (
        lambda: HEAD + b"\x0c\0\x01a\x7f\xff\xff\xff\0",
        "longer than the rest",
    ),
    "an array of negative length": (lambda: HEAD + b"\x07\0\x01a\xff\xff\xff\xff\0", "longer than"),
    "ends in a list": (lambda: list_of(0, 3, b""), "kind 0"),
    "an unknown tag": (lambda: HEAD + b"\x63\0\x01a\0", "99 at byte 3"),
    "an unknown kind of entry": (lambda: list_of(99, 3, bytes(99)), "kind 99"),
    "no compound": (lambda: b"\x01\0\0\0", "not NBT"),
    "nothing": (lambda: b"", "cut off"),
    "a gigabyte in a megabyte": (gigabyte, "over 64 MiB"),
    "a broken check sum": (
        lambda: gzip.compress(HEAD + b"\0")[:-8] + bytes(8),
        "broken compressed",
    ),
    "broken compression": (lambda: b"x\x9c" + b"\xff" * 99, "broken compressed"),
}


@pytest.mark.parametrize("name", HOSTILE)
def test_hostile_files_are_refused_soon(name: str):
    make, place = HOSTILE[name]
    data = make()
    with limited_cost(), untraced(), pytest.raises(DesignError, match=place) as caught:
        read_nbt(data, "evil.nbt")
    assert str(caught.value).startswith("evil.nbt: ") and "\n" not in str(caught.value)


@pytest.mark.parametrize("name", sorted(set(HOSTILE) - {"a million names"}))
def test_hostile_files_are_refused_small(name: str):
    data = HOSTILE[name][0]()
    tracemalloc.start()
    with untraced(), pytest.raises(DesignError):
        read_nbt(data, "evil.nbt")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 200 * 2**20


def test_a_large_file_that_unpacks_to_far_more_is_refused_soon():
    bomb = gzip.compress(bytes(2**27), 1) + bytes(2**26)
    with limited_cost(), pytest.raises(DesignError, match="over 64 MiB"):
        read_nbt(bomb, "evil.nbt")


@pytest.mark.parametrize("size", [2**20 - 9, 2**20 - 8, 2**20, 2**21 + 1])
def test_arrays_around_the_size_of_a_piece_come_whole(size: int):
    body = HEAD + b"\x07\0\x01a" + struct.pack(">i", size) + b"\1" * size + b"\0"
    for wrap in WRAPPINGS.values():
        assert read_nbt(wrap(body), "f") == {"a": b"\1" * size}


def strings(memory: int) -> bytes:
    """A list of empty strings that take this much memory by the reader's estimate."""
    count = memory // (80 + "".__sizeof__())
    return list_of(8, count, bytes(2 * count))


def test_the_memory_of_a_file_ends_at_its_limit():
    with untraced():
        assert read_nbt(strings(MAX_MEMORY - 1000), "f")["a"][0] == ""
    with pytest.raises(DesignError, match="over 48 MiB of memory by byte"):
        read_nbt(strings(MAX_MEMORY + 1000), "f")


@pytest.mark.parametrize("name", ["BlockEntities", "TileEntities", "Entities", "block_entities"])
def test_block_entities_and_entities_without_a_design_take_no_memory(name: str):
    def entity(item: str) -> bytes:
        note = 30_000 * "x"
        items = b"\x09\0\5Items\x0a\0\0\0\1\x08\0\2id" + text(item) + b"\0"
        return b"\x08\0\4note" + text(note) + items + b"\0"

    def text(of: str) -> bytes:
        return struct.pack(">H", len(of)) + of.encode()

    count = 2_000
    many = [entity("minecraft:dirt")] * (count // 2)
    body = b"".join([*many, entity("minecraft:red_banner"), *many])
    head = b"\n\0\0\x09" + text(name) + b"\x0a" + struct.pack(">i", count + 1)
    data = head + body + b"\0"
    tracemalloc.start()
    with untraced():
        tree = read_nbt(data, "f")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert [one["Items"] for one in tree[name]] == [[{"id": "minecraft:red_banner"}]]
    assert peak < 2**20
    with pytest.raises(DesignError, match="over 48 MiB of memory"):
        read_nbt(head.replace(name.encode(), b"x" * len(name)) + body + b"\0", "f")


def test_the_estimate_of_memory_is_cautious():
    item = {"Slot": nbtlib.Byte(300 % 128), "id": nbtlib.String("minecraft:red_banner")}
    box = nbtlib.Compound({"Items": nbtlib.List[nbtlib.Compound]([nbtlib.Compound(item)] * 27)})
    data = encode(nbtlib.Compound({"boxes": nbtlib.List[nbtlib.Compound]([box] * 3000)}))
    tracemalloc.start()
    with untraced():
        read_nbt(data, "f")
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < MAX_MEMORY


@pytest.mark.parametrize("order", ORDERS)
@pytest.mark.parametrize("count", [1, 63, 64, 65, 5000])
def test_compounds_of_numbers_stay_bytes_where_many_follow_each_other(order: str, count: int):
    blocks = [
        nbtlib.Compound(
            {
                "pos": nbtlib.List[nbtlib.Int]([n % 7, -n, 2]),
                "state": nbtlib.Int(n % 300),
                "light": nbtlib.Float(n / 2),
                "one": nbtlib.List[nbtlib.Byte]([n % 9]),
                "none": nbtlib.List[nbtlib.Int]([]),
            }
        )
        for n in range(count)
    ]
    blocks.insert(count // 2, nbtlib.Compound({"id": nbtlib.String("minecraft:banner")}))
    root = nbtlib.Compound({"blocks": nbtlib.List[nbtlib.Compound](blocks)})
    found = read_nbt(encode(root, order), "f", order)
    wanted = [
        {key: value[0] if key == "one" else value for key, value in block.items()}
        for block in plain(root)["blocks"]
    ]
    is_short = count // 2 < 64 and count - count // 2 < 64
    assert any(isinstance(part, Rows) for part in found["blocks"]) != is_short
    got = [
        {
            key: value[0] if key == "one" and isinstance(value, list) else value
            for key, value in block.items()
        }
        for block in plain(found["blocks"])
    ]
    assert got == wanted


def test_a_structure_of_a_million_blocks_is_read_soon_and_small():
    """Incendium's largest has 816,000 blocks, in 30 MB."""
    head = (
        b"\x09\0\7palette\x0a\0\0\0\2\x08\0\4Name\0\x05stone\0"
        b"\x08\0\4Name\0\x0ared_banner\0\x09\0\6blocks\x0a" + struct.pack(">i", BIG)
    )
    states = np.zeros(BIG, ">i4")
    states[777_777] = 1
    row = b"\3\0\5state" + bytes(4) + b"\x09\0\3pos\3\0\0\0\3" + bytes(12) + b"\0"
    body = np.tile(np.frombuffer(row, np.uint8), (BIG, 1))
    body[:, 8:12] = states.view(np.uint8).reshape(BIG, 4)
    body[777_777, 23:35] = np.frombuffer(struct.pack(">iii", 4, 5, 6), np.uint8)
    data = HEAD + head + body.tobytes() + b"\0"
    tracemalloc.start()
    with limited_cost(20):
        found = list(find_in_bytes(data, "f"))
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert [one.where for one in found] == ["f block 4,5,6"]
    assert peak < 60 * 2**20


SOUND = encode(
    nbtlib.Compound(
        {
            "Patterns": nbtlib.List[nbtlib.Compound](
                [nbtlib.Compound({"Pattern": nbtlib.String("cr"), "Color": nbtlib.Int(3)})] * 3
            ),
            "longs": nbtlib.LongArray(range(9)),
            "pos": nbtlib.List[nbtlib.Int]([1, 2, 3]),
        }
    )
)


@settings(max_examples=300)
@given(st.lists(st.tuples(st.integers(0, len(SOUND) - 1), st.binary(max_size=3)), max_size=6))
def test_changed_bytes_are_read_or_refused(changes: list[tuple[int, bytes]]):
    data = SOUND
    for place, piece in changes:
        data = data[:place] + piece + data[place + 1 :]
    try:
        assert isinstance(read_nbt(data, "f"), dict)
    except DesignError as error:
        assert "\n" not in str(error)
