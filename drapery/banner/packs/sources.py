"""Where a pack's files come from.

Nothing is ever unpacked: a file is found by its name inside the pack, read whole up to a limit and
handed on. Names are those of the pack's root: `assets/minecraft/textures/…`, with slashes.
"""

from pathlib import Path
from typing import Protocol, runtime_checkable

from drapery.banner.names import shown
from drapery.banner.packs.checks import reason
from drapery.banner.packs.folders import open_folder
from drapery.banner.packs.zips import open_zip
from drapery.errors import PackError


@runtime_checkable
class PackSource(Protocol):
    """The files of one pack: a folder, a zip, arrays in memory, or a class of your own."""

    @property
    def label(self) -> str:
        """What errors call the pack."""

    def read(self, name: str, limit: int) -> bytes | None:
        """A file whole, or None where there is none. Raises PackError, also beyond the limit."""

    def files(self, folder: str) -> tuple[str, ...]:
        """Names of all files under a folder, sorted."""

    def folders(self, folder: str) -> tuple[str, ...]:
        """Names of the folders right under a folder, sorted, without the path to it."""


def open_source(path: str | Path | PackSource) -> PackSource:
    """The files of a folder, zip or jar. A source is returned as it is.

    Raises PackError naming the path and the remedy.
    """
    if isinstance(path, PackSource):
        return path
    if not isinstance(path, str | Path):
        raise PackError(f"{shown(path)} is not a pack: give a path, a MemoryPack or an opened pack")
    target = Path(path)
    try:
        if target.is_dir():
            return open_folder(target)
        if target.is_file():
            return open_zip(target)
    except (OSError, ValueError) as error:
        raise PackError(f"pack {target} cannot be read: {reason(error)}") from None
    raise PackError(f"pack {target} does not exist: check the path")
