"""Check the package for npm: `python -m release.check_npm FILE.tgz`.

The files of `docs/guides/vite.md` become a project, in which the package is installed. TypeScript
must find its types, and the site that Vite builds must hold each of its `.bin` files. It needs npm.
"""

import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from release.build import ROOT

GUIDE = ROOT / "docs/guides/vite.md"
TOOLS = ("vite@8", "typescript@5")
TYPES = "--noEmit --strict --target es2022 --module esnext --moduleResolution bundler"


def guide_files() -> dict[str, str]:
    """The files that the guide shows, by name."""
    found = re.findall(r'(?ms)^```\w+ title="([^"]+)"\n(.*?)^```', GUIDE.read_text("utf-8"))
    return dict(found)


def main(package: Path) -> None:
    """Raises SystemExit where the built site lacks a file, and CalledProcessError of npm."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, text in guide_files().items():
            (folder / file).write_text(text, "utf-8")
        npm(folder, "npm", "init", "-y")
        npm(folder, "npm", "install", "--no-audit", "--no-fund", *TOOLS, package.resolve())
        npm(folder, "npx", "tsc", *TYPES.split(), "main.ts")
        npm(folder, "npx", "vite", "build", "--base=/banners/")
        made = {each.read_bytes() for each in folder.glob("dist/assets/*.bin")}
        needed = [*folder.glob("node_modules/drapery-banner/*.bin")]
        lost = sorted(each.name for each in needed if each.read_bytes() not in made)
        if not needed or lost:
            raise SystemExit(f"the site has {len(made)} files, and lacks {', '.join(lost)}")
    print(f"{package.name}: types, and {len(needed)} files in the site that Vite builds")


def npm(folder: Path, program: str, *words: str | Path) -> None:
    """Run a program of npm, which is a script of cmd on Windows."""
    command = [shutil.which(program) or program, *words]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
