"""Sources of a pack's files.

Nothing is unpacked to disk: a file is read by its name, up to a limit. Names are relative to the
pack's root and have slashes: `assets/minecraft/textures/…`.
"""

from pathlib import Path
from typing import Protocol, runtime_checkable

from drapery.banner.names import shown
from drapery.banner.packs.folders import open_folder
from drapery.banner.packs.zips import open_zip
from drapery.errors import PackError
from drapery.user_files import reason


@runtime_checkable
class PackSource(Protocol):
    """The files of one pack: a folder, a zip, arrays in memory, or a user-defined class."""

    @property
    def label(self) -> str:
        """The name of the pack in messages."""

    def read(self, name: str, limit: int) -> bytes | None:
        """The bytes of a file, or None if it does not exist.

        name: the path in the pack.
        limit: the largest size that is read [bytes].

        Raises PackError if it cannot be read or is over the limit.
        """

    def files(self, folder: str) -> tuple[str, ...]:
        """Names of all files under a folder, sorted."""

    def folders(self, folder: str) -> tuple[str, ...]:
        """Names, without path, of the folders directly under a folder, sorted."""


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
        if target.exists():
            return open_zip(target)
    except (OSError, ValueError) as error:
        raise PackError(f"pack {target} cannot be read: {reason(error)}") from None
    raise PackError(f"pack {target} does not exist: check the path")
