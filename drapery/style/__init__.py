"""How cloth looks: its thickness, where its sides lie on the texture, and the layers on it.

```python
from drapery.cloth import grid
from drapery.render import Mesh, vertex_normals
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

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.style.block import (
        FLAG_MAPPING as FLAG_MAPPING,
        FLAG_SIZE as FLAG_SIZE,
        turn as turn,
    )
    from drapery.style.body import (
        Body as Body,
        Panel as Panel,
        Part as Part,
    )
    from drapery.style.cloth_spec import (
        ClothSpec as ClothSpec,
        cloth_at_rest as cloth_at_rest,
    )
    from drapery.style.crowds import cover_crowd as cover_crowd
    from drapery.style.extrusion import (
        Shell as Shell,
        boundary_edges as boundary_edges,
        extrude as extrude,
        make_shell as make_shell,
    )
    from drapery.style.kinds import Kind as Kind, body_of as body_of, check_kind as check_kind
    from drapery.style.layers import flag_material as flag_material
    from drapery.style.piece import MaterialAt as MaterialAt
    from drapery.style.skins import skin_tables as skin_tables
    from drapery.style.uv_mapping import (
        BoxMapping as BoxMapping,
        SheetMapping as SheetMapping,
        UVMapping as UVMapping,
        box_mapping as box_mapping,
    )
else:
    import_lazily(__name__)
