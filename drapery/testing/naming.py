"""Where the goldens of a pytest test lie, and which goldens may belong to a test.

A golden is `goldens/<test file>/<test>[<label>].png` beside the test's file; numbers are `.npz`,
hashes `.sha256`. A digest of the whole name replaces what a file name cannot hold. Other approved
pictures of the same golden have `~<variant>` before the ending.
"""

import hashlib
import re
from pathlib import Path
from unicodedata import category

FOLDER = "goldens"
ENDINGS = (".png", ".npz", ".sha256")
"""The endings of goldens; no other file is written or deleted."""
MAX_NAME = 200
"""The most bytes of a golden's name; file systems take 255 with the ending."""
VARIANT = re.compile(r"[A-Za-z0-9._-]{1,32}")
"""The names of variants."""

_FORBIDDEN = frozenset('\\/?*:|"<>')
"""What some file system has in no name."""
_VARIANT_AT_END = re.compile(rf"~{VARIANT.pattern}$")


def golden_folder(test_file: Path) -> Path:
    """The folder of the goldens of a file of tests."""
    return test_file.parent / FOLDER / test_file.stem


def golden_stem(test: str, label: str) -> str:
    """The name of a golden's file without its ending.

    test: the name of the test with its classes and its parameters. label: of the golden.
    """
    whole = f"{test}[{label}]"
    short = _short(whole)
    return whole if short == whole else f"{short}-{hashlib.sha256(whole.encode()).hexdigest()[:8]}"


def may_belong(stem: str, test: str) -> bool:
    """Whether a golden's file may be one of a test, whatever its label."""
    return stem.startswith(_short(f"{test}["))


def _short(name: str) -> str:
    clean = "".join(c for c in name if c not in _FORBIDDEN and not category(c).startswith("C"))
    return clean.encode()[:MAX_NAME].decode(errors="ignore")


def variant_path(path: Path, variant: str) -> Path:
    """The file of another approved picture of a golden."""
    return path.with_name(f"{path.stem}~{variant}{path.suffix}")


def approved_paths(path: Path) -> list[Path]:
    """The files of all approved pictures of a golden: its own first, then the variants by name."""
    try:
        names = sorted(file.name for file in path.parent.iterdir())  # no glob: names hold brackets
    except (FileNotFoundError, NotADirectoryError):
        return []
    start = f"{path.stem}~"
    beside = (path.with_name(name) for name in names if name.startswith(start))
    variants = [file for file in beside if without_variant(file) == path]
    return [path, *variants] if path.name in names else variants


def without_variant(path: Path) -> Path:
    """The golden whose approved picture a file is."""
    return path.with_name(_VARIANT_AT_END.sub("", path.stem) + path.suffix)
