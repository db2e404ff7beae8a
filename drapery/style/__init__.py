"""How cloth looks: its thickness, where its sides lie on the texture, and the layers on it.

```python
from drapery.cloth import grid
from drapery.mesh import Mesh, vertex_normals
from drapery.style import FLAG_MAPPING, extrude

cloth = grid(5, 9, width=0.8, height=1.6)
normals = vertex_normals(cloth.rest_positions, cloth.triangles)
thin = Mesh(cloth.rest_positions, normals, cloth.triangles, cloth.uvs)
thick = extrude(thin, 0.04, FLAG_MAPPING)
```

Lengths are in metres and y is up. A sheet gets its thickness by moving each vertex along the
average of its faces' normals; a `UVMapping` says where front, back and rim lie on the texture; a
`Material` of several `TextureLayer`s (`drapery.render`) draws textured quads on one another.
Names are imported when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.style.block import FLAG_MAPPING, FLAG_SIZE, turn
    from drapery.style.body import Body, MaterialAt, Panel, Part
    from drapery.style.crowds import cover_crowd
    from drapery.style.extrusion import Shell, boundary_edges, extrude, make_shell
    from drapery.style.kinds import Kind, body_of, check_kind
    from drapery.style.layers import flag_material
    from drapery.style.skins import skin_tables
    from drapery.style.uv_mapping import BoxMapping, SheetMapping, UVMapping, box_mapping

__all__ = [
    "FLAG_MAPPING",
    "FLAG_SIZE",
    "Body",
    "BoxMapping",
    "Kind",
    "MaterialAt",
    "Panel",
    "Part",
    "SheetMapping",
    "Shell",
    "UVMapping",
    "body_of",
    "boundary_edges",
    "box_mapping",
    "check_kind",
    "cover_crowd",
    "extrude",
    "flag_material",
    "make_shell",
    "skin_tables",
    "turn",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "style.block": ("FLAG_MAPPING", "FLAG_SIZE", "turn"),
        "style.body": ("Body", "MaterialAt", "Panel", "Part"),
        "style.crowds": ("cover_crowd",),
        "style.extrusion": ("Shell", "boundary_edges", "extrude", "make_shell"),
        "style.kinds": ("Kind", "body_of", "check_kind"),
        "style.layers": ("flag_material",),
        "style.skins": ("skin_tables",),
        "style.uv_mapping": ("BoxMapping", "SheetMapping", "UVMapping", "box_mapping"),
    },
)
