"""The material of a cloth, and presets of it.

Cotton and canvas have the measured densities and bending rigidities of an interlock (0.187 kg/m²,
23 µN m) and between those of a denim (0.324 kg/m², 60 to 120 µN m) and a stiff sailcloth: Wang,
O'Brien, Ramamoorthi, "Data-driven elastic models for cloth: modeling and measurement" (SIGGRAPH
2011). The other presets are typical: their densities follow common weights (melton wool 0.7, light
leather 0.3 and heavy 0.6, silk 0.1 kg/m² in the documentation of Unreal's Chaos Cloth), and their
bending rigidities give bending lengths (B / ρ g)^(1/3) of 2 cm for silk to 6 cm for leather, which
Peirce defines in "The handle of cloth" (J. Text. Inst. 21, 1930). Stretch is far
below the 200 to 1000 N/m that Wang et al. measured, since explicit solvers would need many substeps
and every solver limits stretch in another way. Drag is 0.12 N s/m³ over the density, for the
friction of air along the faces. Friction, damping and transmission are estimates.
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType

from drapery.cloth.bending import MAX_DAMPING, MAX_RIGIDITY
from drapery.cloth.checks import check_number

MAX_STIFFNESS = 1e9
"""The greatest stiffness of a spring [N/m]; single precision cannot hold more."""
MAX_DENSITY, MAX_DRAG = 1e6, 1e6


@dataclass(frozen=True)
class Fabric:
    """The material of a cloth; `FABRICS` has presets. The default bends by its springs alone.

    density: mass per area [kg/m²], over 0 and up to 1e6.
    stretch: stiffness of the springs between neighbouring particles [N/m].
    shear: stiffness of the springs across a grid cell [N/m]; only grids have such springs.
    flexion: stiffness of the springs over two cells or across an inner edge [N/m].
    drag: rate at which still air slows the cloth [1/s], 0 to 1e6; it adds to every `Drag` force.
    bending: bending rigidity of the sheet [N m], 0 to 1e6; see `Bending`.
    damping: time over which bending is damped [s], 0 to 1000: the moment is
        bending · (curvature + damping · rate of curvature).
    friction: coefficient of friction on other things, 0 to 100.
    transmission: the share of light that passes through, 0 to 1; the motion does not depend on it.

    Stiffness is 0 to 1e9 N/m. The flag of a Minecraft mod has the default ratio 5 : 1 : 0.2
    (50 : 10 : 2 for particles of 1 kg). The stiffness is of one spring, so a finer grid of the same
    fabric is softer relative to its mass.

    Raises OptionError for a number out of these bounds.
    """

    density: float = 0.3
    stretch: float = 5.0
    shear: float = 1.0
    flexion: float = 0.2
    drag: float = 0.0
    bending: float = 0.0
    damping: float = 0.0
    friction: float = 0.3
    transmission: float = 0.0

    def __post_init__(self) -> None:
        for field in fields(self):
            check_number(f"fabric {field.name}", getattr(self, field.name), *BOUNDS[field.name])

    @property
    def stiffness(self) -> tuple[float, float, float]:
        """Stiffness by the kind of spring: structural, shear, flexion [N/m]."""
        return float(self.stretch), float(self.shear), float(self.flexion)


BOUNDS = {
    "density": (1e-9, MAX_DENSITY, "kg/m²"),
    "stretch": (0.0, MAX_STIFFNESS, "N/m"),
    "shear": (0.0, MAX_STIFFNESS, "N/m"),
    "flexion": (0.0, MAX_STIFFNESS, "N/m"),
    "drag": (0.0, MAX_DRAG, "1/s"),
    "bending": (0.0, MAX_RIGIDITY, "N m"),
    "damping": (0.0, MAX_DAMPING, "s"),
    "friction": (0.0, 100.0, ""),
    "transmission": (0.0, 1.0, ""),
}
"""The smallest and the greatest value of each property, and its unit."""

FABRICS: Mapping[str, Fabric] = MappingProxyType(
    {
        "wool": Fabric(0.5, 40, 20, 0, 0.24, bending=2e-4, damping=0.05, friction=0.4),
        "cotton": Fabric(
            0.187, 40, 15, 0, 0.6, bending=2.3e-5, damping=0.05, friction=0.3, transmission=0.3
        ),
        "linen": Fabric(
            0.22, 60, 20, 0, 0.5, bending=6e-5, damping=0.05, friction=0.3, transmission=0.35
        ),
        "silk": Fabric(
            0.08, 30, 10, 0, 1.5, bending=6e-6, damping=0.02, friction=0.2, transmission=0.5
        ),
        "canvas": Fabric(
            0.4, 80, 40, 0, 0.3, bending=3e-4, damping=0.05, friction=0.4, transmission=0.3
        ),
        "leather": Fabric(0.6, 60, 60, 0, 0.2, bending=1.2e-3, damping=0.1, friction=0.5),
        "felt": Fabric(0.6, 20, 20, 0, 0.2, bending=6e-4, damping=0.1, friction=0.5),
    }
)
"""Presets by name; see the module for their sources."""
