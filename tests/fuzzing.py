"""Fuzzing of the forms: seeded mutations of valid inputs, and a report of what came of them.

The suite runs a short slice of it, `python -m benchmarks.fuzz` the long run.
"""

import gzip
import io
import logging
import math
import random
import re
import struct
import time
import warnings
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import nbtlib
import world_maker as make
from tracing import untraced

from drapery.banner.formats import (
    FORMS,
    parse_banner,
    parse_banners,
    schem,
    structure,
    write_banner,
)
from drapery.banner.formats.binary import BINARY_FORMS
from drapery.banner.formats.block_box import row_of
from drapery.errors import DraperyError

MAX_SECONDS = 10.0
MAX_MEMORY = 200.0
MAX_INPUT = 2**22
MAX_TAGS = 20_000
ANY_TEXT = "any text"
GZIP = b"\x1f\x8b"
_STATUS, _CLEAR = Path("/proc/self/status"), Path("/proc/self/clear_refs")


class Target(NamedTuple):
    """A reader: valid inputs, and how to change them."""

    read: Callable[[Any], Iterable[Any]]
    samples: Sequence[Any]
    mutate: Callable[[random.Random, Sequence[Any]], Any]


@dataclass
class FuzzReport:
    """What came of the inputs of one form.

    outcomes: how many inputs ended so, by a short name. slowest: the longest reading [s], of
    processor time. heaviest: the most memory that a reading added [MB], where Linux tells it.
    failures: inputs that ended otherwise than in banners or a DraperyError.
    """

    outcomes: Counter[str] = field(default_factory=Counter)
    slowest: float = 0.0
    heaviest: float = 0.0
    failures: list[tuple[Any, str]] = field(default_factory=list)

    @property
    def count(self) -> int:
        return sum(self.outcomes.values())


def fuzz(
    read: Callable[[Any], Iterable[Any]],
    samples: Sequence[Any],
    mutate: Callable[[random.Random, Sequence[Any]], Any],
    count: float = math.inf,
    seed: int = 0,
    seconds: float = math.inf,
    slowest: float = MAX_SECONDS,
) -> FuzzReport:
    """Read mutated samples and report the outcomes.

    count: of the samples. seconds: after which no other is read, where fewer were. slowest: the
    longest that one may take [s].
    """
    rng = random.Random(seed)
    report, end = FuzzReport(), time.monotonic() + seconds
    while report.count < count and time.monotonic() < end:
        judge(read, mutate(rng, samples), report, slowest)
    return report


def judge(
    read: Callable[[Any], Iterable[Any]],
    given: Any,
    report: FuzzReport,
    slowest: float = MAX_SECONDS,
) -> None:
    """Read one input and note how it ended."""
    before, start = _memory("VmRSS"), time.process_time()
    lines: list[str] = []
    _forget_peak()
    try:
        with untraced(), warnings.catch_warnings(), _logged(lines):
            warnings.simplefilter("ignore", UserWarning)  # a reader may say what it leaves out
            number = len(list(read(given)))
        outcome = "no banner" if number == 0 else "a banner" if number == 1 else "banners"
    except DraperyError as error:
        outcome = kind_of(str(error))
        if "\n" in str(error):
            report.failures.append((given, f"an error of many lines: {error!r}"))
    except Exception as error:  # what the fuzzing is for: any other end is a failure
        outcome = f"FAILED {type(error).__name__}"
        report.failures.append((given, repr(error)))
    seconds = time.process_time() - start
    if lines:
        report.failures.append((given, f"a library wrote {lines[0]!r} beside the error"))
    if seconds > slowest:
        report.failures.append((given, f"took {seconds:.2f} s"))
    grown = _memory("VmHWM") - before
    if grown > MAX_MEMORY:
        report.failures.append((given, f"took {grown:.0f} MB"))
    report.slowest = max(report.slowest, seconds)
    report.heaviest = max(report.heaviest, grown)
    report.outcomes[outcome] += 1


@contextmanager
def _logged(lines: list[str]) -> Iterator[None]:
    """Collect what libraries log without a handler, which Python writes to standard error."""
    handler, before = logging.Handler(logging.WARNING), logging.lastResort
    handler.emit = lambda record: lines.append(record.getMessage())  # type: ignore[method-assign]
    logging.lastResort = handler  # type: ignore[assignment]
    try:
        yield
    finally:
        logging.lastResort = before


def _memory(name: str) -> float:
    """This process's memory now (VmRSS) or at its peak (VmHWM) [MB]; 0 if unknown."""
    if not _STATUS.exists():
        return 0.0
    line = next(
        line for line in _STATUS.read_text(encoding="utf-8").splitlines() if line.startswith(name)
    )
    return int(line.split()[1]) / 1024


def _forget_peak() -> None:
    """Reset the peak; see proc(5), /proc/pid/clear_refs."""
    if _CLEAR.exists():
        _CLEAR.write_text("5", encoding="utf-8")


def kind_of(message: str) -> str:
    """An error without its place and numbers: `over N tags by byte N`."""
    tail = message.rpartition(": ")[2] if ": " in message else message
    tail = re.sub(r"'[^']*'|\"[^\"]*\"", "'…'", tail).partition(";")[0]
    tail = re.sub(r"\(.*?\)", "(…)", tail).rstrip(")")
    return re.sub(r"[+-]?[\d.,]+(e[+-]?\d+)?", "N", tail)[:60]


def mutate_bytes(rng: random.Random, samples: Sequence[bytes]) -> bytes:
    """A sample with one to eight changes: half of them of its tree, the rest of its bytes."""
    data = rng.choice(samples)
    if rng.random() < 0.5:
        return _with_other_tree(rng, data)
    if data[:2] == GZIP and rng.random() < 0.8:
        return gzip.compress(change_bytes(rng, gzip.decompress(data), samples), 1, mtime=0)
    return change_bytes(rng, data, samples)


def unwrapped(sample: bytes) -> bytes:
    """A sample without its compression."""
    return gzip.decompress(sample) if sample[:2] == GZIP else sample


def _with_other_tree(rng: random.Random, data: bytes) -> bytes:
    """The file with changed tags, written anew, so that the reader gets past the bytes."""
    if data[:2] == GZIP:
        return gzip.compress(_changed_nbt(rng, gzip.decompress(data), "big"), 1, mtime=0)
    if data[0] == 10:
        return _changed_nbt(rng, data, "little")
    chunks = [_chunk_nbt(data, number) for number in range(3)]
    number = rng.randrange(3)
    chunks[number] = _changed_nbt(rng, chunks[number], "big")
    bodies = [struct.pack(">IB", len(chunk) + 1, 3) + chunk for chunk in chunks]
    return make.region({(n, 0): body for n, body in enumerate(bodies)})


def _chunk_nbt(region: bytes, number: int) -> bytes:
    at = int.from_bytes(region[4 * number : 4 * number + 3], "big") * 4096
    return region[at + 5 : at + 4 + int.from_bytes(region[at : at + 4], "big")]


def _changed_nbt(rng: random.Random, raw: bytes, order: str) -> bytes:
    # A file is the one entry of a compound, without the tag that would close the compound.
    file = nbtlib.Compound.parse(io.BytesIO(raw + b"\0"), order)
    (root,) = file.values()
    for _ in range(rng.randint(1, 8)):
        _change_tag(rng, root)
        if sum(map(len, _containers(root))) > MAX_TAGS:
            break
    out = io.BytesIO()
    file.write(out, order)
    return out.getvalue()[:-1]


def _change_tag(rng: random.Random, root: nbtlib.Compound) -> None:
    """Delete, replace, rename or multiply one tag of the tree."""
    parents = [node for node in _containers(root) if len(node)]
    if not parents:
        return
    parent = rng.choice(parents)
    other = rng.choice(parents)
    if isinstance(parent, list):
        at = rng.randrange(len(parent))
        if rng.random() < 0.5:
            parent[at : at + 1] = [parent[at]] * rng.choice((0, 2, 20, 300))
        elif fitting := [tag for tag in _ODD_TAGS if isinstance(tag, type(parent[at]))]:
            parent[at] = rng.choice(fitting)
        return
    key = rng.choice(list(parent))
    tag = parent.pop(key) if rng.random() < 0.6 else parent[key]
    if rng.random() < 0.3 and not isinstance(other, list):
        key = rng.choice(list(other) or [key])
    parent[key] = rng.choice(_ODD_TAGS) if rng.random() < 0.6 else tag


def _containers(root: Any) -> list[Any]:
    found, left = [], [root]
    while left:
        node = left.pop()
        if isinstance(node, dict | list):
            found.append(node)
            left.extend(node.values() if isinstance(node, dict) else node)
    return found


_ODD_TAGS = [
    *(nbtlib.Int(n) for n in (-1, 0, 1, 15, 16, 99, 2**31 - 1, -(2**31))),
    *(nbtlib.Byte(n) for n in (-128, 0, 1, 127)),
    *(nbtlib.Short(n) for n in (-1, 0, 2**15 - 1)),
    *(nbtlib.Long(n) for n in (-(2**63), 2**63 - 1)),
    *(nbtlib.Double(n) for n in (float("nan"), float("inf"), 1e300, -0.5)),
    *(nbtlib.String(s) for s in ("", "Banner", "minecraft:banner", "minecraft:red_banner", "cr")),
    *(
        nbtlib.String(s)
        for s in ("minecraft:shield", "a:b", "red", "\n\t", "x" * 9999, "\U0001f600")
    ),
    *(nbtlib.List[kind]() for kind in (nbtlib.Int, nbtlib.Compound, nbtlib.String, nbtlib.List)),
    nbtlib.List[nbtlib.Int](range(3)),
    nbtlib.List[nbtlib.Double]([float("nan")] * 3),
    nbtlib.List[nbtlib.Compound]([nbtlib.Compound()] * 20),
    nbtlib.Compound(),
    nbtlib.ByteArray([-1] * 20),
    nbtlib.ByteArray([]),
    nbtlib.IntArray([-1, 2**31 - 1, 5]),
    nbtlib.LongArray([-1] * 342),
    nbtlib.LongArray([]),
]


def change_bytes(rng: random.Random, data: bytes, samples: Sequence[bytes]) -> bytes:
    """One to eight changes of bytes."""
    for _ in range(rng.randint(1, 8)):
        data = rng.choice(_BYTE_CHANGES)(rng, data, samples)[:MAX_INPUT]
    return data


def _place(rng: random.Random, data: Sequence[Any]) -> int:
    """Half of the changes go to the first hundred places, where the structure is."""
    return (
        rng.randrange(min(len(data), 100) + 1)
        if rng.random() < 0.5
        else rng.randrange(len(data) + 1)
    )


def _flip(rng: random.Random, data: bytes, _: Any) -> bytes:
    at = _place(rng, data)
    return (
        data[:at]
        + bytes(byte ^ 1 << rng.randrange(8) for byte in data[at : at + 1])
        + data[at + 1 :]
    )


def _overwrite(rng: random.Random, data: bytes, _: Any) -> bytes:
    at, piece = _place(rng, data), rng.choice(_EXTREMES)
    return data[:at] + piece + data[at + len(piece) :]


def _insert(rng: random.Random, data: bytes, _: Any) -> bytes:
    at = _place(rng, data)
    return data[:at] + rng.randbytes(rng.randint(1, 9)) + data[at:]


def _cut(rng: random.Random, data: bytes, _: Any) -> bytes:
    at = _place(rng, data)
    return data[:at] if rng.random() < 0.3 else data[:at] + data[at + rng.randint(1, 40) :]


def _repeat(rng: random.Random, data: bytes, _: Any) -> bytes:
    at = _place(rng, data)
    return data[:at] + data[at : at + rng.randint(1, 40)] * rng.choice((2, 9, 600)) + data[at:]


def _splice(rng: random.Random, data: bytes, samples: Any) -> bytes:
    other = rng.choice(samples)
    at, start = _place(rng, data), _place(rng, other)
    return data[:at] + other[start : start + rng.randint(1, 200)] + data[at:]


_EXTREMES = [
    *(struct.pack(">i", n) for n in (-1, 0, 2**31 - 1, -(2**31), 500_001, 2**24)),
    *(struct.pack("<i", n) for n in (2**31 - 1, 2**24)),
    b"\xff\xff",
    b"\0\0",
    *(bytes([kind]) for kind in range(14)),
    b"\x09\0\0\0\x01" * 200,
    b"\x0a\0\0" * 200,
]

_BYTE_CHANGES = [_flip, _flip, _overwrite, _overwrite, _insert, _cut, _repeat, _splice]


def mutate_text(rng: random.Random, samples: Sequence[str], most: int = 8) -> str:
    """A sample with one to `most` changes."""
    text = rng.choice(samples)
    for _ in range(rng.randint(1, most)):
        text = rng.choice(_TEXT_CHANGES)(rng, text, samples)
    return text


def _insert_token(rng: random.Random, text: str, _: Any) -> str:
    at = _place(rng, text)
    return text[:at] + rng.choice(_TOKENS) + text[at:]


def _replace_letter(rng: random.Random, text: str, _: Any) -> str:
    at = _place(rng, text)
    return text[:at] + rng.choice(_LETTERS) + text[at + 1 :]


_LETTERS = "\"'{}[]:;,=?&./\\-+_0123456789abcdefABCXYZ \t\n\0é€\U0001f600\ud800"
_TOKENS = [
    *(
        "[" * 600,
        "{a:" * 600,
        "(" * 99,
        "]" * 9,
        "}" * 9,
        '"',
        "'",
        "\\",
        "\\u0000",
        "\\N{DIGIT ONE}",
    ),
    *("9" * 400, "-1", "1e400", "0x" + "f" * 99, "0b1", "1_000", "NaN", "true", "null", "bool(1)"),
    *(
        "[B;1b]",
        "[L;" + "9" * 30 + "]",
        "uuid(a)",
        "minecraft:",
        "a:b:c",
        "%00",
        "%ff",
        "&b=",
        "?=",
    ),
    *(
        "Patterns:[",
        "Color:99",
        'pattern:{asset_id:"a:b"}',
        "creeper",
        "red",
        "\n",
        "  ",
        "//",
        "#",
    ),
]

_TEXT_CHANGES = [_replace_letter, _replace_letter, _insert_token, _cut, _repeat, _splice]


def binary_samples() -> dict[str, list[bytes]]:
    """Sound files of every form of bytes, small, so that changes hit what matters."""
    blocks = {
        (1, 0, 3): (make.block_id(make.RED), make.entity(make.RED)),
        (0, 0, 1): (make.block_id(make.LIME, wall=True), make.entity(make.LIME)),
        (0, 1, 0): ("minecraft:chest", make.chest(make.RED, make.SHIELD)),
        (1, 1, 1): (make.block_id(make.PLAIN), None),
    }
    old = {(1, 0, 3): (make.block_id(make.RED), make.entity(make.RED, "1.13"))}
    older = {(1, 0, 3): (None, make.entity(make.RED, "1.12"))}
    now = {place: block for place, block in blocks.items() if block[1]}
    chunks = [make.chunk("1.18", now), make.chunk("1.13", old, 40), make.chunk("1.12", older)]
    bedrock = {(1, 2, 3): make.bedrock_entity(make.RED), (0, 0, 0): make.bedrock_entity(make.LIME)}
    player = {"Inventory": [make.item(make.RED), make.item(make.SHIELD)], "Pos": [1, 2, 3, 4, 5]}
    schematics = [make.schem(version, (2, 2, 4), blocks, 3) for version in (1, 2, 3)]
    return {
        "structure": [structure.write([make.RED]), make.nbt_file(make.structure(blocks))],
        "schem": [schem.write(row_of([make.LIME, make.RED])), *map(make.nbt_file, schematics)],
        "schem3": [schem.write(row_of([make.LIME, make.RED]), version=3)],
        "schematic": [make.nbt_file(make.mcedit((2, 2, 4), make.RED, (1, 0, 3)), "Schematic")],
        "litematic": [make.nbt_file(make.litematic((2, -2, 4), (0, 0, 0), blocks, 20))],
        "mcstructure": [make.raw_nbt(make.mcstructure((2, 3, 4), bedrock), "little")],
        "blueprint": [make.nbt_file(make.blueprint((2, 2, 4), blocks))],
        "region": [make.region({(n, 0): chunk for n, chunk in enumerate(chunks)}, 3)],
        "nbt": [*map(make.nbt_file, chunks), make.nbt_file(player), make.raw_nbt(player, "little")],
    }


def binary_readers() -> dict[str, Callable[[bytes], Iterable[Any]]]:
    """The reader of each form of bytes."""
    return {name: form.read for name, form in BINARY_FORMS.items()}


def text_readers() -> dict[str, Callable[[str], Iterable[Any]]]:
    """The reader of each form of text; `any text` is the parser that recognises the form."""
    readers: dict[str, Callable[[str], Iterable[Any]]] = {
        name: form.read for name, form in FORMS.items()
    }
    return readers | {ANY_TEXT: parse_banners}


def text_samples() -> dict[str, list[str]]:
    """Sound texts of every form of text."""
    samples = {name: _texts(name) for name in FORMS}
    lines = "# ours\n- white creeper:lime\n- red cross:5\n"
    return samples | {ANY_TEXT: [lines, *(text for texts in samples.values() for text in texts)]}


_LAYERS = '[banner_patterns=[{pattern:"creeper",color:"lime"}'
LONG_TEXTS = {
    "broken lines": f"/give @p white_banner{_LAYERS}\n",
    "unclosed lines": "give @p white_banner[banner_patterns=[{\n",
    "unclosed words": "give [banner\n",
    "lines broken within a word": f"give @p white_ban\\\nner{_LAYERS}]]\n",
    "lines broken within a name": 'give @p red_banner[banner_patterns=[{pattern:"cree\nper"}]]\n',
    "lists of a command": "give @p white_banner[{\n {\n {\n",
    "short lines": "a\\\n",
    "talk": "say a banner\n",
    "comments": "# banner layers\n",
}
"""Lines that took the processor's time when they were repeated up to the longest text."""

_MORE_TEXTS = {
    "function": [
        "# comment\n$give @s red_banner[lore=[$(a)],banner_patterns=[{pattern:cross,color:red}]]\n"
        'say it\'s a banner\ngive @s red_banner[\\\n  banner_patterns=[{pattern:"cross",\\\n'
        'color:"red"}]]\nexecute @p ~ ~ ~ detect ~ ~ ~ stone 0 give @p shield 1 0 '
        "{BlockEntityTag:{Base:15,Patterns:[{Pattern:cre,Color:10}]}}\nclear @s red_banner\n"
        "data modify storage a:b c set value [{id:red_banner},[{id:'banner',Count:1}],5]\n"
        "execute as @a[nbt=!{a:1}] run fill 1 2 3 4 5 6 red_banner replace blue_banner\n",
        "give @p red_banner[\n  banner_patterns=[\n    {pattern:cross,color:red}\n  ]\n]\nsay {\n"
        "give @p\n  blue_banner[banner_patterns=[{pattern:cro\\\nss,color:red}]]\n  1\n",
    ],
    "kubejs": [
        "const tag = {BlockEntityTag:{Patterns:[{Pattern:'cre',Color:5}]}}\n"
        "event.shapeless(Item.of('2x white_banner', 3, tag), [`white_banner[banner_patterns=["
        "{pattern:creeper,color:lime}]]`, 'stick'])\nItem.of('shield').withCount(2)"
        ".set('base_color', 'red').set('banner_patterns', [{pattern:'cross',color:'red'}])\n"
        "Item.of('red_banner', {'minecraft:banner_patterns':[]}).withNBT({})",
    ],
    "javascript": [
        "/* a */ const b = {id: 'minecraft:red_banner', count: 2 * n, use() { go(); },\n"
        "components: {banner_patterns: [{pattern: `cross`, color: 'red',}], 'a': (x) => [x]}};\n"
        "// b\nmodule.exports = [{base: dark ? 'red' : 'blue', layers, key: 'it\\'s'}];\n"
        "f({base: 'lime', kind: 'shield', layers: [{pattern: \"cre\\x65per\", color: 'black'}]})",
    ],
    "loot-table": [
        '{"functions": [{"function": "set_components", "components": {"banner_patterns": '
        '[{"pattern": "cross", "color": "red"}], "base_color": "red"}}], "pools": [{"entries": ['
        '{"type": "item", "name": "shield"}, {"name": "banner", "functions": [{"function": '
        '"set_banner_details", "type": 1}, {"function": "set_data", "data": 3}, {"function": '
        '"sequence", "functions": [{"function": "reference", "name": "a:b"}]}]}]}]}',
        '{"criteria": {"a": {"items": ["red_banner"], "nbt": "{BlockEntityTag:{Patterns:['
        '{Pattern:cre,Color:5}]}}"}}, "icon": {"item": "red_banner", "nbt": "{}"}, "result": '
        '"blue_banner", "rules": [{"output_state": {"Name": "red_banner"}, "output_nbt": "{}"}]}',
    ],
}
"""Sound texts of forms that one written banner does not exhaust."""


def _texts(form: str) -> list[str]:
    texts = [FORMS[form].example, *_MORE_TEXTS.get(form, ())]
    for design in ("red", "white creeper:lime border:black", "shield blue acme:x:red flow:lime"):
        with suppress(DraperyError):
            texts.append(write_banner(parse_banner(design), form))
    return texts + (_TYPED if form == "text" else [])


_TYPED = [
    "red banner with white skull and black border",
    "white creeper lime border black",
    "Rotes Banner\nWeißer Creeper\nSchwarzer Bord",
    "rot creeper:weiß bord:schwarz",
    "红色旗帜\n白色苦力怕盾徽",
]
"""What the form `text` reads beside its own shorthand."""
