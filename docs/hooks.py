"""What the site's builder adds: the reference of Python, live cloth, links, llms.txt."""

import os
import re
import shutil
from pathlib import Path
from typing import Any

from linked_files import linked_files, with_links
from python_names import copy_sources

from drapery.settings import Settings
from drapery.web.wasm.module import module_places

ROOT = Path(__file__).resolve().parent.parent
GALLERY = "live-gallery-page.html"
DESIGNER = os.environ.get("DRAPERY_DESIGNER")
"""The address of the designer from the first page, which `release.site` gives."""
DESIGNER_GUIDE = "[the designer](guides/web.md#the-designer)"
"""What the first page says where there is no designer beside the docs."""
PACKAGES_GUIDE = "[this site has the package](reference/extras.md#from-a-site)"
PACKAGES = "../packages/index.html"
"""What `release.packages` writes beside the docs, from the first page."""
PYTHON_NAMES = re.compile(r"<!-- begin: python ([\w.]+) -->\n(?s:.*?)<!-- end: python \1 -->")
"""What a checkout shows of a module; mkdocstrings shows more."""
pages: dict[str, tuple[str, str]] = {}
"""The title and the Markdown of each page, by its path."""


def on_startup(**_: Any) -> None:
    """Copy the sources for mkdocstrings, with `render/` in `drapery/` as it is installed.

    It is done before any plugin is configured: mkdocstrings leaves out folders that do not exist.
    """
    copy = ROOT / "build" / "api" / "drapery"
    shutil.rmtree(copy, ignore_errors=True)
    copy_sources(copy)


def on_config(config: Any) -> None:
    """Let pages load `<drapery-banner>` if its kernels are built; else they show its picture."""
    if _has_kernels():
        from mkdocs.config.config_options import ExtraScriptValue

        script = ExtraScriptValue("element/drapery-banner.js")
        script.type = "module"
        config["extra_javascript"].append(script)


def _has_kernels() -> bool:
    """Whether the WebAssembly module is built; that of the cache may have only those of tests."""
    return module_places()[0].is_file()


def on_files(files: Any, config: Any) -> Any:
    """The files of the site, and those of the repository to which its pages link."""
    for file in linked_files(files, config):
        files.append(file)
    return files


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:
    """The page with the reference of a module, and links to files of the repository."""
    text = PYTHON_NAMES.sub(r"::: \1\n", markdown)
    text = text.replace("<!-- live gallery -->", _live_gallery())
    if page.is_homepage and DESIGNER:
        text = text.replace(DESIGNER_GUIDE, f'<a href="{DESIGNER}">the designer</a>')
        text = text.replace(PACKAGES_GUIDE, f'<a href="{PACKAGES}">this site has the package</a>')
    text = with_links(text, page.file.src_uri)
    pages[page.file.src_uri] = page.title, text
    return text


def on_post_build(config: Any) -> None:
    """Write llms.txt, the Markdown of each page, the element and its gallery."""
    site = Path(config["site_dir"])
    if config["extra_javascript"]:
        from drapery.web.gallery import write_gallery
        from drapery.web.package import write_component

        write_component(site / "element", Settings())
        write_gallery(site / "reference" / GALLERY, Settings())
    lines = [f"# {config['site_name']}", "", f"> {config['site_description']}", ""]
    for name, (title, text) in pages.items():
        target = site / name
        if "\n::: " in f"\n{text}":  # the reference of a module is made in HTML
            target = target.with_suffix(".html")
        else:
            target.write_text(text, encoding="utf-8")
        lines.append(f"- [{title}]({target.relative_to(site).as_posix()})")
    (site / "llms.txt").write_text("\n".join(lines) + "\n", encoding="utf-8")


def _live_gallery() -> str:
    """The page of `drapery web --gallery`, in a frame."""
    if not _has_kernels():
        return (
            "This site was built without the kernels of the element, so the gallery is missing.\n"
        )
    return f'<iframe class="gallery" src="{GALLERY}" title="Gallery of live cloth"></iframe>\n'
