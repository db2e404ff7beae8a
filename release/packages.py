"""What a release gives to install: wheels, the package for npm and the add-on for Blender.

`publish` puts them into a site, with a page that the option `--find-links` of pip reads.
"""

import shutil
from collections.abc import Sequence
from html import escape
from pathlib import Path
from urllib.parse import quote

from drapery.web.wasm.module import module_places
from release import build, npm

FOLDER = "packages"
"""Where the files lie in a site."""
ADD_ON = build.ROOT / "release" / "blender" / "drapery_banners.py"
HOW = {
    ".whl": "for <code>pip</code>, as above",
    ".gz": "the sources, for <code>pip</code> as above",
    ".tgz": "the elements for web pages: <code>npm install</code> with the address of this file",
    ".py": "the add-on for Blender: <em>Edit, Preferences, Add-ons, Install from Disk</em>",
}
"""What each file is for, by its ending."""
PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>Install Drapery</title>
<style>
body {{
  font: 1rem/1.5 system-ui, sans-serif;
  max-inline-size: 44rem; margin: 2rem auto; padding-inline: 1rem;
}}
pre {{ padding: 0.75rem 1rem; border: 1px solid; white-space: pre-wrap; overflow-wrap: anywhere; }}
li {{ margin-block: 0.5rem; overflow-wrap: anywhere; }}
a {{ color: light-dark(#9c2f27, #e0796f); }}
</style>
</head>
<body>
<h1>Install Drapery</h1>
<p>With Python 3.11 or newer<span>, where ADDRESS is that of this page's folder</span>:</p>
<pre><code>pip install --find-links ADDRESS drapery-mc</code></pre>
<p>What it depends on comes from the package index. <a href="../docs/tutorial.html">The tutorial</a>
goes on from here; <a href="../docs/reference/extras.html">extras</a> bring more.</p>
<ul>
{items}
</ul>
<script>
const line = document.querySelector("pre code");
line.textContent = line.textContent.replace("ADDRESS", new URL(".", location).href);
document.querySelector("span").remove();
</script>
</body>
</html>
"""


def make(out: Path, platform: str | None) -> None:
    """Write all files into `python/`, `npm/` and `blender/` of a folder.

    platform: see `release.build`.
    Raises SystemExit without the kernels that pages play.
    """
    if not module_places()[0].is_file():
        raise SystemExit("there are no kernels; run python -m drapery.web.wasm.build first")
    build.build(out / "python", None)
    if platform:
        build.build(out / "python", platform)
    npm.build(out / "npm")
    (out / "blender").mkdir()
    shutil.copy(ADD_ON, out / "blender")


def publish(files: Sequence[Path], site: Path) -> None:
    """Copy files into the packages of a site, and write the page that leads to them."""
    folder = site / FOLDER
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    ordered = sorted(files, key=lambda path: (list(HOW).index(path.suffix), path.name))
    for path in ordered:
        shutil.copy(path, folder)
    items = "\n".join(
        f'<li><a href="{quote(path.name)}">{escape(path.name)}</a>: {HOW[path.suffix]}</li>'
        for path in ordered
    )
    (folder / "index.html").write_text(PAGE.format(items=items), "utf-8", newline="\n")
