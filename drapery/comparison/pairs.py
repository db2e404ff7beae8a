"""Comparison of two pictures, and the first layer with which they differ."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Unpack

from drapery.banner.design import Banner
from drapery.comparison.metrics import EXACT, Difference, measure
from drapery.comparison.panels import side_by_side
from drapery.comparison.report import ReportEntry, data_address
from drapery.comparison.tolerance import Tolerance
from drapery.comparison.variants import Variant, variant_of
from drapery.errors import OptionError
from drapery.render import Frame, contact_sheet
from drapery.settings import Options, Settings


@dataclass(frozen=True)
class Comparison:
    """Two pictures and their difference.

    build_up: for each number of layers drawn (0 is only the base) both pictures and their
        difference; empty for finished pictures.
    """

    first: Variant
    other: Variant
    difference: Difference
    build_up: tuple[tuple[Frame, Frame, Difference], ...]

    @property
    def culprit(self) -> str | None:
        """The first step of the build-up at which the two differ; None if they never differ."""
        for count, (_, _, difference) in enumerate(self.build_up):
            if not difference.same:
                return _step_name(self.other, count)
        return None

    def line(self) -> str:
        """The result in one line."""
        both = f"{self.first.label} and {self.other.label}"
        if self.difference.same:
            return f"{both} are the same to the last bit"
        figures = (
            f"{self.difference.changed} of {self.difference.pixels} pixels differ,"
            f" max {self.difference.max_error}, mean {self.difference.mean_error:.3f}"
        )
        cause = f"; from {self.culprit} on" if self.culprit else ""
        return f"{both}: {figures}{cause}"

    def sheet(self) -> Frame:
        """Both pictures and their difference side by side."""
        return pair_sheet(self)


def compare(
    first: Banner | Frame,
    other: Banner | Frame,
    settings: Settings | None = None,
    *,
    tolerance: Tolerance = EXACT,
    perceptual: bool = False,
    **options: Unpack[Options],
) -> Comparison:
    """Compare two designs, both drawn with the same options, or two finished pictures.

    settings, options: as for `draw`. tolerance: what counts as a difference.
    perceptual: measures SSIM, FLIP and CIEDE2000 too (extra: compare).
    Raises OptionError if the sizes differ, and the errors of `draw`.
    """
    variants = [
        variant_of(label, subject, settings, options)
        for label, subject in (("the first", first), ("the second", other))
    ]
    return compare_variants(variants, tolerance, perceptual=perceptual)[0]


def compare_variants(
    variants: Sequence[Variant], tolerance: Tolerance = EXACT, *, perceptual: bool = False
) -> list[Comparison]:
    """Compare every variant with the first. Raises OptionError if the sizes differ."""
    if len(variants) < 2:
        raise OptionError("one picture cannot be compared; name at least two")
    first, *others = variants
    return [_pair(first, other, tolerance, perceptual) for other in others]


def _pair(first: Variant, other: Variant, tolerance: Tolerance, perceptual: bool) -> Comparison:
    pictures = first.frame.pixels, other.frame.pixels
    difference = measure(*pictures, tolerance, perceptual=perceptual)
    steps = []
    if first.banner is not None and not difference.same:
        for count in range(max(first.layer_count, other.layer_count) + 1):
            a, b = first.with_layers(count), other.with_layers(count)
            steps.append((a, b, measure(a.pixels, b.pixels)))
    return Comparison(first, other, difference, tuple(steps))


def pair_sheet(pair: Comparison) -> Frame:
    """Both pictures and their difference side by side."""
    labels = (pair.first.label[:40], pair.other.label[:40])
    return side_by_side(pair.first.frame.pixels, pair.other.frame.pixels, labels)


def build_up_sheet(pair: Comparison) -> Frame | None:
    """The build-up of both, one column a step; None for finished pictures."""
    if not pair.build_up:
        return None
    names = [_step_name(pair.other, count) for count in range(len(pair.build_up))]
    firsts = [(name, a.pixels) for name, (a, _, _) in zip(names, pair.build_up, strict=True)]
    others = [(f"max {difference.max_error}", b.pixels) for _, b, difference in pair.build_up]
    return contact_sheet([*firsts, *others], columns=len(names))


def _step_name(variant: Variant, count: int) -> str:
    if count == 0 or variant.banner is None:
        return "base"
    if count > len(variant.banner.layers):
        return f"layer {count}"
    layer = variant.banner.layers[count - 1]
    return f"layer {count} ({layer.pattern}, {layer.dye})"


def pair_entry(pair: Comparison) -> ReportEntry:
    """The pair as a part of a report."""
    # Imported here: the words of blazon load a grammar, which only reports need.
    from drapery.banner import alt_text

    pictures = [("side by side", data_address(pair_sheet(pair)))]
    sheet = build_up_sheet(pair)
    if sheet is not None:
        pictures.append(("built up layer by layer", data_address(sheet)))
    facts = {k: v for k, v in pair.difference.as_dict().items() if v is not None}
    banners = dict.fromkeys(
        one.banner for one in (pair.first, pair.other) if one.banner is not None
    )
    shown = "; ".join(alt_text(banner) for banner in banners)
    return ReportEntry(
        *(pair.other.label, pair.difference.same, pair.line(), facts, tuple(pictures), shown)
    )
