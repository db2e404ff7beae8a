"""What is around a subject in its pictures: light, cameras, the ground and the shadow on it."""

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from drapery.arrays import Vectors
from drapery.mesh import Mesh
from drapery.render.camera import Camera
from drapery.render.light import GAME_LIGHT, STUDIO_LIGHT, UNLIT, Light, lit_at
from drapery.render.scene import Model, Scene
from drapery.render.shadow import contact_shadow, shadow_corners
from drapery.render.views import find_view, frame_view, turntable
from drapery.settings import Settings, background_colour
from drapery.style.block import turn
from drapery.style.body import Part
from drapery.styles.catalogue import combined_style

SHOWN_GROUND = 0.4
"""How much of the block below a banner is surely in the picture [m]."""


class Staging:
    """The light, cameras, ground and shadow of the settings, for any subject.

    settings: with the light and samples of their style.
    style: their styles as one.

    ground: the block below the subject or the wall behind it.
    light: the light on the subject.
    own_camera: the camera of the subject; None if a view frames it.

    Raises OptionError for styles that cannot be used.
    """

    def __init__(
        self,
        settings: Settings,
        ground: Iterable[Part] = (),
        light: Light = GAME_LIGHT,
        own_camera: Camera | None = None,
    ) -> None:
        self.style = combined_style(settings.style)
        self.settings = settings = self.style.settle(settings)
        lights = {"flat": UNLIT, "studio": STUDIO_LIGHT, "game": light}
        self.light = lit_at(
            lights[settings.light],
            settings.block_light,
            settings.sky_light,
            settings.daylight,
        )
        self.own_camera = own_camera
        self.ground = [self._grounded(part) for part in ground]

    @property
    def aspect(self) -> float:
        """Width over height of the picture."""
        return self.settings.size[0] / self.settings.size[1]

    def camera(self, points: Sequence[Vectors], aspect: float) -> Camera:
        """The subject's own camera, or one that frames points in the view.

        points: [m], each of shape [..., 3].
        aspect: width / height of the picture.
        """
        if self.own_camera is not None:
            return self.own_camera
        return frame_view(self.settings.view, self.framed(points), aspect)

    def cameras(
        self, points: Sequence[Vectors], aspect: float, count: int, *, around: bool = False
    ) -> list[Camera]:
        """The camera of each moment: the same one, or once around.

        points: what the cameras frame [m], each of shape [..., 3].
        aspect: width / height of the picture.
        count: number of moments.
        around: goes around the points also where the settings have no turntable.
        """
        if (around or self.settings.turntable) and self.own_camera is None:
            view = find_view(self.settings.view)
            return turntable(view, self.framed(points), aspect, count)
        return [self.camera(points, aspect)] * count

    def framed(self, points: Sequence[Vectors]) -> Vectors:
        """Points of the subject [m] with those of the block below and of the shadow, shape [N, 3].

        The block counts down to SHOWN_GROUND. A wall does not: it fills the picture.
        """
        every = np.concatenate([part.reshape(-1, 3) for part in points])
        below = self.ground if self.settings.placement == "standing" else []
        lowest = np.array([-np.inf, -SHOWN_GROUND, -np.inf])
        more = [every, *(np.maximum(model.mesh.positions, lowest) for model in below)]
        if self.settings.shadow:
            more.append(shadow_corners(every, min(0.0, float(every[:, 1].min()))))
        return np.concatenate(more)

    def contact(self, models: Sequence[Model], floor: float) -> Model:
        """The contact shadow of models on a floor, or on the block below them.

        models: what casts it.
        floor: height of the floor [m].
        """
        has_block = self.ground and self.settings.placement == "standing"
        return contact_shadow(models, floor, within=self._ground_extent() if has_block else None)

    def scene(self, models: Sequence[Model], camera: Camera, shadow: Model | None = None) -> Scene:
        """The models in the light.

        models: what is drawn.
        camera: from where it is seen.
        shadow: of the settings, made here unless given.
        """
        settings = self.settings
        if settings.shadow:
            under = shadow or self.contact(models, floor_under([m.mesh for m in models]))
            models = [under, *models]
        return Scene(
            (*self.ground, *models),
            camera,
            settings.drawn_size,
            self.light,
            background_colour(settings.background),
            settings.samples,
        )

    def scenes(
        self,
        meshes: Sequence[Sequence[Mesh]],
        models: Iterable[Sequence[Model]],
        framed: Sequence[Vectors] = (),
        *,
        around: bool = False,
    ) -> Iterator[Scene]:
        """A scene of each moment, on one floor, by one camera or the cameras of a turntable.

        meshes: those of the models of each moment.
        models: each moment's, made when its scene is.
        framed: points that the camera frames [m], each of shape [..., 3]; all meshes unless given.
        around: see `cameras`.
        """
        every = [mesh for moment in meshes for mesh in moment]
        points = framed or [np.concatenate([mesh.positions.reshape(-1, 3) for mesh in every])]
        cameras = self.cameras(points, self.aspect, len(meshes), around=around)
        floor = floor_under(every)
        for moment, camera in zip(models, cameras, strict=True):
            shadow = self.contact(moment, floor) if self.settings.shadow else None
            yield self.scene(moment, camera, shadow)

    def turned(self, mesh: Mesh) -> Mesh:
        """A mesh turned by the rotation or facing of the settings."""
        return turn(mesh, self.settings.turned) if self.settings.turned else mesh

    def _ground_extent(self) -> tuple[float, float, float, float]:
        """Lowest x and z of the block below, then the highest [m]."""
        points = np.concatenate([model.mesh.positions for model in self.ground])[:, [0, 2]]
        (x0, z0), (x1, z1) = points.min(axis=0), points.max(axis=0)
        return float(x0), float(z0), float(x1), float(z1)

    def _grounded(self, part: Part) -> Model:
        """A part of the ground: a wall turns with its banner, the block below does not."""
        mesh = self.turned(part.mesh) if self.settings.placement == "wall" else part.mesh
        return Model(mesh, (part.material_at(0.0),), name=part.name)


def floor_under(meshes: Sequence[Mesh]) -> float:
    """The height of the floor [m]: 0, or the lowest vertex if that is lower."""
    return min(0.0, *(float(mesh.positions[..., 1].min()) for mesh in meshes))
