"""`drapery compare A.png B.png` without the import of typer and numpy.

These two take longer to load than the comparison of small pictures takes.
"""

from collections.abc import Sequence
from pathlib import Path


def compare_files(words: Sequence[str]) -> int | None:
    """Print how two PNG files differ, and return the exit code of `drapery compare`.

    None, and nothing is printed, for all other words, for which the command itself is run. Raises
    OptionError for a file that cannot be read or is broken.
    """
    if len(words) != 3 or words[0] != "compare":
        return None
    if not all(each.lower().endswith(".png") and Path(each).is_file() for each in words[1:]):
        return None
    from drapery.comparison import EXACT, compared_words, measure_files

    first, other = map(Path, words[1:])
    difference = measure_files(first, other)
    if difference is None:
        return None
    print(compared_words(first.name, other.name, difference, EXACT))
    return 0 if difference.agrees else 1
