"""Sheets of labelled pictures, written as one picture or as a page of HTML."""

from dataclasses import dataclass
from pathlib import Path

from drapery.arrays import Pixels
from drapery.file_formats import format_of
from drapery.render import Frame, contact_sheet
from drapery.render.contact import contact_table


@dataclass(frozen=True, eq=False)
class SheetCell:
    """One picture and its label.

    label: the text below it.
    pixels: sRGB with straight alpha, shape [H, W, 4], uint8.
    """

    label: str
    pixels: Pixels


@dataclass(frozen=True, eq=False)
class PictureSheet:
    """Pictures in rows.

    title: of the sheet.
    cells: the pictures, row by row.
    columns: pictures in a row.
    across: headings of columns, which replace the labels; give both headings or neither.
    down: headings of rows.
    """

    title: str
    cells: tuple[SheetCell, ...]
    columns: int
    across: tuple[str, ...] = ()
    down: tuple[str, ...] = ()

    def frame(self) -> Frame:
        """The sheet as one picture."""
        if self.across:
            return contact_table(self.across, self.down, [cell.pixels for cell in self.cells])
        return contact_sheet(self._pictures(), self.columns)

    def save(self, path: str | Path) -> None:
        """Write it as a picture, or as a page that needs no other file.

        Raises OptionError for an ending of neither, OutputError.
        """
        target = Path(path)
        if format_of(target, "still", "page").kind() == "page":
            from drapery.comparison.report import write_text
            from drapery.sheets.page import html_page

            cells = self._pictures()
            write_text(target, html_page(self.title, cells, self.columns, self.across, self.down))
        else:
            self.frame().save(target)

    def _pictures(self) -> list[tuple[str, Pixels]]:
        return [(cell.label, cell.pixels) for cell in self.cells]
