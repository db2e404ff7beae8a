"""Docs and docstrings say in plain words what is: no history, no mood of a machine.

Notes are history.
"""

import re
from pathlib import Path

import pytest
from source_modules import modules

ROOT = Path(__file__).parent.parent
PAGES = [
    *(ROOT / name for name in ("README.md", "SECURITY.md", "CONTRIBUTING.md")),
    *(path for path in sorted(ROOT.glob("docs/**/*.md")) if path.parent.name != "notes"),
]
INSTEAD = {
    r"processor(?:'s)? time|(?:second|minute|ms|µs) of the processor": "CPU time",
    r"busy machine|machine (?:is|was) busy": "under what load, or nothing",
    r"\bjudge": "check",
    r"\basked for\b": "needed",
    r"\breads? as cloth": "what can be seen",
    r"(?<!is )(?<!are )(?<!be )(?<!and )\bused to [a-z]+": "what is",
    r"\b\d[\d.,]*(?: (?!as )[a-z%/]+)? before\b(?! and)": "what is; older figures are notes",
    r"\bbefore one colour\b": "in front of",
}
VAGUE = re.compile(r"\b(?:that(?:\s+#)?\s+of|so(?:\s+#)?\s+many|shall)\b", re.I)
"""Words in place of a noun, a number or the present tense."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_a_page_says_what_is(page: Path) -> None:
    text = " ".join(page.read_text("utf-8").split())
    found = {
        match[0]: f"write {other}"
        for words, other in INSTEAD.items()
        for match in re.finditer(words, text, re.I)
    }
    assert not found


def test_sources_name_what_they_mean() -> None:
    found = [
        f"{path.relative_to(ROOT)}:{text.count(chr(10), 0, match.start()) + 1}: {match[0]!r}"
        for path in modules().values()
        for text in [path.read_text("utf-8")]
        for match in VAGUE.finditer(text)
    ]
    assert not found, "name the thing, the number, or write the present tense"
