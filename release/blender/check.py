"""Run the add-on in Blender without a window: `python -m release.blender.check [DRAPERY]`.

It needs `pip install bpy`. DRAPERY is the command, by default that on the PATH.
"""

import sys
from typing import Any

import bpy

from release.blender import drapery_banners

SECONDS = 0.5


def main(command: str) -> None:
    """Raises SystemExit where cloth lacks its loop or a material, and what the add-on reports."""
    drapery_banners.register()
    drapery_banners.command_of = lambda _context: command
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for options in (
        {"design": "white creeper:lime"},
        {"subject": "garment", "garment": "cape"},
        {"subject": "player", "skin": "dancer", "motion": "run", "garment": "scarf"},
    ):
        before = {*bpy.data.objects}
        bpy.ops.import_scene.drapery(**options, seconds=SECONDS)
        check([each.data for each in {*bpy.data.objects} - before if each.type == "MESH"])
    version = bpy.app.version_string
    print(f"Blender {version}: a banner, a cape and a player's scarf wave in shape keys")


def check(meshes: list[Any]) -> None:
    """Raise SystemExit where no mesh waves until the last frame, with hard texels."""
    cloths = [each for each in meshes if each.shape_keys]
    if not cloths:
        raise SystemExit(f"none of {len(meshes)} meshes waves")
    for cloth in cloths:
        last = bpy.context.scene.frame_end
        ends = cloth.shape_keys.animation_data.action.frame_range[1]
        nodes = [node for each in cloth.materials for node in each.node_tree.nodes]
        filters = {node.interpolation for node in nodes if node.type == "TEX_IMAGE"}
        if ends != last or filters != {"Closest"}:
            raise SystemExit(f"{cloth.name} waves until {ends}, not {last}, with texels {filters}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else "drapery")
