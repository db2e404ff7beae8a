"""Reports on packs: what they have, lack and override."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from drapery.banner.packs.pack import Pack, added_patterns, extra_sprites
from drapery.banner.packs.png import png_size
from drapery.banner.packs.stack import Base, Kind, PackFile, PackLike, Packs, open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import PackError

MAX_CHECKED_BYTES = 512 << 20
"""Most bytes, of files and of decoded texels, that are read to check the sheets of one pack."""


@dataclass(frozen=True)
class PackReport:
    """One pack of a stack.

    format: the resource format that it is read as, or None. overlays: the folders in use.
    formats: the lowest and the highest format that it claims to support, or None.
    has, lacks: of the 43 patterns. added: other patterns that it defines. extra: sheets in the
        game's own namespace that are no pattern, so that no design can name them.
    shields: those of the 43 patterns that it has for shields.
    bases: which of banner_base, shield_base and shield_base_nopattern it has.
    overrides: pairs of a pattern and the pack below whose sheet it overrides.
    sides: pairs of a sheet's side [px] and how many have it, small ones first.
    normal_maps, specular_maps: patterns with LabPBR maps. animated: patterns with frames.
    problems: the errors of files that cannot be read.
    notes: what was read otherwise than it lies in the files, or not at all.
    unchecked: patterns beyond MAX_CHECKED_BYTES; their sheets and maps are not decoded, and are
        not among the sides, maps, animations and problems.
    """

    label: str
    description: str
    format: int | None
    overlays: tuple[str, ...]
    has: tuple[str, ...]
    lacks: tuple[str, ...]
    added: tuple[str, ...]
    shields: tuple[str, ...]
    bases: tuple[str, ...]
    overrides: tuple[tuple[str, str], ...]
    sides: tuple[tuple[int, int], ...]
    normal_maps: tuple[str, ...]
    specular_maps: tuple[str, ...]
    animated: tuple[str, ...]
    problems: tuple[str, ...]
    unchecked: tuple[str, ...] = ()
    formats: tuple[int, int] | None = None
    extra: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()


def describe_packs(
    packs: PackLike | Sequence[PackLike], *, format: int | None = None
) -> tuple[PackReport, ...]:
    """A report on each pack of a stack, lowest first; takes what `open_packs` takes.

    A broken file in a pack becomes one of its problems. Raises PackError for a pack that cannot
    be opened.
    """
    opened = open_packs(packs, format=format)
    ours, *chosen = opened.packs
    reports = []
    for number, pack in enumerate(chosen):
        lower = [Packs((ours, below), format) for below in chosen[:number][::-1]]
        reports.append(_report(pack, Packs((ours, pack), format), lower))
    return tuple(reports)


def _report(pack: Pack, alone: Packs, lower: Sequence[Packs]) -> PackReport:
    problems: list[str] = []
    added, extra = added_patterns(pack), extra_sprites(pack)
    has = _had(alone, PATTERN_NAMES, "banner", problems)
    shields = _had(alone, PATTERN_NAMES, "shield", problems)
    mine = (*has, *_had(alone, (*added, *extra), "banner", problems))
    bases = _bases(alone, problems)
    sheets, unchecked = _decoded_sheets(alone, mine, problems)
    return PackReport(
        pack.label,
        pack.meta.description,
        pack.format,
        tuple(root.rstrip("/") for root in pack.roots if root),
        has,
        tuple(name for name in PATTERN_NAMES if name not in has),
        added,
        shields,
        bases,
        tuple(pair for name in mine for pair in _hidden(name, lower)),
        tuple(sorted(Counter(sheet.side for sheet in sheets.values()).items())),
        tuple(name for name, sheet in sheets.items() if sheet.has_normal),
        tuple(name for name, sheet in sheets.items() if sheet.has_specular),
        tuple(name for name, sheet in sheets.items() if sheet.is_animated),
        tuple(dict.fromkeys(problems)),
        unchecked,
        pack.meta.supported(),
        extra,
        alone.notes(),
    )


@dataclass(frozen=True)
class _SheetFacts:
    side: int
    is_animated: bool
    has_normal: bool
    has_specular: bool


def _decoded_sheets(
    alone: Packs, names: Sequence[str], problems: list[str]
) -> tuple[dict[str, _SheetFacts], tuple[str, ...]]:
    """The sheets that are sound, by pattern, and the patterns beyond the limit."""
    sheets: dict[str, _SheetFacts] = {}
    unchecked = []
    left = MAX_CHECKED_BYTES
    for name in names:
        try:
            cost = sum(_cost(file, alone) for file in alone.files(name))
            if cost > left:
                unchecked.append(name)
                continue
            left -= cost
            sheets[name] = _SheetFacts(
                len(alone.sheet(name)),
                alone.period(name) > 0,
                alone.normal_map(name) is not None,
                alone.specular_map(name) is not None,
            )
        except PackError as error:
            problems.append(str(error))
    return sheets, tuple(unchecked)


def _cost(file: PackFile, packs: Packs) -> int:
    """Bytes of a PNG file and of its decoded texels."""
    width, height = png_size(file.data, f"{packs.packs[file.level].label}: {file.name}")
    return len(file.data) + 4 * width * height


def _had(alone: Packs, names: Sequence[str], kind: Kind, problems: list[str]) -> tuple[str, ...]:
    """The patterns whose sheet comes from the pack."""
    return tuple(name for name in names if _level(alone, name, kind, problems) == 1)


def _level(packs: Packs, name: str, kind: Kind, problems: list[str]) -> int | None:
    try:
        return packs.level(name, kind)
    except PackError as error:
        problems.append(str(error))
        return None


def _bases(alone: Packs, problems: list[str]) -> tuple[str, ...]:
    names: tuple[Base, ...] = ("banner_base", "shield_base", "shield_base_nopattern")
    found = tuple(name for name in names if alone.base_level(name) == 1)
    for name in found:
        try:
            alone.base(name)
        except PackError as error:
            problems.append(str(error))
    return found


def _hidden(name: str, lower: Sequence[Packs]) -> list[tuple[str, str]]:
    """The nearest pack below that has the pattern too, if any."""
    for packs in lower:
        if _level(packs, name, "banner", []) == 1:
            return [(name, packs.packs[1].label)]
    return []
