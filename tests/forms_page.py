"""The part of `docs/reference/forms.md` that is generated from the registry of forms.

`python tests/forms_page.py` writes it anew; a test compares the page with the registry.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Any

from drapery.banner import (
    FORMS,
    PATTERN_NAMES,
    Banner,
    BinaryForm,
    Form,
    Layer,
    binary_forms,
    write_banner,
)
from drapery.errors import DraperyError

PAGE = Path(__file__).parents[1] / "docs" / "reference" / "forms.md"


def texts() -> str:
    """A table of the forms of text, and an example of each; the most used are last recognised."""
    forms = list(reversed(FORMS.values()))
    rows = ["| form | what it is | read | written | source |", "|---|---|---|---|---|"]
    rows += [_row(form, form.title, form.write and _not_held(form)) for form in forms]
    examples = [f"`{form.name}`\n```\n{form.example}\n```" for form in forms]
    return "\n".join(rows) + "\n\n" + "\n\n".join(examples) + "\n"


def files() -> str:
    """A table of the forms of files."""
    rows = ["| form | what it is | read | written | source |", "|---|---|---|---|---|"]
    for form in binary_forms().values():
        endings = ", ".join(f"`{suffix}`" for suffix in form.suffixes)
        held = form.write and _shields(form.write)
        rows.append(_row(form, f"{form.title} ({endings})", held))
    return "\n".join(rows) + "\n"


def _row(form: Form | BinaryForm, title: str, lacks: str | None) -> str:
    written = "no" if form.write is None else f"yes, without {lacks}" if lacks else "yes"
    source = f"<{form.source}>" if form.source.startswith("http") else form.source
    return f"| `{form.name}` | {title} | yes | {written} | {source} |"


def _not_held(form: Form) -> str:
    """What the form refuses to write, found by trying each pattern, a shield and 16 layers."""

    def write(banner: Banner) -> str:
        return write_banner(banner, form.name)

    lacks = [_shields(write)]
    if not _can(write, Banner("red", (Layer("acme:anvil", "lime"),))):
        lacks.append("patterns of data packs")
    patterns = [
        name for name in PATTERN_NAMES if not _can(write, Banner("red", (Layer(name, "lime"),)))
    ]
    lacks += [f"`{name}`" for name in patterns]
    most = next(n for n in range(16, 0, -1) if _can(write, Banner("red", _layers(n))))
    lacks += [f"layers after the {most}th"] if most < 16 else []
    return ", ".join(filter(None, lacks))


def _layers(count: int) -> tuple[Layer, ...]:
    return (Layer("creeper", "lime"),) * count


def _shields(write: Callable[[Banner], Any]) -> str:
    return "" if _can(write, Banner("red", _layers(1), "shield")) else "shields"


def _can(write: Callable[[Banner], Any], banner: Banner) -> bool:
    try:
        write(banner)
    except DraperyError:
        return False
    return True


def generated(page: str) -> str:
    """The page with its two parts written anew."""
    for name, part in (("texts", texts()), ("files", files())):
        begin, end = f"<!-- begin: {name} -->\n", f"<!-- end: {name} -->"
        head, _, rest = page.partition(begin)
        _, _, tail = rest.partition(end)
        page = head + begin + part + end + tail
    return page


if __name__ == "__main__":
    PAGE.write_text(generated(PAGE.read_text("utf-8")), "utf-8")
