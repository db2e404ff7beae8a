"""Build all that a release publishes, and upload nothing: `python -m release.all [-o dist]`.

In a checkout without changes it writes, with the same bytes on every run with the same Python:

    python/           the source archive and the wheel; with --platform TAG also that of this one
    npm/              the package of the element
    blender/          the add-on of one file
    conda/            the package for conda, of the plain wheel
    site.tar.gz       the designer, the docs with live cloth, and the files above but that for conda
    drapery.cdx.json  the dependencies in the versions of constraints.txt, as CycloneDX
    SHA256SUMS        the checksums of these files, for `sha256sum --check`

`--twice` builds all of it again, and names the files that differ. It needs the extras `docs`,
`release` and `web-build`, and ten minutes.
"""

import argparse
import hashlib
import os
import subprocess
import sys
import tempfile
import venv
from collections.abc import Sequence
from pathlib import Path

from release import build, conda, packages, site

SUMS = "SHA256SUMS"


def build_all(out: Path, platform: str | None) -> None:
    """Write all files into a folder. platform: see `release.build`.

    Raises SystemExit where the folder holds files or the checkout has changes.
    """
    if out.exists() and any(out.iterdir()):
        raise SystemExit(f"{out} holds files; name another folder")
    status = ["git", "-C", build.ROOT, "status", "--porcelain"]
    changes = subprocess.run(status, capture_output=True, text=True, check=True).stdout
    if changes:
        raise SystemExit(f"the checkout has changes; commit them first:\n{changes}")
    run("drapery.web.wasm.build")
    if platform:
        run("release.kernels")
    packages.make(out, platform)
    files = list(out.glob("*/*"))
    (wheel,) = (out / "python").glob("*-none-any.whl")
    conda.build(wheel, out / "conda")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        site.build(folder / "site", files)
        (out / "site.tar.gz").write_bytes(build.packed(folder / "site", "site"))
        (out / "drapery.cdx.json").write_bytes(components(wheel, folder / "env"))
    (out / SUMS).write_text(sums(out), "utf-8", newline="\n")


def components(wheel: Path, folder: Path) -> bytes:
    """The packages that a wheel needs, as CycloneDX; they are installed into a new environment."""
    venv.create(folder)
    python = folder / ("Scripts/python.exe" if sys.platform == "win32" else "bin/python")
    run("pip", "--python", python, "install", "--quiet", "-c", "constraints.txt", wheel.resolve())
    out = folder / "components.json"
    words = ("--pyproject", "pyproject.toml", "--output-reproducible", "--of", "JSON", "-o", out)
    run("cyclonedx_py", "environment", python, *words)
    return out.read_bytes()


def sums(folder: Path) -> str:
    """A line for each file of a folder: its SHA-256 and its path, in the order of the paths."""
    paths = sorted(path for path in folder.rglob("*") if path.is_file() and path.name != SUMS)
    return "".join(f"{digest(path)}  {path.relative_to(folder).as_posix()}\n" for path in paths)


def digest(path: Path) -> str:
    """The SHA-256 of a file in hexadecimal digits."""
    return hashlib.sha256(path.read_bytes()).hexdigest()


def differing(first: str, second: str) -> list[str]:
    """The paths whose lines in two lists of checksums differ."""
    return sorted(
        {line.split("  ", 1)[1] for line in {*first.splitlines()} ^ {*second.splitlines()}}
    )


def run(module: str, *words: str | Path) -> None:
    """Run a module of this Python in the checkout; all that it writes bears the time of `epoch`."""
    env = os.environ | {"SOURCE_DATE_EPOCH": str(build.epoch())}
    command = [sys.executable, "-m", module, *words]
    subprocess.run(command, cwd=build.ROOT, env=env, check=True, stdout=sys.stderr)


def main(words: Sequence[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser("python -m release.all", description=__doc__)
    parser.add_argument("-o", "--out", type=Path, default=Path("dist"))
    parser.add_argument("--platform", metavar="TAG", help="as manylinux_2_17_x86_64")
    parser.add_argument("--twice", action="store_true", help="build again, and compare")
    given = parser.parse_args(words)
    build_all(given.out, given.platform)
    made = (given.out / SUMS).read_text("utf-8")
    if given.twice:
        with tempfile.TemporaryDirectory() as folder:
            build_all(Path(folder), given.platform)
            if names := differing(made, (Path(folder) / SUMS).read_text("utf-8")):
                raise SystemExit(f"two builds differ in {', '.join(names)}")
    print(made, end="")


if __name__ == "__main__":
    main()
