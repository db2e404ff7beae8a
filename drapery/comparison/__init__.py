"""Comparison of pictures: measures of the difference, panels that show it, and a report.

`compare` compares two designs or pictures, `measure` two arrays of pixels; `draw_variants` and
`compare_variants` draw and compare designs, packs, layer modes or backends, and name the layer from
which they differ. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.comparison.alignment import align as align
    from drapery.comparison.cost import Cost as Cost, cost_of as cost_of
    from drapery.comparison.difference import Difference as Difference
    from drapery.comparison.files import MAX_FILE as MAX_FILE
    from drapery.comparison.folders import (
        FilePair as FilePair,
        FolderFiles as FolderFiles,
        compare_folders as compare_folders,
        folder_files as folder_files,
    )
    from drapery.comparison.ignored import ignored_pixels as ignored_pixels, painted as painted
    from drapery.comparison.limit_values import read_tolerance as read_tolerance
    from drapery.comparison.limits import LIMIT_OPTIONS as LIMIT_OPTIONS
    from drapery.comparison.loops import measure_pictures as measure_pictures, padded as padded
    from drapery.comparison.metrics import (
        difference_map as difference_map,
        eight_bits as eight_bits,
        errors as errors,
        measure as measure,
        seen as seen,
    )
    from drapery.comparison.pairs import (
        BuildUpStep as BuildUpStep,
        Comparison as Comparison,
        build_up_sheet as build_up_sheet,
        compare as compare,
        compare_variants as compare_variants,
        pair_entry as pair_entry,
        pair_facts as pair_facts,
        pair_sheet as pair_sheet,
    )
    from drapery.comparison.panels import (
        difference_panel as difference_panel,
        joined_panels as joined_panels,
        side_by_side as side_by_side,
    )
    from drapery.comparison.picture import (
        Picture as Picture,
        as_picture as as_picture,
        decode_picture as decode_picture,
        read_picture as read_picture,
    )
    from drapery.comparison.report import (
        ReportEntry as ReportEntry,
        data_address as data_address,
        data_of as data_of,
        html_report as html_report,
        write_text as write_text,
    )
    from drapery.comparison.stills import (
        StillPair as StillPair,
        measure_files as measure_files,
        read_stills as read_stills,
    )
    from drapery.comparison.tolerance import EXACT as EXACT, Tolerance as Tolerance
    from drapery.comparison.variants import (
        Variant as Variant,
        draw_variants as draw_variants,
        is_pack as is_pack,
        is_picture as is_picture,
    )
    from drapery.comparison.words import (
        compared_words as compared_words,
        difference_words as difference_words,
        short_labels as short_labels,
    )
else:
    import_lazily(__name__)
