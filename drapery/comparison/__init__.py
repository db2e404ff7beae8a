"""Comparison of pictures: measures of the difference, panels that show it, and a report.

`compare` compares two designs or pictures, `measure` two arrays of pixels; `draw_variants` and
`compare_variants` draw and compare designs, packs, layer modes or backends, and name the layer from
which they differ. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.comparison.cost import Cost, cost_of
    from drapery.comparison.metrics import Difference, difference_map, errors, measure, seen
    from drapery.comparison.pairs import (
        Comparison,
        build_up_sheet,
        compare,
        compare_variants,
        pair_entry,
        pair_sheet,
    )
    from drapery.comparison.panels import difference_panel, side_by_side
    from drapery.comparison.report import (
        ReportEntry,
        data_address,
        data_of,
        html_report,
        write_text,
    )
    from drapery.comparison.tolerance import Tolerance, ignored_pixels, painted
    from drapery.comparison.variants import Variant, draw_variants

__all__ = [
    "Comparison",
    "Cost",
    "Difference",
    "ReportEntry",
    "Tolerance",
    "Variant",
    "build_up_sheet",
    "compare",
    "compare_variants",
    "cost_of",
    "data_address",
    "data_of",
    "difference_map",
    "difference_panel",
    "draw_variants",
    "errors",
    "html_report",
    "ignored_pixels",
    "measure",
    "painted",
    "pair_entry",
    "pair_sheet",
    "seen",
    "side_by_side",
    "write_text",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "comparison.cost": ("Cost", "cost_of"),
        "comparison.metrics": ("Difference", "difference_map", "errors", "measure", "seen"),
        "comparison.pairs": (
            "Comparison",
            "build_up_sheet",
            "compare",
            "compare_variants",
            "pair_entry",
            "pair_sheet",
        ),
        "comparison.panels": ("difference_panel", "side_by_side"),
        "comparison.report": (
            "ReportEntry",
            "data_address",
            "data_of",
            "html_report",
            "write_text",
        ),
        "comparison.tolerance": ("Tolerance", "ignored_pixels", "painted"),
        "comparison.variants": ("Variant", "draw_variants"),
    },
)
