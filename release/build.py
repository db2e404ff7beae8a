"""Build the source archive and the wheel: `python -m release.build [--platform TAG] [-o dist]`.

The bytes are the same on every run with the same Python: the times of all files are
SOURCE_DATE_EPOCH, by default the time of the last commit. With `--platform`, as
manylinux_2_17_x86_64, only a wheel is built, which holds the kernels that `python -m
release.kernels` and `python -m drapery.web.wasm.build` have compiled before; without it they are
left out. A wheel that is over 1.65 MB without them and `drapery.web` is an error.
"""

import argparse
import gzip
import io
import os
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile
from collections.abc import Sequence
from pathlib import Path

ROOT = Path(__file__).parent.parent
MAX_WHEEL = 1_650_000
"""The most bytes of a wheel, see `size_of_sources`; its modules alone take 1 MB.

With docstrings that describe each parameter in a line of its own the sources take 1.59 MB.
"""
LEFT_OUT = ("drapery/web/", "drapery/jit/kernels-")
NOT_SOURCES = {
    "drapery/jit/kernels-*": "release.kernels",
    "drapery/web/wasm/*.wasm": "drapery.web.wasm.build",
}
"""Built files in a checkout, which no source archive or plain wheel holds, and what makes them."""


def epoch() -> int:
    """The time that built files bear [s]."""
    given = os.environ.get("SOURCE_DATE_EPOCH")
    if given:
        return int(given)
    command = ["git", "-C", ROOT, "log", "-1", "--format=%ct"]
    return int(subprocess.run(command, capture_output=True, text=True, check=True).stdout)


def build(out: Path, platform: str | None) -> list[Path]:
    """Build into a folder; returns the files. platform: see above."""
    time = epoch()
    with tempfile.TemporaryDirectory() as folder:
        tree, made = Path(folder, "source"), Path(folder, "made")
        copy_sources(tree, with_built=platform is not None)
        kinds = ["--wheel"] if platform else ["--sdist", "--wheel"]
        words = [f"-C--build-option=--plat-name={platform}"] if platform else []
        env = os.environ | {"SOURCE_DATE_EPOCH": str(time)}
        command = [sys.executable, "-m", "build", "--no-isolation", *kinds, *words, "-o", made]
        subprocess.run([*command, tree], env=env, check=True, stdout=subprocess.DEVNULL)
        for archive in made.glob("*.tar.gz"):
            archive.write_bytes(same_times(archive.read_bytes(), time))
        for wheel in made.glob("*.whl"):
            if (size := size_of_sources(wheel)) > MAX_WHEEL:
                raise SystemExit(f"{wheel.name} has {size} bytes of sources: over {MAX_WHEEL}")
        out.mkdir(parents=True, exist_ok=True)
        return [Path(shutil.copy(path, out)) for path in sorted(made.iterdir())]


def size_of_sources(wheel: Path) -> int:
    """The bytes of a wheel without those of `drapery.web` and of a platform's kernels."""
    with zipfile.ZipFile(wheel) as archive:
        others = [each for each in archive.infolist() if each.filename.startswith(LEFT_OUT)]
    return wheel.stat().st_size - sum(each.compress_size for each in others)


def copy_sources(tree: Path, with_built: bool) -> None:
    """Copy what git knows, with fixed rights; with_built: and the kernels of this platform."""
    listed = ["git", "-C", ROOT, "ls-files", "-z"]
    names = subprocess.run(listed, capture_output=True, text=True, check=True).stdout
    paths = [ROOT / name for name in names.split("\0") if name]
    if with_built:
        for pattern, maker in NOT_SOURCES.items():
            built = sorted(ROOT.glob(pattern))
            if not built:
                raise SystemExit(f"there is no {pattern}; run python -m {maker} first")
            paths += built
    for path in paths:
        if path.is_file():
            copied = tree / path.relative_to(ROOT)
            copied.parent.mkdir(parents=True, exist_ok=True)
            copied.write_bytes(path.read_bytes())
            copied.chmod(0o755 if path.stat().st_mode & 0o100 else 0o644)


def packed(folder: Path, name: str) -> bytes:
    """The files of a folder as an archive .tar.gz with a folder of this name."""
    content = io.BytesIO()
    with tarfile.open(fileobj=content, mode="w:gz", compresslevel=0) as archive:
        for path in folder.rglob("*"):
            if path.is_file():
                archive.add(path, f"{name}/{path.relative_to(folder).as_posix()}")
    return same_times(content.getvalue(), epoch())


def same_times(archive: bytes, time: int) -> bytes:
    """An archive .tar.gz with files in order, of one time and of nobody."""
    content = io.BytesIO()
    with (
        tarfile.open(fileobj=io.BytesIO(archive)) as old,
        tarfile.open(fileobj=content, mode="w", format=tarfile.PAX_FORMAT) as new,
    ):
        for member in sorted(old.getmembers(), key=lambda each: each.name):
            member.mtime, member.uid, member.gid = time, 0, 0
            member.uname = member.gname = ""
            member.pax_headers = {}
            member.mode = 0o755 if member.isdir() or member.mode & 0o100 else 0o644
            new.addfile(member, old.extractfile(member) if member.isfile() else None)
    packed = io.BytesIO()
    with gzip.GzipFile(filename="", fileobj=packed, mode="wb", mtime=time) as file:
        file.write(content.getvalue())
    return packed.getvalue()


def main(words: Sequence[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser("python -m release.build", description=__doc__)
    parser.add_argument("-o", "--out", type=Path, default=Path("dist"))
    parser.add_argument("--platform", metavar="TAG", help="as manylinux_2_17_x86_64")
    given = parser.parse_args(words)
    for path in build(given.out, given.platform):
        sources = f", {size_of_sources(path)} of sources" if path.suffix == ".whl" else ""
        print(f"{path}: {path.stat().st_size} bytes{sources}")


if __name__ == "__main__":
    main()
