"""What packs have, lack and override, for a person who wonders why a banner looks as it does."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from drapery.banner.packs.pack import Pack, added_patterns
from drapery.banner.packs.stack import Base, Kind, PackLike, Packs, open_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import PackError


@dataclass(frozen=True)
class PackReport:
    """One pack of a stack.

    format: the resource format that it is read as, or None; overlays: the folders that count.
    has, lacks: of the 43 patterns. added: patterns of its own. shields: of the 43, for shields.
    bases: which of banner_base, shield_base and shield_base_nopattern it has.
    overrides: pairs of a pattern and the pack below whose sheet it hides.
    sides: pairs of a sheet's side [px] and how many have it, small ones first.
    normal_maps, specular_maps: patterns with LabPBR maps. animated: patterns with frames.
    problems: the errors of files that cannot be used.
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
    added = added_patterns(pack)
    has = _had(alone, PATTERN_NAMES, "banner", problems)
    shields = _had(alone, PATTERN_NAMES, "shield", problems)
    mine = (*has, *_had(alone, added, "banner", problems))
    sound = [name for name in mine if _works(alone, name, problems)]
    return PackReport(
        pack.label,
        pack.meta.description,
        pack.format,
        tuple(root.rstrip("/") for root in pack.roots if root),
        has,
        tuple(name for name in PATTERN_NAMES if name not in has),
        added,
        shields,
        _bases(alone, problems),
        tuple(pair for name in mine for pair in _hidden(name, lower)),
        tuple(sorted(Counter(len(alone.sheet(name)) for name in sound).items())),
        tuple(name for name in sound if alone.normal_map(name) is not None),
        tuple(name for name in sound if alone.specular_map(name) is not None),
        tuple(name for name in sound if alone.period(name)),
        tuple(dict.fromkeys(problems)),
    )


def _had(alone: Packs, names: Sequence[str], kind: Kind, problems: list[str]) -> tuple[str, ...]:
    """The patterns whose sheet comes from the pack."""
    return tuple(name for name in names if _level(alone, name, kind, problems) == 1)


def _level(packs: Packs, name: str, kind: Kind, problems: list[str]) -> int | None:
    try:
        return packs.level(name, kind)
    except PackError as error:
        problems.append(str(error))
        return None


def _works(packs: Packs, name: str, problems: list[str]) -> bool:
    try:
        packs.sheet(name), packs.normal_map(name), packs.specular_map(name)
    except PackError as error:
        problems.append(str(error))
        return False
    return True


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
