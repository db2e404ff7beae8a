"""A style: a named chain of steps that change motion, shape, material and picture."""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Literal

import numpy as np

from drapery.arrays import Vectors
from drapery.errors import OptionError
from drapery.mesh import Mesh
from drapery.option import one_of
from drapery.render.backends import DrawScene, draw_with_buffers
from drapery.render.buffers import Buffers
from drapery.render.frame import Frame
from drapery.render.identity_cache import IdentityCache
from drapery.render.scene import Material, Scene
from drapery.settings import Lighting, Options, Settings
from drapery.style.piece import Piece
from drapery.styles.canvas import Canvas, laid_over, large_pixel
from drapery.styles.chain import chain_fault, makes_pixels
from drapery.styles.colours import as_pixels
from drapery.styles.large_pixels import PLACES
from drapery.styles.step import StepKind, StyleStep, as_toml, parameter_lines

CLEAR = (0, 0, 0, 0)
Page = tuple[tuple[int, int], tuple[int, int, int, int]]
"""Size and background of a picture; see `Scene`."""
MAX_SAMPLES = 1 << 25
"""The most samples of a picture that steps change; they take about 1 GiB."""

_materials: IdentityCache[Material] = IdentityCache(32)


@dataclass(frozen=True)
class Style:
    """How cloth is to look: steps that change what is simulated and drawn.

    `one | other` has the steps of both, those of `one` first.

    name: shown in lists.
    steps: applied kind by kind, each kind in this order; see `StyleStep`.
    light: of a picture that gives none, see `Settings`; None leaves it.
    samples: of a picture that gives none, see `Settings`; None leaves them.
    description: one line about it.

    Raises OptionError, also for steps that together exceed the bounds of `styles.chain`.
    """

    name: str
    steps: tuple[StyleStep, ...] = ()
    light: Lighting | None = None
    samples: Literal[1, 4, 16] | None = None
    description: str = ""

    def __post_init__(self) -> None:
        if self.light is not None:
            one_of("light", self.light, ("game", "flat", "studio"))
        if self.samples is not None:
            one_of("samples", self.samples, (1, 4, 16))
        if not all(isinstance(step, StyleStep) for step in self.steps):
            raise OptionError(f"style {self.name}: a step is not a StyleStep; make it one")
        object.__setattr__(self, "steps", tuple(self.steps))
        if fault := chain_fault(self.steps):
            raise OptionError(f"style {self.name}: {fault.message}")

    def __or__(self, other: "Style") -> "Style":
        return Style(
            f"{self.name} | {other.name}",
            (*self.steps, *other.steps),
            other.light or self.light,
            other.samples or self.samples,
        )

    @classmethod
    def load(cls, path: str | Path) -> "Style":
        """The style of a TOML file, named after it.

        Raises OptionError that names the file, the line, the field and the remedy.
        """
        # Imported here: a picture without a style needs no step, and no pydantic.
        from drapery.styles.loading import read_style_file

        parsed, steps = read_style_file(path)
        return cls(Path(path).stem, steps, parsed.light, parsed.samples, parsed.description)

    def has(self, kind: StepKind) -> bool:
        """Whether any step is of this kind."""
        return any(step.kind == kind for step in self.steps)

    def describe(self) -> str:
        """The style as TOML, with every parameter, its meaning and its limits as comments."""
        lines = [f"description = {as_toml(self.description)}"] if self.description else []
        lines += [f'light = "{self.light}"'] if self.light else []
        lines += [f"samples = {self.samples}"] if self.samples else []
        for step in self.steps:
            lines += ["", f"[[{step.kind}]]", f'step = "{step.name}"', *parameter_lines(step)]
        return "\n".join(lines).strip() + "\n"

    def settle(self, settings: Settings) -> Settings:
        """The settings with this style's light and samples where they give none."""
        own: Options = {}
        if self.light and "light" not in settings.given:
            own["light"] = self.light
        if self.samples and "samples" not in settings.given:
            own["samples"] = self.samples
        return settings.changed(**own)

    def move(self, piece: Piece, positions: Vectors) -> Vectors:
        """The positions of a piece at all moments after the motion steps [m], shape [F, N, 3].

        piece: the cloth that moves.
        positions: of its vertices at all moments [m], shape [F, N, 3].
        """
        for step in self._of("motion"):
            positions = step.apply(piece, positions)
        return positions

    def mesh(self, piece: Piece, positions: Vectors) -> Mesh:
        """The shape steps applied, then the thickness.

        piece: the cloth.
        positions: of its vertices at one moment [m], shape [N, 3].

        Raises OptionError for a step that returns something else.
        """
        shaped: Mesh | tuple[Piece, Vectors] = piece, positions
        for step in self._of("shape"):
            if isinstance(shaped, Mesh):
                raise OptionError(
                    f"style {self.name}: step {step.name} follows one that makes a mesh;"
                    " put it before that step"
                )
            shaped = step.apply(*shaped)
        if isinstance(shaped, Mesh):
            return shaped
        piece, positions = shaped
        return piece.mesh(positions)

    def material(self, material: Material) -> Material:
        """The material steps applied; the same object for the same material, while it is cached."""
        if not self.has("material"):
            return material
        return _materials.get((material,), self, lambda: self._dyed(material))

    def draw(self, scene: Scene | Frame, draw_scene: DrawScene) -> Frame:
        """A scene drawn by a backend, and the picture steps applied to all but its background.

        Edges are smoothed after the steps: the scene is drawn larger, with one sample a pixel.

        scene: what is drawn. A finished frame is changed as a flat picture: all that is visible is
            one model.
        draw_scene: the backend.

        Raises OptionError for over MAX_SAMPLES samples.
        """
        return next(self.draw_loop((scene,), draw_scene))

    def draw_loop(self, scenes: Iterable[Scene | Frame], draw_scene: DrawScene) -> Iterator[Frame]:
        """The scenes of a loop, drawn as by `draw`.

        Each is drawn when the iterator reaches it, or all at once for steps that are `over_time`.

        scenes: scenes or finished frames, all of one size.
        draw_scene: the backend.
        """
        steps = [*self._of("picture")]
        if not steps:
            yield from (one if isinstance(one, Frame) else draw_scene(one) for one in scenes)
            return
        first = next((n for n, step in enumerate(steps) if step.over_time), len(steps))
        canvases: Iterator[tuple[Page, Canvas]] = (
            (_page(scene), self._canvas(scene, draw_scene, steps[:first])) for scene in scenes
        )
        if first < len(steps):
            canvases = self._together(canvases, steps[first:])
        for (size, background), canvas in canvases:
            pixels = canvas.finished(size)
            if background[3]:
                behind = np.array([background], np.uint8).view(np.uint32)
                pixels = as_pixels(laid_over(pixels.view(np.uint32)[..., 0], behind))
            yield Frame(pixels)

    def _canvas(
        self, scene: Scene | Frame, draw_scene: DrawScene, steps: Sequence[StyleStep]
    ) -> Canvas:
        """A scene after some picture steps; large pixels at first are drawn as such."""
        samples = 1 if isinstance(scene, Frame) else scene.samples
        (width, height), grid = _page(scene)[0], int(samples**0.5)
        self._check_samples(width * height * samples)
        if isinstance(scene, Frame):
            canvas = Canvas(scene.pixels, partial(_flat_buffers, scene))
        elif steps and makes_pixels(steps[0]):
            canvas = _large_pixels(scene, dict(steps[0].parameters)["size"], draw_scene)
            steps = steps[1:]
        else:
            large = width * grid, height * grid
            sharp = replace(scene, size=large, samples=1, background=CLEAR)
            frame, make_buffers = draw_with_buffers(sharp, draw_scene)
            canvas = Canvas(frame.pixels, make_buffers, grid)
        for step in steps:
            canvas = step.apply(canvas)
        return canvas

    def _together(
        self, drawn: Iterable[tuple[Page, Canvas]], steps: Iterable[StyleStep]
    ) -> Iterator[tuple[Page, Canvas]]:
        """All scenes after some more steps, of which at least one is over time."""
        pages: list[Page] = []
        canvases: list[Canvas] = []
        for page, canvas in drawn:
            pages.append(page)
            canvases.append(canvas.alone())
            self._check_samples(canvas.pixels[..., 0].size * len(canvases), "all frames together")
        if not canvases:
            return iter(())
        for step in steps:
            each = step.over_time
            canvases = step.apply(canvases) if each else [step.apply(one) for one in canvases]
        return zip(pages, canvases, strict=True)

    def _check_samples(self, count: int, of: str = "pictures") -> None:
        if count > MAX_SAMPLES:
            raise OptionError(
                f"style {self.name} changes {of} of at most {MAX_SAMPLES} samples;"
                " use a smaller size, fewer samples or a shorter loop"
            )

    def _of(self, kind: StepKind) -> Iterable[StyleStep]:
        return (step for step in self.steps if step.kind == kind)

    def _dyed(self, material: Material) -> Material:
        for step in self._of("material"):
            material = step.apply(material)
        return material


def _page(picture: Scene | Frame) -> Page:
    if isinstance(picture, Scene):
        return picture.size, picture.background
    return (picture.pixels.shape[1], picture.pixels.shape[0]), CLEAR


def _flat_buffers(frame: Frame) -> Buffers:
    """Those of a picture on paper: what is visible looks to the viewer from one distance [m]."""
    shown, (size, _) = frame.pixels[..., 3] > 0, _page(frame)
    found = Buffers.empty(size)
    found.depth[shown], found.normal[shown] = 1.0, (0.0, 0.0, 1.0)
    found.model[shown] = found.material[shown] = 0
    found.uv[..., 0] = np.where(shown, (np.arange(size[0]) + 0.5) / size[0], 0)
    found.uv[..., 1] = np.where(shown, (np.arange(size[1])[:, None] + 0.5) / size[1], 0)
    return found


def _large_pixels(scene: Scene, size: int, draw_scene: DrawScene) -> Canvas:
    """A scene drawn with a few samples in each square of size x size pixels, of which it keeps one.

    size: 0 uses `large_pixel`. The squares lie evenly about the middle of the picture, so
    those at its edges may be cut.
    """
    size = size or large_pixel(scene.size[1])
    across, down = (-(-side // size) for side in scene.size)
    taller = down * size / scene.size[1]
    camera = scene.camera
    if camera.height is not None:
        camera = replace(camera, height=camera.height * taller)
    else:
        half = math.tan(math.radians(camera.fov / 2)) * taller
        camera = replace(camera, fov=2 * math.degrees(math.atan(half)))
    fine = across * PLACES, down * PLACES
    sharp = replace(scene, camera=camera, size=fine, samples=1, background=CLEAR)
    corner = (down * size - scene.size[1]) // 2, (across * size - scene.size[0]) // 2
    frame, make_buffers = draw_with_buffers(sharp, draw_scene)
    return replace(Canvas(frame.pixels, make_buffers).coarse(PLACES), pixel=size, corner=corner)
