"""Comparison of pictures: measures of the difference, panels that show it, and a report.

`compare` compares two designs or pictures, `measure` two arrays of pixels; `draw_variants` and
`compare_variants` draw and compare designs, packs, layer modes or backends, and name the layer from
which they differ. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.comparison.alignment import align
    from drapery.comparison.cost import Cost, cost_of
    from drapery.comparison.difference import Difference
    from drapery.comparison.files import MAX_FILE
    from drapery.comparison.folders import (
        FilePair,
        FolderFiles,
        compare_folders,
        folder_files,
    )
    from drapery.comparison.ignored import ignored_pixels, painted
    from drapery.comparison.limit_values import read_tolerance
    from drapery.comparison.limits import LIMIT_OPTIONS
    from drapery.comparison.loops import measure_pictures, padded
    from drapery.comparison.metrics import (
        difference_map,
        eight_bits,
        errors,
        measure,
        seen,
    )
    from drapery.comparison.pairs import (
        BuildUpStep,
        Comparison,
        build_up_sheet,
        compare,
        compare_variants,
        pair_entry,
        pair_facts,
        pair_sheet,
    )
    from drapery.comparison.panels import difference_panel, joined_panels, side_by_side
    from drapery.comparison.picture import (
        Picture,
        as_picture,
        decode_picture,
        read_picture,
    )
    from drapery.comparison.report import (
        ReportEntry,
        data_address,
        data_of,
        html_report,
        write_text,
    )
    from drapery.comparison.stills import StillPair, measure_files, read_stills
    from drapery.comparison.tolerance import EXACT, Tolerance
    from drapery.comparison.variants import Variant, draw_variants, is_pack, is_picture
    from drapery.comparison.words import compared_words, difference_words, short_labels

__all__ = [
    "EXACT",
    "LIMIT_OPTIONS",
    "MAX_FILE",
    "BuildUpStep",
    "Comparison",
    "Cost",
    "Difference",
    "FilePair",
    "FolderFiles",
    "Picture",
    "ReportEntry",
    "StillPair",
    "Tolerance",
    "Variant",
    "align",
    "as_picture",
    "build_up_sheet",
    "compare",
    "compare_folders",
    "compare_variants",
    "compared_words",
    "cost_of",
    "data_address",
    "data_of",
    "decode_picture",
    "difference_map",
    "difference_panel",
    "difference_words",
    "draw_variants",
    "eight_bits",
    "errors",
    "folder_files",
    "html_report",
    "ignored_pixels",
    "is_pack",
    "is_picture",
    "joined_panels",
    "measure",
    "measure_files",
    "measure_pictures",
    "padded",
    "painted",
    "pair_entry",
    "pair_facts",
    "pair_sheet",
    "read_picture",
    "read_stills",
    "read_tolerance",
    "seen",
    "short_labels",
    "side_by_side",
    "write_text",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "comparison.alignment": ("align",),
        "comparison.cost": ("Cost", "cost_of"),
        "comparison.difference": ("Difference",),
        "comparison.files": ("MAX_FILE",),
        "comparison.ignored": ("ignored_pixels", "painted"),
        "comparison.folders": (
            "FilePair",
            "FolderFiles",
            "compare_folders",
            "folder_files",
        ),
        "comparison.limit_values": ("read_tolerance",),
        "comparison.limits": ("LIMIT_OPTIONS",),
        "comparison.loops": ("measure_pictures", "padded"),
        "comparison.metrics": (
            "difference_map",
            "eight_bits",
            "errors",
            "measure",
            "seen",
        ),
        "comparison.pairs": (
            "BuildUpStep",
            "Comparison",
            "build_up_sheet",
            "compare",
            "compare_variants",
            "pair_entry",
            "pair_facts",
            "pair_sheet",
        ),
        "comparison.panels": ("difference_panel", "joined_panels", "side_by_side"),
        "comparison.picture": (
            "Picture",
            "as_picture",
            "decode_picture",
            "read_picture",
        ),
        "comparison.report": (
            "ReportEntry",
            "data_address",
            "data_of",
            "html_report",
            "write_text",
        ),
        "comparison.stills": ("StillPair", "measure_files", "read_stills"),
        "comparison.tolerance": ("EXACT", "Tolerance"),
        "comparison.variants": ("Variant", "draw_variants", "is_pack", "is_picture"),
        "comparison.words": ("compared_words", "difference_words", "short_labels"),
    },
)
