"""The registry of forms: reads banners from any text or file, and writes a banner in any form."""

import re
import sys
import warnings
from collections.abc import Callable
from itertools import islice
from pathlib import Path
from types import ModuleType

from drapery.banner.design import Banner
from drapery.banner.formats import (
    bedrock,
    block_entity,
    commands,
    give,
    give_legacy,
    give_old,
    item,
    item_replace,
    minecraft_tools,
    needcoolshoes,
    own_json,
    planet_minecraft,
    setblock,
    shorthand,
    summon,
    trees,
    wynncraft,
)
from drapery.banner.formats.form import BinaryForm, Form, single
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.snbt import MAX_TEXT
from drapery.banner.names import shown
from drapery.errors import DesignError

MAX_COMMANDS = 20_000
"""Most commands in one text, one per line."""

_HEAD = 8192


def _form(module: ModuleType, read: Callable[[str], list[FoundBanner]]) -> Form:
    return Form(module.NAME, module.TITLE, module.EXAMPLE, module.recognises, read, module.write)


def _site(module: ModuleType) -> Form:
    def write(banner: Banner) -> str:
        if banner.kind not in module.KINDS:
            raise DesignError(f"{module.SITE} edits banners, not shields: write the form 'give'")
        address: str = module.write(banner)
        return address

    name = module.NAME.replace("_", "-")
    title = f"address of {module.SITE}'s editor, or its code alone"
    return Form(name, title, module.EXAMPLE, module.recognises, single(module.parse), write)


_TABLE = (
    _site(planet_minecraft),
    _site(needcoolshoes),
    _site(minecraft_tools),
    _form(give_old, commands.read_command),
    _form(setblock, commands.read_command),
    _form(summon, commands.read_command),
    _form(item_replace, commands.read_command),
    _form(block_entity, block_entity.read),
    _form(wynncraft, trees.read_wynncraft),
    _form(own_json, trees.read),
    _form(bedrock, trees.read),
    _form(item, trees.read),
    _form(give_legacy, commands.read_command),
    _form(give, commands.read_command),
    _form(shorthand, single(shorthand.parse)),
)

FORMS: dict[str, Form] = {form.name: form for form in _TABLE}
"""Every form of text by name. A text is read by the first form that recognises it."""


def recognise(text: str) -> Form:
    """The first form that recognises a text. Raises DesignError if none does."""
    for form in _TABLE:
        if form.recognises(text):
            return form
    if text.lstrip().startswith(("http://", "https://")):
        raise DesignError(
            f"{shown(text.strip(), 60)}: not the address of a known banner editor;"
            " copy the banner's /give command instead"
        )
    raise DesignError(
        f"{shown(text.strip(), 60)}: not a known form of a banner; write it as"
        f" {shorthand.EXAMPLE!r}, or paste a /give command"
    )


def parse_banners(text: str, *, form: str | None = None) -> list[FoundBanner]:
    """All banners of a text, at least one, each with its place in the text.

    form: one of FORMS, or None to recognise it. A text may have several commands, one on each
        line, as in a function file; a broken line is skipped with a warning.

    Raises DesignError with the place and the remedy.
    """
    if len(text) > MAX_TEXT:
        raise DesignError(f"the text has {len(text)} characters, over {MAX_TEXT}: shorten it")
    text = text.removeprefix("\ufeff")
    if not text.strip():
        raise DesignError(f"the text is empty: give a banner, such as {shorthand.EXAMPLE!r}")
    if form is not None:
        return _named(form).read(text)
    lines = _command_lines(text)
    return _all_lines(lines) if len(lines) > 1 else recognise(text).read(text)


def parse_banner(text: str, *, form: str | None = None, number: int | None = None) -> Banner:
    """The banner of a text in any form.

    form: one of FORMS, or None to recognise it. number: which banner, from 1, if the text holds
        several.

    Raises DesignError with the place and the remedy.
    """
    return choose_banner(parse_banners(text, form=form), number)


def write_banner(banner: Banner, form: str = "json") -> str:
    """The banner in one of FORMS. Raises DesignError if that form cannot hold it."""
    write = _named(form).write
    if write is None:
        raise DesignError(f"the form {form!r} can be read but not written")
    return write(banner)


def choose_banner(found: list[FoundBanner], number: int | None = None) -> Banner:
    """One of the banners that were found; several equal ones count as one.

    number: which, from 1. Raises DesignError if it is out of range, and for None if the banners
    differ.
    """
    if number is None and len({f.banner for f in found}) == 1:
        return found[0].banner
    if number is None:
        first, last = found[0].where, found[-1].where
        raise DesignError(
            f"{len(found)} banners, from {shown(first)} to {shown(last)}: choose one by its number"
        )
    if not 1 <= number <= len(found):
        raise DesignError(f"there is no banner number {number}; use 1 to {len(found)}")
    return found[number - 1].banner


def read_design(
    source: str | Path, *, form: str | None = None, number: int | None = None
) -> Banner:
    """The banner of a text, of a file if a file of that name exists, or of standard input ("-").

    Raises DesignError as `parse_banner` does, and for files that cannot be read.
    """
    return choose_banner(read_designs(source, form=form), number)


def read_designs(source: str | Path, *, form: str | None = None) -> list[FoundBanner]:
    """All banners of a text, a file or a world's folder, or standard input ("-").

    Raises DesignError as `parse_banners` does, and for files that cannot be read.
    """
    if source == "-":
        return parse_banners(_decoded(_read_stdin(), "-"), form=form)
    path = _as_path(source)
    if path is None:
        return parse_banners(str(source), form=form)
    try:
        return _read_path(path, form)
    except OSError as error:
        raise DesignError(f"{path}: {error.strerror or error}; check the path") from None


def _read_stdin() -> bytes:
    try:
        return sys.stdin.buffer.read(4 * MAX_TEXT + 1)
    except (AttributeError, OSError):  # Python has no sys.stdin where the descriptor is closed
        raise DesignError("-: standard input cannot be read; give the design or a file") from None


def _named(form: str) -> Form:
    if form in FORMS:
        return FORMS[form]
    if form in binary_forms():
        raise DesignError(f"the form {form!r} is for files, but this is a text; give a file")
    raise _unknown(form)


def _unknown(form: str) -> DesignError:
    import difflib

    known = (*FORMS, *binary_forms())
    close = difflib.get_close_matches(form[:40].lower(), known, 1)
    hint = f"; did you mean '{close[0]}'?" if close else f"; known are {', '.join(known)}"
    return DesignError(f"unknown form {shown(form)}{hint}")


def binary_forms() -> dict[str, BinaryForm]:
    """Every form of files by name. Importing them loads numpy, which texts do not need."""
    from drapery.banner.formats.binary import BINARY_FORMS

    return BINARY_FORMS


def _command_lines(text: str) -> list[tuple[int, str]]:
    """The lines that are commands, with their numbers; empty for a text of one line."""
    if "\n" not in text.strip():
        return []
    lines = enumerate(text.split("\n"), 1)
    return [(number, line) for number, line in lines if commands.command_of(line)]


def _all_lines(lines: list[tuple[int, str]]) -> list[FoundBanner]:
    """The banners of all commands. Broken commands are skipped if others are correct."""
    if len(lines) > MAX_COMMANDS:
        raise DesignError(f"the text has {len(lines)} commands, over {MAX_COMMANDS}: split it")
    found: list[FoundBanner] = []
    errors: list[DesignError] = []
    for number, line in lines:
        if "banner" not in line and "shield" not in line:
            continue
        try:
            read = commands.read_command(line, line=number)
            found += [FoundBanner(f.banner, f"line {number} {f.where}") for f in read]
        except DesignError as error:
            errors.append(DesignError(_with_line(str(error), number)))
    return _with_warnings(
        found, errors, "there is no banner in the commands: paste a /give command"
    )


def _with_line(message: str, number: int) -> str:
    if message.startswith("line "):
        return message
    return f"line {number}{', ' if message.startswith('column ') else ': '}{message}"


def _with_warnings(
    found: list[FoundBanner], errors: list[DesignError], nothing: str
) -> list[FoundBanner]:
    """The banners that were found, with warnings of the errors; raises if none was found."""
    if not found:
        raise errors[0] if errors else DesignError(nothing)
    for error in islice(errors, _MOST_WARNINGS):
        warnings.warn(str(error), stacklevel=3)
    if len(errors) > _MOST_WARNINGS:
        warnings.warn(f"and {len(errors) - _MOST_WARNINGS} more like these", stacklevel=3)
    return found


_MOST_WARNINGS = 5

_FILE_NAME = re.compile(r"[^\s:{}\[\]\"'?&=]+\.[A-Za-z][A-Za-z0-9]{1,5}")
"""One word with a suffix: a file name, since no text of a banner looks like that."""

_SUFFIXES = frozenset(
    f".{suffix}"
    for suffix in (
        *("json", "mcfunction", "snbt", "txt"),
        *("dat", "litematic", "mca", "mcstructure", "nbt", "schem", "schematic"),
    )
)


def _as_path(source: str | Path) -> Path | None:
    """The file or world that a source names, or None if the source is a text."""
    if isinstance(source, Path):
        return source
    if len(source) > 1024 or "\n" in source or "\0" in source:
        return None
    path = Path(source)
    try:
        if path.exists() and (not path.is_dir() or _is_world(path)):
            return path
        if path.is_dir() and path.name != source:
            raise DesignError(f"{shown(source, 80)}: a folder, but not a Java world; give a file")
    except OSError:
        return None
    known = path.suffix.lower() in _SUFFIXES and not set('{}[]"').intersection(source)
    if known or _FILE_NAME.fullmatch(source):
        raise DesignError(f"{shown(source, 80)}: there is no such file; check the path")
    return None


def _is_world(path: Path) -> bool:
    return (path / "level.dat").exists() or (path / "region").is_dir()


def _read_path(path: Path, form: str | None) -> list[FoundBanner]:
    from drapery.banner.formats.files import is_binary

    if form is not None and form not in FORMS:
        if form not in binary_forms():
            raise _unknown(form)
        return _read_as(path, binary_forms()[form])
    if path.is_dir():
        return _read_binary(path)
    with path.open("rb") as file:
        head = file.read(_HEAD)
        binary = is_binary(head, path.stat().st_size) or path.suffix.lower() == ".mca"
        if binary and form is None:
            return _read_binary(path)
        data = head + file.read(4 * MAX_TEXT + 1 - len(head))
    text = _decoded(data, str(path))
    try:
        return parse_banners(text, form=form)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from None


def _read_as(path: Path, form: BinaryForm) -> list[FoundBanner]:
    """All banners of a file, read in this form whatever its bytes look like."""
    from drapery.banner.formats.compression import MAX_BYTES, check_size

    if path.is_dir():
        raise DesignError(
            f"{path}: a folder, but not a file of the form {form.name!r}; give a file"
        )
    check_size(path.stat().st_size, str(path), MAX_BYTES)
    try:
        return _with_warnings(list(form.read(path.read_bytes())), [], "no banner in it")
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from None


def _read_binary(path: Path) -> list[FoundBanner]:
    from drapery.banner.formats.files import banners_in

    errors: list[DesignError] = []
    return _with_warnings(list(banners_in(path, errors.append)), errors, f"{path}: no banner in it")


def _decoded(data: bytes, name: str) -> str:
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise DesignError(
            f"{name}: neither text nor a known kind of file (byte {error.start});"
            " give UTF-8 text, NBT, a schematic or a region"
        ) from None
