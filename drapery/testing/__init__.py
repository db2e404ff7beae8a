"""Golden-image tests: a pytest plugin, and the same checks without writing Python.

With pytest the fixture `golden`, of the type `Golden`, compares a picture with its golden file, and
`golden_numbers` positions and other numbers.
`read_cases` and `check_cases` check a TOML or YAML file of cases. `agrees` compares two pictures
within a `Tolerance`. `check_style` tests a style of your own, and `check_garment` a garment. Names
are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.comparison.tolerance import Tolerance as Tolerance
    from drapery.testing.case_check import (
        CaseResult as CaseResult,
        check_cases as check_cases,
        unused_goldens as unused_goldens,
        update_cases as update_cases,
    )
    from drapery.testing.cases import Case as Case, CaseFile as CaseFile, read_cases as read_cases
    from drapery.testing.explain import (
        LayerNote as LayerNote,
        explain_change as explain_change,
        layer_notes as layer_notes,
    )
    from drapery.testing.failures import (
        GoldenUpdate as GoldenUpdate,
        accept_failures as accept_failures,
        clear_report as clear_report,
        keep_failure as keep_failure,
        markdown_report as markdown_report,
        write_report as write_report,
    )
    from drapery.testing.garment_check import check_garment as check_garment
    from drapery.testing.golden import (
        GoldenError as GoldenError,
        agrees as agrees,
        decode as decode,
        encode as encode,
        fingerprint as fingerprint,
    )
    from drapery.testing.plugin import Golden as Golden
    from drapery.testing.style_check import check_style as check_style
else:
    import_lazily(__name__)
