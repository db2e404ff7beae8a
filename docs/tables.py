"""The parts of pages that are generated, so that they read well where they lie in a checkout.

`python docs/tables.py` writes each anew between `<!-- begin: NAME -->` and `<!-- end: NAME -->`; a
test compares. NAME is one of `TABLES`, or `python MODULE` for the public names of a module.
"""

import ast
import re
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Any

import typer.main
from public_names import PACKAGES
from python_names import names_of

from drapery.commands.app import command_line
from drapery.file_formats import FORMATS, KIND_NAMES, MAX_FPS
from drapery.option import Option
from drapery.packs import PACK_FORMATS
from drapery.player_settings import PLAYER_OPTIONS
from drapery.settings import LOOP_OPTIONS, OPTIONS

ROOT = Path(__file__).resolve().parent.parent
PART = re.compile(r"<!-- begin: (.+) -->\n(?s:.*?)<!-- end: \1 -->")
ALPHA = {"full": "half too", "bit": "whole only", "none": "none"}
QUOTES = '"""'
SHORT = 15
"""The most lines of an example that a page shows whole."""
AUDIENCES = {"anyone": "yes", "local": "no", "python": "Python only"}


def pages() -> Iterator[tuple[Path, str]]:
    """Each page with generated parts, and its text with these made anew."""
    for path in sorted((ROOT / "docs").glob("**/*.md")):
        text = path.read_text(encoding="utf-8")
        if set(PART.findall(text)) - FORMS:
            yield path, PART.sub(_part, text)


def _part(found: re.Match[str]) -> str:
    name = found[1]
    if name in FORMS:
        return found[0]
    kind, _, module = name.partition(" ")
    text = names_of(module) if kind == "python" else TABLES[name]()
    return f"<!-- begin: {name} -->\n{text}<!-- end: {name} -->"


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


def _examples() -> str:
    """A section of each short program: what it says of itself, and its lines."""
    texts = {path: path.read_text("utf-8") for path in sorted((ROOT / "examples").glob("*.py"))}
    return "\n".join(
        f"## {path.stem}\n\n{ast.get_docstring(ast.parse(text))}\n\n"
        f'```python title="{path.name}"\n{text.split(QUOTES, 2)[2].strip()}\n```\n'
        for path, text in texts.items()
        if len([line for line in text.splitlines() if line.strip()]) <= SHORT
    )


def _packages() -> str:
    """A table of the public packages, with links to the reference of each."""
    rows = [
        f"| [{name}](python/{name.rpartition('.')[2]}.md) | {text} |"
        for name, text in PACKAGES.items()
    ]
    return "\n".join(["| package | what it holds |", "|---|---|", *rows, ""])


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
    "examples": _examples,
    "garments": _garments,
    "packages": _packages,
    "pack-formats": _pack_formats,
    "file-formats": _file_formats,
}
FORMS = {"texts", "files"}
"""The parts that `tests/forms_page.py` writes."""


if __name__ == "__main__":
    for file, content in pages():
        file.write_text(content, encoding="utf-8", newline="\n")
