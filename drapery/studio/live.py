"""The live banner: it is the body of pictures, but its cloth advances step by step.

Its wind can change and its cloth can be grabbed. All changes are calls between time steps, so the
same calls in the same order give a bit-identical motion. Without such calls the motion is the same
as in pictures: after three seconds the cloth has the positions of a picture of `time` 3.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from drapery import Banner
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh
from drapery.packs import Packs
from drapery.render import Camera, Model
from drapery.scenes import STEP, LiveBody, floor_under
from drapery.settings import OPTIONS, Settings
from drapery.studio.live_cloth import LiveCloth, new_live_cloth
from drapery.studio.wind_controls import (
    WindControls,
    carried_on,
    steered,
    wind_controls_of,
)
from drapery.style import Body, Shell, body_of, cover_crowd, turn
from drapery.web.panes import Pane, ViewerState

SHADOW_STEPS = 6
"""The number of time steps after which a contact shadow is drawn again."""
SWINGS = np.array(((-0.2, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.0, 0.7)))
"""How far a light wind moves cloth from its rest position: to both sides, to the front [m]."""
UNFRAMED = Camera((0, 0, 3), (0, 0, 0))
"""A placeholder camera: each viewer frames the scene for the aspect ratio of its own picture."""


@dataclass(frozen=True, eq=False)
class Ray:
    """A line of sight. origin: [m]. along: its direction, any length. facing: the camera's."""

    origin: Array
    along: Array
    facing: Array


class Live:
    """A body in the wind.

    wind_controls: the current wind. leaves_room: whether its views leave room for later motion;
    if false, they equal the views of pictures. Raises OptionError or PackError.
    """

    def __init__(self, design: Banner | None, packs: Packs, settings: Settings) -> None:
        settings = _lit(design, settings)
        self.wind_controls = wind_controls_of(settings)
        self.leaves_room = False
        self._cuts = 0
        self._disturbed = False
        self._keys: tuple[str, ...] = ()
        self._azimuth = 0.0
        self._other: Body | None = None
        self._captions: tuple[str, ...] = ("",)
        self._held: int | None = None
        self._shadow: tuple[int, Model] | None = None
        self._live = LiveBody(body_of(design, packs, settings), settings, (), cover=_thicken)
        self._live.cloths = [*self._cloths_for(self._live.body)]

    @property
    def time(self) -> float:
        """The simulated time [s]."""
        return self._live.time

    @property
    def is_picture(self) -> bool:
        """Whether it equals a picture of this `time`: true if only the settings' wind moved it."""
        own = wind_controls_of(self._settings)
        return not self._disturbed and self.wind_controls == own

    def update(
        self,
        design: Banner | None,
        packs: Packs,
        settings: Settings,
        beside: Packs | None = None,
        captions: tuple[str, str] = ("", ""),
    ) -> None:
        """Show other designs, packs, settings; cloth with an unchanged spec continues its motion.

        beside: other packs; then the design is shown twice, side by side. captions: the labels of
        the two sides. Raises OptionError or PackError; then nothing changes.
        """
        before, settings = self._live, _lit(design, settings)
        body = body_of(design, packs, settings)
        other = None if beside is None else body_of(design, beside, settings)
        live = LiveBody(body, settings, self._cloths_for(body), cover=_thicken)
        live.wind, live.steps = before.wind, before.steps
        self._live, self._other = live, other
        self._captions = captions if other is not None else ("",)
        self._shadow = None
        # Keep a wind that keys have changed, unless the wind of the settings has changed.
        if wind_controls_of(settings) != wind_controls_of(before.staging.settings):
            self.set_wind(wind_controls_of(settings, self.wind_controls.on))

    def set_wind(self, controls: WindControls) -> None:
        """Replace the wind; it applies from the next time step."""
        live = self._live
        self._disturbed |= live.steps > 0
        self.wind_controls = controls
        wind = controls.wind
        live.wind = carried_on(live.wind, wind, self.time) if live.steps else wind

    def press(self, keys: Iterable[str], azimuth: float) -> None:
        """Hold these keys until the next call; see `steered`.

        azimuth: the viewer's azimuth about the banner's block [degrees].
        """
        self._keys = tuple(sorted(set(keys)))
        self._azimuth = azimuth

    def reframe(self) -> None:
        """Reset the camera to the named view."""
        self._cuts += 1

    def reset(self) -> None:
        """Return to the start: the cloth at rest, in the same wind."""
        self._disturbed = False
        self._held = None
        self._shadow = None
        self._live.steps = 0
        self._live.wind = self.wind_controls.wind
        self._live.cloths = [new_live_cloth(cloth.spec) for cloth in self.cloths]

    def grab(self, ray: Ray) -> bool:
        """Grab the free particle nearest to a line of sight; False if there is none."""
        self.release()
        found = [
            (miss, number, particle)
            for number, cloth in enumerate(self.cloths)
            for miss, particle in [self._nearest(number, cloth, ray)]
            if particle is not None
        ]
        if not found:
            return False
        _, number, particle = min(found)
        self._disturbed = True
        self._held = number
        self.replace_cloth(number, self.cloths[number].grabbed(particle))
        return True

    def pull(self, ray: Ray) -> None:
        """Pull the grabbed particle to a line of sight; its distance from the camera stays."""
        grab = None if self._held is None else self.cloths[self._held].grab
        depth = float(np.sum(ray.along * ray.facing))
        if self._held is None or grab is None or abs(depth) < 1e-6:
            return
        at = _to_world(self._live, self._held, grab.target)
        share = float(np.sum((at - ray.origin) * ray.facing)) / depth
        target = self._from_world(self._held, ray.origin + share * ray.along)
        self.replace_cloth(self._held, self.cloths[self._held].pulled(target))

    def release(self) -> None:
        """Let go of the grabbed particle."""
        if self._held is not None:
            self.replace_cloth(self._held, self.cloths[self._held].released())
        self._held = None

    def step(self, steps: int = 1) -> None:
        """Make time steps. Raises OptionError if the cloth blew up; it then restarts at rest."""
        each = 1 if self._keys else steps
        for _ in range(0, steps, each):
            if self._keys:
                azimuth = self._azimuth + self._settings.turned
                self.set_wind(steered(self.wind_controls, self._keys, azimuth, STEP))
            try:
                self._live.advance(each)
            except OptionError as error:
                self.reset()
                raise OptionError(
                    f"the cloth blew up with the solver {self._settings.solver} and starts"
                    " again at rest; use another solver, a coarser grid or less wind"
                ) from error

    def particles(self) -> list[Array]:
        """The particles of each cloth, in the cloth's frame [m], shape [N, 3]."""
        return [cloth.positions for cloth in self.cloths]

    def shown(self) -> ViewerState:
        """What the viewer shows at this moment."""
        live, settings = self._live, self._settings
        meshes = live.meshes()
        bodies = (live.body, *([] if self._other is None else [self._other]))
        moves = self.leaves_room and settings.pose == "cloth"
        rests = [cloth.whole.rest_positions for cloth in self.cloths] if moves else []
        framing = partial(_camera, live, meshes, rests)
        panes = []
        for body, caption in zip(bodies, self._captions, strict=True):
            models = live.models(meshes, self.time, body)
            shadow = self._shadow_of(models) if settings.shadow else None
            scene = live.staging.scene(models, live.body.camera or UNFRAMED, shadow)
            panes.append(Pane(scene, framing, caption))
        first = len(live.parts) + int(settings.shadow)
        soft = settings.pose == "cloth"
        grip = frozenset(range(first, len(meshes) + int(settings.shadow)) if soft else ())
        controls = self.wind_controls
        wind = (controls.speed, controls.heading - settings.turned, controls.on) if grip else None
        framed = (settings.view, settings.kind, settings.placement, settings.pose, settings.pins)
        cut = (*framed, len(live.parts), self._cuts)
        return ViewerState(tuple(panes), len(panes), grip, True, wind, cut, self.time)

    @property
    def _settings(self) -> Settings:
        return self._live.staging.settings

    @property
    def cloths(self) -> list[LiveCloth]:
        """The cloths that move, by number."""
        return [cloth for cloth in self._live.cloths if isinstance(cloth, LiveCloth)]

    def _cloths_for(self, body: Body) -> list[LiveCloth]:
        """A cloth for each panel: the current one, or a new one if its spec has changed."""
        old = dict(enumerate(self.cloths))
        cloths = []
        for number, panel in enumerate(body.panels):
            spec, cloth = panel.cloth, old.get(number)
            if cloth is None or cloth.spec != spec:
                self._disturbed |= self._live.steps > 0
                cloth = new_live_cloth(spec) if cloth is None else cloth.remade(spec)
            cloths.append(cloth)
        return cloths

    def replace_cloth(self, number: int, cloth: LiveCloth) -> None:
        """Put another cloth in the place of the one of this number."""
        self._live.cloths[number] = cloth

    def _shadow_of(self, models: Sequence[Model]) -> Model:
        steps = self._live.steps
        if self._shadow is None or abs(steps - self._shadow[0]) >= SHADOW_STEPS:
            floor = floor_under([model.mesh for model in models])
            self._shadow = steps, self._live.staging.contact(models, floor)
        return self._shadow[1]

    def _nearest(self, number: int, cloth: LiveCloth, ray: Ray) -> tuple[float, int | None]:
        """The free particle nearest to a line of sight, and their squared distance [m²]."""
        among = cloth.free
        if self._settings.pose != "cloth" or not len(among):
            return np.inf, None
        places = _to_world(self._live, number, cloth.positions[among])
        along = ray.along / np.sqrt(np.sum(ray.along * ray.along))
        off = np.cross(places - ray.origin, along)
        misses = np.sum(off * off, axis=1)
        best = int(np.argmin(misses))
        return float(misses[best]), int(among[best])

    def _from_world(self, number: int, points: Array) -> Array:
        origin = self._live.body.panels[number].origin
        return _turned_points(points, -self._settings.turned) - origin


def _lit(design: Banner | None, settings: Settings) -> Settings:
    """The settings without options of the light that the subject does not have, as in pictures."""
    subject = settings.subject(design.kind if design else "banner")
    idle = [
        name
        for name in settings.given_values
        if "light" in OPTIONS[name].affects and not OPTIONS[name].applies(subject, "live")
    ]
    return settings.changed(**{name: OPTIONS[name].default for name in idle})


def _thicken(shell: Shell, sheet: Array, thickness: float) -> Mesh:
    """The shell around a sheet [m], [N, 3], by a kernel: it is shown again and again."""
    mesh = cover_crowd(shell, sheet[None], thickness)
    return replace(mesh, positions=mesh.positions[0], normals=mesh.normals[0])


def _to_world(live: LiveBody, number: int, points: Array) -> Array:
    """Convert points from a cloth's frame to the world's [m], shape [..., 3]."""
    return _turned_points(points + live.body.panels[number].origin, live.staging.settings.turned)


def _camera(
    live: LiveBody, meshes: Sequence[Mesh], rests: Sequence[Array], aspect: float
) -> Camera:
    """A camera that frames meshes, and cloths that swing about their rest positions [m]."""
    swung = [
        _to_world(live, number, rest + swing)
        for number, rest in enumerate(rests)
        for swing in SWINGS
    ]
    return live.staging.camera([*(mesh.positions for mesh in meshes), *swung], aspect)


def _turned_points(points: Array, degrees: float) -> Array:
    nothing = np.zeros((0, 3), np.int32)
    return turn(Mesh(points, points, nothing, points), degrees).positions if degrees else points
