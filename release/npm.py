"""Pack the element for npm: `python -m release.npm [-o dist]`.

`drapery-banner-VERSION.tgz` holds what `drapery web --component` writes, and the licence. The bytes
are the same on every run with the same Python, as those of `release.build`. The kernels that pages
play must have been compiled before: `python -m drapery.web.wasm.build`.
"""

import argparse
import json
import shutil
import tempfile
from collections.abc import Sequence
from pathlib import Path

from drapery import Settings
from drapery.web.package import write_component
from drapery.web.page import SIZE
from release.build import ROOT, packed
from release.repository import ADDRESS

TEXTS = ("LICENSE", "README.md", "package.json")
"""What each package holds beside the files that its package.json names."""


def build(out: Path) -> Path:
    """Write the package into a folder; returns the file."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        write_component(folder, Settings(size=SIZE))
        shutil.copy(ROOT / "LICENSE", folder)
        return pack(folder, out, ADDRESS)


def pack(folder: Path, out: Path, address: str) -> Path:
    """Pack a folder with a package.json. Raises SystemExit where it lacks a file of the package.

    address: of the repository, which npm compares with that of the workflow; none if empty.
    """
    described = folder / "package.json"
    package = json.loads(described.read_text("utf-8"))
    if address:
        package["repository"] = {"type": "git", "url": f"git+{address}.git"}
        described.write_text(json.dumps(package, indent=2) + "\n", "utf-8", newline="\n")
    for name in (*package["files"], package["main"], package["types"], *TEXTS):
        if not any(folder.glob(name)):
            raise SystemExit(f"{package['name']} lacks {name}")
    out.mkdir(parents=True, exist_ok=True)
    made = out / f"{package['name']}-{package['version']}.tgz"
    made.write_bytes(packed(folder, "package"))
    return made


def main(words: Sequence[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser("python -m release.npm", description=__doc__)
    parser.add_argument("-o", "--out", type=Path, default=Path("dist"))
    made = build(parser.parse_args(words).out)
    print(f"{made}: {made.stat().st_size} bytes")


if __name__ == "__main__":
    main()
