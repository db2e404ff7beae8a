"""Whether the pictures that odiff and pixelmatch are tested with get the same verdicts from us.

`python -m benchmarks.peers_fixtures --node FOLDER --pictures FOLDER...` compares every two pictures
of a folder that have one size, with pixels of smoothed edges counted and not. The first folder has
been made by `npm install odiff-bin pixelmatch pngjs`; the others are those of the fixtures in the
repositories of both. odiff and pixelmatch 7 measure colours in YIQ as we do, pixelmatch 8 in OKLab.

Of the 210 comparisons of pixelmatch's fixtures of up to 200,000 pixels all numbers of pixels are
those of pixelmatch 7.1; 209 verdicts are those of pixelmatch 8.0, and 206 those of odiff 4.5, which
sees translucent pixels on white only, not on a pattern. Of the 56 of odiff's fixtures of up to
3,000,000 pixels all verdicts are those of odiff, and the 10 that pixelmatch's reader of PNG files
takes are those of pixelmatch 7.1 with all numbers.
"""

import argparse
import json
import subprocess
from collections import defaultdict
from collections.abc import Iterator
from itertools import combinations
from pathlib import Path
from typing import NamedTuple

from PIL import Image

from benchmarks.quick import add_quick, needs
from drapery import DraperyError
from drapery.comparison import Tolerance, measure_pictures, read_picture

THRESHOLD = 0.1
"""The difference of colour that does not count, the default of both."""
LIMIT = 20.0
"""How long odiff may take for two pictures [s]."""
FORMATS = (".png", ".jpg", ".jpeg", ".bmp", ".tiff", ".webp")
COUNT = """
import fs from 'node:fs';
import {PNG} from 'pngjs';
import match from 'pixelmatch';
const count = ([a, b, includeAA]) => {
  const [x, y] = [a, b].map((path) => PNG.sync.read(fs.readFileSync(path)));
  return match(x.data, y.data, null, x.width, x.height, {threshold: THRESHOLD, includeAA});
};
const tried = (job) => { try { return count(job); } catch { return null; } };
console.log(JSON.stringify(JSON.parse(fs.readFileSync(0)).map(tried)));
""".replace("THRESHOLD", str(THRESHOLD))


class Job(NamedTuple):
    """Two pictures. smoothed: whether pixels of smoothed edges count."""

    first: str
    other: str
    smoothed: bool


def jobs(folder: Path, most: int) -> Iterator[Job]:
    """Every two pictures of one size, of at most so many pixels, no content twice."""
    sizes: dict[tuple[int, int], dict[bytes, Path]] = defaultdict(dict)
    for path in sorted(folder.rglob("*")):
        if path.suffix.lower() in FORMATS:
            with Image.open(path) as picture:
                if picture.width * picture.height <= most:
                    sizes[picture.size].setdefault(path.read_bytes(), path)
    for paths in sizes.values():
        for first, other in combinations(map(str, paths.values()), 2):
            yield from (Job(first, other, smoothed) for smoothed in (True, False))


def ours(job: Job) -> int | None:
    """How many pixels differ; None for a picture that cannot be read."""
    limits = Tolerance(colour=THRESHOLD, antialiasing=job.smoothed)
    try:
        pictures = [read_picture(Path(path)) for path in (job.first, job.other)]
    except DraperyError:
        return None
    return measure_pictures(*pictures, limits).beyond


def odiff(program: Path, job: Job) -> int | None:
    """How many pixels differ to odiff; None where it fails."""
    words = [str(program), job.first, job.other, "--threshold", str(THRESHOLD)]
    words += ["--parsable-stdout", *([] if job.smoothed else ["--antialiasing"])]
    try:
        run = subprocess.run(
            words, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=LIMIT
        )
    except subprocess.TimeoutExpired:
        return None
    return {0: 0, 22: int(run.stdout.split(";")[0] or -1)}.get(run.returncode)


def pixelmatch(node: Path, asked: list[Job]) -> list[int | None]:
    """How many pixels differ to pixelmatch; None for what is no PNG file."""
    words = ["node", "--input-type=module", "--eval", COUNT]
    run = subprocess.run(
        words, cwd=node, input=json.dumps(asked), stdout=subprocess.PIPE, text=True, check=True
    )
    found: list[int | None] = json.loads(run.stdout)
    return found


def print_agreement(
    name: str, asked: list[Job], mine: list[int | None], theirs: list[int | None]
) -> None:
    """How often verdicts and counts agree, and every pair with another verdict."""
    known = [
        (job, a, b)
        for job, a, b in zip(asked, mine, theirs, strict=True)
        if a is not None and b is not None
    ]
    other = [(job, a, b) for job, a, b in known if (a == 0) != (b == 0)]
    counts = sum(a == b for _, a, b in known)
    print(f"{name}: {len(known)} of {len(asked)} comparisons are possible", end="; ")
    print(f"{len(known) - len(other)} verdicts and {counts} numbers of pixels agree")
    for job, a, b in other:
        edges = "" if job.smoothed else " without smoothed edges"
        print(f"  {Path(job.first).name}, {Path(job.other).name}{edges}: ours {a}, theirs {b}")


def main() -> None:
    """Print where verdicts agree."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--node", type=Path, help="a folder with odiff-bin and pixelmatch of npm")
    words.add_argument("--pictures", type=Path, nargs="+", default=[], help="folders of fixtures")
    words.add_argument("--most", type=int, default=1_000_000, help="pixels of a picture")
    add_quick(words)
    given = words.parse_args()
    needs(given.node and given.pictures, "a folder of npm with one of fixtures")
    (program, *_) = given.node.absolute().glob("node_modules/@odiff/*/odiff*")
    for folder in given.pictures:
        asked = list(jobs(folder.absolute(), given.most))
        print(f"{folder}: {len(asked)} comparisons")
        mine = [ours(job) for job in asked]
        print_agreement("odiff", asked, mine, [odiff(program, job) for job in asked])
        print_agreement("pixelmatch", asked, mine, pixelmatch(given.node, asked))


if __name__ == "__main__":
    main()
