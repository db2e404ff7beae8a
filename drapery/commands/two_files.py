"""`drapery compare A.png B.png` without the import of typer and numpy.

These two take longer to load than the comparison of small pictures takes.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from drapery.comparison import StillPair


def compare_files(words: Sequence[str]) -> int | None:
    """Print how two PNG files differ, and return the exit code of `drapery compare`.

    `-o FILE.png` after the files writes the picture of the comparison. None, and nothing is
    printed, for all other words, for which the command itself is run. Raises OptionError for a
    file that cannot be read or is broken, OutputError for a picture that cannot be written.
    """
    if len(words) not in (3, 5) or words[0] != "compare":
        return None
    if not all(each.lower().endswith(".png") and Path(each).is_file() for each in words[1:3]):
        return None
    target = _target(words[3:])
    if target is None and len(words) == 5:
        return None
    from drapery.comparison import EXACT, compared_words, read_stills

    first, other = map(Path, words[1:3])
    if target is not None:
        from drapery.output_files import check_writable

        check_writable(target)
    pair = read_stills(first, other)
    if pair is None:
        return None
    difference = pair.measure()
    print(compared_words(first.name, other.name, difference, EXACT))
    if target is not None:
        _write(target, pair, (first.name, other.name))
    return 0 if difference.agrees else 1


def _target(words: Sequence[str]) -> Path | None:
    """The picture that `-o` names; None for other words."""
    if len(words) != 2 or words[0] not in ("-o", "--out"):
        return None
    path = Path(words[1])
    return path if path.suffix.lower() == ".png" else None


def _write(target: Path, pair: "StillPair", labels: tuple[str, str]) -> None:
    from drapery.comparison import short_labels
    from drapery.output_files import replacing
    from drapery.render.encode.quick_png import quick_png_of_strips

    strips = pair.sheet_strips(short_labels(*labels))
    with replacing(target) as beside:
        beside.write_bytes(quick_png_of_strips(strips))
