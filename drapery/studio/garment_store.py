"""The garment and the skin of a tab's own: files that were sent, checked and named by the user."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path

from drapery import DraperyError
from drapery.errors import OptionError, shown
from drapery.garments import Garment, check_skin, tailor
from drapery.studio.document import Document
from drapery.studio.uploads import Uploads

MAX_PARTICLES = 4096
"""The most particles of all pieces of a garment."""
MAX_SKIN = 1024
"""The widest skin [pixels]."""
MAX_NAME = 32
MAX_FILES = 64
"""The files that a tab keeps; all are kept, because the steps that Undo goes back may name them."""


class GarmentStore:
    """The last garment and the last skin that were sent.

    path: of the garment, by which `find_garment` finds it. title: what the user sees of it. skin:
    the path of the skin. names: the user's names of the files by their paths.
    """

    def __init__(self, document: Document, uploads: Uploads) -> None:
        self._document = document
        self._uploads = uploads
        self.path: Path | None = None
        self.title = ""
        self.skin: Path | None = None
        self.names: dict[str, str] = {}

    def adopt(self, number: int) -> str:
        """Check an uploaded garment and keep it in place of the one before; returns its path.

        Raises OptionError or PackError, whose line names the user's file.
        """
        self.path = self._keep(number, "garment", ".toml", self._check)
        found = Garment.load(self.path)
        self.title = f"{self.names[str(self.path)]}: {found.description}".removesuffix(": ")
        return str(self.path)

    def adopt_skin(self, number: int) -> str:
        """Check an uploaded skin and keep it in place of the one before; returns its path.

        Raises OptionError or PackError, whose line names the user's file.
        """
        self.skin = self._keep(number, "skin", ".png", lambda path: check_skin(path, MAX_SKIN))
        return str(self.skin)

    def _keep(
        self, number: int, purpose: str, ending: str, check: Callable[[Path], object]
    ) -> Path:
        upload = self._uploads.get(number, purpose)
        if len(self.names) >= MAX_FILES:
            self._uploads.remove(number)
            raise OptionError(f"this tab has {MAX_FILES} garments and skins; open a new one")
        stem = re.sub(r"[^a-z0-9_-]+", "-", Path(upload.name).stem.lower())[:MAX_NAME].strip("-")
        folder = self._document.folder / f"{purpose}-{number}-own"
        path = folder / f"{stem or purpose}{ending}"
        try:
            folder.mkdir()
            path.write_bytes(upload.path.read_bytes())
            check(path)
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
        return path

    def _check(self, path: Path) -> None:
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
