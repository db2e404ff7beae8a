"""The banner that waves: a body whose cloth moves on tick by tick, and whatever may disturb it.

Everything that happens comes from calls between ticks, so the same calls in the same order give
the same motion to the bit. Left alone it is the motion of pictures: after three seconds it hangs
as in a picture of `time` 3.
"""

from collections.abc import Iterable
from dataclasses import dataclass, replace

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.cloth import Gravity, Wind
from drapery.errors import OptionError
from drapery.mesh import Array, Mesh, vertex_normals
from drapery.render.camera import Camera
from drapery.render.light import UNLIT, Light, lit_at
from drapery.render.scene import Material, Model, Scene
from drapery.render.shadow import contact_shadow
from drapery.render.views import frame_view
from drapery.scenes.staging import STEP
from drapery.settings import Settings, background_colour
from drapery.studio.live_cloth import (
    ClothSpec,
    LiveCloth,
    free,
    grabbed,
    hang,
    moved,
    pulled,
    released,
    rewoven,
)
from drapery.studio.panes import Pane, Shown
from drapery.studio.wind_controls import (
    WindControls,
    carried_on,
    steered,
    wind_controls_of,
    wind_of,
)
from drapery.style.block import turn
from drapery.style.body import Body, Panel
from drapery.style.extrusion import Shell, make_shell
from drapery.style.kinds import body_of

SHADOW_TICKS = 6
"""A contact shadow is drawn anew after so many ticks."""
SWINGS = ((-0.2, 0.0, 0.0), (0.2, 0.0, 0.0), (0.0, 0.0, 0.7))
"""How far cloth in a breeze goes from where it hangs: to both sides, and out to the front [m]."""


@dataclass(frozen=True, eq=False)
class Ray:
    """A line of sight. origin, along: [m] and any length; facing: where the camera looks."""

    origin: Array
    along: Array
    facing: Array


@dataclass(frozen=True, eq=False)
class Sheet:
    """A panel of the body, its cloth and the shell that is drawn of it."""

    panel: Panel
    hanging: LiveCloth
    shell: Shell


class Live:
    """A body in the wind.

    breeze: what blows. roomy: whether its views leave room for what it may do next; else they are
    those of pictures.
    """

    def __init__(self, design: Banner | None, packs: Packs, settings: Settings) -> None:
        self.breeze = wind_controls_of(settings)
        self.ticks = 0
        self.roomy = False
        self._settings = settings
        self._cuts = 0
        self._disturbed = False
        self._keys: tuple[str, ...] = ()
        self._azimuth = 0.0
        self._sheets: list[Sheet] = []
        self._captions: tuple[str, ...] = ("",)
        self._held: int | None = None
        self._shadow: tuple[int, Model] | None = None
        self._wind: Wind | None = None
        self.wear(design, packs, settings)

    @property
    def time(self) -> float:
        """How long it has moved [s]."""
        return self.ticks * STEP

    @property
    def is_picture(self) -> bool:
        """Whether it hangs as in a picture of this `time`: nothing but its own wind moved it."""
        return not self._disturbed and self.breeze == wind_controls_of(self._settings)

    def wear(
        self,
        design: Banner | None,
        packs: Packs,
        settings: Settings,
        beside: Packs | None = None,
        captions: tuple[str, str] = ("", ""),
    ) -> None:
        """Show this from now on; cloth that is made as before moves on undisturbed.

        beside: other packs, to show the same design side by side in both, under captions. Raises
        OptionError or PackError; nothing has changed then.
        """
        before = self._settings
        body = body_of(design, packs, settings)
        other = None if beside is None else body_of(design, beside, settings)
        sheets = self._rehung(body, settings)
        self._body, self._other, self._settings, self._sheets = body, other, settings, sheets
        self._parts = [_turned(part.mesh, settings) for part in body.parts]
        self._captions = captions if other is not None else ("",)
        self._shadow = None
        # What keys have made of the wind stays, unless the settings ask for another.
        if wind_controls_of(settings) != wind_controls_of(before):
            self.blow(wind_controls_of(settings, self.breeze.on))

    def blow(self, breeze: WindControls) -> None:
        """Another wind from now on."""
        self._disturbed |= self.ticks > 0
        self.breeze = breeze
        wind = wind_of(breeze)
        self._wind = wind if self._wind is None else carried_on(self._wind, wind, self.time)

    def press(self, keys: Iterable[str], azimuth: float) -> None:
        """Hold these keys of the wind until others are; see `steered`.

        azimuth: of the viewer about the banner's block [degrees].
        """
        self._keys = tuple(sorted(set(keys)))
        self._azimuth = azimuth

    def look_anew(self) -> None:
        """Frame what is seen as the named view does."""
        self._cuts += 1

    def reset(self) -> None:
        """Back to the start: the cloth at rest, in the same wind."""
        self.ticks = 0
        self._disturbed = False
        self._held = None
        self._wind = wind_of(self.breeze)
        self._shadow = None
        self._sheets = [replace(s, hanging=hang(s.hanging.weave)) for s in self._sheets]

    def grab(self, ray: Ray) -> bool:
        """Take hold of the free particle nearest to a line of sight; false where there is none."""
        self.let_go()
        found = [
            (miss, number, particle)
            for number, sheet in enumerate(self._sheets)
            for miss, particle in [self._nearest(sheet, ray)]
            if particle is not None
        ]
        if not found:
            return False
        _, number, particle = min(found)
        self._disturbed = True
        self._held = number
        self._change(number, grabbed(self._sheets[number].hanging, particle))
        return True

    def pull(self, ray: Ray) -> None:
        """Pull what is held to a line of sight, no nearer to the camera and no further off."""
        if self._held is None:
            return
        sheet = self._sheets[self._held]
        if sheet.hanging.hand is None:
            return
        at = self._placed(sheet, sheet.hanging.hand.target)
        depth = float(np.sum(ray.along * ray.facing))
        if abs(depth) < 1e-6:
            return
        share = float(np.sum((at - ray.origin) * ray.facing)) / depth
        target = self._unplaced(sheet, ray.origin + share * ray.along)
        self._change(self._held, pulled(sheet.hanging, target))

    def let_go(self) -> None:
        """Let go of what is held."""
        if self._held is not None:
            self._change(self._held, released(self._sheets[self._held].hanging))
        self._held = None

    def step(self, ticks: int = 1) -> None:
        """Move on by so many ticks. Raises OptionError for cloth that blew up; it hangs anew."""
        for _ in range(ticks):
            if self._keys:
                self.blow(steered(self.breeze, self._keys, self._azimuth_of_cloth(), STEP))
            if self._settings.pose == "cloth":
                self._move()
            self.ticks += 1

    def particles(self) -> list[Array]:
        """Where the particles of each cloth are, in its own frame [m], shape [N, 3]."""
        return [sheet.hanging.positions for sheet in self._sheets]

    def shown(self) -> Shown:
        """What is seen at this moment."""
        meshes = [*self._parts, *map(self._drawn, self._sheets)]
        first = len(self._parts)
        worn = [self._materials(self._body)]
        if self._other is not None:
            worn.append(self._materials(self._other))
        panes = tuple(
            Pane(self._scene(meshes, materials), self._framing(meshes), caption)
            for materials, caption in zip(worn, self._captions, strict=True)
        )
        under = int(self._settings.shadow)
        soft = self._settings.pose == "cloth"
        grip = frozenset(range(first + under, len(meshes) + under) if soft else ())
        wind = self._heading() if grip else None
        return Shown(panes, len(panes), grip, True, wind, self._cut(), self.time)

    def _cut(self) -> object:
        asked = self._settings
        return asked.view, asked.kind, asked.placement, len(self._parts), self._cuts

    def _scene(self, meshes: list[Mesh], materials: list[Material]) -> Scene:
        settings = self._settings
        models = [Model(mesh, (look,)) for mesh, look in zip(meshes, materials, strict=True)]
        if settings.shadow:
            models.insert(0, self._shadow_of(models))
        return Scene(
            tuple(models),
            self._body.camera or Camera((0, 0, 3), (0, 0, 0)),
            settings.drawn_size,
            _light(self._body, settings),
            background_colour(settings.background),
            settings.samples,
        )

    def _framing(self, meshes: list[Mesh]) -> "_Framing":
        points = [mesh.positions for mesh in meshes]
        if self.roomy and self._settings.pose == "cloth":
            points += [
                self._placed(sheet, sheet.hanging.whole.rest_positions + swing)
                for sheet in self._sheets
                for swing in np.array(SWINGS)
            ]
        return _Framing(self._settings.view, tuple(points), self._body.camera)

    def _shadow_of(self, models: list[Model]) -> Model:
        if self._shadow is None or abs(self.ticks - self._shadow[0]) >= SHADOW_TICKS:
            floor = min(0.0, *(float(model.mesh.positions[:, 1].min()) for model in models))
            self._shadow = self.ticks, contact_shadow(models, floor)
        return self._shadow[1]

    def _materials(self, body: Body) -> list[Material]:
        material_getters = [part.material_at for part in body.parts] + [
            panel.material_at for panel in body.panels
        ]
        return [material_at(self.time) for material_at in material_getters]

    def _drawn(self, sheet: Sheet) -> Mesh:
        """The sheet as it is drawn: thick, in its place; the game's own where no cloth is asked."""
        settings, panel = self._settings, sheet.panel
        if settings.pose == "vanilla":
            phase = self.time / panel.sway if panel.sway else 0.0
            return _turned(panel.board(phase, settings.thickness), settings)
        hung = sheet.hanging.positions + panel.origin
        normals = vertex_normals(hung, sheet.shell.sheet)
        thick = sheet.shell.cover(hung, normals, settings.thickness * panel.texel)
        return _turned(thick, settings)

    def _rehung(self, body: Body, settings: Settings) -> list[Sheet]:
        old = dict(enumerate(self._sheets))
        return [
            self._rehung_panel(panel, settings, old.get(number))
            for number, panel in enumerate(body.panels)
        ]

    def _rehung_panel(self, panel: Panel, settings: Settings, old: Sheet | None) -> Sheet:
        weave = ClothSpec(settings.grid, panel.size, settings.pins or panel.pins, settings.solver)
        if old is not None and old.hanging.weave == weave:
            hanging = old.hanging
        else:
            self._disturbed |= self.ticks > 0
            hanging = hang(weave) if old is None else rewoven(old.hanging, weave)
        cloth = hanging.whole
        same = (
            old is not None
            and old.panel.uv_mapping == panel.uv_mapping
            and old.hanging.whole is cloth
        )
        shell = (
            old.shell if old and same else make_shell(cloth.triangles, cloth.uvs, panel.uv_mapping)
        )
        return Sheet(panel, hanging, shell)

    def _move(self) -> None:
        if self._wind is None:
            self._wind = wind_of(self.breeze)
        forces = (Gravity(), self._wind)
        try:
            for number, sheet in enumerate(self._sheets):
                self._change(number, moved(sheet.hanging, forces))
        except OptionError as error:
            self.reset()
            name = self._settings.solver
            raise OptionError(
                f"the cloth blew up with the solver {name} and hangs anew; use another solver,"
                " a coarser grid or less wind"
            ) from error

    def _change(self, number: int, hanging: LiveCloth) -> None:
        self._sheets[number] = replace(self._sheets[number], hanging=hanging)

    def _nearest(self, sheet: Sheet, ray: Ray) -> tuple[float, int | None]:
        """How far a line of sight misses the nearest free particle [m], and which that is."""
        among = free(sheet.hanging)
        if self._settings.pose != "cloth" or not len(among):
            return np.inf, None
        places = self._placed(sheet, sheet.hanging.positions[among])
        along = ray.along / np.sqrt(np.sum(ray.along * ray.along))
        off = np.cross(places - ray.origin, along)
        misses = np.sum(off * off, axis=1)
        best = int(np.argmin(misses))
        return float(misses[best]), int(among[best])

    def _placed(self, sheet: Sheet, points: Array) -> Array:
        """Points of a cloth's frame in the world [m], shape [..., 3]."""
        return _turned_points(points + sheet.panel.origin, self._settings.turned)

    def _unplaced(self, sheet: Sheet, points: Array) -> Array:
        return _turned_points(points, -self._settings.turned) - sheet.panel.origin

    def _azimuth_of_cloth(self) -> float:
        return self._azimuth + self._settings.turned

    def _heading(self) -> tuple[float, float, bool]:
        """Speed [m/s] and where the wind blows to in the world [degrees], and whether it does."""
        x, _, z = wind_of(replace(self.breeze, speed=1.0, on=True)).velocity
        heading = float(np.degrees(np.arctan2(x, z))) - self._settings.turned
        return self.breeze.speed, heading, self.breeze.on


@dataclass(frozen=True, eq=False)
class _Framing:
    """A camera for pictures of any shape."""

    view: str
    points: tuple[Array, ...]
    own: Camera | None

    def __call__(self, aspect: float) -> Camera:
        if self.own is not None:
            return self.own
        return frame_view(self.view, np.concatenate(self.points), aspect)


def _light(body: Body, settings: Settings) -> Light:
    light = UNLIT if settings.light == "flat" else body.light
    return lit_at(light, settings.block_light, settings.sky_light, settings.daylight)


def _turned(mesh: Mesh, settings: Settings) -> Mesh:
    return turn(mesh, settings.turned) if settings.turned else mesh


def _turned_points(points: Array, degrees: float) -> Array:
    nothing = np.zeros((0, 3), np.int32)
    return turn(Mesh(points, points, nothing, points), degrees).positions if degrees else points
