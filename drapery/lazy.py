"""Public names of a package that are imported at their first use (PEP 562).

`drapery --help` must not wait for numba, nor a user of one name for the modules of all others. A
package says each name once, as type checkers read it:

    if TYPE_CHECKING:
        from drapery.settings import Settings as Settings
    else:
        import_lazily(__name__)
"""

import sys
from collections.abc import Iterator
from dis import get_instructions
from importlib import import_module
from types import CodeType
from typing import Any

OWN = "drapery."
"""What the names of modules begin with whose names a package passes on."""


def import_lazily(package: str) -> None:
    """Import each public name of a package at its first use; also set `__all__` and `dir`.

    package: its `__name__`. It is called by the module itself, after its imports for type checkers.
    """
    module = sys.modules[package]
    # Compiled code has the imports for type checkers too, though they do not run. Names of imports
    # that ran are the package's own affair.
    imports = _imports(sys._getframe(1).f_code)
    module_of = {name: source for name, source in imports if name not in vars(module)}

    def get_attribute(name: str) -> Any:
        if name not in module_of:
            raise AttributeError(f"module {package!r} has no attribute {name!r}")
        value = getattr(import_module(module_of[name]), name)
        setattr(module, name, value)
        return value

    names = sorted(module_of)
    vars(module).update(__all__=names, __getattr__=get_attribute, __dir__=lambda: names)


def _imports(code: CodeType) -> Iterator[tuple[str, str]]:
    """Each name that the code imports from a module of ours, and the module."""
    source = ""
    for each in get_instructions(code):
        if each.opname == "IMPORT_NAME":
            source = each.argval
        elif each.opname == "IMPORT_FROM" and source.startswith(OWN):
            yield each.argval, source
