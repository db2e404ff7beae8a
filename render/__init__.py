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

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.mesh import Mesh, face_normals, make_mesh, vertex_normals
    from drapery.render.backends import DrawScene, backend, backend_names
    from drapery.render.buffers import Buffers
    from drapery.render.camera import Camera, clip_matrix, projection_matrix, view_matrix
    from drapery.render.contact import contact_sheet, contact_table, on_checker, stack_frames
    from drapery.render.contact_images import checkered, contact_strips
    from drapery.render.debug import (
        at_particles,
        edges_model,
        normals_model,
        pins_model,
        spring_stretch,
        springs_model,
        stretch_model,
    )
    from drapery.render.doctor import BackendReport, backend_report
    from drapery.render.drawing import Colour, draw_models, draw_scene, make_model
    from drapery.render.drawlist import DrawList, Topology, draw_list, make_topology
    from drapery.render.encode import check_quality, check_target, save_animation, save_frame
    from drapery.render.encode.output import check_writable, make_folder, replacing
    from drapery.render.encode.png import apng_bytes, png_bytes
    from drapery.render.encode.quick_png import quick_png_bytes, quick_png_of_strips
    from drapery.render.encode.webp import webp_bytes
    from drapery.render.export import save_model
    from drapery.render.flatten import composite_layers
    from drapery.render.frame import Animation, Frame, Pixels
    from drapery.render.identity_cache import IdentityCache
    from drapery.render.light import GAME_LIGHT, UNLIT, Light, lit_at
    from drapery.render.lines import dot_model, line_model
    from drapery.render.materials import MaterialTables
    from drapery.render.relief import bake_normal_maps
    from drapery.render.resize import enlarge
    from drapery.render.scene import Material, Model, Scene, Texels, TextureLayer
    from drapery.render.shadow import contact_shadow
    from drapery.render.soft import draw_buffers
    from drapery.render.views import VIEWS, View, find_view, frame_points, frame_view, turntable

__all__ = [
    "GAME_LIGHT",
    "UNLIT",
    "VIEWS",
    "Animation",
    "BackendReport",
    "Buffers",
    "Camera",
    "Colour",
    "DrawList",
    "DrawScene",
    "Frame",
    "IdentityCache",
    "Light",
    "Material",
    "MaterialTables",
    "Mesh",
    "Model",
    "Pixels",
    "Scene",
    "Texels",
    "TextureLayer",
    "Topology",
    "View",
    "apng_bytes",
    "at_particles",
    "backend",
    "backend_names",
    "backend_report",
    "bake_normal_maps",
    "check_quality",
    "check_target",
    "check_writable",
    "checkered",
    "clip_matrix",
    "composite_layers",
    "contact_shadow",
    "contact_sheet",
    "contact_strips",
    "contact_table",
    "dot_model",
    "draw_buffers",
    "draw_list",
    "draw_models",
    "draw_scene",
    "edges_model",
    "enlarge",
    "face_normals",
    "find_view",
    "frame_points",
    "frame_view",
    "line_model",
    "lit_at",
    "make_folder",
    "make_mesh",
    "make_model",
    "make_topology",
    "normals_model",
    "on_checker",
    "pins_model",
    "png_bytes",
    "projection_matrix",
    "quick_png_bytes",
    "quick_png_of_strips",
    "replacing",
    "save_animation",
    "save_frame",
    "save_model",
    "spring_stretch",
    "springs_model",
    "stack_frames",
    "stretch_model",
    "turntable",
    "vertex_normals",
    "view_matrix",
    "webp_bytes",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "mesh": ("Mesh", "face_normals", "make_mesh", "vertex_normals"),
        "render.backends": ("DrawScene", "backend", "backend_names"),
        "render.buffers": ("Buffers",),
        "render.camera": ("Camera", "clip_matrix", "projection_matrix", "view_matrix"),
        "render.contact": ("contact_sheet", "contact_table", "on_checker", "stack_frames"),
        "render.contact_images": ("checkered", "contact_strips"),
        "render.debug": (
            "at_particles",
            "edges_model",
            "normals_model",
            "pins_model",
            "spring_stretch",
            "springs_model",
            "stretch_model",
        ),
        "render.doctor": ("BackendReport", "backend_report"),
        "render.drawing": ("Colour", "draw_models", "draw_scene", "make_model"),
        "render.drawlist": ("DrawList", "Topology", "draw_list", "make_topology"),
        "render.encode": ("check_quality", "check_target", "save_animation", "save_frame"),
        "render.encode.output": ("check_writable", "make_folder", "replacing"),
        "render.encode.png": ("apng_bytes", "png_bytes"),
        "render.encode.quick_png": ("quick_png_bytes", "quick_png_of_strips"),
        "render.encode.webp": ("webp_bytes",),
        "render.export": ("save_model",),
        "render.flatten": ("composite_layers",),
        "render.frame": ("Animation", "Frame", "Pixels"),
        "render.identity_cache": ("IdentityCache",),
        "render.light": ("GAME_LIGHT", "UNLIT", "Light", "lit_at"),
        "render.lines": ("dot_model", "line_model"),
        "render.materials": ("MaterialTables",),
        "render.relief": ("bake_normal_maps",),
        "render.resize": ("enlarge",),
        "render.scene": ("Material", "Model", "Scene", "Texels", "TextureLayer"),
        "render.shadow": ("contact_shadow",),
        "render.soft": ("draw_buffers",),
        "render.views": ("VIEWS", "View", "find_view", "frame_points", "frame_view", "turntable"),
    },
)
