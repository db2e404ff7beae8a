"""Reports on packs: what they have, lack and override, and what is wrong or odd in them."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from drapery.banner.packs.pack import Pack, added_patterns, extra_sprites
from drapery.banner.packs.sheet_checks import Budget, check_sheets, sheet_notes, sides
from drapery.banner.packs.slips import likely_slips, near
from drapery.banner.packs.stack import Base, Kind, PackLike, Packs, open_packs, sheet_name
from drapery.banner.packs.texture_checks import check_equipment, check_textures
from drapery.banner.packs.texture_ids import split_id
from drapery.banner.patterns import PATTERN_NAMES
from drapery.errors import PackError

MAX_CHECKED_BYTES = 512 << 20
"""Most bytes, of files and of decoded texels, that are read to check the textures of one pack."""


@dataclass(frozen=True)
class PackReport:
    """One pack of a stack.

    label: the pack's name in messages.
    description: what its `pack.mcmeta` says.
    format: the resource format that it is read as, or None.
    overlays: the folders in use.
    has: those of the 43 patterns that it has.
    lacks: those of the 43 patterns that it does not have.
    added: other patterns that it defines.
    shields: those of the 43 patterns that it has for shields.
    bases: which of banner_base, shield_base and shield_base_nopattern it has.
    overrides: pairs of a pattern and the pack below whose sheet it overrides.
    sides: pairs of a sheet's side [px] and how many have it, small ones first.
    normal_maps: patterns with a LabPBR normal map. A sheet for shields is called `creeper
        (shield)`.
    specular_maps: patterns with a LabPBR specular map, named as `normal_maps`.
    animated: patterns with frames, named as `normal_maps`.
    problems: the errors of files that cannot be drawn: sheets, bases, and all other textures.
    unchecked: patterns beyond MAX_CHECKED_BYTES; their sheets and maps are not decoded, and are not
        among the sides, maps, animations and problems.
    formats: the lowest and the highest format that it claims to support, or None.
    extra: sheets in the game's own namespace that are no pattern, so that no design can name them.
    notes: what was read otherwise than it lies in the files, or not at all, and what the author may
        not have meant.
    lacks_for_shields: patterns, of the 43 and of those that it adds, that have no sheet for
        shields; empty if none has one.
    shield_sides: as `sides`, of the sheets for shields.
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
    lacks_for_shields: tuple[str, ...] = ()
    shield_sides: tuple[tuple[int, int], ...] = ()


def describe_packs(
    packs: PackLike | Sequence[PackLike], *, format: int | None = None
) -> tuple[PackReport, ...]:
    """A report on each pack of a stack, lowest first.

    A broken file in a pack becomes one of its problems.

    packs: what `open_packs` takes.
    format: pack format of the game's version, see `open_packs`.

    Raises PackError for a pack that cannot be opened.
    """
    opened = open_packs(packs, format=format)
    ours, *chosen = opened.packs
    reports = []
    for number, pack in enumerate(chosen):
        lower = [Packs((ours, below), format) for below in chosen[:number][::-1]]
        reports.append(_report(pack, Packs((ours, pack), format), lower, opened))
    return tuple(reports)


def _report(pack: Pack, alone: Packs, lower: Sequence[Packs], whole: Packs) -> PackReport:
    problems: list[str] = []
    added, extra = added_patterns(pack), extra_sprites(pack)
    has = _had(alone, PATTERN_NAMES, "banner", problems)
    shields = _had(alone, PATTERN_NAMES, "shield", problems)
    more = (*added, *extra)
    mine = (*has, *_had(alone, more, "banner", problems))
    mine_for_shields = (*shields, *_had(alone, more, "shield", problems))
    budget = Budget(MAX_CHECKED_BYTES)
    sheets = check_sheets(alone, mine, "banner", budget, problems)
    plates = check_sheets(alone, mine_for_shields, "shield", budget, problems)
    facts = sheets | {sheet_name(name, "shield"): each for name, each in plates.items()}
    bases = _bases(alone, problems)
    check_textures(alone, budget, problems)
    notes = (
        *check_equipment(alone, whole, problems),
        *sheet_notes(sheets, "banner"),
        *sheet_notes(plates, "shield"),
        *_without_texture(more, pack, whole),
        *likely_slips(pack),
    )
    lacking = [name for name in (*PATTERN_NAMES, *added) if name not in mine_for_shields]
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
        sides(sheets),
        tuple(name for name, sheet in facts.items() if sheet.has_normal),
        tuple(name for name, sheet in facts.items() if sheet.has_specular),
        tuple(name for name, sheet in facts.items() if sheet.is_animated),
        tuple(dict.fromkeys(problems)),
        budget.unchecked(),
        pack.meta.supported(),
        extra,
        (*alone.notes(), *notes),
        tuple(lacking) if mine_for_shields else (),
        sides(plates),
    )


def _without_texture(names: Sequence[str], pack: Pack, whole: Packs) -> Iterator[str]:
    """Patterns that a pack defines, but whose texture is in no pack of the stack."""
    for name in names:
        if _level(whole, name, "banner", []) is None and _is_sound(whole, name):
            namespace, path = split_id(whole.asset_id(name))
            file = f"assets/{namespace}/textures/entity/banner/{path}.png"
            others = [other for other in whole.patterns() if other.startswith(f"{namespace}:")]
            meant = near(name, (n for n in others if _level(whole, n, "banner", []) is not None))
            hint = f"; there is one for {meant}" if meant else ""
            yield f"{pack.label}: {name} is defined, but no pack has its texture {file}{hint}"


def _is_sound(packs: Packs, name: str) -> bool:
    """Whether the definition of a pattern can be read."""
    try:
        packs.asset_id(name)
    except PackError:
        return False
    return True


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
    """The bases that the pack has; the errors of broken ones and of their maps are problems."""
    names: tuple[Base, ...] = ("banner_base", "shield_base", "shield_base_nopattern")
    found = []
    for name in names:
        for read in (alone.base_level, alone.base, alone.base_normal_map, alone.base_specular_map):
            try:
                value = read(name)
            except PackError as error:
                problems.append(str(error))
            else:
                if read == alone.base_level and value == 1:
                    found.append(name)
    return tuple(found)


def _hidden(name: str, lower: Sequence[Packs]) -> list[tuple[str, str]]:
    """The nearest pack below that has the pattern too, if any."""
    for packs in lower:
        if _level(packs, name, "banner", []) == 1:
            return [(name, packs.packs[1].label)]
    return []
