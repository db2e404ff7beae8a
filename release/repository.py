"""The address of the repository, which stands here alone: `python -m release.repository`.

The command writes it into the files that publish it. Without an address it takes the fields out,
and examples say `OWNER/drapery`, so that nothing names an address that may be somebody else's.
"""

import re
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

ROOT = Path(__file__).parent.parent
ADDRESS = ""
"""As https://github.com/NAME/drapery; empty until the project has an owner."""
PLACE = "OWNER/drapery"
"""What examples say without an address."""
USES = re.compile(r"((?:^|\s)- (?:uses: |repo: https://github\.com/))[\w.-]+/drapery\b")


class Fields(NamedTuple):
    """The lines of a file that hold the address, and the text before which they stand."""

    path: str
    lines: str
    before: str


FIELDS = (
    Fields(
        "pyproject.toml",
        '[project.urls]\nHomepage = "{0}"\nIssues = "{0}/issues"\n'
        'Changelog = "{0}/blob/main/CHANGELOG.md"\n\n',
        "# What each extra is for",
    ),
    Fields("CITATION.cff", "repository-code: {0}\n", "license: ["),
    Fields("CHANGELOG.md", "\n[Unreleased]: {0}/commits/main\n", ""),
)


def files(address: str) -> Iterator[tuple[Path, str]]:
    """Each file that may hold the address, and its text with this one, or without any if empty."""
    for path, lines, before in FIELDS:
        text = (ROOT / path).read_text("utf-8")
        held = re.escape(lines).replace(re.escape("{0}"), r"https://[\w./-]+?")
        text = re.sub(held, "", text)
        place = text.rindex(before)
        added = lines.format(address) if address else ""
        yield ROOT / path, text[:place] + added + text[place:]
    name = address.removeprefix("https://github.com/") or PLACE
    for path in examples():
        yield path, USES.sub(rf"\g<1>{name}", path.read_text("utf-8"))


def examples() -> list[Path]:
    """The pages and examples that use the action or the hook."""
    paths = [*ROOT.glob("docs/**/*.md"), *ROOT.glob("examples/*/.*.yaml")]
    paths += ROOT.glob("examples/*/.github/workflows/*.yml")
    return [path for path in sorted(paths) if USES.search(path.read_text("utf-8"))]


if __name__ == "__main__":
    for file, content in files(ADDRESS):
        file.write_text(content, encoding="utf-8", newline="\n")
