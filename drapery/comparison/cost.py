"""The cost of drawing a variant: textured quads, and time for a frame."""

from dataclasses import dataclass
from statistics import median
from time import perf_counter

from drapery.banner.packs import open_packs
from drapery.comparison.variants import Variant
from drapery.errors import OptionError
from drapery.render import Scene, backend
from drapery.stage.subjects import still

REPEATS = 9


@dataclass(frozen=True)
class Cost:
    """What it takes to draw one frame.

    quads: textured quads drawn.
    milliseconds: for one frame, the median of a few frames.
    """

    quads: int
    milliseconds: float


def cost_of(variant: Variant) -> Cost:
    """Measure a variant on this machine.

    Raises OptionError for a finished picture.
    """
    if variant.banner is None or variant.settings is None:
        raise OptionError(f"{variant.label} is a finished picture; give a design to measure")
    scene = still(
        variant.banner,
        open_packs(variant.settings.packs, format=variant.settings.format),
        variant.settings,
    )
    draw_scene = backend(variant.settings.backend)
    draw_scene(scene)
    times = []
    for _ in range(REPEATS):
        start = perf_counter()
        draw_scene(scene)
        times.append(perf_counter() - start)
    return Cost(quads(scene), 1000 * median(times))


def quads(scene: Scene) -> int:
    """Textured quads in a scene: two triangles each, once for every layer."""
    triangles = sum(len(m.mesh.triangles) * len(m.materials[0].layers) for m in scene.models)
    return triangles // 2
