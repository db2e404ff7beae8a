"""A force of its own beside the wind: one gust that moves down a hall."""

from dataclasses import dataclass

import numpy as np

from drapery.cloth import Cloth, State
from drapery.elementary import sine_of_turns
from drapery.mesh import Array


@dataclass(frozen=True)
class Gust:
    """A gust that moves down the hall, lifts the banners off the walls and makes them flutter.

    start: when it enters the hall [s]. speed: [m/s]. length: from its front to its end [m].
    strength: the acceleration in its middle [m/s²].
    ripple: by how much of it parts of a banner are pushed apart, so that it folds.
    """

    start: float = 0.3
    speed: float = 11.0
    length: float = 14.0
    strength: float = 6.0
    ripple: float = 1.5

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        """The acceleration [m/s²], shape [B, N, 3]. The length of the hall is along -z."""
        x, y, depth = state.positions[..., 0], state.positions[..., 1], -state.positions[..., 2]
        front = (state.time - self.start) * self.speed
        inside = 2 * (front - depth) / self.length - 1
        swell = np.maximum(0, 1 - inside * inside) ** 2
        flutter = 0.6 + 0.4 * sine_of_turns(0.35 * depth - 2.1 * state.time)
        push = self.strength * swell * flutter
        # Waves shorter than two banners: one side or end of a banner is pushed, and not the other.
        waves = sine_of_turns(0.8 * depth + 0.6 * y - 2.3 * state.time)
        off = push + self.ripple * self.strength * swell * waves
        return np.stack([-np.sign(x) * off, 0.15 * push, -0.6 * push], axis=-1)
