"""Banners, garments and players of Drapery in Blender: *File*, *Import*, *Drapery cloth*.

This file is an add-on: *Edit*, *Preferences*, *Add-ons*, *Install from Disk*. It runs the command
`drapery`, which is installed outside of Blender; where it is not on the PATH, the preferences of
the add-on name it. The loop comes as shape keys, with materials, at the frame rate of the scene.
"""

import subprocess
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import bpy

bl_info = {
    "name": "Drapery cloth",
    "description": "Minecraft banners, garments and players with cloth that waves",
    "author": "Drapery contributors",
    "version": (0, 1, 0),
    "blender": (4, 2, 0),
    "location": "File > Import",
    "category": "Import-Export",
}
MISSING = "there is no command {!r}; name that of Drapery in the preferences of the add-on"
FIELDS = {"model": ("design",), "garment": ("garment",), "player": ("skin", "motion", "garment")}
"""What is asked for, of each subject."""
LONGEST = 600.0
"""How long the command may take [s]; the first call after an installation compiles kernels."""


class DraperyError(Exception):
    """One line for the user."""


class DraperyPreferences(bpy.types.AddonPreferences):
    """Where the command is."""

    bl_idname = __name__
    command: bpy.props.StringProperty(name="Command", default="drapery", subtype="FILE_PATH")

    def draw(self, _context: Any) -> None:
        self.layout.prop(self, "command")


class ImportDrapery(bpy.types.Operator):
    """Import a banner, garment or player whose cloth waves in a loop"""

    bl_idname = "import_scene.drapery"
    bl_label = "Drapery cloth"
    bl_options = {"REGISTER", "UNDO"}  # noqa: RUF012 -- as Blender wants it

    subject: bpy.props.EnumProperty(
        name="Subject",
        items=[
            ("model", "Banner", "A banner on its pole"),
            ("garment", "Garment", "By its name"),
            ("player", "Player", "In a skin and a garment, moving"),
        ],
    )
    design: bpy.props.StringProperty(
        name="Design",
        description="A banner in any form that Drapery reads, such as a /give command",
        default="white creeper:lime border:black",
    )
    garment: bpy.props.StringProperty(
        name="Garment", description="Its name, as `drapery garment --list` has it", default="cape"
    )
    skin: bpy.props.StringProperty(
        name="Skin", description="traveller, dancer, or the path of a PNG file", default="traveller"
    )
    motion: bpy.props.StringProperty(
        name="Motion", description="Such as walk, run, sneak, swim, or walk+wave", default="walk"
    )
    seconds: bpy.props.FloatProperty(name="Seconds", default=2.0, min=0.1, max=60.0)

    def invoke(self, context: Any, _event: Any) -> set[str]:
        return context.window_manager.invoke_props_dialog(self, width=400)

    def draw(self, _context: Any) -> None:
        self.layout.prop(self, "subject")
        for name in FIELDS[self.subject]:
            self.layout.prop(self, name)
        self.layout.prop(self, "seconds")

    def execute(self, context: Any) -> set[str]:
        render = context.scene.render
        rate = max(1, round(render.fps / render.fps_base))
        fields = {name: getattr(self, name) for name in FIELDS[self.subject]}
        try:
            with tempfile.TemporaryDirectory() as folder:
                path = Path(folder, "cloth.glb")
                words = words_of(self.subject, fields, self.seconds, rate, path)
                run_command(command_of(context), words)
                show(context, path, rate, self.seconds)
        except DraperyError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        return {"FINISHED"}


def command_of(context: Any) -> str:
    """The command that the preferences name."""
    addon = context.preferences.addons.get(__name__)
    return addon.preferences.command if addon else "drapery"


def words_of(
    subject: str, fields: Mapping[str, str], seconds: float, rate: int, path: Path
) -> list[str]:
    """The words of the command that writes a loop [s] at a rate [1/s] to a file.

    fields: those of the subject, by name; a player of no garment wears none.
    """
    words = [subject, "--seconds", f"{seconds:g}", "--fps", str(rate), "-o", str(path)]
    if subject != "player":
        return [*words, "--", *fields.values()]
    flags = {"skin": "--skin", "motion": "--motion", "garment": "--wear"}
    return [*words, *(f"{flags[name]}={value}" for name, value in fields.items() if value)]


def run_command(command: str, words: Sequence[str]) -> None:
    """Run a command. Raises DraperyError with the line that it says, or why it cannot run."""
    try:
        done = subprocess.run(
            [command, *words], capture_output=True, text=True, encoding="utf-8", timeout=LONGEST
        )
    except OSError:
        raise DraperyError(MISSING.format(command)) from None
    except subprocess.TimeoutExpired:
        raise DraperyError(f"{command} took over {LONGEST:g} s; try fewer seconds") from None
    if done.returncode:
        lines = done.stderr.strip().splitlines() or [f"{command} ends with {done.returncode}"]
        raise DraperyError(lines[-1])


def show(context: Any, path: Path, rate: int, seconds: float) -> None:
    """Import a file into the scene, whose rate and last frame become those of the loop."""
    scene, before = context.scene, {*bpy.data.materials}
    scene.render.fps, scene.render.fps_base = rate, 1.0
    bpy.ops.import_scene.gltf(filepath=str(path))
    for material in {*bpy.data.materials} - before:
        for node in material.node_tree.nodes if material.node_tree else ():
            if node.type == "TEX_IMAGE":
                node.interpolation = "Closest"  # texels are hard, as in the game
    scene.frame_start, scene.frame_end = 1, max(1, round(rate * seconds))


def add_entry(menu: Any, _context: Any) -> None:
    """The entry of the menu *Import*."""
    menu.layout.operator(ImportDrapery.bl_idname, text="Drapery cloth")


CLASSES = (DraperyPreferences, ImportDrapery)


def register() -> None:
    """Blender calls it when the add-on is enabled."""
    for each in CLASSES:
        bpy.utils.register_class(each)
    bpy.types.TOPBAR_MT_file_import.append(add_entry)


def unregister() -> None:
    """Blender calls it when the add-on is disabled."""
    bpy.types.TOPBAR_MT_file_import.remove(add_entry)
    for each in reversed(CLASSES):
        bpy.utils.unregister_class(each)
