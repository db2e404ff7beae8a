"""A curtain of 500 dots in the plane: a tutorial's Verlet cloth, step by step as published.

The cloth has 25 x 20 particles at distances of 0.2 m; its top row is pinned. Each step of 0.02 s
applies gravity and a sine wind, then makes six passes over the distances between neighbours, in
which each free end moves half of the correction. There is one step a frame, at 30 frames a second.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from drapery.cloth import STRUCTURAL, Cloth, Gravity, SolverPBD, State, grid, rest_state, simulate
from drapery.elementary import sine_of_turns
from drapery.mesh import Array
from drapery.render import Frame
from drapery.scenes.catalogue import Clip
from drapery.scenes.parameters import SceneParameters, grid_parameter, parameter

CLIP = Clip(count=300, fps=30.0)
STEPS_PER_SECOND = 30
"""Steps per second of the film; the simulated time of a step is `dt`."""
FINER = 3
"""The plot is drawn this many times larger and then reduced, for smooth dots."""
X_RANGE, Y_RANGE = (0, 6), (-5, 6)
DOT, RIM, INK, LINES, PAPER = (
    (0, 154, 250),
    (12, 40, 70),
    (60, 60, 64),
    (226, 226, 228),
    (255, 255, 255),
)


@dataclass(frozen=True)
class JuliaParameters(SceneParameters):
    """What can be set of the scene `julia`."""

    grid: tuple[int, int] = grid_parameter((25, 20), "Particles across and down the curtain")
    spacing: float = parameter(0.2, "Distance of neighbouring particles", (0.01, 1), "m")
    dt: float = parameter(0.02, "Time step", (0.001, 0.1), "s")
    passes: int = parameter(6, "Passes over all distances in a step", (1, 64))
    gravity: float = parameter(9.8, "Acceleration downwards", (-100, 100), "m/s²")
    wind: float = parameter(2.0, "Amplitude of the wind's acceleration", (-100, 100), "m/s²")
    turn: float = parameter(0.05, "Phase of the wind's sine in a step", (-4, 4), "radians")


@dataclass(frozen=True)
class SineWind:
    """An acceleration along x that is a sine of the number of the step; the first is number 1."""

    parameters: JuliaParameters

    def acceleration(self, cloth: Cloth, state: State) -> Array:
        """The acceleration [m/s²], shape [N, 3]."""
        p = self.parameters
        number = round(state.time / p.dt) + 1
        push = np.zeros_like(cloth.rest_positions)
        push[:, 0] = p.wind * sine_of_turns(p.turn * number / (2 * np.pi))
        return push


def play(parameters: JuliaParameters, clip: Clip) -> Iterator[Frame]:
    """The dots after each step, as a plot."""
    empty = _plot(clip.size)
    wanted = [1 + round(k * STEPS_PER_SECOND / clip.fps) for k in range(clip.count)]
    states = enumerate(steps(parameters))
    number, state = next(states)
    for step in wanted:
        while number < step:
            number, state = next(states)
        yield _with_dots(empty, state.positions[0], clip.size)


def steps(parameters: JuliaParameters) -> Iterator[State]:
    """The start, then the state after each step."""
    cloth = curtain(parameters)
    forces = (Gravity((0.0, -parameters.gravity, 0.0)), SineWind(parameters))
    start = rest_state(cloth, dtype=np.float64)
    solver = SolverPBD.plain(parameters.passes)
    return simulate(cloth, solver, forces, parameters.dt, start=start)


def curtain(parameters: JuliaParameters) -> Cloth:
    """The cloth; springs from the lowest row up, of each particle its right, then its upper."""
    (columns, rows), spacing = parameters.grid, parameters.spacing
    cloth = grid(columns, rows, (columns - 1) * spacing, (rows - 1) * spacing)
    number = np.arange(rows * columns, dtype=np.int32).reshape(rows, columns)[::-1]
    places = np.zeros((rows * columns, 3))
    places[number, 0] = np.arange(1, columns + 1) * spacing
    places[number, 1] = np.arange(1, rows + 1)[:, None] * spacing
    pairs = [
        (number[j, i], neighbour)
        for j in range(rows)
        for i in range(columns)
        for neighbour in (*number[j, i + 1 : i + 2], *number[j + 1 : j + 2, i])
    ]
    count = len(pairs)
    return replace(
        cloth,
        rest_positions=places,
        spring_pairs=np.array(pairs, np.int32),
        spring_length=np.full(count, spacing),
        spring_stiffness=np.ones(count),
        spring_kind=np.full(count, STRUCTURAL, np.uint8),
    )


def _with_dots(empty: Image.Image, positions: Array, size: tuple[int, int]) -> Frame:
    image = empty.copy()
    pen = ImageDraw.Draw(image)
    radius = max(1.0, size[0] / 160) * FINER
    for x, y in _on_plot(positions[:, :2], size):
        pen.ellipse((x - radius, y - radius, x + radius, y + radius), DOT, RIM, width=FINER)
    # Dots beyond the axes are not shown.
    (left, top), (right, low) = np.rint(
        _on_plot(np.array([(X_RANGE[0], Y_RANGE[1]), (X_RANGE[1], Y_RANGE[0])]), size)
    ).astype(int)
    area = (int(left), int(top), int(right), int(low))
    whole = empty.copy()
    whole.paste(image.crop(area), area)
    return Frame(np.asarray(whole.reduce(FINER).convert("RGBA")))


def _plot(size: tuple[int, int]) -> Image.Image:
    """Axes and grid lines, FINER times larger."""
    image = Image.new("RGB", (size[0] * FINER, size[1] * FINER), PAPER)
    pen = ImageDraw.Draw(image)
    (left, right), (low, high) = X_RANGE, Y_RANGE
    for x in range(left, right + 1):
        pen.line([tuple(p) for p in _on_plot(np.array([(x, low), (x, high)]), size)], LINES, FINER)
    for y in range(low, high + 1):
        pen.line(
            [tuple(p) for p in _on_plot(np.array([(left, y), (right, y)]), size)], LINES, FINER
        )
    corners = _on_plot(np.array([(left, high), (left, low), (right, low)]), size)
    pen.line([tuple(p) for p in corners], INK, FINER)
    small = image.reduce(FINER)
    _write_ticks(ImageDraw.Draw(small), size)
    return small.resize(image.size, Image.Resampling.NEAREST)


def _write_ticks(pen: ImageDraw.ImageDraw, size: tuple[int, int]) -> None:
    """Write the numbers beside the axes."""
    font = ImageFont.load_default_imagefont()
    for x in range(X_RANGE[0], X_RANGE[1] + 1):
        at = _on_plot(np.array([(x, Y_RANGE[0])]), size)[0] / FINER
        pen.text((at[0] - 3, at[1] + 4), str(x), fill=INK, font=font)
    for y in range(Y_RANGE[0], Y_RANGE[1] + 1):
        at = _on_plot(np.array([(X_RANGE[0], y)]), size)[0] / FINER
        pen.text((at[0] - 6 * len(str(y)) - 4, at[1] - 6), str(y), fill=INK, font=font)


def _on_plot(points: Array, size: tuple[int, int]) -> Array:
    """Places of points [N, 2] on the enlarged plot [pixels], shape [N, 2]."""
    width, height = size[0] * FINER, size[1] * FINER
    margin = min(24 * FINER, width // 6, height // 6)
    (left, right), (low, high) = X_RANGE, Y_RANGE
    x = margin + (points[:, 0] - left) / (right - left) * (width - 1.5 * margin)
    y = height - margin - (points[:, 1] - low) / (high - low) * (height - 1.5 * margin)
    return np.stack([x, y], axis=1)
