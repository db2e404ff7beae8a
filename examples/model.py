"""A waving banner as a GLB with morph targets, opened again."""

import sys
from pathlib import Path

import trimesh

from drapery import Banner
from drapery.banner.packs import open_packs
from drapery.render.export import save_model
from drapery.scenes.stager import loop
from drapery.settings import Settings


def main(folder: Path) -> None:
    banner = Banner.parse("white creeper:lime border:black")
    save_model(loop(banner, open_packs(()), Settings(), 20, 10), folder / "banner.glb", fps=10)
    opened = trimesh.load_scene(folder / "banner.glb")
    print(f"banner.glb: {len(opened.geometry)} meshes, bounds {opened.bounds.round(2).tolist()}")


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
