"""The component's modules of JavaScript as one.

The modules import each other only by names in braces, and no two have a top-level name in common,
so their texts in the order of their imports are one module. A test checks both.
"""

import base64
import json
import re
from collections.abc import Iterable, Mapping, Sequence
from graphlib import TopologicalSorter
from pathlib import Path

WEB = Path(__file__).parent
ENTRY = WEB / "component" / "element.js"
DESIGNER_ENTRY = WEB / "designer" / "element.js"
ELEMENTS = ("DraperyBanner", "DraperyCape", "DraperyElytra", "DraperyPlayer")
PUBLIC = ("DesignError", *ELEMENTS, "readDesign")
"""What the module exports."""
DESIGNER_PUBLIC = ("DraperyDesigner", *PUBLIC)
"""What the designer's module exports."""
NO_PLACES = "const PLACES = {};"
"""The table of files in `places.js`, which a module of a package fills."""

_IMPORT = re.compile(r'^import \{[^}]*\} from "([^"]+)";\n', re.MULTILINE)
_EXPORT = re.compile(r"^export (?=async function|function|class|const)", re.MULTILINE)
_COMMENT = re.compile(r"^\s*(//.*|/\*\*([^*]|\*(?!/))*\*/)\n", re.MULTILINE)


def bundled_module(
    entry: Path = ENTRY,
    public: Sequence[str] = PUBLIC,
    places: Mapping[str, str] | None = None,
    more: Sequence[Path] = (),
) -> str:
    """The text of one module that has all that a module, and `more` of them, import, without
    comments.

    places: see `beside` and `within`; a page that holds its files itself has none.
    """
    imports: dict[Path, list[Path]] = {}
    unseen = [each.resolve() for each in (entry, *more)]
    while unseen:
        module = unseen.pop()
        if module not in imports:
            names = _IMPORT.findall(module.read_text(encoding="utf-8"))
            imports[module] = [(module.parent / name).resolve() for name in names]
            unseen += imports[module]
    order = TopologicalSorter(imports).static_order()
    inner = [_inner(module.read_text(encoding="utf-8")) for module in order]
    text = "".join([*inner, f"export {{ {', '.join(public)} }};\n"])
    lines = [f"  {json.dumps(name)}: {place},\n" for name, place in (places or {}).items()]
    return text.replace(NO_PLACES, f"const PLACES = {{\n{''.join(lines)}}};") if lines else text


def beside(names: Iterable[str]) -> dict[str, str]:
    """The places of files beside a module, as expressions that bundlers find."""
    return {name: f"() => new URL({json.dumps(f'./{name}')}, import.meta.url)" for name in names}


def within(files: Mapping[str, bytes]) -> dict[str, str]:
    """The places of files that the module holds itself."""
    return {name: json.dumps(base64.b64encode(data).decode()) for name, data in files.items()}


def _inner(text: str) -> str:
    plain = _EXPORT.sub("", _IMPORT.sub("", _COMMENT.sub("", text)))
    return re.sub(r"\n{2,}", "\n", plain).strip() + "\n"
