"""The cloth of a body: how it is made, moved, made thick and put into a `Scene`.

Still pictures, loops, 3-D files and pages share it, so they agree to the bit.
A panel of cloth is simulated in its own frame, its top edge along x through the origin, and moved
to its place when it is drawn.
"""

import math
import warnings
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache, partial

import numpy as np

from drapery.arrays import Vectors
from drapery.cloth import FABRICS, Fabric, Wind
from drapery.mesh import Array, Mesh
from drapery.render.scene import Material, Model, Scene
from drapery.settings import Settings
from drapery.stage.forces import forces_of, wind_of
from drapery.stage.recording import Drape, Schedule, record
from drapery.stage.staging import Staging
from drapery.style.body import Body, Panel
from drapery.style.cloth_spec import ClothSpec, cloth_at_rest
from drapery.style.extrusion import thicken
from drapery.style.finish import finished
from drapery.style.grids import finer_shell
from drapery.style.piece import Piece
from drapery.style.refinement import cells_per_cell, finer_shape
from drapery.style.uv_mapping import UVMapping

STEP = 1.0 / 60.0
"""The longest time step of a picture, and the time step of a page [s]."""
MAX_CACHED = 16 << 20
"""A recorded motion is cached up to this size [bytes]."""


class StagedBody:
    """A body in its staging, and how it is drawn where its cloth is.

    times: cells that are drawn along each cell of the simulated grid.

    body: what is drawn.
    settings: the options of the picture.
    curves: whether a large picture shows curves through the particles; a display's does not.

    Raises OptionError for options that do not fit the body.
    """

    step = STEP
    tolerance = 0.0

    def __init__(self, body: Body, settings: Settings, *, curves: bool = True) -> None:
        self.body = body
        self.staging = Staging(settings, body.ground, body.light, body.camera)
        self.parts = [self.staging.turned(part.mesh) for part in body.parts]
        settings, (columns, rows) = self.staging.settings, self.staging.settings.grid
        # A shape step gets the simulated grid, and makes the finer one that it needs.
        curves = curves and settings.pose == "cloth" and not self.staging.style.has("shape")
        self.times = cells_per_cell(settings.drawn_size, (rows, columns)) if curves else 1

    @property
    def drapes(self) -> tuple[Drape, ...]:
        """The cloth of each panel in the wind of the settings; none in the game's stiff pose."""
        return tuple(_drape_of(spec, self.staging.settings) for spec in self._specs)

    @property
    def _specs(self) -> tuple[ClothSpec, ...]:
        panels = self.body.panels if self.staging.settings.pose == "cloth" else ()
        return tuple(panel.cloth for panel in panels)

    def at_rest(self) -> list[Mesh]:
        """What is drawn before the first time step; see `soft` and `stiff`.

        Raises OptionError for cloth that cannot be made.
        """
        if self.staging.settings.pose == "cloth":
            return self.soft([drape.begin(STEP).state.positions[0] for drape in self.drapes])
        return self.stiff([0.0 for _ in self.body.panels])

    def soft(self, sheets: Sequence[Vectors]) -> list[Mesh]:
        """The stiff parts, then each panel as cloth: thick and in its place.

        sheets: each panel's particles in its own frame [m], shape [N, 3].
        """
        panels = zip(self.body.panels, sheets, strict=True)
        return [*self.parts, *(self._thick(panel, sheet) for panel, sheet in panels)]

    def stiff(self, phases: Sequence[float]) -> list[Mesh]:
        """The stiff parts, then each panel as the game draws it, at a phase 0..1 of its sway."""
        panels = zip(self.body.panels, phases, strict=True)
        boards = (panel.board(phase) for panel, phase in panels)
        return [*self.parts, *map(self.staging.turned, boards)]

    def models(self, meshes: Sequence[Mesh], time: float, body: Body | None = None) -> list[Model]:
        """Meshes with the materials of a body.

        meshes: one for each part and panel.
        time: of animated textures [s].
        body: another one, which gives the materials.
        """
        shown = body or self.body
        materials = [part.material_at(time) for part in shown.parts]
        materials += [self._material(panel.piece, time) for panel in shown.panels]
        names = [part.name for part in shown.parts] + [each.piece.name for each in shown.panels]
        return [
            Model(mesh, (made,), name=name)
            for mesh, made, name in zip(meshes, materials, names, strict=True)
        ]

    def _material(self, piece: Piece, time: float) -> Material:
        """The material of a piece at a time [s] in the style, with the finish of its fabric."""
        settings = self.staging.settings
        material = self.staging.style.material(piece.material_at(time))
        if settings.finish == "plain" or settings.pose != "cloth":
            return material
        return with_finish(material, settings.fabric, piece.shell.uv_mapping, piece.size)

    def moved(self, motions: Sequence[Vectors]) -> list[Vectors]:
        """The motion of each panel after the style's steps. motions: [m], each [F, N, 3]."""
        style = self.staging.style
        if not style.has("motion"):
            return [*motions]
        panels = zip(self.body.panels, motions, strict=True)
        return [style.move(self._piece(panel), motion) for panel, motion in panels]

    def record(
        self, at: Schedule, on_moment: Callable[[int, int], object] | None = None
    ) -> Sequence[Vectors]:
        """Where the cloth of each panel is at the moments of a schedule [m], each [F, N, 3].

        None where the settings have the game's own stiff pose.

        at: the moments.
        on_moment: see `recording.record`.

        Raises OptionError for cloth that cannot be moved.
        """
        settings = self.staging.settings
        particles = sum(math.prod(spec.shape) for spec in self._specs)
        size = len(at.moments) * particles * 3 * np.dtype(float).itemsize
        named = isinstance(settings.solver, str) and not isinstance(settings.fabric, Fabric)
        named = named and not isinstance(settings.wind, Wind) and not settings.forces
        if named and on_moment is None and size <= MAX_CACHED:
            # Pictures that differ in other options share a motion.
            return _cached(self._specs, settings.only("motion", "wind"), at)
        return record(self.drapes, at, on_moment=on_moment)

    def scenes(self, motions: Sequence[Vectors], at: Schedule) -> Iterator[Scene]:
        """The scene of each picture of a schedule.

        A loop of what does not move is shown from all around.

        motions: where the cloth of each panel is [m], each of shape [F, N, 3]; none in a stiff
            pose.
        at: the moments.
        """
        is_cloth = self.staging.settings.pose == "cloth"
        if is_cloth:
            moved = self.moved(motions)
            moments = [
                self.soft([each[frame] for each in moved]) for frame, _ in enumerate(at.times)
            ]
        else:
            moments = [self.stiff(phases) for phases in self._phases(at)]
        times = at.times
        if at.fps is not None:
            times = texture_times(self.body.period, len(at.times), at.fps)
        moves = any(is_cloth or panel.sway for panel in self.body.panels)
        models = map(self.models, moments, times)
        framed = [points for meshes in moments for points in self._framed(meshes)]
        return self.staging.scenes(moments, models, framed, around=len(moments) > 1 and not moves)

    def _framed(self, meshes: Sequence[Mesh]) -> list[Array]:
        """The vertices that a camera frames: of finer cloth those at its particles, so that
        pictures of all sizes show the same. None where it frames all."""
        if self.times == 1:
            return []
        columns, rows = self.staging.settings.grid
        fine = *finer_shape((rows, columns), self.times), 3
        sheet = fine[0] * fine[1]
        found = [mesh.positions for mesh in meshes[: len(self.parts)]]
        for mesh in meshes[len(self.parts) :]:
            for side in (mesh.positions[:sheet], mesh.positions[sheet : 2 * sheet]):
                found.append(side.reshape(fine)[:: self.times, :: self.times])
        return found

    def _phases(self, at: Schedule) -> list[list[float]]:
        """The phase of each panel's own sway in each picture."""
        panels, count = self.body.panels, len(at.times)
        if at.period is None:
            return [[_phase(panel, time) for panel in panels] for time in at.times]
        # A whole number of the game's sways fills the loop.
        sways = [max(1, round(_phase(panel, at.period))) for panel in panels]
        return [[n * frame / count for n in sways] for frame in range(count)]

    def _piece(self, panel: Panel) -> Piece:
        return replace(panel.piece, finer=finer_shell(panel.piece.shell, self.times))

    def _thick(self, panel: Panel, sheet: Array) -> Mesh:
        piece, positions = panel.piece, sheet + panel.origin
        if self.times > 1 or self.staging.style.has("shape"):
            return self.staging.turned(self.staging.style.mesh(self._piece(panel), positions))
        return self.staging.turned(thicken(piece.shell, positions, piece.thickness))


def with_finish(
    material: Material, fabric: str | Fabric, mapping: UVMapping, size: tuple[float, float]
) -> Material:
    """A material that looks like its fabric; see `finished`.

    fabric: its name, or a fabric that looks like the preset that it equals, or else as before.
    """
    name = fabric if isinstance(fabric, str) else _fabric_names().get(fabric)
    if name is None:
        return material
    return finished(material, name, FABRICS[name].transmission, mapping, size)


@lru_cache(maxsize=1)
def _fabric_names() -> dict[Fabric, str]:
    return {fabric: name for name, fabric in FABRICS.items()}


def texture_times(period: float, count: int, fps: float) -> tuple[float, ...]:
    """The time at which each frame of a loop shows its textures [s], shape [count].

    A whole number of the textures' periods fills the loop. A period over one and a half loops
    is not changed; the loop then has a visible seam, and a UserWarning says so.
    """
    length = count / fps
    periods = round(length / period) if period else 0
    if period and not periods:
        warnings.warn(
            f"the textures repeat after {period:g} s, the loop after {length:g} s, so its seam"
            f" shows; use seconds {period:g}",
            UserWarning,
            stacklevel=2,
        )
    pace = periods * period / length if periods else 1.0
    return tuple(pace * frame / fps for frame in range(count))


def _phase(panel: Panel, time: float) -> float:
    return time / panel.sway if panel.sway else 0.0


def _drape_of(spec: ClothSpec, settings: Settings) -> Drape:
    """The cloth of a spec in the wind of the settings. Raises OptionError."""
    return Drape(
        partial(cloth_at_rest, spec),
        lambda period: forces_of(settings, wind_of(settings, period)),
    )


@lru_cache(maxsize=16)
def _cached(specs: tuple[ClothSpec, ...], settings: Settings, at: Schedule) -> tuple[Array, ...]:
    # Banners of one batch often move alike, because a design does not change the cloth.
    motions = record([_drape_of(spec, settings) for spec in specs], at)
    for motion in motions:
        motion.flags.writeable = False
    return tuple(motions)
