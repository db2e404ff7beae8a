"""Cloth of a body that plays on without Python: the kernels to call, and their arguments.

`drapery.web.wasm` compiles the kernels to WebAssembly and writes the arguments to a file.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from drapery.banner.design import MAX_LAYERS
from drapery.cloth.contact import lanes_contact
from drapery.cloth.live import LiveCall, live_call
from drapery.cloth.live import play as play_cloth  # what is called `play` here is a scene
from drapery.cloth.live_wind import aim
from drapery.errors import OptionError
from drapery.mesh import Array
from drapery.render.soft.live_picture import draw_live, make_live_picture
from drapery.scenes.recording import Schedule
from drapery.scenes.stager import (
    LEE,
    STEP,
    StagedBody,
    cloth_at_rest,
    cloth_spec,
    forces_of,
    wind_of,
)
from drapery.settings import Settings
from drapery.style.block import turn_centre, turn_matrix
from drapery.style.body import Body, Panel
from drapery.style.live_shell import LiveShell, cover, make_live_shell
from drapery.styles.grids import grid_shell

SPARE = MAX_LAYERS + 2
"""Layers of a design: the bare cloth, its base and its patterns."""


@dataclass(frozen=True)
class LiveKernel:
    """A call that a host makes: a compiled function that returns 0, and its arguments.

    name: of the function for these types of arguments.
    """

    name: str
    function: Callable[..., Any]
    arguments: tuple[Any, ...]


@dataclass(frozen=True, eq=False)
class LivePanel:
    """A panel of cloth at the start of its motion.

    header: what a host wants to know, for JSON. calls: by what they do: `aim` turns the wind,
    `play` makes time steps, `cover` writes the vertices of the thick cloth; see `live_panels` for
    `draw`, and `live_garment` for `pose`.
    arrays: parts of the arguments that the host reads and writes, by name.
    functions: what kernels call by an address, and an example of its arguments; fields of named
    tuples that hold such an address have the name of the function.
    """

    header: Mapping[str, Any]
    calls: Mapping[str, LiveKernel]
    arrays: Mapping[str, NDArray[Any]]
    functions: Mapping[str, tuple[Callable[..., Any], tuple[Any, ...]]]


def live_panels(
    body: Body, settings: Settings, lanes: int | None = None, *, picture: bool = False
) -> list[LivePanel]:
    """The panels of a body, to be played in the wind of the settings.

    lanes: of the arrays; by default a register of this processor. Cloth that is not for a picture
    passes through itself, since a hand may pull it.
    picture: whether the call `draw` draws the picture of the settings, with the camera that frames
    the cloth at `settings.time`; only for bodies of one panel, without shadows. The header then has
    `picture`, its width and height; and `steps`, after which the cloth is that of the still. The
    host may replace `materials`, `layers` and `atlas`; the layers end with SPARE rows of zeros.
    Raises OptionError for settings that cannot be played without Python.
    """
    staged = StagedBody(body, settings)
    staging = staged.staging
    for kind in ("motion", "shape"):
        if staging.style.has(kind):
            raise OptionError(
                f"a style with steps of {kind} cannot be played without Python; "
                "use styles of materials and pictures only"
            )
    if staging.settings.pose != "cloth":
        raise OptionError(f"pose {staging.settings.pose} has no cloth to play; use pose cloth")
    if not picture:
        staged = StagedBody(body, _pulled(settings))
        return [_live_panel(staged, panel, lanes) for panel in body.panels]
    if len(body.panels) != 1 or staging.settings.pixel != 1 or staging.style.has("picture"):
        raise OptionError(
            "pictures of several panels, of large pixels and of styles with steps of picture need "
            "Python; leave out the picture"
        )
    return [_with_picture(staged, lanes)]


def _pulled(settings: Settings) -> Settings:
    """The settings of cloth that a hand may pull, which passes through itself.

    A hand does not feel what is in its way, and cloth that it has pulled through itself could not
    come back.
    """
    return replace(settings, contact="world") if settings.contact == "all" else settings


def _with_picture(staged: StagedBody, lanes: int | None) -> LivePanel:
    """The panel with a call that draws its body, with the time steps of `still`."""
    body, settings = staged.body, staged.staging.settings
    at = Schedule.still(settings.time, STEP)
    panel = _live_panel(staged, body.panels[0], lanes, at.dt)
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


def _live_panel(
    staged: StagedBody, panel: Panel, lanes: int | None, step: float = STEP
) -> LivePanel:
    settings = staged.staging.settings
    spec = cloth_spec(panel, settings, staged.body.solids)
    wind = wind_of(settings)
    sheltered = settings.placement == "wall" and isinstance(settings.wind, int | float)
    lee = (1.0, 1.0, LEE) if sheltered else (1.0, 1.0, 1.0)
    call = live_call(cloth_at_rest(spec, step), forces_of(settings, wind), wind, lee, lanes)
    columns, rows = settings.grid
    shell = make_live_shell(
        grid_shell(rows, columns, panel.uv_mapping),
        panel.origin,
        settings.thickness * panel.texel,
        staged.staging.light,
        *turning_of(settings),
    )
    size = list(map(float, panel.size))
    return make_live_panel(call, shell, {"columns": columns, "rows": rows, "size": size})


def make_live_panel(call: LiveCall, shell: LiveShell, header: Mapping[str, Any]) -> LivePanel:
    """The panel of a cloth and its shell. header: what hosts also want to know."""
    live, blown, plan, batch, substeps = call
    x, _, z = blown.velocity
    method = type(plan).__name__.removesuffix("Plan").lower()
    return LivePanel(
        {
            **header,
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
            "wind": blown.velocity,
            **{name: getattr(shell, name) for name in ("vertices", "normals", "light")},
        },
        {"resolve": (lanes_contact.resolve, lanes_contact.EXAMPLE)},
    )


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
