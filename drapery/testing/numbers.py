"""Goldens of numbers: arrays with a stated tolerance, and files by their hash."""

import hashlib
import io
import math
import zipfile
import zlib
from collections.abc import Mapping
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.comparison import MAX_FILE
from drapery.errors import OptionError, counted, shown
from drapery.testing.check import GoldenCheck, GoldenResult, check_content
from drapery.testing.golden import GoldenError
from drapery.user_files import read_user_file

Numbers = dict[str, NDArray[Any]]
"""Arrays by name; a single array has the name `numbers`."""

KINDS = "biufc"
"""The kinds of arrays that hold numbers, by numpy's letters."""


def is_file(source: Any) -> bool:
    """Whether a golden of a source is the hash of a file."""
    return isinstance(source, (str, PathLike))


def check_numbers(check: GoldenCheck, source: Any, within: float) -> GoldenResult:
    """Compare arrays or a file with the golden, or write it in an update.

    Raises OptionError for what holds no numbers and for a tolerance that does nothing.
    """
    if not 0 <= within < math.inf:
        raise OptionError(f"within {within} is not a distance; use 0 or more")
    if is_file(source):
        if within:
            raise OptionError("within does nothing for a file, whose bytes count; leave it out")
        data = _fingerprint(Path(source))
        return check_content(check, data, lambda known: _hash_changed(known, data))
    numbers = as_numbers(source)
    return check_content(
        check,
        encode_numbers(numbers),
        lambda known: changed(decode_numbers(known), numbers, within),
    )


def as_numbers(source: Any) -> Numbers:
    """Arrays by name, of a mapping of arrays, an array or a number.

    Raises OptionError for what holds no numbers.
    """
    given = source if isinstance(source, Mapping) else {"numbers": source}
    numbers = {}
    for name, value in given.items():
        if not isinstance(name, str) or not name or "/" in name:
            raise OptionError(f"{shown(name)} is not the name of an array; use a word")
        try:
            array = np.asarray(value)
        except ValueError:
            array = np.array(None)
        if array.dtype.kind not in KINDS:
            raise OptionError(
                f"{shown(value)} has no numbers; give an array, or the path of a file"
            )
        numbers[name] = array
    return numbers


def encode_numbers(numbers: Numbers) -> bytes:
    """The bytes of a golden file of arrays, which `numpy.load` reads."""
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, array in numbers.items():
            inner = io.BytesIO()
            np.save(inner, array, allow_pickle=False)
            # Without a date of its own the same arrays give the same bytes.
            archive.writestr(zipfile.ZipInfo(f"{name}.npy"), inner.getvalue(), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()


def decode_numbers(data: bytes) -> Numbers:
    """The arrays in a golden file. Raises GoldenError."""
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            if sum(each.file_size for each in archive.infolist()) > MAX_FILE:
                raise GoldenError(f"its arrays have over {MAX_FILE >> 20} MiB; keep fewer numbers")
            return {
                each.filename.removesuffix(".npy"): np.load(
                    io.BytesIO(archive.read(each)), allow_pickle=False
                )
                for each in archive.infolist()
            }
    except (ValueError, OSError, EOFError, zipfile.BadZipFile, zlib.error, NotImplementedError):
        raise GoldenError("the golden is not a readable NPZ") from None


def changed(expected: Numbers, actual: Numbers, within: float) -> str:
    """What differs, in a line; nothing where all arrays agree."""
    if expected.keys() != actual.keys():
        return f"the arrays are {', '.join(actual)}, they were {', '.join(expected)}"
    lines = (_array_changed(name, was, actual[name], within) for name, was in expected.items())
    return "; ".join(line for line in lines if line)


def _array_changed(name: str, was: NDArray[Any], now: NDArray[Any], within: float) -> str:
    if (was.shape, was.dtype.name) != (now.shape, now.dtype.name):
        forms = (f"{each.dtype.name} [{', '.join(map(str, each.shape))}]" for each in (now, was))
        return f"{name} are {', they were '.join(forms)}"
    with np.errstate(all="ignore"):  # infinite numbers agree with themselves alone
        apart = np.abs(now.astype(_wide(now)) - was.astype(_wide(was)))
        agrees = (now == was) | ((now != now) & (was != was)) | (apart <= within)
    if agrees.all():
        return ""
    beyond = np.where(agrees, -1.0, np.where(np.isnan(apart), np.inf, apart))
    place = np.unravel_index(int(beyond.argmax()), now.shape)
    at = f" at [{', '.join(map(str, map(int, place)))}]" if now.shape else ""
    limit = f" by more than {within:g}" if within else ""
    return (
        f"{name} differ{limit} in {(~agrees).sum()} of {now.size}, the most{at}:"
        f" {now[place]:.9g}, it was {was[place]:.9g}"
    )


def _wide(array: NDArray[Any]) -> type:
    return np.complex128 if array.dtype.kind == "c" else np.float64


def _fingerprint(path: Path) -> bytes:
    """The golden of a file: one line with its size and the SHA-256 of its bytes."""
    data = read_user_file(path, MAX_FILE, shorter="write a smaller file")
    return f"{counted(len(data), 'byte')} sha256:{hashlib.sha256(data).hexdigest()}\n".encode()


def _hash_changed(known: bytes, now: bytes) -> str:
    if known == now:
        return ""
    was = known.decode("ascii", "replace").strip()
    return f"the file changed from {was} to {now.decode().strip()}"
