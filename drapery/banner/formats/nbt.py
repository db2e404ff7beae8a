"""Binary NBT, of Java (big endian) and Bedrock (little endian), read within limits.

A file's tree comes as plain Python: compounds are `dict`, lists `list`, numbers `int` and
`float`, strings `str`. Byte arrays are `bytes`; int and long arrays and lists of numbers are
`Numbers`, which are decoded when they are used, or `list` if they are short. Compounds of nothing
but numbers, as the blocks of a structure, are `Rows` where many follow each other in a list. nbtlib
only writes: it reads zeros past the end of a file and recurses without a limit.
"""

import struct
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Literal, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from drapery.banner.formats.compression import inflate
from drapery.banner.formats.rows import Rows
from drapery.banner.formats.tree import DataTree
from drapery.errors import DesignError

MAX_DEPTH = 512
"""Most compounds and lists inside each other; the game has the same limit."""

MAX_MEMORY = 48 * 2**20
"""Most memory of one file's tree, beside its bytes, by a cautious estimate [bytes]. Arrays and the
blocks of structures and schematics stay bytes, so that only entities, items and names count."""

MAX_NAMES = 4096
"""Most names that compounds share in memory; usual files have some hundreds."""

SHORT_LIST = 4
"""The longest lists of numbers (positions, rotations) that are `list`; longer ones are Numbers."""

Order: TypeAlias = Literal["big", "little"]
Reader: TypeAlias = Callable[[bytes, int], tuple[Any, int]]
"""Reads a payload at a place: its value, and the place after it."""
Length: TypeAlias = Callable[[bytes, int], tuple[Any, ...]]

_COST = (0, *(80,) * 6, 80, 80, 136, 176, 176, 176)
"""Estimated memory of a tag of each kind with its entry, without a string's letters [bytes]."""

WORDS = (b"banner", b"Banner", b"shield")
"""What holds a design has one of these in its bytes."""

_SCANNED = frozenset({"BlockEntities", "TileEntities", "block_entities", "Entities", "entities"})
"""Lists of which only those compounds are kept that may hold a design."""

_LEAST_ROWS = 64
"""Fewer equal compounds in a row are read one by one."""

_END, _STRING, _LIST, _COMPOUND, _LAST = 0, 8, 9, 10, 12
_NUMBERS = {1: "i1", 2: "i2", 3: "i4", 4: "i8", 5: "f4", 6: "f8"}
_STRUCT_LETTERS = {1: "b", 2: "h", 3: "i", 4: "q", 5: "f", 6: "d"}


class Codec(NamedTuple):
    """How one byte order reads lengths and payloads; compounds and lists have no reader."""

    short: Length
    int_: Length
    readers: list[Reader | None]
    dtypes: dict[int, str]


@dataclass(frozen=True, eq=False, repr=False, slots=True)
class Numbers:
    """An array or a long list of numbers within the file's bytes. It is truthy and equals only
    itself."""

    data: bytes
    start: int
    length: int
    dtype: str

    def __repr__(self) -> str:
        return f"an array of {self.length}"

    def array(self) -> NDArray[Any]:
        """The numbers, shape [length], not copied."""
        return np.frombuffer(self.data, self.dtype, self.length, self.start)


class _BytesError(Exception):
    """A fault in the bytes; the caller adds the name of the file."""


@dataclass(slots=True)
class _List:
    """A list of compounds or lists that are not all read yet.

    left: how many are not. single: how many of them are read one by one before the next search for
    Rows. pause: how many that are at least; it grows where no Rows are found.
    """

    items: list[DataTree]
    kind: int
    left: int
    single: int = 0
    pause: int = 1
    scanned: bool = False


Container: TypeAlias = dict[str, DataTree] | _List


@dataclass
class _Cursor:
    """The state of reading: the place in the bytes, the memory still allowed, the names so far.

    names_memory: what of the memory the names take.
    """

    data: bytes
    at: int
    codec: Codec
    memory_left: int = MAX_MEMORY
    names: dict[bytes, str] = field(default_factory=dict)
    names_memory: int = 0

    def spend(self, memory: int) -> None:
        self.memory_left -= memory
        if self.memory_left < 0:
            raise _BytesError(
                f"its tags take over {MAX_MEMORY >> 20} MiB of memory by byte {self.at};"
                " save a smaller piece of it"
            )


def read_nbt(data: bytes, where: str, order: Order | None = None) -> dict[str, DataTree]:
    """The root compound of an NBT file: gzip, zlib or raw, in either byte order.

    where: the file's name, for errors. order: the byte order; None detects it. Bedrock's `.dat`
    header of eight bytes is skipped.

    Raises DesignError, naming the file and the byte, for files that are not NBT, end too early,
    or exceed MAX_BYTES, MAX_DEPTH or MAX_MEMORY.
    """
    data = inflate(data, where)
    start = 8 if _has_bedrock_header(data) else 0
    guess: Order = "little" if start else _guess_order(data)
    try:
        return _read_root(_Cursor(data, start, _CODECS[order or guess]))
    except (IndexError, struct.error):
        fault = f"cut off: it ends at byte {len(data)} within a tag; save or download it again"
    except _BytesError as found:
        fault = str(found)
    raise DesignError(f"{where}: {fault}")


def is_nbt(head: bytes, size: int | None = None) -> bool:
    """Whether an uncompressed file begins as NBT does: with a compound whose name is short.

    head: its first bytes. size: of the whole file, if that is more [bytes].
    """
    return _has_bedrock_header(head, size) or (head[:1] == b"\n" and 0 in head[1:3])


def _has_bedrock_header(head: bytes, size: int | None = None) -> bool:
    """Whether the bytes begin as Bedrock's level.dat: a version and the length of the rest."""
    size = len(head) if size is None else size
    return head[8:9] == b"\n" and int.from_bytes(head[4:8], "little") == size - 8


def _guess_order(data: bytes) -> Order:
    """The byte order in which the length of the first name is shorter.

    Names are far shorter than 256 bytes; read in the wrong order, such a length is at least
    256. If the root's name is empty, the name of its first child decides.
    """
    for at in (1, 4):
        big = int.from_bytes(data[at : at + 2], "big")
        little = int.from_bytes(data[at : at + 2], "little")
        if big or little:
            return "little" if little < big else "big"
    return "big"


def _read_root(cursor: _Cursor) -> dict[str, DataTree]:
    kind = cursor.data[cursor.at]
    if kind != _COMPOUND:
        raise _BytesError(f"not NBT: byte {cursor.at} is {kind}, not 10; give an NBT file")
    cursor.at = cursor.at + 3 + cursor.codec.short(cursor.data, cursor.at + 1)[0]
    root: dict[str, DataTree] = {}
    _grow(cursor, root)
    return root


def _grow(cursor: _Cursor, root: dict[str, DataTree]) -> None:
    """Fill the containers from the innermost open one, without recursion."""
    stack: list[Container] = [root]
    scanned: _Scanned | None = None
    while stack:
        parent = stack[-1]
        child = _fill(cursor, parent)
        if child is None:
            stack.pop()
            if scanned and len(stack) == scanned.depth:
                scanned.leave_out(cursor)
                scanned = None
        elif len(stack) < MAX_DEPTH:
            if scanned is None and isinstance(parent, _List) and parent.scanned:
                scanned = _Scanned(parent.items, len(stack), cursor)
            stack.append(child)
        else:
            raise _BytesError(f"nested over {MAX_DEPTH} deep at byte {cursor.at}; flatten it")


class _Scanned:
    """A compound of a list of which only those are kept that may hold a design."""

    def __init__(self, items: list[DataTree], depth: int, cursor: _Cursor) -> None:
        self.items, self.depth, self.start = items, depth, cursor.at
        self.memory = cursor.memory_left + cursor.names_memory

    def leave_out(self, cursor: _Cursor) -> None:
        """Take the compound, which ends here, out of its list if it holds no design."""
        inner = cursor.data[self.start : cursor.at]
        if not any(word in inner for word in WORDS):
            self.items.pop()
            cursor.memory_left = self.memory - cursor.names_memory + _COST[_COMPOUND]


def _fill(cursor: _Cursor, container: Container) -> Container | None:
    """Fill a container until its end (None) or until a child that must be filled before it."""
    if isinstance(container, _List):
        return _fill_list(cursor, container)
    return _fill_compound(cursor, container)


def _fill_compound(cursor: _Cursor, node: dict[str, DataTree]) -> Container | None:
    data, names = cursor.data, cursor.names
    length_of, readers = cursor.codec.short, cursor.codec.readers
    while kind := data[cursor.at]:
        start = cursor.at + 3
        stop = start + length_of(data, cursor.at + 1)[0]
        name = names.get(data[start:stop]) or _new_name(cursor, data[start:stop])
        if kind > _LAST:
            raise _BytesError(
                f"{kind} at byte {cursor.at} is not a kind of tag; save the file again"
            )
        cursor.spend(_COST[kind])
        reader = readers[kind]
        if reader:
            value, cursor.at = reader(data, stop)
            node[name] = value
            if kind == _STRING:
                cursor.spend(value.__sizeof__())
            continue
        cursor.at = stop
        node[name], child = _open(cursor, kind)
        if isinstance(child, _List):
            child.scanned = name in _SCANNED
        if child is not None:
            return child
    cursor.at += 1
    return None


def _fill_list(cursor: _Cursor, unfinished: _List) -> Container | None:
    items, kind = unfinished.items, unfinished.kind
    while unfinished.left:
        if kind == _COMPOUND and unfinished.single < 1 and unfinished.left >= _LEAST_ROWS:
            rows = _rows(cursor, unfinished.left)
            if rows:
                items.append(rows)
                unfinished.left -= len(rows)
                unfinished.pause = 1
                continue
            unfinished.single, unfinished.pause = unfinished.pause, min(2 * unfinished.pause, 256)
        if kind == _COMPOUND:
            cursor.spend(_COST[kind])
        unfinished.left -= 1
        unfinished.single -= 1
        value, child = _open(cursor, kind)
        items.append(value)
        if child is not None:
            return child
    return None


def _rows(cursor: _Cursor, most: int) -> Rows | None:
    """The Rows that begin here, or None if there are fewer than _LEAST_ROWS."""
    layout = _layout(cursor)
    if layout is None:
        return None
    size, fields, varying = layout
    data, start = cursor.data, cursor.at
    fixed = np.ones(size, bool)
    for first, stop in varying:
        fixed[first:stop] = False
    template = np.frombuffer(data, np.uint8, size, start)[fixed]
    count, piece = 1, _LEAST_ROWS
    most = min(most, (len(data) - start) // size)
    while count < most:
        piece = min(piece, most - count)
        here = np.frombuffer(data, np.uint8, piece * size, start + count * size)
        equal = (here.reshape(piece, size)[:, fixed] == template).all(axis=1)
        run = piece if equal.all() else int(equal.argmin())
        count += run
        if run < piece:
            break
        piece = min(8 * piece, _MOST_ROWS)
    if count < _LEAST_ROWS:
        return None
    cursor.at += count * size
    cursor.spend(_COST[_COMPOUND] * (2 + len(fields)))
    names = {_new_name(cursor, name): field for name, field in fields.items()}
    return Rows(data, start, count, size, names)


_MOST_ROWS = 2**16
"""Most rows that are compared at once, which bounds the memory."""

_Layout: TypeAlias = tuple[int, dict[bytes, tuple[int, str, int]], list[tuple[int, int]]]


def _layout(cursor: _Cursor) -> _Layout | None:
    """The size, the fields and the places of the numbers of a compound, if it has only numbers."""
    data, codec, at = cursor.data, cursor.codec, cursor.at
    fields: dict[bytes, tuple[int, str, int]] = {}
    varying: list[tuple[int, int]] = []
    while kind := data[at]:
        stop = at + 3 + codec.short(data, at + 1)[0]
        name, length = data[at + 3 : stop], 1
        if kind == _LIST:
            kind, length, stop = data[stop], codec.int_(data, stop + 1)[0], stop + 5
        if kind not in _NUMBERS or not 0 <= length <= SHORT_LIST:
            return None
        dtype = codec.dtypes[kind]
        at = stop + length * int(dtype[-1])
        fields[name] = (stop - cursor.at, dtype, length)
        varying.append((stop - cursor.at, at - cursor.at))
    size = at + 1 - cursor.at
    return (size, fields, varying) if cursor.at + size <= len(data) else None


def _open(cursor: _Cursor, kind: int) -> tuple[DataTree, Container | None]:
    """The value of a compound or list that begins here, and the part of it that is not filled."""
    if kind == _COMPOUND:
        node: dict[str, DataTree] = {}
        return node, node
    kind, length = _list_head(cursor)
    if kind in _NUMBERS:
        return _numbers(cursor, kind, length), None
    reader = cursor.codec.readers[kind]
    if reader:
        return _values(cursor, reader, length), None
    items: list[DataTree] = []
    return items, _List(items, kind, length)


def _list_head(cursor: _Cursor) -> tuple[int, int]:
    """The kind of a list's entries and their number, which the rest of the file must hold."""
    at = cursor.at
    kind, length = cursor.data[at], max(0, cursor.codec.int_(cursor.data, at + 1)[0])
    cursor.at = at + 5
    if kind > _LAST or (kind == _END and length):
        raise _BytesError(f"a list of {length} of kind {kind} at byte {at}; save the file again")
    if length > len(cursor.data) - cursor.at:
        raise _BytesError(
            f"a list of {length} at byte {at} is longer than the rest; save or download it again"
        )
    if kind != _COMPOUND and kind not in _NUMBERS:
        cursor.spend(length * _COST[kind])
    return kind, length


def _numbers(cursor: _Cursor, kind: int, length: int) -> list[Any] | Numbers:
    dtype = cursor.codec.dtypes[kind]
    value, cursor.at = _array(cursor.data, cursor.at, dtype, length)
    return value


def _values(cursor: _Cursor, reader: Reader, length: int) -> list[DataTree]:
    """A list of strings or arrays."""
    items = []
    for _ in range(length):
        value, cursor.at = reader(cursor.data, cursor.at)
        cursor.spend(value.__sizeof__())
        items.append(value)
    return items


def _new_name(cursor: _Cursor, raw: bytes) -> str:
    name = _text(raw)
    # Compounds of many names grow in steps, so that an entry may take twice its place.
    memory = 64 + name.__sizeof__()
    cursor.spend(memory)
    if len(cursor.names) < MAX_NAMES:
        cursor.names[raw] = name
        cursor.names_memory += memory
    return name


def _text(raw: bytes) -> str:
    """Text as Java writes it: UTF-8, but NUL in two bytes, and rare characters as surrogates."""
    try:
        return raw.decode()
    except UnicodeDecodeError:
        pass
    try:
        halves = raw.replace(b"\xc0\x80", b"\0").decode("utf-8", "surrogatepass")
    except UnicodeDecodeError:
        return raw.decode("utf-8", "replace")
    return halves.encode("utf-16", "surrogatepass").decode("utf-16", "replace")


def _array(data: bytes, at: int, dtype: str, length: int) -> tuple[list[Any] | Numbers, int]:
    stop = at + length * int(dtype[-1])
    if length < 0 or stop > len(data):
        raise _BytesError(
            f"an array of {length} at byte {at} is longer than the rest; save it again"
        )
    numbers = Numbers(data, at, length, dtype)
    return (numbers.array().tolist() if length <= SHORT_LIST else numbers), stop


def _number_reader(letter: str) -> Reader:
    unpack, size = struct.Struct(letter).unpack_from, struct.calcsize(letter)

    def read(data: bytes, at: int) -> tuple[Any, int]:
        return unpack(data, at)[0], at + size

    return read


def _string_reader(length_of: Length) -> Reader:
    def read(data: bytes, at: int) -> tuple[str, int]:
        stop = at + 2 + length_of(data, at)[0]
        return _text(data[at + 2 : stop]), stop

    return read


def _array_reader(length_of: Length, dtype: str) -> Reader:
    def read(data: bytes, at: int) -> tuple[list[Any] | Numbers, int]:
        return _array(data, at + 4, dtype, length_of(data, at)[0])

    return read


def _byte_array_reader(length_of: Length) -> Reader:
    def read(data: bytes, at: int) -> tuple[bytes, int]:
        stop = at + 4 + length_of(data, at)[0]
        if not at + 4 <= stop <= len(data):
            raise _BytesError(f"an array at byte {at} is longer than the rest; save it again")
        return data[at + 4 : stop], stop

    return read


def _codec(mark: str) -> Codec:
    """The readers of a byte order, whose struct and numpy mark is `>` or `<`."""
    short, int_ = struct.Struct(mark + "H").unpack_from, struct.Struct(mark + "i").unpack_from
    readers: list[Reader | None] = [None] * (_LAST + 1)
    for kind, letter in _STRUCT_LETTERS.items():
        readers[kind] = _number_reader(mark + letter)
    readers[7] = _byte_array_reader(int_)
    readers[8] = _string_reader(short)
    readers[11] = _array_reader(int_, mark + "i4")
    readers[12] = _array_reader(int_, mark + "i8")
    dtypes = {kind: mark + name for kind, name in _NUMBERS.items()}
    return Codec(short, int_, readers, dtypes)


_CODECS: dict[Order, Codec] = {"big": _codec(">"), "little": _codec("<")}
