"""How much of the project a picture passes through: `python -m benchmarks.pipeline`.

modules  of this project that a warm `draw(...).save` enters: a second draw, with another seed, of a
         banner and of the garment `cape`.
calls    of Python functions in the same, those of all libraries counted.
still    calls of this project's Python functions to make the scene of a cape's still of 3 s on a
         player; the scene is not drawn.
Counts depend on no clock and no processor. Beside them are the goals.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory
from types import FrameType

from benchmarks.quick import add_quick
from drapery import Banner, Settings, draw
from drapery.garments import Garment, find_garment
from drapery.packs import open_packs
from drapery.scenes import still
from drapery.settings import Options

ROOT = Path(__file__).parents[1]
OURS = tuple(str(ROOT / name) + "/" for name in ("drapery", "render", "assets"))
MODULES = {"banner": 45, "cape": 50}
"""Modules that a warm draw may enter."""
CALLS = {"banner": 4000, "cape": 6000}
"""Calls that it may make."""
STILL = 4000
"""Calls that a cape's still may make."""


def calls_of(work: Callable[[], object]) -> Counter[str]:
    """How often Python functions are called by some work, by the file that they are in."""
    found: Counter[str] = Counter()

    def note(frame: FrameType, event: str, argument: object) -> None:
        if event == "call":
            found[frame.f_code.co_filename] += 1

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(before)
    return found


def ours(calls: Counter[str]) -> Counter[str]:
    """The calls of this project's functions, by the path of the file in it."""
    return Counter(
        {
            Path(name).relative_to(ROOT).as_posix(): count
            for name, count in calls.items()
            if name.startswith(OURS)
        }
    )


def warm_draw(subject: Banner | Garment, options: Options, folder: Path) -> Counter[str]:
    """The calls of a second draw and its file."""
    path = folder / "picture.png"
    draw(subject, seed=1, **options).save(path)
    return calls_of(lambda: draw(subject, seed=2, **options).save(path))


def main() -> None:
    """Print the counts."""
    words = argparse.ArgumentParser("python -m benchmarks.pipeline", description=__doc__)
    add_quick(words)
    quick = words.parse_args().quick
    time = 0.1 if quick else 3.0
    options: Options = {"time": time, "size": (64, 64)} if quick else {}
    banner = Banner.parse("white creeper:lime border:black")
    subjects = {"banner": banner, "cape": find_garment("cape")}
    with TemporaryDirectory() as folder:
        for name, subject in subjects.items():
            calls = warm_draw(subject, options, Path(folder))
            print(f"{name}: {len(ours(calls))} modules are entered (goal {MODULES[name]})")
            print(f"{name}: {calls.total():,} calls of Python functions (goal {CALLS[name]:,})")
    packs, settings = open_packs(()), Settings(time=time)
    still(find_garment("cape"), packs, replace(settings, seed=1))
    made = ours(calls_of(lambda: still(find_garment("cape"), packs, settings)))
    print(f"a cape's still of {time:g} s: {made.total():,} calls of ours (goal {STILL:,}), most in")
    for file, count in made.most_common(5):
        print(f"  {file}: {count:,}")


if __name__ == "__main__":
    main()
