"""The garments and the skins of a tab's own: files that its user sent and named."""

import re
import secrets
import shutil
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path, PurePath

from drapery import DraperyError
from drapery.errors import OptionError, shown
from drapery.garments import Garment, check_skin, tailor
from drapery.studio.document import Document
from drapery.studio.uploads import Uploads, link_or_copy

MAX_PARTICLES = 4096
"""The most particles of all pieces of a garment."""
MAX_SKIN = 1024
"""The widest skin [pixels]."""
MAX_NAME = 32
ENDINGS = {"garment": ".toml", "skin": ".png"}
MAX_FILES = 64
"""The files that a tab keeps; all are kept, because the steps that Undo goes back may name them."""


class GarmentStore:
    """The garments and skins that were sent.

    names: the user's names of the files, by their paths.
    """

    def __init__(self, document: Document, uploads: Uploads) -> None:
        self._document = document
        self._uploads = uploads
        self.names: dict[str, str] = {}

    def titles(self, purpose: str) -> dict[str, str]:
        """What the user sees of the garments, or of the skins, by their paths."""
        found = {path: name for path, name in self.names.items() if path.endswith(ENDINGS[purpose])}
        if purpose == "skin":
            return found
        about = {path: Garment.load(Path(path)).description for path in found}
        return {path: f"{name}: {about[path]}".removesuffix(": ") for path, name in found.items()}

    def adopt(self, number: int, purpose: str) -> str:
        """Check an uploaded garment or skin and keep it; returns its path.

        Raises OptionError or PackError, whose line names the user's file.
        """
        upload = self._uploads.get(number, purpose)
        if len(self.names) >= MAX_FILES:
            self._uploads.remove(number)
            raise OptionError(f"this tab has {MAX_FILES} garments and skins; open a new one")
        stem = re.sub(r"[^a-z0-9_-]+", "-", Path(upload.name).stem.lower())[:MAX_NAME].strip("-")
        folder = self._document.folder / f"{purpose}-{secrets.token_hex(8)}"
        path = folder / f"{stem or purpose}{ENDINGS[purpose]}"
        try:
            folder.mkdir()
            path.write_bytes(upload.path.read_bytes())
            self._check(path, purpose)
        except OSError as error:
            shutil.rmtree(folder, ignore_errors=True)
            raise OptionError(f"{upload.name} cannot be stored: {error.strerror}") from None
        except DraperyError as error:
            shutil.rmtree(folder, ignore_errors=True)
            line = str(error).replace(str(path), upload.name)
            if not line.startswith(upload.name):
                line = f"{upload.name}: {line}"
            raise type(error)(line) from None
        finally:
            self._uploads.remove(number)
        self.names[str(path)] = upload.name
        return str(path)

    def restore(self, names: Mapping[str, str]) -> None:
        """Take over the files of another tab, as `names` has them, if they are still there."""
        for path, name in names.items():
            here = self._document.folder / _place(path)
            with suppress(OSError):  # the page says it where the file is worn: it is not here
                here.parent.mkdir(exist_ok=True)
                link_or_copy(Path(path), here)
                self.names[str(here)] = name

    def find(self, path: object) -> str | None:
        """The path of a file that was sent to this tab, or to one that this tab goes on from."""
        return next((each for each in self.names if _place(each) == _place(str(path))), None)

    def _check(self, path: Path, purpose: str) -> None:
        if purpose == "skin":
            check_skin(path, MAX_SKIN)
            return
        garment = Garment.load(path)
        # Whoever made the file must not choose what is read here.
        if named := garment.named_paths:
            raise OptionError(
                f"garment {garment.name} names {shown(named[0])}, which was not sent; leave it"
                " out, or use a block, a design, a texture of the packs, or the name of a style"
            )
        count = sum(len(each.start) for each in tailor(garment, self._document.packs()))
        if count > MAX_PARTICLES:
            raise OptionError(
                f"garment {garment.name} has {count} particles; use at most {MAX_PARTICLES}"
            )


def _place(path: str) -> PurePath:
    """The place of a file in the folder of its tab; no two files that were sent have the same."""
    return PurePath(*PurePath(path).parts[-2:])
