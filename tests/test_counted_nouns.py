"""A message that counts says `1 golden` and `2 goldens`, never `1 goldens`."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from drapery.errors import counted

ROOT = Path(__file__).parent.parent
FILES = sorted(path for name in ("drapery", "render") for path in (ROOT / name).rglob("*.py"))

NOUN = re.compile(r" (?:[a-z]+ )?([a-z-]+s|vertices|indices)\b")
_WORDS = """
address applies as begins belongs closes does draws edits ends exists fits follows gives has hides
holds is its joins lacks less lies lists looks makes means meets ms must names needs of others
pass passes reads refuses runs says shows sits stands starts states stretches takes this unless
uses was write writes
"""
NO_NOUNS = frozenset(_WORDS.split())
LIMITS = re.compile(r"\b(over|most|least|up to|too (many|much|large)|use [012] to)\b")
"""Words of a message about a limit, which numbers pass that are larger than 1."""
SEVERAL = {
    "drapery/banner/formats/planet_minecraft.py": {"len(code)"},  # an even number
    "drapery/banner/formats/registry.py": {"len(found)"},  # banners that differ
    "drapery/banner/formats/block_box.py": {"len(banners)"},  # too many
    "drapery/banner/names.py": {"value.bit_length()"},
    "drapery/banner/packs/stack.py": {"kind"},  # the name of a kind
    "drapery/banner/packs/zips.py": {"entry.file_size"},  # too many
    "drapery/batch/manifest.py": {"len(faults)"},  # said from the second on
    "drapery/batch/pool.py": {"self._failed_starts"},  # more than the limit
    "drapery/batch/report.py": {"counts.drawn / seconds"},  # a rate
    "drapery/batch/rows.py": {"len(cells)"},  # more than the columns
    "drapery/cloth/colliders/shapes.py": {"shape[-1]"},
    "drapery/commands/animate.py": {"fitted.fps"},  # a rate
    "drapery/comparison/limit_values.py": {"len(frames)"},  # of a loop
    "drapery/comparison/picture.py": {"plays"},  # 1 is said as once
    "drapery/picture_file.py": {"max_side"},
    "drapery/scenes/parameters.py": {"count"},  # numbers of a pair or triple
    "drapery/settings.py": {"self.fps"},  # a rate
    "drapery/studio/exports.py": {"self._limit"},
    "drapery/studio/panels/text.py": {"len(upload_queue.found)"},  # banners that differ
    "drapery/studio/uploads.py": {"bounds.max_count"},
    "drapery/styles/chain.py": {"kind"},
    "drapery/styles/step.py": {"many"},  # a range of numbers
    "drapery/web/scene_file.py": {"kind"},
}
"""Values that are never 1, or no numbers."""


def counts(tree: ast.AST) -> Iterator[tuple[int, str, str]]:
    """The line, the value and the noun where a text counts by a value that may be 1."""
    for text in ast.walk(tree):
        if not isinstance(text, ast.JoinedStr):
            continue
        words = "".join(part.value for part in text.values if isinstance(part, ast.Constant))
        if LIMITS.search(words):
            continue
        for before, value, after in zip(
            [None, *text.values], text.values, text.values[1:], strict=False
        ):
            if not isinstance(value, ast.FormattedValue) or not isinstance(after, ast.Constant):
                continue
            noun = NOUN.match(after.value)
            is_size = isinstance(before, ast.Constant) and re.search(r"\dx|\bx ?$", before.value)
            if noun and not NO_NOUNS & set(noun[0].split()) and not is_size and is_number(value):
                yield value.lineno, ast.unparse(value.value), noun[0].strip()


def is_number(value: ast.FormattedValue) -> bool:
    """Whether the value may be a number and is no constant."""
    shown = ast.unparse(value.value)
    is_text = "shown(" in shown or "join(" in shown or "name" in shown or value.conversion != -1
    return not is_text and not re.fullmatch(r"(\w+\.)*_?[A-Z][A-Z_]+(\[\d\])?( >> 20)?", shown)


@pytest.mark.parametrize("path", FILES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_a_count_has_its_noun_in_the_singular_too(path: Path) -> None:
    name = path.relative_to(ROOT).as_posix()
    source = path.read_text(encoding="utf-8")
    found = [each for each in counts(ast.parse(source)) if each[1] not in SEVERAL.get(name, ())]
    assert not found, f"{name}: write counted(number, noun), or add a word to NO_NOUNS: {found}"
    assert not re.search(r"""\{['"]s?['"] if .* else ['"]s?['"]\}""", source), name


def test_the_sweep_finds_what_it_looks_for() -> None:
    tree = ast.parse("""f"{len(paths)} goldens written"; f"{n} of {len(found)} more vertices" """)
    assert [each[2] for each in counts(tree)] == ["goldens", "more vertices"]


def test_irregular_plurals_and_lengths_are_given() -> None:
    assert (counted(1, "golden"), counted(0, "golden")) == ("1 golden", "0 goldens")
    assert counted(1, "vertex", "vertices") == "1 vertex"
    assert counted(2, "vertex", "vertices") == "2 vertices"
    assert (counted(1.0, "texel"), counted(2.5, "texel")) == ("1 texel", "2.5 texels")
