"""Two folders of pictures: files of the same path are compared, and the others are named."""

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from drapery.comparison.pairs import Comparison, compare_variants
from drapery.comparison.picture import read_picture
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.comparison.variants import Variant
from drapery.comparison.words import difference_words
from drapery.errors import OptionError
from drapery.file_formats import endings_read

MAX_FILES = 100_000
"""The most files in a folder."""


@dataclass(frozen=True)
class FilePair:
    """A file of two folders.

    name: its path in the folders.
    verdict: "same", "within" the limits, "different", "removed", "added", or "broken".
    comparison: of both pictures; None unless both can be compared.
    path: of the file, if only one folder has it.
    fault: why both cannot be compared, or nothing.
    """

    name: str
    verdict: str
    comparison: Comparison | None = None
    path: Path | None = None
    fault: str = ""

    def line(self) -> str:
        """The result in one line."""
        return f"{self.name}: {self.words()}"

    def words(self) -> str:
        """The result without the name."""
        if self.comparison is not None:
            return difference_words(self.comparison.difference, self.comparison.tolerance)
        return self.fault or self.verdict


@dataclass(frozen=True)
class FolderFiles:
    """The pictures of a folder and of those in it.

    names: their paths in the folder, sorted.
    others: the number of files that are no pictures, and of links to folders.
    """

    names: tuple[str, ...]
    others: int


def folder_files(folder: Path) -> FolderFiles:
    """The files of a folder.

    Raises OptionError for a folder that cannot be read, or too many.
    """
    names: list[str] = []
    others = 0
    for parent, folders, files in os.walk(folder, onerror=_refuse):
        others += sum((Path(parent) / name).is_symlink() for name in folders)
        pictures = [name for name in files if name.lower().endswith(endings_read())]
        others += len(files) - len(pictures)
        within = Path(parent).relative_to(folder)
        names += ((within / name).as_posix() for name in pictures)
        if len(names) + others > MAX_FILES:
            raise OptionError(f"{folder} has over {MAX_FILES} files; compare a part of it")
    return FolderFiles(tuple(sorted(names)), others)


def _refuse(error: OSError) -> None:
    raise OptionError(f"{error.filename}: {error.strerror}; make the folder readable")


def compare_folders(
    first: Path, other: Path, tolerance: Tolerance = EXACT, *, perceptual: bool = False
) -> Iterator[FilePair]:
    """Compare the pictures of two folders, by their paths, one after the other.

    Files that only one folder has are removed or added. A file that cannot be read is broken, and
    the others are compared all the same.

    first: the folder of the expected pictures.
    other: the folder that is compared with it.
    tolerance: what counts as a difference.
    perceptual: measures SSIM, FLIP and CIEDE2000 too.

    Raises OptionError as `folder_files`, and if neither folder has a picture.
    """
    old, new = folder_files(first), folder_files(other)
    if not old.names and not new.names:
        raise OptionError(f"{first} and {other} have no pictures; name two folders that have some")
    known = set(old.names), set(new.names)
    for name in sorted(known[0] | known[1]):
        if name not in known[1]:
            yield FilePair(name, "removed", path=first / name)
        elif name not in known[0]:
            yield FilePair(name, "added", path=other / name)
        else:
            yield _compared(name, first, other, tolerance, perceptual)


def _compared(
    name: str, first: Path, other: Path, tolerance: Tolerance, perceptual: bool
) -> FilePair:
    paths = first / name, other / name
    try:
        variants = [Variant(path.as_posix(), read_picture(path)) for path in paths]
        (pair,) = compare_variants(variants, tolerance, perceptual=perceptual)
    except OptionError as error:
        return FilePair(name, "broken", fault=str(error))
    return FilePair(name, pair.difference.verdict, pair)
