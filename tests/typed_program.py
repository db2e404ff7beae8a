"""A program of a user, with mistakes at its end that a type checker must find.

`.ci/types` checks it with mypy, which reports a comment that ignores nothing; `test_typing.py`
checks it with ty where Drapery is installed. It is not run.
"""

from collections.abc import Iterator
from pathlib import Path

import numpy as np

import drapery
from drapery import (
    Animation,
    Banner,
    Frame,
    Settings,
    animate,
    compare,
    draw,
    draw_face,
    iter_frames,
    parse_banners,
    read_designs,
    save_model,
    simulate,
)
from drapery.cloth import Drag, Fabric, SolverXPBD, State, Wind, grid
from drapery.packs import MemoryPack, open_packs
from drapery.render import VIEWS, backend

banner: Banner = Banner.parse("white creeper:lime")
settings = Settings(wind=6, size=(64, 64), solver="xpbd", packs=["a.zip", Path("b")])
frame: Frame = draw(banner, settings, view="hero", pins="top", samples=4)
waving: Animation = animate(banner, seconds=2, fps=10, background="#ffffff")
frames: Iterator[Frame] = iter_frames(banner, settings, wind=Wind((1.0, 0.0, 3.0)))
face: Frame = draw_face(banner, packs=open_packs(), scale=4, side="back")
draw(
    banner,
    solver=SolverXPBD(substeps=8),
    fabric=Fabric(density=0.2),
    forces=[Drag(0.2)],
    packs=open_packs(MemoryPack(patterns={"own:dot": np.zeros((64, 64), np.uint8)})),
    view=VIEWS["hero"],
    backend=backend("soft"),
)
draw(kind="cape", texture=np.zeros((32, 64, 4), np.uint8))
save_model(banner, "banner.glb", seconds=1, grid=(9, 17))
same: bool = compare(banner, frame, size=(64, 64)).difference.same
bases: list[str] = [found.banner.base for found in (*parse_banners("red"), *read_designs("red"))]
states: Iterator[State] = simulate(grid(5, 9, 1.0, 2.0))
version: str = drapery.__version__

draw(banner, wnid=6)  # type: ignore[call-arg]
draw(banner, wind="strong")  # type: ignore[arg-type]
draw(banner, pose="still")  # type: ignore[arg-type]
draw("white")  # type: ignore[arg-type]
print(frame.pixel)  # type: ignore[attr-defined]
