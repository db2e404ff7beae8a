"""Cloth that plays on without Python: the kernels to call, and their arguments.

`drapery.web.wasm` compiles the kernels to WebAssembly and writes the arguments to a file.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from drapery.arrays import Vectors
from drapery.banner.design import MAX_LAYERS
from drapery.cloth import Force, MovingCloth, Wind
from drapery.cloth.live import (
    STILL,
    LiveMotion,
    live_call,
    play as play_cloth,  # what is called `play` here is a scene
)
from drapery.cloth.live_wind import aim
from drapery.cloth.solvers.driver import functions_of
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.soft.live_picture import draw_live, make_live_picture
from drapery.settings import Settings
from drapery.stage.bodies import STEP, StagedBody
from drapery.stage.forces import forces_of, lee_of, wind_of
from drapery.stage.recording import Schedule
from drapery.stage.staging import Staging
from drapery.style.block import turn_centre, turn_matrix
from drapery.style.body import Body, Panel
from drapery.style.cloth_spec import cloth_at_rest
from drapery.style.grids import finer_shell
from drapery.style.live_figure import LiveFigure, pose_figure
from drapery.style.live_shell import LiveShell, cover, make_live_shell
from drapery.style.piece import Piece

SPARE = MAX_LAYERS + 2
"""Layers of a design: the bare cloth, its base and its patterns."""


@dataclass(frozen=True)
class LiveKernel:
    """A call that a host makes: a compiled function that returns 0, and its arguments.

    name: of the function for these types of arguments.
    function: the function.
    arguments: what it is called with.
    """

    name: str
    function: Callable[..., Any]
    arguments: tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class LivePanel:
    """A panel of cloth at the start of its motion.

    header: facts for a host, for JSON.
    calls: by what they do: `aim` turns the wind, `play` makes time steps, `cover` writes the
        vertices of the thick cloth; see `live_panels` for `pose`, and `live_picture` for `draw`.
    arrays: parts of the arguments that the host reads and writes, by name.
    functions: what kernels call by an address, and an example of its arguments; fields of named
        tuples that hold such an address have the name of the function.
    """

    header: Mapping[str, Any]
    calls: Mapping[str, LiveKernel]
    arrays: Mapping[str, np.ndarray]
    functions: Mapping[str, tuple[Callable[..., Any], tuple[Any, ...]]]


@dataclass(frozen=True, eq=False)
class PlayedCloth:
    """A cloth at the start of its motion, and how a host moves and draws it.

    moving: the cloth.
    forces: on it, with one wind.
    wind: the free wind, which a host may turn.
    piece: how it is drawn.
    place: of its own frame in the picture [m], shape [3].
    lee: see `live_call`.
    motion: see `live_call`.
    header: further facts for hosts, for JSON.
    """

    moving: MovingCloth
    forces: tuple[Force, ...]
    wind: Wind
    piece: Piece
    place: Vectors
    lee: tuple[float, float, float] = (1.0, 1.0, 1.0)
    motion: LiveMotion = STILL
    header: Mapping[str, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class PlayedSubject:
    """A subject at the start of its motion, which plays on without Python.

    staging: its light, cameras, ground and shadow.
    cloths: those that move.
    figure: who wears them.
    """

    staging: Staging
    cloths: tuple[PlayedCloth, ...]
    figure: LiveFigure | None = None


def played_body(body: Body, settings: Settings) -> PlayedSubject:
    """A body to be played in the wind of the settings; its cloth passes through itself.

    A hand may pull it, and does not feel what is in its way: cloth that it has pulled through
    itself could not come back.

    body: what is drawn.
    settings: the options of the picture.

    Raises OptionError for settings that cannot be played.
    """
    staged = StagedBody(body, settings)
    _check_played(staged.staging)
    pulled = (replace(each, cloth=replace(each.cloth, itself=False)) for each in body.panels)
    cloths = tuple(_played_cloth(staged, panel) for panel in pulled)
    return PlayedSubject(staged.staging, cloths)


def live_panels(played: PlayedSubject, lanes: int | None = None) -> list[LivePanel]:
    """The cloths of a subject. The first also has its figure, if there is one.

    With a figure, the call `pose` writes the arrays `figure` and `figureLight`.

    played: the subject at the start of its motion.
    lanes: of the arrays; by default a register of this processor.

    Raises OptionError for cloth that cannot be played without Python.
    """
    panels = [_live_panel(cloth, played.staging, lanes) for cloth in played.cloths]
    return (
        panels if played.figure is None else [_with_figure(panels[0], played.figure), *panels[1:]]
    )


def live_picture(body: Body, settings: Settings, lanes: int | None = None) -> LivePanel:
    """The panel of a body, with the call `draw`, which draws the picture of the settings.

    Only for bodies of one panel, without shadows. The camera frames the cloth at `settings.time`.
    The header has `picture`, its width and height; and `steps`, after which the cloth is as in
    the still. The host may replace `materials`, `layers` and `atlas`; the layers end with SPARE
    rows of zeros.

    body: what is drawn.
    settings: the options of the picture.
    lanes: see `live_panels`.

    Raises OptionError for settings that cannot be played or drawn without Python.
    """
    staged = StagedBody(body, settings)
    staging = staged.staging
    _check_played(staging)
    if len(body.panels) != 1 or staging.settings.pixel != 1 or staging.style.has("picture"):
        raise OptionError(
            "pictures of several panels, of large pixels and of styles with steps of picture need "
            "Python; leave out the picture"
        )
    at = Schedule.still(staging.settings.time, STEP)
    cloth = _played_cloth(staged, body.panels[0], at.dt)
    piece = replace(cloth.piece, finer=finer_shell(cloth.piece.shell, staged.times))
    panel = _live_panel(replace(cloth, piece=piece), staging, lanes)
    scene = next(staged.scenes(staged.record(at), at))
    live = make_live_picture(scene, len(scene.models) - 1, SPARE)
    vertices, normals = panel.arrays["vertices"], panel.arrays["normals"]
    draw = LiveKernel("draw", draw_live, (vertices, normals, live))
    return replace(
        panel,
        header={
            **panel.header,
            "picture": list(live.size),
            "steps": at.every * at.moments[0],
        },
        calls={**panel.calls, "draw": draw},
        arrays={
            **panel.arrays,
            **{name: getattr(live, name) for name in ("picture", "materials", "layers", "atlas")},
        },
    )


def _check_played(staging: Staging) -> None:
    for kind in ("motion", "shape"):
        if staging.style.has(kind):
            raise OptionError(
                f"a style with steps of {kind} cannot be played without Python; "
                "use styles of materials and pictures only"
            )
    if staging.settings.pose != "cloth":
        raise OptionError(f"pose {staging.settings.pose} has no cloth to play; use pose cloth")


def _played_cloth(staged: StagedBody, panel: Panel, step: float = STEP) -> PlayedCloth:
    settings = staged.staging.settings
    wind = wind_of(settings)
    (rows, columns), piece = panel.piece.grid_shape, panel.piece
    return PlayedCloth(
        cloth_at_rest(panel.cloth, step),
        forces_of(settings, wind),
        wind,
        piece,
        panel.origin,
        lee=(1.0, 1.0, lee_of(settings)),
        header={"columns": columns, "rows": rows, "size": list(map(float, piece.size))},
    )


def _live_panel(cloth: PlayedCloth, staging: Staging, lanes: int | None) -> LivePanel:
    call = live_call(cloth.moving, cloth.forces, cloth.wind, cloth.lee, lanes, cloth.motion)
    live, blown, plan, batch, substeps = call
    turning = turning_of(staging.settings)
    shell = make_live_shell(cloth.piece, cloth.place, staging.light, *turning)
    x, _, z = blown.velocity
    method = type(plan).__name__.removesuffix("Plan").lower()
    return LivePanel(
        {
            **cloth.header,
            "step": float(live.dt[0]),
            "origin": shell.place.tolist(),
            "frame": _frame(shell).tolist(),
            "pins": live.pins.tolist(),
            "wind": blown.velocity.tolist(),
            "heading": math.degrees(math.atan2(x, z)),
            "vertices": len(shell.light),
            "method": method,
        },
        {
            "aim": LiveKernel("aim", aim, (live, blown, batch.gusts, batch.numbers)),
            "play": LiveKernel(f"play_{method}", play_cloth, (live, plan, batch, substeps)),
            "cover": LiveKernel("cover", cover, (live.positions, shell)),
        },
        {
            **{name: getattr(live, name) for name in ("clock", "grab", "target")},
            **{name: getattr(live, name) for name in ("positions", "velocities")},
            **{name: getattr(batch, name) for name in ("x", "v")},  # by which another cloth goes on
            "wind": blown.velocity,
            **{name: getattr(batch.gusts, name) for name in ("seeds", "phases", "turns")},
            **{name: getattr(shell, name) for name in ("vertices", "normals", "light")},
        },
        functions_of(batch, cloth.moving.solver_state),
    )


def _with_figure(panel: LivePanel, figure: LiveFigure) -> LivePanel:
    """The panel with a call that poses the wearer in the row of its table that is due."""
    row = panel.calls["play"].arguments[0].row
    call = LiveKernel("pose", pose_figure, (row, figure))
    arrays = {"row": row, "figure": figure.vertices, "figureLight": figure.light}
    return replace(panel, calls={**panel.calls, "pose": call}, arrays={**panel.arrays, **arrays})


def _frame(shell: LiveShell) -> Array:
    """From places in the picture to places in the frame of a panel, shape [3, 4]."""
    back = shell.turn.T
    # einsum adds in a fixed order; BLAS may not.
    turned = np.einsum("ij,j->i", back, shell.middle)
    return np.column_stack([back, shell.middle - turned - shell.place])


def turning_of(settings: Settings) -> tuple[Array, Array]:
    """The rotation of a body and the point about which it turns [m]."""
    if settings.turned:
        return turn_matrix(settings.turned), turn_centre()
    return np.eye(3), np.zeros(3)
