"""The garment of a tab's own: a TOML file that was sent, checked and given the user's name."""

import re
import shutil
from pathlib import Path

from drapery import DraperyError
from drapery.errors import OptionError
from drapery.garments import Garment, tailor
from drapery.studio.document import Document
from drapery.studio.uploads import Uploads

MAX_PARTICLES = 4096
"""The most particles of all its pieces."""
MAX_NAME = 32


class GarmentStore:
    """The last file of a garment that was sent. path: of it, by which `find_garment` finds it."""

    def __init__(self, document: Document, uploads: Uploads) -> None:
        self._document = document
        self._uploads = uploads
        self.path: Path | None = None
        self.title = ""

    def adopt(self, number: int) -> str:
        """Check an uploaded file and keep it in place of the one before; returns its path.

        Raises OptionError or PackError, whose line names the user's file.
        """
        upload = self._uploads.get(number, "garment")
        stem = re.sub(r"[^a-z0-9_-]+", "-", Path(upload.name).stem.lower())[:MAX_NAME].strip("-")
        folder = self._document.folder / f"garment-{number}-own"
        path = folder / f"{stem or 'garment'}.toml"
        try:
            folder.mkdir()
            path.write_bytes(upload.path.read_bytes())
            garment = Garment.load(path)
            self._check(garment)
        except OSError as error:
            shutil.rmtree(folder, ignore_errors=True)
            raise OptionError(f"{upload.name} cannot be stored: {error.strerror}") from None
        except DraperyError as error:
            shutil.rmtree(folder, ignore_errors=True)
            raise type(error)(str(error).replace(str(path), upload.name)) from None
        finally:
            self._uploads.remove(number)
        self.path, self.title = path, f"{upload.name}: {garment.description}".removesuffix(": ")
        return str(path)

    def _check(self, garment: Garment) -> None:
        if garment.paths:
            raise OptionError(
                f"garment {garment.name} names the file {garment.paths[0].name}, which the studio"
                " does not have; use a block, a design, or a texture of the packs"
            )
        count = sum(len(each.start) for each in tailor(garment, self._document.packs()))
        if count > MAX_PARTICLES:
            raise OptionError(
                f"garment {garment.name} has {count} particles; use at most {MAX_PARTICLES}"
            )
