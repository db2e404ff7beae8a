"""Shields: a plate with the design, and a handle behind it."""

from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.mesh import Mesh
from drapery.settings import Settings
from drapery.style.body import Body, Part
from drapery.style.boxes import ModelBox, box_mesh, upright
from drapery.style.layers import handle_material_at, plate_material_at, textures_period
from drapery.style.slot import SHIELD_POSE, SLOT_LIGHT, in_slot, slot_camera

TEXEL = 1.0 / 16.0
"""Metres per texel."""

PLATE = ModelBox((-6, -11, -2), (12, 22, 1), (0, 0))
HANDLE = ModelBox((-1, -3, -1), (2, 6, 6), (26, 0))
_STANDING = (0.5, 11 * TEXEL, 0.5)
"""Place of the model's origin when the shield stands on the floor [m]."""

NAMES = ("shield/plate", "shield/handle")


def body(design: Banner | None, packs: Packs, settings: Settings) -> Body:
    """The shield, its plate towards the viewer. design: None is a shield without one.

    Raises PackError.
    """
    materials = (
        plate_material_at(design, packs, settings),
        handle_material_at(design, packs, settings),
    )
    period = textures_period(design, packs, "shield")
    if settings.placement == "item":
        plate, handle = (
            in_slot(_upright_at(box, (0, 0, 0)), SHIELD_POSE) for box in (PLATE, HANDLE)
        )
        parts = tuple(map(Part, (plate, handle), materials, NAMES))
        return Body(parts, (), period, SLOT_LIGHT, slot_camera(settings.size))
    plate, handle = (_upright_at(box, _STANDING) for box in (PLATE, HANDLE))
    return Body(tuple(map(Part, (plate, handle), materials, NAMES)), (), period)


def _upright_at(box: ModelBox, origin: tuple[float, float, float]) -> Mesh:
    return upright(box_mesh(box), TEXEL, origin)
