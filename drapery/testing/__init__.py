"""Golden-image tests: a pytest plugin, and the same checks without writing Python.

With pytest the fixture `golden`, of the type `Golden`, compares a picture with its golden file.
`read_cases` and `check_cases` check a TOML or YAML file of cases. `agrees` compares two pictures
within a `Tolerance`. `check_style` tests a style of your own, and `check_garment` a garment. Names
are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.comparison import Tolerance
    from drapery.testing.case_check import CaseResult, check_cases, unused_goldens, update_cases
    from drapery.testing.cases import Case, CaseFile, read_cases
    from drapery.testing.explain import LayerNote, explain_change, layer_notes
    from drapery.testing.failures import (
        GoldenUpdate,
        accept_failures,
        clear_report,
        keep_failure,
        markdown_report,
        write_report,
    )
    from drapery.testing.garment_check import check_garment
    from drapery.testing.golden import (
        GoldenError,
        agrees,
        decode,
        encode,
        fingerprint,
    )
    from drapery.testing.plugin import Golden
    from drapery.testing.style_check import check_style

__all__ = [
    "Case",
    "CaseFile",
    "CaseResult",
    "Golden",
    "GoldenError",
    "GoldenUpdate",
    "LayerNote",
    "Tolerance",
    "accept_failures",
    "agrees",
    "check_cases",
    "check_garment",
    "check_style",
    "clear_report",
    "decode",
    "encode",
    "explain_change",
    "fingerprint",
    "keep_failure",
    "layer_notes",
    "markdown_report",
    "read_cases",
    "unused_goldens",
    "update_cases",
    "write_report",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "comparison.tolerance": ("Tolerance",),
        "testing.case_check": ("CaseResult", "check_cases", "unused_goldens", "update_cases"),
        "testing.cases": ("Case", "CaseFile", "read_cases"),
        "testing.explain": ("LayerNote", "explain_change", "layer_notes"),
        "testing.failures": (
            "GoldenUpdate",
            "accept_failures",
            "clear_report",
            "keep_failure",
            "markdown_report",
            "write_report",
        ),
        "testing.garment_check": ("check_garment",),
        "testing.golden": (
            "GoldenError",
            "agrees",
            "decode",
            "encode",
            "fingerprint",
        ),
        "testing.plugin": ("Golden",),
        "testing.style_check": ("check_style",),
    },
)
