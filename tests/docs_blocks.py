"""The code blocks of the docs, and how a test types them as a reader does.

Every command must end with exit code 0, as under `set -e`. A comment before a block says what is
special: `<!-- exit 1 -->` is the exit code of its last command, and with `<!-- not run: REASON -->`
only the options of its commands are checked. A block with `title="NAME"` is saved under this name.
"""

import os
import re
import runpy
import shlex
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import typer.main
from markdown_it import MarkdownIt

from drapery.commands.app import command_line

ROOT = Path(__file__).parent.parent
DOCS = ROOT / "docs"
SHELL = ("", "sh", "console")
BY_HAND = {
    "pip": "it installs",
    ".": "it is for one shell",
    "python -m venv": "it makes an environment",
    "npm": "`python -m release.check_npm` runs it",
    "npx": "`python -m release.check_npm` runs it",
    "dask ssh": "it needs other machines",
    "python -m http.server": "it does not end by itself",
    "drapery studio": "it does not end by itself",
    "drapery web": "it needs the kernels of pages, which take two minutes to compile",
    "drapery player --skin skin.png --cape cape.png --motion run --speed 4 --rotation 7": (
        "it writes a page, see `drapery web`"
    ),
    "drapery batch guilds.csv": "it needs four processes, a scheduler or an object store",
    "drapery gallery": "it draws for two minutes",
    "drapery scene freefall": "it draws for half a minute",
    "drapery scene blocky": "it draws for ten seconds",
    "drapery garment poncho": "it draws for ten seconds",
    "drapery match painting.webp": "it searches twelve banners for half a minute",
    "drapery match flag.jpg": "it searches as the command before it does",
    "drapery match screenshot.png --corners": "it searches as the command after it does",
    'drapery animate "red gradient:black" --style cel': "it draws for ten seconds",
    "drapery player --skin dancer --wear skirt --wear scarf": "it draws for half a minute",
    "drapery sheet players": "it draws for twenty seconds",
}
"""How the commands begin that no test runs, and why. They are typed by hand before a release."""

TYPED = (
    *("docker", "drapery", "just", "npm", "npx", "pip", "podman", "properdocs", "pytest", "python"),
    *("rattler-build", "ruff"),
)
"""What pages tell every reader to type."""
OTHER = re.compile(r"&&|\\$|\$\(|^[^\"]*'|^(?:[^\"#]|\"[^\"]*\")*,")
"""What cmd and PowerShell 5.1 do not know: `&&` and a backslash, and cmd single quotes.

PowerShell makes several words of a bare one with commas.
"""


@dataclass(frozen=True)
class Block:
    """A fenced block. line: of its opening fence. note: the comment before it."""

    line: int
    language: str
    title: str
    note: str
    text: str

    @property
    def is_run(self) -> bool:
        return not self.note.startswith("not run: ")

    @property
    def exit_code(self) -> int:
        found = re.fullmatch(r"exit (\d+)", self.note)
        return int(found[1]) if found else 0


def blocks(page: Path) -> Iterator[Block]:
    """The fenced blocks of a page in their order."""
    note = ""
    for token in MarkdownIt().parse(page.read_text("utf-8")):
        if token.type == "html_block":
            note = token.content.strip().removeprefix("<!--").removesuffix("-->").strip()
        elif token.type == "code_block":
            yield Block(token.map[0] if token.map else 0, "", "", note, token.content)
        elif token.type == "fence":
            language, _, more = token.info.strip().partition(" ")
            title = re.search(r'title="([^"]+)"', more)
            line = token.map[0] + 1 if token.map else 0
            yield Block(line, language, title[1] if title else "", note, token.content)
            note = ""
        elif token.level == 0:
            note = ""


def commands(text: str) -> list[tuple[str, str]]:
    """The commands of a block, and what each is said to print; a `$` begins those of a terminal."""
    text = text.replace("\\\n", "")
    if not text.startswith("$ "):
        return [(line, "") for line in text.splitlines() if line.strip()]
    pairs = (part.partition("\n") for part in re.split(r"(?m)^\$ ", text)[1:])
    return [(command, output) for command, _, output in pairs]


def check_command(line: str) -> None:
    """Check the names and values of a command's options. Raises an error of typer."""
    program, *words = shlex.split(line.rpartition("&& ")[2], comments=True)
    if program != "drapery":
        return
    command: Any = typer.main.get_command(command_line())
    name = "drapery"
    while hasattr(command, "commands"):
        name, *words = words
        command = command.commands[name]
    command.make_context(name, list(words))


def is_for_one_shell(line: str) -> bool:
    """Whether a command, or options of one, cannot be typed in each of the three shells."""
    if re.match(r"[A-Z_]+=\S+ +\w", line):
        return True
    return (line.partition(" ")[0] in TYPED or line.startswith("--")) and bool(OTHER.search(line))


def prints(said: str, printed: str) -> bool:
    """Whether a text is what a page says, where `...` stands for anything."""
    parts = said.rstrip("\n").replace("...\n", "...").split("...")
    pattern = "(?s:.*)".join(map(re.escape, parts))
    return re.fullmatch(pattern, printed.rstrip("\n")) is not None


@dataclass
class Reader:
    """Types blocks in a folder. drapery: runs a command line and returns code, output, errors."""

    folder: Path
    drapery: Callable[..., tuple[int, str, str]]
    names: dict[str, Any] = field(default_factory=lambda: {"__name__": "docs"})

    def type(self, page: Path, block: Block) -> None:
        """Run a block, or save it, or check its commands."""
        where = f"{page.name}, line {block.line}"
        if block.title:
            path = self.folder / block.title
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(block.text, "utf-8")
        elif block.language == "python":
            code = compile("\n" * block.line + block.text, str(page), "exec")
            if block.is_run:
                exec(code, self.names)
        elif block.language in SHELL:
            *first, last = commands(block.text)
            for command in first:
                self.type_command(where, block, *command, code=0)
            self.type_command(where, block, *last, code=block.exit_code)

    def type_command(self, where: str, block: Block, line: str, said: str, code: int) -> None:
        """Run or check a command that is to end with a code and to print what a page says."""
        if not block.is_run or any(f"{line} ".startswith(f"{each} ") for each in BY_HAND):
            check_command(line)
            return
        found, printed = self.run(line)
        assert found == code, f"{where}: {line}\nends with {found}, not {code}:\n{printed}"
        # Pages write paths with slashes.
        if said and not prints(said, printed.replace(os.sep, "/")):
            raise AssertionError(f"{where}: {line}\nprints\n{printed}")

    def run(self, line: str) -> tuple[int, str]:
        """The exit code of a command and what it prints."""
        program, *words = shlex.split(line.rpartition("&& ")[2], comments=True)
        if program == "drapery":
            code, out, err = self.drapery(*words)
            return code, err + out
        if program == "python":
            runpy.run_path(str(self.folder / words[0]), run_name="__main__")
            return 0, ""
        assert program == "pytest", f"the tests cannot run {line}"
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *words]
        done = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, timeout=120)
        return done.returncode, done.stdout + done.stderr
