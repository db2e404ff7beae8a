"""The sheets of one pack, decoded: their sizes, maps and alpha, and what is odd about them."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from drapery.banner.packs.masks import looks_like_mask
from drapery.banner.packs.png import png_size
from drapery.banner.packs.stack import Kind, PackFile, Packs, sheet_name
from drapery.banner.sprites import FLAG_REGIONS, SHIELD_REGIONS
from drapery.errors import PackError, counted

_PLACES = {
    "banner": ("flag", (FLAG_REGIONS["front"], FLAG_REGIONS["back"])),
    # The back of a shield shows no pattern.
    "shield": ("shield", (SHIELD_REGIONS["front"],)),
}


@dataclass
class Budget:
    """How many bytes, of files and of decoded texels, may still be read."""

    left: int
    _sheets: list[str] = field(default_factory=list)
    _others: int = 0

    def takes(self, file: PackFile, place: str) -> bool:
        """Whether this PNG file is still read; it counts then. Raises PackError."""
        return self._spend(_cost(file, place))

    def takes_sheet(self, name: str, files: Sequence[tuple[PackFile, str]]) -> bool:
        """Whether the files of a sheet, each with its place, are still read. Raises PackError."""
        if self._spend(sum(_cost(file, place) for file, place in files)):
            return True
        self._sheets.append(name)
        return False

    def leave_out(self, count: int) -> None:
        """Note how many textures beside the sheets are not read."""
        self._others += count

    def unchecked(self) -> tuple[str, ...]:
        """The sheets that were not read, and how many other textures."""
        others = [counted(self._others, "other texture")] if self._others else []
        return (*self._sheets, *others)

    def _spend(self, cost: int) -> bool:
        if cost > self.left:
            return False
        self.left -= cost
        return True


@dataclass(frozen=True)
class SheetFacts:
    """A decoded sheet. side: [px]. is_opaque, is_clear: whether all texels that show are so.

    is_mask: whether it looks like a mask from before 1.15 that is not read as one.
    """

    side: int
    is_animated: bool
    has_normal: bool
    has_specular: bool
    is_opaque: bool
    is_clear: bool
    is_mask: bool


def check_sheets(
    alone: Packs, names: Sequence[str], kind: Kind, budget: Budget, problems: list[str]
) -> dict[str, SheetFacts]:
    """The sheets that are sound, by pattern. Adds the errors of the others to the problems."""
    sheets: dict[str, SheetFacts] = {}
    for name in names:
        try:
            files = [(file, alone.place(file)) for file in alone.files(name, kind)]
            if budget.takes_sheet(sheet_name(name, kind), files):
                sheets[name] = _facts(alone, name, kind)
        except PackError as error:
            problems.append(str(error))
    return sheets


def sides(sheets: Mapping[str, SheetFacts]) -> tuple[tuple[int, int], ...]:
    """Pairs of a side [px] and how many sheets have it, small ones first."""
    return tuple(sorted(Counter(sheet.side for sheet in sheets.values()).items()))


def sheet_notes(sheets: Mapping[str, SheetFacts], kind: Kind) -> Iterator[str]:
    """What an author may not have meant: small sheets, and sheets that hide all or show nothing."""
    counts = sides(sheets)
    usual = max(counts, key=lambda pair: pair[::-1])[0] if counts else 0
    small = [f"{name} ({s.side} px)" for name, s in sheets.items() if s.side < usual]
    if small:
        yield f"smaller than most {kind} sheets, which have {usual} px: {', '.join(small)}"
    place, _ = _PLACES[kind]
    # The pattern `base` colours all of the cloth.
    opaque = [name for name, s in sheets.items() if s.is_opaque and name != "base"]
    if opaque:
        masks = any(sheets[name].is_mask for name in opaque)
        hint = " (masks from before 1.15? use format 4 to read them as masks)" if masks else ""
        yield (
            f"no transparent texel on the {place}, so that each hides all below it:"
            f" {', '.join(opaque)}{hint}"
        )
    clear = [name for name, sheet in sheets.items() if sheet.is_clear]
    if clear:
        yield f"no visible texel on the {place}, so that each shows nothing: {', '.join(clear)}"


def _facts(alone: Packs, name: str, kind: Kind) -> SheetFacts:
    sheet = alone.sheet(name, kind)
    _, regions = _PLACES[kind]
    alphas = [region.crop(sheet[..., 3:]) for region in regions]
    return SheetFacts(
        len(sheet),
        alone.period(name, kind) > 0,
        alone.normal_map(name, kind) is not None,
        alone.specular_map(name, kind) is not None,
        all((alpha == 255).all() for alpha in alphas),
        not any(alpha.any() for alpha in alphas),
        looks_like_mask(sheet),
    )


def _cost(file: PackFile, place: str) -> int:
    """Bytes of a PNG file and of its decoded texels."""
    width, height = png_size(file.data, place)
    return len(file.data) + 4 * width * height
