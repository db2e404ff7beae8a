"""`drapery doctor`: versions, which backends work, and remedies for those that do not."""

import platform
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console


def run() -> None:
    """Report what works on this machine, with a remedy for each part that does not."""
    from importlib.metadata import version

    from rich.console import Console
    from rich.markup import escape

    import drapery
    from drapery.render.doctor import backend_report

    console = Console(highlight=False)
    console.print(f"drapery {drapery.__version__}, Python {platform.python_version()}")
    for name in ("numpy", "numba", "pillow", "trimesh"):
        console.print(f"  {name} {version(name)}")
    _say_where_kernels_are(console)
    for backend in backend_report():
        mark = "[green]works[/]" if backend.works else "[yellow]does not work[/]"
        console.print(f"backend {backend.name}: {mark} ({escape(backend.detail)})", soft_wrap=True)
        if backend.remedy:
            console.print(f"  to mend it: {escape(backend.remedy)}", soft_wrap=True)


def _say_where_kernels_are(console: "Console") -> None:
    from rich.markup import escape

    from drapery.jit import compiler_fault
    from drapery.jit.kernel_cache import REMEDY, kernel_cache_status

    if fault := compiler_fault():
        line = f"kernels: [yellow]cannot be compiled[/]\n  to mend it: {escape(fault)}"
        console.print(line, soft_wrap=True)
    status = kernel_cache_status()
    if status.folder is not None:
        line = f"[green]kept[/] in {escape(str(status.folder))}"
    else:
        line = f"[yellow]not kept[/] ({escape(status.reason)})\n  to mend it: {escape(REMEDY)}"
    console.print(f"compiled kernels: {line}", soft_wrap=True)
