"""Styles on the pictures of ready-made scenes."""

import warnings
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import partial
from itertools import chain

from drapery.errors import OptionError
from drapery.render.backends import DrawScene
from drapery.render.frame import Frame
from drapery.render.light import STUDIO_LIGHT, UNLIT
from drapery.render.scene import Scene
from drapery.scenes.picture_grid import ClipPicture, PictureGrid
from drapery.style.tailoring import ClothModel
from drapery.styles.cloth_models import moved_by_style, tailored
from drapery.styles.style import Style


def styled_pictures(
    pictures: Iterable[ClipPicture], style: Style, draw_scene: DrawScene
) -> Iterator[ClipPicture]:
    """The pictures of a clip in a style, one by one.

    Motion and shape steps change rectangles of cloth, material steps all cloth, and picture steps
    all pictures, also frames that a scene draws itself. Motion steps, and picture steps over time,
    need all pictures at once.
    """
    pictures = iter(pictures)
    first = next(pictures, None)
    if first is None:
        return iter(())
    _warn_of_idle_steps(first, style)
    pictures = chain((first,), pictures)
    if style.has("motion") and any(map(_has_pieces, _scenes(first))):
        pictures = _moved([*pictures], style)
    shaped = (_each(picture, partial(_dressed, style=style)) for picture in pictures)
    if not style.has("picture"):
        return shaped
    if not any(step.over_time for step in style.steps):
        draw = partial(style.draw, draw_scene=draw_scene)
        return (_every(picture, draw) for picture in shaped)
    if not isinstance(first, PictureGrid):  # each is forgotten when it is drawn
        return style.draw_loop(map(_single, shaped), draw_scene)
    return _together([*shaped], style, draw_scene)


def _warn_of_idle_steps(first: ClipPicture, style: Style) -> None:
    """Say which steps change nothing in a clip that begins with this picture."""
    scenes = _scenes(first)
    if not scenes and any(step.kind != "picture" for step in style.steps):
        warnings.warn(
            f"style {style.name}: only its picture steps change something, since the scene draws"
            " its own frames",
            stacklevel=3,
        )
    shapes = style.has("shape") or style.has("motion")
    if scenes and shapes and not any(map(_has_pieces, scenes)):
        warnings.warn(
            f"style {style.name}: its motion and shape steps change nothing, since the scene has no"
            " rectangle of cloth",
            stacklevel=3,
        )


def _single(picture: ClipPicture) -> Scene | Frame:
    if isinstance(picture, PictureGrid):
        raise OptionError("a clip mixes grids and pictures; a style over time needs one kind")
    return picture


def _has_pieces(scene: Scene) -> bool:
    """Whether a scene has a rectangle of cloth."""
    return any(isinstance(model, ClothModel) and model.thin for model in scene.models)


def _each(picture: ClipPicture, change: Callable[[Scene], Scene | Frame]) -> ClipPicture:
    """The picture with all of its scenes changed."""
    if isinstance(picture, PictureGrid):
        parts = (part if isinstance(part, Frame) else change(part) for part in picture.pictures)
        return replace(picture, pictures=tuple(parts))
    return picture if isinstance(picture, Frame) else change(picture)


def _every(picture: ClipPicture, draw: Callable[[Scene | Frame], Frame]) -> ClipPicture:
    """The picture with all of its scenes and frames drawn."""
    if isinstance(picture, PictureGrid):
        return replace(picture, pictures=tuple(map(draw, picture.pictures)))
    return draw(picture)


def _parts(picture: ClipPicture) -> tuple[Scene | Frame, ...]:
    """The pictures in a grid, or the one picture."""
    return picture.pictures if isinstance(picture, PictureGrid) else (picture,)


def _scenes(picture: ClipPicture) -> list[Scene]:
    """The scenes in a picture, in the order in which `_each` changes them."""
    return [part for part in _parts(picture) if isinstance(part, Scene)]


def _together(
    pictures: list[ClipPicture], style: Style, draw_scene: DrawScene
) -> Iterator[ClipPicture]:
    """Each place of a grid of pictures is a loop."""
    loops = zip(*map(_parts, pictures), strict=True)
    drawn = [style.draw_loop(scenes, draw_scene) for scenes in loops]
    for picture in pictures:
        frames = iter([next(loop) for loop in drawn])
        yield _every(picture, lambda _, frames=frames: next(frames))  # type: ignore[misc]


def _dressed(scene: Scene, style: Style) -> Scene:
    """A scene with the style's light, samples, shapes and materials."""
    lights = {"flat": UNLIT, "studio": STUDIO_LIGHT}
    return replace(
        scene,
        models=tuple(tailored(model, style) for model in scene.models),
        light=lights.get(style.light or "", scene.light),
        samples=style.samples or scene.samples,
    )


def _moved(pictures: list[ClipPicture], style: Style) -> Iterator[ClipPicture]:
    """The pictures with the motion steps applied to each rectangle of cloth over all of them."""
    frames = [_scenes(picture) for picture in pictures]
    places = [_move_models(scenes, style) for scenes in zip(*frames, strict=True)]
    for number, picture in enumerate(pictures):
        scenes = iter([place[number] for place in places])
        yield _each(picture, lambda _, scenes=scenes: next(scenes))  # type: ignore[misc]


def _move_models(scenes: Sequence[Scene], style: Style) -> list[Scene]:
    models = moved_by_style([scene.models for scene in scenes], style)
    return [replace(scene, models=tuple(m)) for scene, m in zip(scenes, models, strict=True)]
