"""What the site's builder adds to the pages: tables of options and commands, links, and llms.txt.

A page writes `<!-- table: NAME -->` where a table of `TABLES` comes.
"""

import logging
import re
import shutil
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

import typer.main

from drapery.commands.app import command_line
from drapery.file_formats import FORMATS, KIND_NAMES, MAX_FPS
from drapery.option import Option
from drapery.packs import PACK_FORMATS
from drapery.player_settings import PLAYER_OPTIONS
from drapery.settings import LOOP_OPTIONS, OPTIONS, Settings
from drapery.web.wasm.module import module_places

ROOT = Path(__file__).resolve().parent.parent
GALLERY = "live-gallery-page.html"
ALPHA = {"full": "half too", "bit": "whole only", "none": "none"}
AUDIENCES = {"anyone": "yes", "local": "no", "python": "Python only"}
pages: dict[str, tuple[str, str]] = {}
"""The title and the Markdown of each page, by its path."""


def on_startup(**_: Any) -> None:
    """Copy the sources for mkdocstrings, with `render/` in `drapery/` as it is installed.

    It is done before any plugin is configured: mkdocstrings leaves out folders that do not exist.
    """
    copy = ROOT / "build" / "api" / "drapery"
    shutil.rmtree(copy, ignore_errors=True)
    sources = shutil.ignore_patterns("__pycache__", "*.png", "*.js", "*.wasm")
    shutil.copytree(ROOT / "drapery", copy, ignore=sources)
    shutil.copytree(ROOT / "render", copy / "render", ignore=sources)


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


def on_page_markdown(markdown: str, page: Any, config: Any, files: Any) -> str:
    """The page with its tables, and with links to files that are not on the site as plain text."""
    text = re.sub(r"<!-- table: ([\w-]+) -->", lambda found: TABLES[found[1]](), markdown)
    text = re.sub(r"\[([^]]+)\]\((?:\.\./)+(?!docs/)([\w./-]+)\)", _outside(page, config), text)
    pages[page.file.src_uri] = page.title, text
    return text


def on_post_build(config: Any) -> None:
    """Write llms.txt, the Markdown of each page beside its HTML, the element and its gallery."""
    site = Path(config["site_dir"])
    if config["extra_javascript"]:
        from drapery.web.gallery import write_gallery
        from drapery.web.page import write_component

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


def _outside(page: Any, config: Any) -> Callable[[re.Match[str]], str]:
    """Replaces a link that leads out of the docs: by its text, if what it names exists."""
    folder = Path(config["docs_dir"], page.file.src_uri).parent

    def replace(found: re.Match[str]) -> str:
        target = re.search(r"\(([^)]*)\)$", found[0])
        assert target is not None
        path = (folder / target[1]).resolve()
        if path.is_relative_to(Path(config["docs_dir"]).resolve()):
            return found[0]
        if not path.exists():
            logging.getLogger("mkdocs.hooks").warning("%s: no %s", page.file.src_uri, target[1])
        return f"{found[1]} (`{PurePosixPath(path.relative_to(ROOT))}`)"

    return replace


def _options(table: Mapping[str, Option]) -> str:
    lines = ["| option | meaning | default | over HTTP |", "|---|---|---|---|"]
    for name, option in table.items():
        flag = "" if option.audience == "python" else f"`{option.command_flag}`"
        names = flag if flag == f"`--{name.replace('_', '-')}`" else f"{flag} `{name}`".strip()
        text = option.to_text(option.default)
        default = option.default_text or (f"`{text}`" if text else "none")
        cells = names, option.describe(), default, AUDIENCES[option.audience]
        lines.append(f"| {' | '.join(map(_cell, cells))} |")
    return "\n".join(lines) + "\n"


def _garments() -> str:
    """A section of each garment: its picture and its file."""
    folder = ROOT / "drapery" / "garments" / "files"
    return "\n".join(
        f"## {path.stem}\n\n![{path.stem}](../pictures/garments/{path.stem}.png)\n\n"
        f"```toml\n{path.read_text(encoding='utf-8')}```\n"
        for path in sorted(folder.glob("*.toml"))
    )


def _live_gallery() -> str:
    """The page of `drapery web --gallery`, in a frame."""
    if not _has_kernels():
        return (
            "This site was built without the kernels of the element, so the gallery is missing.\n"
        )
    return f'<iframe class="gallery" src="{GALLERY}" title="Gallery of live cloth"></iframe>\n'


def commands() -> str:
    """A table of all commands, and a section of each with its options."""
    sections = list(_command("drapery", typer.main.get_command(command_line())))
    found = re.findall(r"(?m)^## (.+)\n\n(.+?)(?:\n|$)", "\n".join(sections))
    rows = [f"| [`{name}`](#{name.replace(' ', '-')}) | {_cell(text)} |" for name, text in found]
    return "\n".join(["| command | what it does |", "|---|---|", *rows, "", *sections])


def _command(path: str, command: Any) -> Iterator[str]:
    """A heading, the help and the options of a command or of its subcommands."""
    if hasattr(command, "commands"):
        for name, inner in command.commands.items():
            yield from _command(f"{path} {name}", inner)
        return
    own = [p for p in command.params if not _FLAGS.intersection(p.opts)]
    own.sort(key=lambda p: p.opts[0].startswith("-"))  # arguments come first
    rows = [_row(p) for p in own if p.name != "help"]
    yield f"## {path}\n\n{command.help}\n"
    if rows:
        yield "| option | meaning |\n|---|---|\n" + "\n".join(rows) + "\n"
    if flags := [f"`{p.opts[0]}`" for p in command.params if _FLAGS.intersection(p.opts)]:
        yield f"[Options of a picture](options.md): {', '.join(flags)}.\n"


def _row(parameter: Any) -> str:
    flags = ", ".join(f"`{flag}`" for flag in parameter.opts if flag.startswith("-"))
    name = flags or f"`{parameter.metavar or parameter.name.upper()}`"
    return f"| {name} | {_cell(parameter.help or '')} |"


def _pack_formats() -> str:
    """A table of the formats of packs, the newest first."""
    lines = ["| format | game | since | what changed |", "|---|---|---|---|"]
    for each in reversed(PACK_FORMATS):
        number = f"{each.number}.{each.minor}" if each.minor else str(each.number)
        lines.append(f"| {number} | {each.game} | {each.date} | {_cell(each.changed)} |")
    return "\n".join(lines) + "\n"


def _file_formats() -> str:
    """A table of the formats of files that are written, and of those that are only read."""
    lines = [
        "| format | ending | holds | transparency | limits | needs | contents |",
        "|---|---|---|---|---|---|---|",
    ]
    for each in FORMATS:
        if not each.kinds:
            continue
        pixels = {"still", "loop"}.intersection(each.kinds)
        limits = [f"{each.max_side} pixels a side"] if each.max_side else []
        limits += [f"{each.max_fps} frames/s"] if each.max_fps < MAX_FPS else []
        cells = (
            each.name,
            ", ".join(f"`{ending}`" for ending in each.endings),
            ", ".join(KIND_NAMES[kind] for kind in each.kinds),
            ALPHA[each.alpha] if pixels else "",
            ", ".join(limits),
            f"`{each.extra}`" if each.extra else "",
            each.about,
        )
        lines.append(f"| {' | '.join(map(_cell, cells))} |")
    read = [f"{each.name} (`{'`, `'.join(each.endings)}`)" for each in FORMATS if not each.kinds]
    return "\n".join(lines) + f"\n\nAlso read, where pictures are compared: {', '.join(read)}.\n"


def _cell(text: str) -> str:
    return text.replace("|", "\\|")


_FLAGS = {
    option.command_flag
    for table in (OPTIONS, LOOP_OPTIONS, PLAYER_OPTIONS)
    for option in table.values()
    if option.audience != "python"
}
TABLES: dict[str, Callable[[], str]] = {
    "options": lambda: _options(OPTIONS),
    "loop-options": lambda: _options(LOOP_OPTIONS),
    "player-options": lambda: _options(PLAYER_OPTIONS),
    "commands": commands,
    "garments": _garments,
    "live-gallery": _live_gallery,
    "pack-formats": _pack_formats,
    "file-formats": _file_formats,
}
