"""The steps that a file of a style can name."""

from collections.abc import Mapping
from types import MappingProxyType

from drapery.styles import material_steps, motion_steps, picture_steps, pixel_steps, shape_steps
from drapery.styles.step import StepFunction, StepKind

_FUNCTIONS: dict[StepKind, tuple[StepFunction, ...]] = {
    "motion": (motion_steps.calm, motion_steps.hold, motion_steps.snap_angles, motion_steps.squash),
    "shape": (
        shape_steps.thickness,
        shape_steps.smooth,
        shape_steps.coarse,
        shape_steps.facets,
        shape_steps.boards,
        shape_steps.voxels,
        shape_steps.level_texels,
        shape_steps.swallow_tail,
        shape_steps.rounded_hem,
        shape_steps.fringe,
        shape_steps.tear,
    ),
    "material": (
        material_steps.weave,
        material_steps.felt,
        material_steps.embroider,
        material_steps.flatten,
        material_steps.bevel,
        material_steps.hatch,
        material_steps.stained_glass,
        material_steps.palette,
        material_steps.age,
        material_steps.parchment,
    ),
    "picture": (
        pixel_steps.pixels,
        pixel_steps.opacity,
        pixel_steps.limit,
        pixel_steps.clean,
        pixel_steps.steady,
        picture_steps.shade,
        picture_steps.outline,
        picture_steps.posterize,
        picture_steps.palette,
        picture_steps.tones,
        picture_steps.hatching,
        picture_steps.paper,
        picture_steps.scanlines,
        picture_steps.drop_shadow,
        picture_steps.glow,
    ),
}

STEPS: Mapping[StepKind, Mapping[str, StepFunction]] = MappingProxyType(
    {
        kind: MappingProxyType({each.__name__.replace("_", "-"): each for each in functions})
        for kind, functions in _FUNCTIONS.items()
    }
)
"""The functions by kind and name; see `StyleStep`."""
