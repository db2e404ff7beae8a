"""From a photo or screenshot of a banner to its design."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from drapery.banner import DYES, LOOM_LAYERS, MAX_LAYERS
from drapery.match.art import HEIGHT, WIDTH, Stack, read_art
from drapery.match.colours import UNIT, distances, oklab
from drapery.match.lit import LitFace, LitSearch, lit_face
from drapery.match.perspective import (
    BENDS,
    TEXEL_TERMS,
    Corner,
    PhotoView,
    Reals,
    as_corners,
    checked_picture,
    find_corners,
)
from drapery.match.search import MAX_ALTERNATIVES, Match
from drapery.option import within
from drapery.packs import PackLike, open_packs

_GAINS = (0.5, 0.6, 0.68, 0.76, 0.84, 0.92, 1.0)
"""Lights that the search begins with."""
_KICKS = 16
_SEED = 19
_STIFF = 3000.0
"""How much a flag resists being bent by `_aligned`."""


def match_photo(
    picture: NDArray[np.uint8],
    corners: Sequence[Corner] | None = None,
    *,
    layers: int = LOOM_LAYERS,
    packs: PackLike | Sequence[PackLike] = (),
    format: int | None = None,
    alternatives: int = 3,
) -> list[Match]:
    """The designs that a banner in a photo or screenshot most likely has, best first.

    The light is estimated: a gain of each channel, and the shades of folds. So is how the cloth
    bends between its corners.

    picture: sRGB, uint8 [H, W, 3] or [H, W, 4]. corners: of the flag as one sees it, upper left,
    upper right, lower right, lower left [pixels right, pixels down]; None finds them, before a
    background of one colour. layers: the most layers, 0 to 16. packs, format: as in `Settings`.
    alternatives: the most designs. The error of each is the mean distance of its face from the one
    that was seen, in OKLab.
    Raises OptionError, also where no flag is found, or PackError.
    """
    within("layers", layers, 0, MAX_LAYERS, "layers")
    within("alternatives", alternatives, 1, MAX_ALTERNATIVES, "designs")
    shown = checked_picture(picture)
    view = PhotoView(shown, find_corners(shown) if corners is None else as_corners(corners))
    art = read_art(open_packs(packs, format=format))
    search = LitSearch(art, np.array([dye.rgb for dye in DYES.values()], np.float64), layers)
    found: dict[Stack, tuple[float, LitFace]] = {}
    for start in _starts(search, lit_face(view.face())):
        _refine(search, view, start, found)
    _kick(search, found)
    best = min(found, key=lambda stack: found[stack][0])
    _refine(search, view, best, found)
    best = min(found, key=lambda stack: found[stack][0])
    face = found[best][1]
    for variant in search.variants(face, best):
        _put(search, face, variant, found)
    chosen = _distinct(search, sorted(found, key=lambda stack: found[stack][0]), alternatives)
    return [
        Match(art.banner(*stack), _distance(search, found[stack][1], stack)) for stack in chosen
    ]


def _starts(search: LitSearch, face: LitFace) -> list[Stack]:
    """Designs to align a photo with: the best of each number of layers, and the best of all."""
    tried: dict[Stack, float] = {}
    for gain in _GAINS:
        lit = LitFace(face.seen, face.weights, np.full(3, gain), face.shade)
        for stack in search.beam(lit, 4, 12, 2):
            shown = search.paint(*stack)
            fits = lit.relit(shown, shaded=False).relit(shown, shaded=True)
            tried[stack] = fits.error(shown, len(stack[1]))
    ordered = sorted(tried, key=lambda stack: tried[stack])
    found: dict[Stack, tuple[float, LitFace]] = {}
    for stack in ordered[:3]:
        lit = face.relit(search.paint(*stack), shaded=False)
        for one in dict.fromkeys([stack, *search.beam(lit, 6, 40, 4)[:4]]):
            _put(search, lit, search.descend(lit, one)[1], found)
    best = sorted(found, key=lambda stack: found[stack][0])[:2]
    counts = (next((s for s in ordered if len(s[1]) == count), None) for count in (1, 2, 3))
    return list(dict.fromkeys([*best, *(stack for stack in counts if stack is not None)]))


def _refine(
    search: LitSearch, view: PhotoView, stack: Stack, found: dict[Stack, tuple[float, LitFace]]
) -> None:
    """Align the photo with a design, search in the light that fits, and again."""
    bend = np.zeros((2, BENDS))
    shown = search.paint(*stack)
    face = lit_face(view.face()).relit(shown, shaded=False).relit(shown, shaded=True)
    for last in (False, False, True):
        bend = _aligned(view, bend, search.paint(*stack) * face.light)
        seen = lit_face(view.face(bend))
        face = LitFace(seen.seen, seen.weights, face.gain, face.shade)
        face = face.relit(search.paint(*stack), shaded=False)
        starts = [stack] if last else [stack, *search.beam(face, 6, 30, 3)[:3]]
        results = sorted(search.descend(face, one) for one in dict.fromkeys(starts))
        for _, one in results[:3]:
            _put(search, face, one, found)
        stack = results[0][1]
        face = face.relit(search.paint(*stack), shaded=True)


def _kick(search: LitSearch, found: dict[Stack, tuple[float, LitFace]]) -> None:
    """Descend from a wide beam, and from the best design after random changes."""
    rng = np.random.default_rng(_SEED)
    best = min(found, key=lambda stack: found[stack][0])
    face = found[best][1]
    for stack in search.beam(face, search.most, 100, 4)[:4]:
        _put(search, face, search.descend(face, stack)[1], found)
    for _ in range(_KICKS):
        base, layers = min(found, key=lambda stack: found[stack][0])
        changed = list(layers)
        for _ in range(int(rng.integers(1, 3))):
            place = int(rng.integers(len(changed) + 1))
            layer = int(rng.integers(search.patterns)), int(rng.integers(len(search.dyes)))
            changed[place : place + int(rng.integers(2))] = [layer]
        _put(search, face, search.descend(face, (base, tuple(changed[: search.most])))[1], found)


def _put(
    search: LitSearch, face: LitFace, stack: Stack, found: dict[Stack, tuple[float, LitFace]]
) -> None:
    """Add a design with its error in the light that fits it, unless it is known as better."""
    shown = search.paint(*stack)
    lit = face.relit(shown, shaded=True)
    error = lit.error(shown, len(stack[1]))
    if stack not in found or error < found[stack][0]:
        found[stack] = error, lit


def _distinct(search: LitSearch, stacks: list[Stack], count: int) -> list[Stack]:
    """The first stacks whose faces differ."""
    chosen: list[Stack] = []
    for stack in stacks:
        shown = search.paint(*stack)
        if all(np.abs(search.paint(*other) - shown).mean() > 1 for other in chosen):
            chosen.append(stack)
        if len(chosen) == count:
            break
    return chosen


def _distance(search: LitSearch, face: LitFace, stack: Stack) -> float:
    seen = np.clip(face.colours, 0, 255).astype(np.float32)
    shown = np.clip(search.paint(*stack), 0, 255).astype(np.float32)
    return float(distances(oklab(seen), oklab(shown)).mean() / UNIT)


def _aligned(view: PhotoView, bend: Reals, wanted: Reals) -> Reals:
    """A bend with which the face looks more like one that is wanted, by Gauss-Newton steps."""
    terms = TEXEL_TERMS
    for step in range(4):
        times = 2 if step < 2 else 1
        seen, goal = _softened(view.face(bend), times), _softened(wanted, times)
        levels = seen.reshape(HEIGHT, WIDTH, 3)
        slopes = [np.asarray(np.gradient(levels, axis=axis)).reshape(-1, 3) for axis in (1, 0)]
        rest = goal - seen
        weights = 1 / (1 + (np.abs(rest).mean(axis=1) / 25) ** 2)
        rows = np.concatenate([terms[:, :, None] * slope for slope in slopes])
        rows = rows.reshape(2 * BENDS, -1)
        weighted = rows * np.repeat(weights, 3)
        square = np.einsum("in,jn->ij", weighted, rows)
        linear = np.einsum("in,n->i", weighted, rest.ravel()) - _STIFF * bend.ravel()
        square[np.diag_indices(2 * BENDS)] *= 1.001
        square[np.diag_indices(2 * BENDS)] += _STIFF
        bend = bend + _solved(square, linear).reshape(2, BENDS)
    return bend


def _softened(face: Reals, times: int) -> Reals:
    levels = face.reshape(HEIGHT, WIDTH, 3)
    for _ in range(times):
        for axis in (0, 1):
            wide = np.pad(levels, [(int(k == axis),) * 2 for k in range(3)], mode="edge")
            first, middle, last = (
                wide.take(range(k, k + levels.shape[axis]), axis=axis) for k in range(3)
            )
            levels = (first + 2 * middle + last) / 4
    return levels.reshape(-1, 3)


def _solved(matrix: Reals, right: Reals) -> Reals:
    """The solution of a positive definite system, by Gaussian elimination in a fixed order."""
    rows = np.concatenate([matrix, right[:, None]], axis=1)
    count = len(right)
    for pivot in range(count):
        rows[pivot] /= rows[pivot, pivot]
        factors = rows[:, pivot].copy()
        factors[pivot] = 0
        rows -= factors[:, None] * rows[pivot]
    return rows[:, -1]
