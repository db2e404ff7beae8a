"""WebAssembly modules as bytes: their sections, and modules with some of their functions.

A module is a head of eight bytes and sections; a section is the number of its kind, its length and
its content. Numbers are in LEB128: seven bits a byte, the lowest first.
"""

from collections.abc import Collection, Iterator

HEAD = b"\0asm\x01\0\0\0"
CUSTOM, EXPORT, CODE = 0, 7, 10
"""The kinds of sections that are read here. The content of a custom one begins with its name."""
FUNCTION = 0
"""The kind of an export."""
FUNCTION_NAMES = 1
"""The part of the section `name` that has those of functions."""
UNREACHABLE = b"\0\0\x0b"
"""The body of a function without locals that fails."""


def sections(module: bytes) -> Iterator[tuple[int, bytes]]:
    """The kind and the content of each section."""
    at = len(HEAD)
    while at < len(module):
        kind = module[at]
        content, at = _text(module, at + 1)
        yield kind, content


def custom_section(name: str, content: bytes) -> bytes:
    """A custom section as bytes, which can be appended to a module."""
    text = name.encode()
    return _section(CUSTOM, _number(len(text)) + text + content)


def custom_content(module: bytes, name: str) -> bytes | None:
    """The content of the custom section with this name; None without one."""
    for kind, content in sections(module):
        if kind == CUSTOM:
            found, start = _text(content, 0)
            if found == name.encode():
                return content[start:]
    return None


def function_names(module: bytes) -> dict[str, int]:
    """The numbers of functions by the names that the linker wrote into the section `name`."""
    found: dict[str, int] = {}
    content, at = custom_content(module, "name") or b"", 0
    while at < len(content):
        part = content[at]
        names, at = _text(content, at + 1)
        if part == FUNCTION_NAMES:
            count, place = _read(names, 0)
            for _ in range(count):
                number, place = _read(names, place)
                name, place = _text(names, place)
                found[name.decode()] = number
    return found


def trimmed(module: bytes, exports: Collection[str], functions: Collection[int]) -> bytes:
    """The module with these exports of functions, and the bodies of functions with these numbers,
    without custom sections. The other functions keep their numbers, and fail if they are called."""
    made = [HEAD]
    for kind, content in sections(module):
        if kind == EXPORT:
            content = _kept_exports(content, exports)
        elif kind == CODE:
            content = _kept_bodies(content, functions)
        if kind != CUSTOM:
            made.append(_section(kind, content))
    return b"".join(made)


def _kept_exports(content: bytes, names: Collection[str]) -> bytes:
    count, at = _read(content, 0)
    kept = []
    for _ in range(count):
        start = at
        name, at = _text(content, at)
        is_kept = content[at] != FUNCTION or name.decode() in names
        _, at = _read(content, at + 1)
        if is_kept:
            kept.append(content[start:at])
    return _number(len(kept)) + b"".join(kept)


def _kept_bodies(content: bytes, numbers: Collection[int]) -> bytes:
    count, at = _read(content, 0)
    made = [_number(count)]
    for number in range(count):
        body, at = _text(content, at)
        kept = body if number in numbers else UNREACHABLE
        made.append(_number(len(kept)) + kept)
    return b"".join(made)


def _section(kind: int, content: bytes) -> bytes:
    return bytes([kind]) + _number(len(content)) + content


def _text(data: bytes, at: int) -> tuple[bytes, int]:
    """Bytes after their length, and where they end."""
    length, start = _read(data, at)
    return data[start : start + length], start + length


def _read(data: bytes, at: int) -> tuple[int, int]:
    """A number, and where it ends."""
    number = shift = 0
    while True:
        byte, at = data[at], at + 1
        number |= (byte & 127) << shift
        shift += 7
        if byte < 128:
            return number, at


def _number(value: int) -> bytes:
    made = bytearray()
    while value > 127:
        made.append(value & 127 | 128)
        value >>= 7
    return bytes([*made, value])
