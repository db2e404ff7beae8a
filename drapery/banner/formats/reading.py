"""Reads banners from a text, a file, a folder, a world, or standard input."""

import os
import re
import sys
import warnings
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

from drapery.banner.formats.form import BinaryForm
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.registry import (
    FORMS,
    binary_forms,
    named_now,
    parse_all,
    parse_banners,
    some_of,
    unknown_form,
    warn_of,
)
from drapery.banner.formats.snbt import MAX_TEXT
from drapery.banner.names import shown
from drapery.errors import DesignError
from drapery.user_files import open_user_file

_HEAD = 8192
_ZIP = b"PK\x03\x04"
_MOST_NAMED = 20

_FILE_NAME = re.compile(r"[^\s:{}\[\]\"'?&=]+\.[A-Za-z][A-Za-z0-9]{1,5}")
"""One word with a suffix: a file name, since no text of a banner looks like that."""

_PATH = re.compile(r"(?:\.{0,2}/)?[\w.-]{1,200}(?:/[\w.-]{1,200}){0,20}/?")
"""One word that may be the name of a file or a folder."""

_SUFFIXES = tuple(
    f".{suffix}"
    for suffix in (
        *("json", "txt", "snbt", "mcfunction", "yml", "yaml", "sk", "dsc", "zs", "js"),
        *("nbt", "dat", "schem", "schematic", "litematic", "mcstructure", "blueprint", "mca"),
    )
)
"""Of the files that are read in a folder."""


def read_designs(source: str | Path, *, form: str | None = None) -> list[FoundBanner]:
    """All banners of a text, a file, a folder of files, a world, a data pack, or standard input.

    A data pack may be a folder or a zip; those of a world are read with it. A folder that is
    neither a world nor a pack is read file by file, sorted by name, without its folders and links;
    each banner's place begins with its file's name. One UserWarning names all that is not read,
    with the reason.

    source: a text, or the path of a file or folder if there is one of that name; "-" is standard
        input.
    form: one of FORMS or of `binary_forms()`, or None to recognise it.

    Raises DesignError as `parse_banners` does, for files that cannot be read, and for a folder
    without a design or with over 100,000 files.
    """
    if not isinstance(source, str | Path):
        raise DesignError(f"design {shown(source)} is not a text; write it in quotes")
    form = named_now(form)
    if source == "-":
        return parse_banners(_decoded(_read_stdin(), "-"), form=form)
    path = _as_path(source)
    if path is None:
        return _read_text(str(source), form)
    errors: list[DesignError] = []
    try:
        if path.is_dir() and not _is_world(path) and not _is_pack(path):
            return _read_folder(path, form)
        found = _read_path(path, form, errors)
    except OSError as error:
        raise DesignError(f"{path}: {error.strerror or error}; check the path") from None
    warn_of(errors)
    return found


def _read_stdin() -> bytes:
    try:
        return sys.stdin.buffer.read(4 * MAX_TEXT + 1)
    except (AttributeError, OSError):  # Python has no sys.stdin where the descriptor is closed
        raise DesignError("-: standard input cannot be read; give the design or a file") from None


def _read_text(text: str, form: str | None) -> list[FoundBanner]:
    """The banners of a text; the error of a single word says that no file has that name."""
    errors: list[DesignError] = []
    try:
        found = parse_all(text, form, errors)
    except DesignError as error:
        if "/" in text and _PATH.fullmatch(text):
            raise DesignError(f"{text}: there is no such file or folder; check the path") from None
        if _PATH.fullmatch(text):
            raise DesignError(f"{error} (and no file or folder has that name)") from None
        raise
    warn_of(errors)
    return found


def _as_path(source: str | Path) -> Path | None:
    """The file or folder that a source names, or None if the source is a text."""
    if isinstance(source, Path):
        return source
    if not source.strip() or len(source) > 1024 or "\n" in source or "\0" in source:
        return None
    path = Path(source)
    try:
        if path.is_dir():
            is_word = path.name == source and not _is_world(path)
            return None if is_word and _is_design(source) else path
        if path.exists():
            return path
    except OSError:  # the text is too long for a name
        return None
    known = path.suffix.lower() in _SUFFIXES and not set('{}[]"').intersection(source)
    if known or _FILE_NAME.fullmatch(source):
        raise DesignError(f"{shown(source, 80)}: there is no such file; check the path")
    return None


def _is_design(text: str) -> bool:
    try:
        return bool(parse_all(text, None, []))
    except DesignError:
        return False


def _is_world(path: Path) -> bool:
    """Whether a folder is a world of either edition; one of Bedrock Edition is refused later."""
    files = (path / "level.dat", path / "db" / "CURRENT")
    return any(file.exists() for file in files) or (path / "region").is_dir()


def _is_pack(path: Path) -> bool:
    from drapery.banner.formats import datapack

    return datapack.is_pack(path)


def _read_pack(path: Path, errors: list[DesignError]) -> list[FoundBanner]:
    """All banners of a data pack. It is imported here, since it loads numpy."""
    from drapery.banner.formats import datapack

    find = datapack.in_folder if path.is_dir() else datapack.in_zip
    return some_of(list(find(path, errors.append)), errors, f"{path}: no banner in the pack")


def _read_path(path: Path, form: str | None, errors: list[DesignError]) -> list[FoundBanner]:
    from drapery.banner.formats.files import is_binary

    if form is not None and form not in FORMS:
        if form not in binary_forms():
            raise unknown_form(form)
        return _read_as(path, binary_forms()[form])
    if path.is_dir():
        kind = "a world" if _is_world(path) else "a data pack"
        _check_form(path, form, kind)
        return _read_world(path, errors) if _is_world(path) else _read_pack(path, errors)
    with open_user_file(path, descriptors=True) as file:
        head = file.read(_HEAD)
        if head.startswith(_ZIP):
            _check_form(path, form, "a zip")
            return _read_pack(path, errors)
        binary = is_binary(head, path.stat().st_size) or path.suffix.lower() == ".mca"
        if binary and form is None:
            return _read_binary(path, errors)
        data = head + file.read(4 * MAX_TEXT + 1 - len(head))
    try:
        text = _decoded(data, str(path))
    except DesignError:
        _check_form(path, form if binary else None, "a binary file")
        raise
    if form is None and path.suffix.lower() == ".mcfunction":
        form = "function"
    try:
        return parse_all(text, form, errors)
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from None


def _check_form(path: Path, form: str | None, kind: str) -> None:
    """Raise DesignError if the form of a text is asked for, but the path is not a text."""
    if form is not None:
        raise DesignError(
            f"{path}: {kind}, which cannot be read as the form {form!r};"
            " leave the form out, so that it is recognised"
        )


def _read_as(path: Path, form: BinaryForm) -> list[FoundBanner]:
    """All banners of a file, read in this form whatever its bytes look like."""
    from drapery.banner.formats.compression import MAX_BYTES, check_size

    if path.is_dir():
        raise DesignError(
            f"{path}: a folder, but not a file of the form {form.name!r}; give a file"
        )
    with open_user_file(path) as file:
        check_size(path.stat().st_size, str(path), MAX_BYTES)
        data = file.read(MAX_BYTES + 1)
    try:
        return some_of(list(form.read(data)), [], "no banner in it")
    except DesignError as error:
        raise DesignError(f"{path}: {error}") from None


def _read_world(path: Path, errors: list[DesignError]) -> list[FoundBanner]:
    """All banners of a world: of its regions, players and structures, and of its data packs."""
    from drapery.banner.formats import datapack
    from drapery.banner.formats.files import banners_in

    found = [*banners_in(path, errors.append), *datapack.in_world(path, errors.append)]
    return some_of(found, errors, f"{path}: no banner in it")


def _read_binary(path: Path, errors: list[DesignError]) -> list[FoundBanner]:
    from drapery.banner.formats.files import banners_in

    return some_of(list(banners_in(path, errors.append)), errors, f"{path}: no banner in it")


def _read_folder(folder: Path, form: str | None) -> list[FoundBanner]:
    """The banners of all files of a folder, with a warning that names what is not read."""
    if form is not None and form not in FORMS and form not in binary_forms():
        raise unknown_form(form)
    found: list[FoundBanner] = []
    skipped: list[str] = []
    for path in _sorted_entries(folder):
        errors: list[DesignError] = []
        try:
            _check_entry(path)
            found += [_in_file(one, path.name) for one in _read_path(path, form, errors)]
        except DesignError as error:
            errors = [error]
        except OSError as error:
            errors = [DesignError(f"{error.strerror or error}; make it readable")]
        skipped += [f"{path.name} ({_reason(error, path)})" for error in errors]
    if not found:
        remedy = f"give files such as {', '.join(_SUFFIXES[:5])}"
        rest = f"; not read: {_listed(skipped)}" if skipped else ""
        raise DesignError(f"{folder}: no design in the folder; {remedy}{rest}")
    if skipped:
        warnings.warn(f"{folder}: not read: {_listed(skipped)}", stacklevel=3)
    return found


def _sorted_entries(folder: Path) -> Iterator[Path]:
    from drapery.banner.formats import files

    names: list[str] = []
    with os.scandir(folder) as entries:
        for entry in entries:
            names.append(entry.name)
            if len(names) > files.MAX_FILES:
                raise DesignError(f"{folder}: over {files.MAX_FILES} files; split it")
    return (folder / name for name in sorted(names))


def _check_entry(path: Path) -> None:
    """Raises DesignError for what is not a file of designs by its kind or its name."""
    if path.is_symlink():
        raise DesignError("a link; give the file itself")
    if path.is_dir():
        raise DesignError("a folder; give it by itself")
    if not path.is_file():
        raise DesignError("not a file")
    if path.suffix.lower() not in _SUFFIXES:
        raise DesignError("not a known ending of a file of designs")


def _in_file(found: FoundBanner, name: str) -> FoundBanner:
    """The banner with a place that begins with its file's name."""
    if found.where.startswith(name):
        return found
    return replace(found, where=f"{name} {found.where}".rstrip())


def _reason(error: DesignError, path: Path) -> str:
    return str(error).removeprefix(f"{path}: ").removeprefix(f"{path.name}: ")


def _listed(skipped: list[str]) -> str:
    more = len(skipped) - _MOST_NAMED
    ending = f", and {more} more" if more > 0 else ""
    return ", ".join(skipped[:_MOST_NAMED]) + ending


def _decoded(data: bytes, name: str) -> str:
    encoding = "utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig"
    try:
        return data.decode(encoding)
    except UnicodeDecodeError as error:
        raise DesignError(
            f"{name}: neither text nor a known kind of file (byte {error.start});"
            " give UTF-8 text, NBT, a schematic or a region"
        ) from None
