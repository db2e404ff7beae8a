"""The light on a face that is seen: smooth over the cloth, of one colour.

A texel shows its colour times the light there. The light is a sum of products of Chebyshev
polynomials along both sides of the face; small factors are likelier than large ones. All sums have
a fixed order, so that results do not depend on the machine.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from drapery.match.art import HEIGHT, WIDTH
from drapery.match.smooth import Reals, grid_fit, orders, products, row_sums

_ACROSS, _DOWN = 9, 7
"""The highest orders of the polynomials along the two sides."""
_USUAL, _SPREAD = 0.8, 0.12
"""The mean of all light, and how far it usually is from that."""
_WAVE = 0.03
"""How large the factor of a polynomial usually is; those of higher orders are smaller."""
_NOISE = 3.0
"""The noise of a texel [levels]."""
_ASTRAY = 12.0
"""Differences of this many levels count half in a fit."""
_FITS = 3
_MOST = 60.0
"""Differences above this many levels count as this many: the texel shows something else."""
_LEAST, _BRIGHTEST = 0.2, 1.2
"""The least and the most light of a texel."""
_TINT, _TINTS = 0.03, (0.7, 1.4)
"""How far the light of a channel usually is from the mean, and its least and greatest share."""


@dataclass(frozen=True, eq=False)
class SeenFace:
    """The texels of a face as they are seen.

    levels: 8-bit, [HEIGHT * WIDTH, 3]. weights: how much each texel counts, 0 to 1; less at edges,
    where it may show its neighbour.
    """

    levels: Reals
    weights: Reals

    def light_on(self, face: Reals) -> Reals:
        """The light [n, 3] in which the face of a design [n, 3] looks most like this."""
        light, tint = np.full(len(face), _USUAL), np.ones(3)
        for _ in range(_FITS):
            tinted = face * tint
            rest = np.abs(self.levels - tinted * light[:, None]).mean(axis=1)
            weights = self.weights / (1 + (rest / _ASTRAY) ** 2) / _NOISE**2
            square = (tinted * tinted).sum(axis=1)
            more = (tinted * self.levels).sum(axis=1) / np.maximum(square, 1) - _USUAL
            goal, counts = (part.reshape(HEIGHT, WIDTH) for part in (more, weights * square))
            factors = grid_fit(goal, counts, _STIFFNESS, _ACROSS, _DOWN)
            light = np.clip(_USUAL + row_sums(_TERMS.T, factors), _LEAST, _BRIGHTEST)
            dark = face * light[:, None]
            both = np.stack([dark * dark, dark * self.levels]) * weights[:, None]
            square, product = both.transpose(0, 2, 1).copy().sum(axis=2) + 1 / _TINT**2
            tint = np.clip(product / square, *_TINTS)
            tint = tint / tint.mean()
        return np.asarray(light[:, None] * tint)

    def error(self, face: Reals, light: Reals) -> float:
        """How little a face [n, 3] looks like this in a light [n, 3], in levels, summed."""
        rest = np.abs(self.levels - face * light).mean(axis=1)
        return float((np.minimum(rest, _MOST) * self.weights).sum())

    def without(self, light: Reals) -> NDArray[np.uint8]:
        """This face without its light, [n, 3]."""
        return np.asarray(np.rint(np.clip(self.levels / light, 0, 255)), np.uint8)


def seen_face(levels: Reals) -> SeenFace:
    """A face [n, 3] that is seen, with the weights of its texels."""
    grid = np.pad(levels.reshape(HEIGHT, WIDTH, 3), ((1, 1), (1, 1), (0, 0)), mode="edge")
    middle = grid[1:-1, 1:-1]
    step = np.zeros((HEIGHT, WIDTH))
    for other in (grid[1:-1, 2:], grid[1:-1, :-2], grid[2:, 1:-1], grid[:-2, 1:-1]):
        step = np.maximum(step, np.abs(other - middle).mean(axis=2))
    return SeenFace(levels, 1 / (1 + (step / 16).reshape(-1)))


def _texels() -> tuple[Reals, Reals]:
    """The middle of each texel in the unit square."""
    v, u = np.divmod(np.arange(HEIGHT * WIDTH), WIDTH)
    return (u + 0.5) / WIDTH, (v + 0.5) / HEIGHT


_TERMS = products(*_texels(), _ACROSS, _DOWN)
"""The terms of the light at each texel, [K, n]."""


def _stiffness() -> Reals:
    """How much the factor of each term resists being large, [K]."""
    first, second = orders(_ACROSS, _DOWN)
    usual = _WAVE / (1 + (first / 6) ** 2 + (second / 3) ** 2)
    usual[0] = _SPREAD
    return np.asarray(1 / usual**2)


_STIFFNESS = _stiffness()
