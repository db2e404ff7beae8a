"""Comparison of two pictures, and the first layer with which they differ."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Unpack

from drapery.comparison.alignment import Aligned, align
from drapery.comparison.difference import Difference
from drapery.comparison.loops import measure_pictures
from drapery.comparison.panels import side_by_side
from drapery.comparison.picture import as_picture
from drapery.comparison.report import ReportEntry, data_address
from drapery.comparison.tolerance import EXACT, Tolerance
from drapery.comparison.variants import Variant, variant_of
from drapery.comparison.words import compared_words, short_labels
from drapery.errors import OptionError
from drapery.render import Frame, contact_sheet
from drapery.settings import Options, Settings

if TYPE_CHECKING:
    from drapery.banner.design import Banner


@dataclass(frozen=True)
class BuildUpStep:
    """Two designs, each with its first layers only, and how their pictures differ.

    names: what the step adds to each design; None where it adds nothing.
    first: the picture of the first design.
    other: the picture of the other design.
    difference: how these pictures differ.
    changed: whether the designs differ in the step.
    hidden: whether what differs cannot be seen at the end.
    """

    names: tuple[str | None, str | None]
    first: Frame
    other: Frame
    difference: Difference
    changed: bool = False
    hidden: bool = False

    def described(self) -> str:
        """The step in words."""
        return _described(*self.names)


@dataclass(frozen=True)
class Comparison:
    """Two pictures and their difference.

    first: the picture that the other is compared with.
    other: the picture that is compared with it.
    difference: how the finished pictures differ.
    build_up: one step for the base, and one for each layer of both designs, or of one if the other
        has no such layer; empty for finished pictures.
    tolerance: what counts as a difference.
    hidden_layers: what differs in the designs and cannot be seen, in words.
    """

    first: Variant
    other: Variant
    difference: Difference
    build_up: tuple[BuildUpStep, ...]
    tolerance: Tolerance = EXACT
    hidden_layers: tuple[str, ...] = ()

    @property
    def culprit(self) -> str | None:
        """The step from which on the pictures differ up to the end; None if they never differ.

        What differs in between and is then hidden by layers above is no cause.
        """
        for step in self.build_up:
            if step.changed and not step.hidden:
                return step.described()
        cause = None
        for step in reversed(self.build_up):
            if step.difference.agrees:
                break
            cause = step.described()
        return cause

    def line(self) -> str:
        """The result in one line."""
        names = self.first.label, self.other.label
        return compared_words(
            *names, self.difference, self.tolerance, self.culprit, self.hidden_layers
        )

    def sheet(self) -> Frame:
        """Both pictures and their difference side by side."""
        return pair_sheet(self)


def compare(
    first: "Banner | Frame",
    other: "Banner | Frame",
    settings: Settings | None = None,
    *,
    tolerance: Tolerance = EXACT,
    perceptual: bool = False,
    **options: Unpack[Options],
) -> Comparison:
    """Compare two designs, both drawn with the same options, or two finished pictures.

    Pictures of other sizes are different.

    first: a design or a finished picture.
    other: the design or picture that is compared with the first.
    settings: the options of the pictures of designs, see `draw`.
    tolerance: what counts as a difference.
    perceptual: measures SSIM, FLIP and CIEDE2000 too.
    options: fields of `Settings` by name, which override those of `settings`.

    Raises DesignError, OptionError, PackError or BackendError, as `draw` does.
    """
    variants = [
        variant_of(label, subject, settings, options)
        for label, subject in (("the first", first), ("the second", other))
    ]
    return compare_variants(variants, tolerance, perceptual=perceptual)[0]


def compare_variants(
    variants: Sequence[Variant],
    tolerance: Tolerance = EXACT,
    *,
    perceptual: bool = False,
) -> list[Comparison]:
    """Compare every variant with the first.

    variants: two or more.
    tolerance: what counts as a difference.
    perceptual: measures SSIM, FLIP and CIEDE2000 too.

    Raises OptionError for a single one.
    """
    if len(variants) < 2:
        raise OptionError("one picture cannot be compared; name at least two")
    first, *others = variants
    return [_pair(first, other, tolerance, perceptual) for other in others]


def _pair(
    first: Variant,
    other: Variant,
    tolerance: Tolerance,
    perceptual: bool,
) -> Comparison:
    pictures = first.picture, other.picture
    difference = measure_pictures(*pictures, tolerance, perceptual=perceptual)
    if first.banner is None or other.banner is None:
        return Comparison(first, other, difference, (), tolerance)
    steps = [((-1, -1)), *align(first.banner.layers, other.banner.layers)]
    changed = [number for number, step in enumerate(steps) if _differs(first, other, step)]
    if difference.same:
        words = tuple(_described(*_names(first, other, steps[number])) for number in changed)
        return Comparison(first, other, difference, (), tolerance, words)
    hidden = _hidden(first, other, steps, changed, tolerance)
    build_up = tuple(
        replace(step, changed=number in changed, hidden=number in hidden)
        for number, step in enumerate(_build_up(first, other, steps, tolerance))
    )
    words = tuple(build_up[number].described() for number in hidden)
    return Comparison(first, other, difference, build_up, tolerance, words)


def _differs(first: Variant, other: Variant, step: Aligned) -> bool:
    """Whether two designs differ in a step."""
    return _part(first, step[0]) != _part(other, step[1])


def _part(variant: Variant, place: int | None) -> object:
    """The layer of a design at a place, or its base at -1; None at None."""
    if place is None or variant.banner is None:
        return None
    return variant.banner.layers[place] if place >= 0 else variant.banner.base


def _hidden(
    first: Variant,
    other: Variant,
    steps: Sequence[Aligned],
    changed: Sequence[int],
    tolerance: Tolerance,
) -> list[int]:
    """The steps that make no difference at the end: undone in the second design, it looks the same.

    None if that holds for each of them, as where one step hides what another one does.
    """
    if len(changed) < 2:
        return []
    found = []
    for number in changed:
        undone = as_picture(_undone(first, other, steps, number))
        if measure_pictures(other.picture, undone, tolerance).agrees:
            found.append(number)
    return [] if len(found) == len(changed) else found


def _undone(first: Variant, other: Variant, steps: Sequence[Aligned], number: int) -> Frame:
    """The second design with a step of the first in place of its own."""
    assert first.banner is not None and other.banner is not None
    base = first.banner.base if number == 0 else other.banner.base
    layers = []
    for each, (old, new) in enumerate(steps[1:], 1):
        source, place = (first.banner, old) if each == number else (other.banner, new)
        if place is not None:
            layers.append(source.layers[place])
    return other.drawn(replace(other.banner, base=base, layers=tuple(layers)))


def _build_up(
    first: Variant, other: Variant, steps: Sequence[Aligned], tolerance: Tolerance
) -> Iterator[BuildUpStep]:
    """The steps of both designs side by side; equal layers belong together."""
    counts = [0, 0]
    for places in steps:
        counts = [
            count if place is None else place + 1
            for count, place in zip(counts, places, strict=True)
        ]
        pictures = first.with_layers(counts[0]), other.with_layers(counts[1])
        old, new = map(as_picture, pictures)
        difference = measure_pictures(old, new, tolerance)
        yield BuildUpStep(_names(first, other, places), *pictures, difference)


def _names(first: Variant, other: Variant, step: Aligned) -> tuple[str | None, str | None]:
    """What a step adds to each design."""
    old, new = (
        None if place is None else _step_name(variant, place + 1)
        for variant, place in zip((first, other), step, strict=True)
    )
    return old, new


def _described(old: str | None, new: str | None) -> str:
    """A step in words: a layer that one design lacks is named as such."""
    if old is None or new is None:
        return f"{old or new}, which only the {'second' if old is None else 'first'} has"
    return old if old == new else f"{new} in place of {old}"


def pair_sheet(pair: Comparison) -> Frame:
    """Both pictures and their difference side by side; of loops the first frames that differ."""
    number = (pair.difference.frames or (1,))[0] - 1
    frames = [
        picture.frames[min(number, len(picture.frames) - 1)]
        for picture in (pair.first.picture, pair.other.picture)
    ]
    labels = short_labels(pair.first.label, pair.other.label)
    return side_by_side(frames[0], frames[1], labels, tolerance=pair.tolerance)


def build_up_sheet(pair: Comparison) -> Frame | None:
    """The build-up of both, one column a step; None for finished pictures."""
    if not pair.build_up:
        return None
    firsts = [(step.names[0] or "-", step.first.pixels) for step in pair.build_up]
    others = [(step.names[1] or "-", step.other.pixels) for step in pair.build_up]
    return contact_sheet([*firsts, *others], columns=len(pair.build_up))


def _step_name(variant: Variant, count: int) -> str:
    if variant.banner is None:
        return "base"
    if count == 0:
        return f"base ({variant.banner.base})"
    layer = variant.banner.layers[count - 1]
    return f"layer {count} ({layer.pattern}, {layer.dye})"


def pair_entry(pair: Comparison, *, pictured: bool = True) -> ReportEntry:
    """The pair as a part of a report.

    pair: what was compared.
    pictured: whether the part has pictures.
    """
    # Imported here: the words of blazon load a grammar, which only reports need.
    from drapery.banner import alt_text

    pictures = [("side by side", data_address(pair_sheet(pair)))] if pictured else []
    sheet = build_up_sheet(pair) if pictured else None
    if sheet is not None:
        pictures.append(("built up layer by layer", data_address(sheet)))
    facts = {k: _fact(v) for k, v in pair_facts(pair).items() if v not in (None, (), {})}
    banners = dict.fromkeys(
        one.banner for one in (pair.first, pair.other) if one.banner is not None
    )
    shown = "; ".join(alt_text(banner) for banner in banners)
    return ReportEntry(
        *(pair.other.label, pair.difference.agrees, pair.line(), facts, tuple(pictures), shown)
    )


def _fact(value: object) -> object:
    """A fact as a page shows it."""
    if isinstance(value, dict):
        return "; ".join(f"{name} {_fact(each)}" for name, each in value.items())
    if isinstance(value, tuple):
        return ", ".join(str(_fact(each)) for each in value)
    return value


def pair_facts(pair: Comparison) -> dict[str, object]:
    """The verdict, the figures and the limits of a pair, as reports have them."""
    return {
        "a": pair.first.label,
        "b": pair.other.label,
        "from": pair.culprit,
        "hidden_layers": pair.hidden_layers,
        "limits": pair.tolerance.limits(),
        **pair.difference.as_dict(),
    }
