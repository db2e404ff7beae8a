"""Print the SHA-256 of pictures and models: `python -m benchmarks.same_bits`.

Run it on two machines, Pythons or sets of dependencies: every line must be the same. The bytes of
mp4 and webp files come from encoders that change with their version, so for animations the pixels
are hashed, and the bytes only of PNG files and models, which this package writes itself.
"""

import hashlib
import platform
import sys
import tempfile
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path

import llvmlite.binding

from drapery import Banner, animate, draw, draw_face, save_model

SOLVERS = ("desbrun", "xpbd", "pbd", "verlet", "implicit", "provot")
VIEWS = ("front", "back", "iso", "gui", "hero")
DESIGN = Banner.parse("white creeper:lime border:black")


def outputs() -> Iterator[tuple[str, bytes]]:
    """The name and the bytes of each output."""
    yield "face", draw_face(DESIGN).pixels.tobytes()
    for solver in SOLVERS:
        yield f"solver {solver}", draw(DESIGN, solver=solver, grid=(11, 21)).pixels.tobytes()
    for view in VIEWS:
        frame = draw(DESIGN, view=view, samples=4, shadow=True)
        yield f"view {view}", frame.pixels.tobytes()
    loop = animate(DESIGN, seconds=1, fps=10, size=(96, 128), wind=8)
    yield "animation", b"".join(frame.pixels.tobytes() for frame in loop)
    with tempfile.TemporaryDirectory() as folder:
        for name in ("still.png", "loop.gif", "model.glb", "model.obj", "model.ply"):
            path = Path(folder, name)
            if path.suffix == ".png":
                draw(DESIGN).save(path)
            elif path.suffix == ".gif":
                loop.save(path)
            else:
                save_model(DESIGN, path)
            yield path.suffix, path.read_bytes()


def main() -> None:
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "numba", "pillow"))
    target = llvmlite.binding.get_host_cpu_name()
    about = f"{platform.machine()} ({target}), Python {platform.python_version()}, {packages}"
    print(about, file=sys.stderr)
    for name, data in outputs():
        print(f"{hashlib.sha256(data).hexdigest()}  {name}")


if __name__ == "__main__":
    main()
