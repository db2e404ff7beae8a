"""`drapery doctor`: versions, which backends work, and what would mend those that do not."""

import platform
from importlib.metadata import version


def run() -> None:
    """Say what works on this machine and, where something does not, the line that mends it."""
    from rich.console import Console
    from rich.markup import escape

    from drapery.render.doctor import backend_report

    console = Console(highlight=False)
    console.print(f"drapery {version('drapery')}, Python {platform.python_version()}")
    for name in ("numpy", "numba", "pillow", "trimesh"):
        console.print(f"  {name} {version(name)}")
    for backend in backend_report():
        mark = "[green]works[/]" if backend.works else "[yellow]does not work[/]"
        console.print(f"backend {backend.name}: {mark} ({escape(backend.detail)})", soft_wrap=True)
        if backend.remedy:
            console.print(f"  to mend it: {escape(backend.remedy)}", soft_wrap=True)
