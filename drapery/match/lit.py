"""The designs that look most like a face in unknown light: a beam, then descent layer by layer.

A texel shows its colour times the light there. Of each layer the squared error of every pattern in
every dye is a quadratic in the dye, made of few sums over texels. Texels at edges count less, since
they may show their neighbour; each layer has a cost, since every layer explains some noise.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from drapery.match.art import HEIGHT, WIDTH, FaceArt, Stack
from drapery.match.perspective import Reals

_TEXELS = HEIGHT * WIDTH
_LAYER = 60.0
"""What a layer costs, as an error [levels^2 over the variance of noise]."""
_NOISE = 36.0
"""The variance of a texel's noise [levels^2]."""
_ASTRAY = 0.7
"""How far a texel may be from its place [texels]."""
_TINT = 2000.0
"""What light of a colour costs, times the deviation of the logarithms of its channels."""
_SHADES = (0.7, 1.4)
"""How dark and bright folds are, times the light of the whole."""
_SWEEPS = 6


@dataclass(frozen=True, eq=False)
class LitFace:
    """A face that is seen and the light on it.

    seen: 8-bit levels, [n, 3]. weights: of texels, [n]. gain: of the light's channels, [3].
    shade: of texels, [n].
    """

    seen: Reals
    weights: Reals
    gain: Reals
    shade: Reals

    @cached_property
    def light(self) -> Reals:
        """The light on each texel, [n, 3]."""
        return np.asarray(self.shade[:, None] * self.gain)

    @cached_property
    def colours(self) -> Reals:
        """The face without its light, [n, 3]."""
        return np.asarray(self.seen / np.maximum(self.light, 0.05))

    @cached_property
    def channel_weights(self) -> Reals:
        """What errors of `colours` count, [n, 3]."""
        return np.asarray(self.light**2 * self.weights[:, None])

    def relit(self, face: Reals, *, shaded: bool) -> "LitFace":
        """In the light in which a design's face [n, 3] looks most like this. shaded: with folds."""
        dark = face * self.shade[:, None]
        weights = self.weights[:, None]
        gain = (self.seen * dark * weights).sum(0) / (dark * dark * weights).sum(0)
        if not shaded:
            return replace(self, gain=gain)
        lit = face * gain
        share = _blurred((self.seen * lit).sum(1)) + 300
        shade = np.clip(share / (_blurred((lit * lit).sum(1)) + 300), *_SHADES)
        return replace(self, gain=gain, shade=shade)

    def error(self, face: Reals, layers: int) -> float:
        """How little a design's face [n, 3] looks like this, with the cost of its layers."""
        rest = ((self.seen - face * self.light) ** 2 * self.weights[:, None]).sum()
        tint = np.std(np.log(np.clip(self.gain, 0.05, 2)))
        return float(rest + _LAYER * layers + _TINT * tint)


def lit_face(seen: Reals) -> LitFace:
    """A face [n, 3] in even light."""
    levels = np.pad(seen.reshape(HEIGHT, WIDTH, 3), ((1, 1), (1, 1), (0, 0)), mode="edge")
    middle = levels[1:-1, 1:-1]
    steps = np.zeros((HEIGHT, WIDTH, 3))
    for first, second in (
        (levels[1:-1, 2:], levels[1:-1, :-2]),
        (levels[2:, 1:-1], levels[:-2, 1:-1]),
    ):
        steps += np.maximum(np.abs(first - middle), np.abs(second - middle)) ** 2
    weights = 1 / (_NOISE + _ASTRAY**2 * steps.mean(axis=2).ravel())
    return LitFace(seen, weights, np.ones(3), np.ones(_TEXELS))


def _blurred(values: Reals) -> Reals:
    """Means of texels [n] over about four texels to each side, by weights of a triangle."""
    weights = np.array([1, 2, 3, 4, 3, 2, 1]) / 16
    padded = np.pad(values.reshape(HEIGHT, WIDTH), 3, mode="edge")
    rows = sum(weight * padded[k : k + HEIGHT] for k, weight in enumerate(weights))
    mixed = sum(weight * rows[:, k : k + WIDTH] for k, weight in enumerate(weights))
    return np.asarray(mixed).ravel()


class LitSearch:
    """Finds designs in the look of one `FaceArt`, by weighted squares of 8-bit levels."""

    def __init__(self, art: FaceArt, dyes: Reals, layers: int) -> None:
        self.most, self.dyes = layers, dyes
        self.patterns = len(art.patterns)
        self.bases = art.bases.reshape(-1, _TEXELS, 3).astype(np.float64)
        self.alpha = art.alpha.reshape(self.patterns, _TEXELS, 3)[:, :, 0] / 255
        white = int(dyes.sum(axis=1).argmax())
        dyed = art.dyed[:, white].reshape(self.patterns, _TEXELS, 3) / dyes[white]
        # The patterns' own shading; a pack with coloured ones is met nearly.
        self.shown = self.alpha * dyed.mean(axis=2)

    def paint(self, base: int, layers: Iterable[tuple[int, int]]) -> Reals:
        """The face [n, 3] of a design, without rounding."""
        below: Reals = self.bases[base]
        for layer in layers:
            below = self._laid(below, layer)
        return below

    def beam(self, face: LitFace, layers: int, width: int, kept: int) -> list[Stack]:
        """The best designs that come of adding layers to the best `width`; `kept` of each count."""
        states: list[Stack] = [(base, ()) for base in range(len(self.bases))]
        shown, weights = self.bases, face.channel_weights
        errors = ((shown - face.colours) ** 2 * weights).sum(axis=(1, 2))
        found = dict(zip(states, errors.tolist(), strict=True))
        for _ in range(min(layers, self.most)):
            table = self._errors(shown, face.colours, weights)
            chosen: dict[float, Stack] = {}
            faces = []
            for index in np.argsort(table, axis=None, kind="stable")[: 4 * width]:
                state, pattern, dye = (int(n) for n in np.unravel_index(index, table.shape))
                base, below = states[state]
                error = round(float(table.flat[index]), 6)
                # Equal errors are nearly always equal faces.
                if error not in chosen and len(chosen) < width:
                    chosen[error] = base, (*below, (pattern, dye))
                    faces.append(self._laid(shown[state], (pattern, dye)))
            found |= {state: error for error, state in list(chosen.items())[:kept]}
            states, shown = list(chosen.values()), np.stack(faces)
        return sorted(found, key=lambda state: found[state] + _LAYER * len(state[1]))

    def descend(self, face: LitFace, stack: Stack) -> tuple[float, Stack]:
        """Leave out, replace and add single layers while that helps; the error and the design."""
        now = self._error(face, stack), stack
        for _ in range(_SWEEPS):
            before = now[0]
            for changes in (self._without, self._replaced, self._rebased, self._inserted):
                now = changes(face, now)
            if now[0] > before - 1e-9:
                break
        return now

    def variants(self, face: LitFace, stack: Stack) -> list[Stack]:
        """A design with one layer in the next best dye or pattern, for each layer."""
        base, layers = stack
        found = []
        for place, layer in enumerate(layers):
            table = self._place_errors(face, stack, place, 1)
            table[layer] = np.inf
            pattern, dye = (int(n) for n in np.unravel_index(table.argmin(), table.shape))
            found.append((base, (*layers[:place], (pattern, dye), *layers[place + 1 :])))
        return found

    def _error(self, face: LitFace, stack: Stack) -> float:
        rest = (self.paint(*stack) - face.colours) ** 2 * face.channel_weights
        return float(rest.sum()) + _LAYER * len(stack[1])

    def _laid(self, below: Reals, layer: tuple[int, int]) -> Reals:
        pattern, dye = layer
        shown = self.shown[pattern][:, None] * self.dyes[dye]
        return np.asarray(below + shown - self.alpha[pattern][:, None] * below)

    def _errors(self, below: Reals, wanted: Reals, weights: Reals) -> Reals:
        """Errors of every pattern in every dye on faces [S, n, 3]; shape [S, patterns, dyes]."""
        total = np.zeros((len(below), self.patterns, len(self.dyes)))
        for channel in range(3):
            weight, dye = weights[:, channel], self.dyes[:, channel]
            seen = below[..., channel]
            rest = seen - wanted[:, channel]
            base = (rest * rest * weight).sum(axis=1)[:, None]
            fixed = base - 2 * _products(rest * seen * weight, self.alpha)
            fixed += _products(seen * seen * weight, self.alpha**2)
            linear = _products(rest * weight, self.shown)
            linear -= _products(seen * weight, self.alpha * self.shown)
            square = (self.shown**2 * weight).sum(axis=1)
            total += fixed[..., None] + 2 * linear[..., None] * dye
            total += square[None, :, None] * dye**2
        return total

    def _place_errors(self, face: LitFace, stack: Stack, place: int, removed: int) -> Reals:
        """Errors of every layer at a place, instead of `removed` layers there, [patterns, dyes]."""
        base, layers = stack
        below = self.paint(base, layers[:place])
        added, passed = np.zeros((_TEXELS, 3)), np.ones(_TEXELS)
        for pattern, dye in reversed(layers[place + removed :]):
            added += (passed * self.shown[pattern])[:, None] * self.dyes[dye]
            passed = passed * (1 - self.alpha[pattern])
        clear = np.where(passed > 0.02, passed, 1)[:, None]
        weights = face.channel_weights * np.where(passed > 0.02, passed**2, 0)[:, None]
        return np.asarray(self._errors(below[None], (face.colours - added) / clear, weights)[0])

    def _better(self, face: LitFace, now: tuple[float, Stack], tried: Stack) -> tuple[float, Stack]:
        error = self._error(face, tried)
        return (error, tried) if error < now[0] - 1e-9 else now

    def _without(self, face: LitFace, now: tuple[float, Stack]) -> tuple[float, Stack]:
        place = 0
        while place < len(now[1][1]):
            base, layers = now[1]
            after = self._better(face, now, (base, layers[:place] + layers[place + 1 :]))
            place += after is now
            now = after
        return now

    def _replaced(self, face: LitFace, now: tuple[float, Stack]) -> tuple[float, Stack]:
        for place in range(len(now[1][1])):
            base, layers = now[1]
            best = self._best(self._place_errors(face, now[1], place, 1))
            now = self._better(face, now, (base, (*layers[:place], best, *layers[place + 1 :])))
        return now

    def _rebased(self, face: LitFace, now: tuple[float, Stack]) -> tuple[float, Stack]:
        for base in range(len(self.bases)):
            now = self._better(face, now, (base, now[1][1]))
        return now

    def _inserted(self, face: LitFace, now: tuple[float, Stack]) -> tuple[float, Stack]:
        base, layers = now[1]
        if len(layers) >= self.most:
            return now
        for place in range(len(layers) + 1):
            best = self._best(self._place_errors(face, (base, layers), place, 0))
            now = self._better(face, now, (base, (*layers[:place], best, *layers[place:])))
        return now

    def _best(self, table: Reals) -> tuple[int, int]:
        pattern, dye = np.unravel_index(table.argmin(), table.shape)
        return int(pattern), int(dye)


def _products(left: Reals, right: Reals) -> Reals:
    """Sums over the last axis of left [S, n] times right [P, n], [S, P], without BLAS."""
    return np.asarray(np.einsum("sn,pn->sp", left, right))
