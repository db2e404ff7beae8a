"""The material of a cloth."""

from dataclasses import dataclass, fields

from drapery.cloth.checks import check_number

MAX_STIFFNESS = 1e9
"""The greatest stiffness of a spring [N/m]; single precision cannot hold more."""
MAX_DENSITY, MAX_DRAG = 1e6, 1e6


@dataclass(frozen=True)
class Fabric:
    """The material of a cloth. The default is light wool.

    density: mass per area [kg/m²], over 0 and up to 1e6.
    stretch: stiffness of the springs between neighbouring particles [N/m].
    shear: stiffness of the springs across a grid cell [N/m]; only grids have such springs.
    bend: stiffness of the springs over two cells or across an inner edge [N/m].
    drag: rate at which still air slows the cloth [1/s], 0 to 1e6; it adds to every `Drag` force.

    Stiffness is 0 to 1e9 N/m. The default ratio 5 : 1 : 0.2 is that of the flag of a Minecraft mod
    (50 : 10 : 2 for particles of 1 kg). The stiffness is that of one spring, so a finer grid of the
    same fabric is softer relative to its mass. Raises OptionError for a number out of these bounds.
    """

    density: float = 0.3
    stretch: float = 5.0
    shear: float = 1.0
    bend: float = 0.2
    drag: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            check_number(f"fabric {field.name}", getattr(self, field.name), *BOUNDS[field.name])

    @property
    def stiffness(self) -> tuple[float, float, float]:
        """Stiffness by the kind of spring: structural, shear, flexion [N/m]."""
        return self.stretch, self.shear, self.bend


BOUNDS = {
    "density": (1e-9, MAX_DENSITY, "kg/m²"),
    "stretch": (0.0, MAX_STIFFNESS, "N/m"),
    "shear": (0.0, MAX_STIFFNESS, "N/m"),
    "bend": (0.0, MAX_STIFFNESS, "N/m"),
    "drag": (0.0, MAX_DRAG, "1/s"),
}
"""The smallest and the greatest value of each property, and its unit."""
