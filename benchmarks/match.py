"""How well designs are found: faces of random designs, and pictures against a greedy search.

`python -m benchmarks.match faces --count 100` makes faces of random designs and searches them, in
our own art or in that of `--pack`: the share that is found exactly and the processor time of each.
`python -m benchmarks.match pictures --count 12` compares the mean CIEDE2000 of the best design with
that of a greedy search on flags, letters, icons and paintings that are drawn here. It needs the
extra `bench`. The greedy search is of the kind of Image2Banners: layer after layer it takes the
pattern and dye with the least product of mean CIEDE2000 and of 2 minus the structural similarity.
`--sheet FILE` shows pictures and banners beside each other.
"""

import argparse
import time
from collections import Counter
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, ImageDraw, ImageFont

from benchmarks.quick import add_quick
from drapery.banner import DYES
from drapery.match import Matcher
from drapery.match.art import HEIGHT, WIDTH, FaceArt, Levels, Stack
from drapery.match.exact import ExactSearch

SEED = 19
SIZE = (160, 320)
KINDS = ("flag", "letter", "icon", "painting")
PAINTS = (
    "f4f1ea1a1c22c8102ee8731af2c230ffe08a1e7a3c6bbf59a8d8b00b2e6f2f6fd08ec6ef"
    "5a2d82b06ab3f2a9c0d94f7a6b4226b98a5ac9b79c8a8f98546a7b0f766ec2e3d0702632"
)
"""The colours of the pictures, six hexadecimal digits each."""

SHORT_LIST = 24
"""Layers whose structural similarity the greedy search looks at: those of the least CIEDE2000."""


def random_stack(art: FaceArt, layers: int, rng: np.random.Generator) -> Stack:
    """A base and layers that are all equally likely."""
    patterns = rng.integers(len(art.patterns), size=layers)
    base, *dyes = rng.integers(16, size=layers + 1)
    return int(base), tuple(zip(patterns.tolist(), map(int, dyes), strict=True))


def print_faces(packs: tuple[Path, ...], layers: int, numbers: range) -> None:
    """The share of faces of random designs that are found, and the times."""
    art = Matcher(packs).art
    search, times, found, fewest = ExactSearch(art), [], 0, Counter[int]()
    for number in numbers:
        stack = random_stack(art, layers, np.random.default_rng((SEED, layers, number)))
        face = art.paint(*stack)
        begin = time.process_time()
        made = search.find(face, layers)
        times.append(time.process_time() - begin)
        if made is not None and (art.paint(*made) == face).all():
            found += 1
            fewest[len(made[1])] += 1
    median, most, worst = np.percentile(times, [50, 99, 100])
    print(
        f"{layers:2} layers: {found} of {len(numbers)} exact ({found / len(numbers):.2%});"
        f" processor time median {median:.3f} s, 99 % {most:.2f} s, longest {worst:.2f} s;"
        f" layers of the designs found {dict(sorted(fewest.items()))}",
        flush=True,
    )


def picture(number: int) -> Image.Image:
    """A flag, letter, icon or painting, the same one for the same number."""
    rng = np.random.default_rng((SEED, number))
    image = Image.new("RGB", SIZE, colour(rng))
    draw = ImageDraw.Draw(image)
    {"flag": flag, "letter": letter, "icon": icon, "painting": painting}[
        KINDS[number % len(KINDS)]
    ](draw, rng, number // len(KINDS))
    return image


def colour(rng: np.random.Generator) -> tuple[int, int, int]:
    """One of a paintbox, a little lighter or darker; none is a dye."""
    part = int(rng.integers(len(PAINTS) // 6)) * 6
    value = int(PAINTS[part : part + 6], 16)
    change = int(rng.integers(-24, 25))
    red, green, blue = (min(max(value >> shift & 255, 24), 231) + change for shift in (16, 8, 0))
    return red, green, blue


def flag(draw: ImageDraw.ImageDraw, rng: np.random.Generator, number: int) -> None:
    """Stripes, a cross or a saltire, and a disc or a canton."""
    width, height = SIZE
    kind, stripes = number % 5, int(rng.integers(2, 6))
    if kind in (0, 1):
        for stripe in range(stripes):
            fill = colour(rng)
            if kind:
                draw.rectangle((0, stripe * height // stripes, width, height), fill)
            else:
                draw.rectangle((stripe * width // stripes, 0, width, height), fill)
    elif kind == 2:
        fill = colour(rng)
        draw.rectangle((0, 130, width, 190), fill)
        draw.rectangle((45, 0, 95, height), fill)
    elif kind == 3:
        fill = colour(rng)
        draw.line((0, 0, width, height), fill, 36)
        draw.line((width, 0, 0, height), fill, 36)
    else:
        draw.polygon([(0, 0), (width, height), (0, height)], colour(rng))
    if rng.random() < 0.5:
        draw.ellipse((40, 120, 120, 200), colour(rng))
    else:
        draw.rectangle((0, 0, 80, 130), colour(rng))


def letter(draw: ImageDraw.ImageDraw, rng: np.random.Generator, number: int) -> None:
    text = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"[number % 36]
    font = ImageFont.load_default(size=260)
    draw.text((SIZE[0] / 2, SIZE[1] / 2), text, colour(rng), font, anchor="mm")


def icon(draw: ImageDraw.ImageDraw, rng: np.random.Generator, number: int) -> None:
    """A face, a heart, a tree, a house or a fish."""
    first, second = colour(rng), colour(rng)
    kind = number % 5
    if kind == 0:
        draw.ellipse((10, 90, 150, 230), first)
        for x in (45, 95):
            draw.ellipse((x, 125, x + 20, 150), second)
        draw.arc((45, 150, 115, 205), 20, 160, second, 9)
    elif kind == 1:
        draw.ellipse((10, 80, 85, 165), first)
        draw.ellipse((75, 80, 150, 165), first)
        draw.polygon([(15, 140), (145, 140), (80, 250)], first)
    elif kind == 2:
        draw.rectangle((66, 200, 94, 300), first)
        draw.polygon([(80, 30), (150, 140), (10, 140)], second)
        draw.polygon([(80, 90), (155, 220), (5, 220)], second)
    elif kind == 3:
        draw.rectangle((25, 150, 135, 290), first)
        draw.polygon([(80, 50), (155, 150), (5, 150)], second)
        draw.rectangle((65, 215, 95, 290), second)
    else:
        draw.ellipse((10, 110, 120, 200), first)
        draw.polygon([(105, 155), (155, 105), (155, 205)], first)
        draw.ellipse((35, 135, 55, 155), second)


def painting(draw: ImageDraw.ImageDraw, rng: np.random.Generator, number: int) -> None:
    """A sky that fades, hills and a sun, or blots of paint."""
    width, height = SIZE
    top, bottom = np.array(colour(rng)), np.array(colour(rng))
    for y in range(height):
        red, green, blue = (top + (bottom - top) * y / height).astype(int).tolist()
        draw.line((0, y, width, y), (red, green, blue))
    if number % 2:
        x, y = rng.integers(20, 140), rng.integers(30, 120)
        draw.ellipse((x - 22, y - 22, x + 22, y + 22), colour(rng))
        for hill in range(3):
            left = float(rng.integers(-100, 100))
            box = (left, 190 + 40 * hill, left + 220, 420)
            draw.ellipse(box, colour(rng))
        return
    for _ in range(14):
        x, y = rng.integers(0, width), rng.integers(0, height)
        w, h = rng.integers(10, 70, 2)
        draw.ellipse((x - w, y - h, x + w, y + h), colour(rng))


def lab_of(face: NDArray[np.generic]) -> NDArray[np.float64]:
    from skimage.color import rgb2lab

    return np.asarray(rgb2lab(np.asarray(face, np.float64) / 255))


def mean_difference(face: Levels, goal: NDArray[np.generic]) -> float:
    """The mean CIEDE2000 of two faces."""
    from skimage.color import deltaE_ciede2000

    shape = (HEIGHT, WIDTH, 3)
    return float(deltaE_ciede2000(lab_of(face.reshape(shape)), lab_of(goal.reshape(shape))).mean())


def greedy(art: FaceArt, goal: Levels, layers: int) -> Stack:
    """Layer after layer the one that makes the picture most alike, until none does."""
    from skimage.color import deltaE_ciede2000
    from skimage.metrics import structural_similarity

    lab = lab_of(goal.reshape(-1, 3))
    shape = (HEIGHT, WIDTH, 3)

    def cost(face: Levels, difference: float) -> float:
        similar = structural_similarity(
            face.reshape(shape).astype(np.uint8),
            goal.reshape(shape).astype(np.uint8),
            channel_axis=2,
        )
        return difference * (2 - float(similar))

    base = min(range(16), key=lambda dye: mean_difference(art.bases[dye], goal))
    stack: tuple[tuple[int, int], ...] = ()
    face = art.bases[base]
    best = cost(face, mean_difference(face, goal))
    for _ in range(layers):
        now = deltaE_ciede2000(lab_of(face.reshape(-1, 3)), lab)
        table = []
        for pattern in range(len(art.patterns)):
            part = np.flatnonzero(art.alpha[pattern, ::3])
            alpha = art.alpha[pattern].reshape(-1, 3)[part]
            dyed = art.dyed[pattern].reshape(16, -1, 3)[:, part]
            seen = (alpha * dyed + (255 - alpha) * face.reshape(-1, 3)[part] + 127) // 255
            goals = np.broadcast_to(lab[part], seen.shape)
            change = deltaE_ciede2000(lab_of(seen), goals) - now[part]
            table.append(now.mean() + change.sum(axis=1) / len(lab))
        order = np.argsort(np.ravel(table), kind="stable")[:SHORT_LIST]
        tried = []
        for place in order.tolist():
            layer = divmod(place, 16)
            tried.append((cost(art.lay(*layer, face), float(np.ravel(table)[place])), layer))
        least, layer = min(tried)
        if least >= best:
            break
        best, stack = least, (*stack, layer)
        face = art.lay(*layer, face)
    return base, stack


def print_pictures(
    packs: tuple[Path, ...],
    layers: int,
    numbers: range,
    effort: int,
    sheet: Path | None,
) -> None:
    """The mean CIEDE2000 of both searches on each kind of picture."""
    matcher = Matcher(packs)
    sums: dict[str, list[tuple[float, float, float, float]]] = {kind: [] for kind in KINDS}
    shown = []
    for number in numbers:
        image = picture(number).resize((WIDTH, HEIGHT), Image.Resampling.BOX)
        face = np.asarray(image)
        goal = face.reshape(-1).astype(np.int32)
        begin = time.process_time()
        other = matcher.art.paint(*greedy(matcher.art, goal, layers))
        between = time.process_time()
        (best,) = matcher.match(face, layers=layers, alternatives=1, effort=effort)
        taken = time.process_time() - between
        names = {name: index for index, name in enumerate(matcher.art.patterns)}
        stack = tuple((names[one.pattern], DYES[one.dye].number) for one in best.banner.layers)
        ours = matcher.art.paint(DYES[best.banner.base].number, stack)
        row = mean_difference(ours, goal), mean_difference(other, goal), taken, between - begin
        sums[KINDS[number % len(KINDS)]].append(row)
        shown.append((face, ours.reshape(face.shape)))
    every = [row for rows in sums.values() for row in rows]
    for kind, rows in (*sums.items(), ("all", every)):
        if not rows:
            continue
        ours_mean, greedy_mean, seconds, greedy_seconds = np.mean(rows, axis=0)
        wins = sum(row[0] < row[1] for row in rows)
        print(
            f"{kind:8} {len(rows):3} pictures: mean CIEDE2000 {ours_mean:.2f}, greedy"
            f" {greedy_mean:.2f}; lower in {wins}; processor time {seconds:.1f} s, greedy"
            f" {greedy_seconds:.1f} s"
        )
    if sheet is not None:
        save_sheet(shown, sheet)


def save_sheet(shown: list[tuple[NDArray[np.generic], ...]], path: Path) -> None:
    """Each picture beside the best design, six to a row."""
    from drapery.render import Frame

    cells = []
    for faces in shown:
        gap = np.full((HEIGHT, 2, 3), 255, np.uint8)
        row = np.hstack([part for face in faces for part in (face.astype(np.uint8), gap)])
        cells.append(np.pad(row, ((2, 2), (2, 2), (0, 0)), constant_values=255))
    while len(cells) % 6:
        cells.append(np.full_like(cells[0], 255))
    rows = [np.hstack(cells[start : start + 6]) for start in range(0, len(cells), 6)]
    pixels = np.vstack(rows).repeat(3, axis=0).repeat(3, axis=1)
    Frame(np.dstack([pixels, np.full_like(pixels[..., 0], 255)])).save(path)


def main() -> None:
    """Print the figures."""
    words = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    words.add_argument("what", nargs="?", choices=("faces", "pictures"), help="by default both")
    words.add_argument("--count", type=int, default=12)
    words.add_argument("--first", type=int, default=0, help="number of the first one")
    words.add_argument("--layers", type=int, nargs="+", default=[6])
    words.add_argument("--effort", type=int, default=24)
    words.add_argument("--pack", type=Path, action="append", default=[])
    words.add_argument("--sheet", type=Path)
    add_quick(words)
    given = words.parse_args()
    if given.quick:
        given.count, given.layers, given.effort = 1, [2], 1
    for layers in given.layers:
        numbers = range(given.first, given.first + given.count)
        if given.what != "pictures":
            print_faces(tuple(given.pack), layers, numbers)
        if given.what != "faces":
            print_pictures(tuple(given.pack), layers, numbers, given.effort, given.sheet)


if __name__ == "__main__":
    main()
