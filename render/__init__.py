"""Pictures of meshes with textures, cameras and lights. It does not depend on banners or cloth.

A `Scene` holds models, a camera and a light; a backend draws it as a `Frame`; a frame or an
`Animation` is saved as a file. `draw_models` does it in one line:

    from drapery.render import draw_models, make_mesh, make_model

    draw_models([make_model(make_mesh(positions, triangles), colour="#b02e26")]).save("red.png")

A backend of your own is a function from a `Scene` to a `Frame`. `bake_normal_maps` puts the light
of normal maps into the textures, `draw_list` merges all models into one list of triangles with one
atlas, and `composite_layers` makes one texture of each material's layers.

Lengths are metres, angles degrees, colours 8-bit sRGB with straight alpha. The axes are
right-handed with y up. Names are loaded when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.mesh import (
        Mesh as Mesh,
        face_normals as face_normals,
        make_mesh as make_mesh,
        vertex_normals as vertex_normals,
    )
    from drapery.render.backends import (
        DrawScene as DrawScene,
        backend as backend,
        backend_names as backend_names,
    )
    from drapery.render.buffers import Buffers as Buffers
    from drapery.render.camera import (
        Camera as Camera,
        clip_matrix as clip_matrix,
        projection_matrix as projection_matrix,
        view_matrix as view_matrix,
    )
    from drapery.render.contact import contact_sheet as contact_sheet
    from drapery.render.debug import (
        at_particles as at_particles,
        edges_model as edges_model,
        normals_model as normals_model,
        pins_model as pins_model,
        spring_stretch as spring_stretch,
        springs_model as springs_model,
        stretch_model as stretch_model,
    )
    from drapery.render.drawing import (
        Colour as Colour,
        draw_models as draw_models,
        draw_scene as draw_scene,
        make_model as make_model,
    )
    from drapery.render.drawlist import (
        DrawList as DrawList,
        Topology as Topology,
        draw_list as draw_list,
    )
    from drapery.render.encode import save_animation as save_animation, save_frame as save_frame
    from drapery.render.encode.fitting import (
        FittedLoop as FittedLoop,
        save_for as save_for,
    )
    from drapery.render.encode.png import apng_bytes as apng_bytes, png_bytes as png_bytes
    from drapery.render.encode.sheet import save_sprites as save_sprites
    from drapery.render.encode.webp import webp_bytes as webp_bytes
    from drapery.render.export import save_scenes as save_scenes
    from drapery.render.flatten import composite_layers as composite_layers
    from drapery.render.frame import Animation as Animation, Frame as Frame
    from drapery.render.light import (
        GAME_LIGHT as GAME_LIGHT,
        UNLIT as UNLIT,
        Light as Light,
        lit_at as lit_at,
    )
    from drapery.render.lines import dot_model as dot_model, line_model as line_model
    from drapery.render.materials import MaterialTables as MaterialTables
    from drapery.render.relief import bake_normal_maps as bake_normal_maps
    from drapery.render.scene import (
        Material as Material,
        Model as Model,
        Scene as Scene,
        SurfaceDetail as SurfaceDetail,
        TextureLayer as TextureLayer,
    )
    from drapery.render.shadow import contact_shadow as contact_shadow
    from drapery.render.soft import draw_buffers as draw_buffers
    from drapery.render.views import (
        VIEWS as VIEWS,
        View as View,
        find_view as find_view,
        frame_points as frame_points,
        frame_view as frame_view,
        turntable as turntable,
    )
else:
    import_lazily(__name__)
