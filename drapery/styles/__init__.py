"""Styles: how cloth is to look, as named chains of steps that anyone can write.

```python
from drapery import Banner, draw
from drapery.styles import Style, find_style

banner = Banner.parse("white creeper:lime border:black")
draw(banner, style="ink").save("ink.png")
draw(banner, style=Style.load("my.toml") | find_style("tattered")).save("mine.png")
```

A `Style` holds `StyleStep`s of four kinds. Each is a plain function with keyword parameters:

- `motion` steps change a `Sheet` of all moments of a loop;
- `shape` steps change the `Sheet` of one moment, or make a `Mesh` of it;
- `material` steps change the `Material` of the cloth;
- `picture` steps change a `Canvas`, the picture with its `Buffers` (depth, normal, model), or all
  canvases of a loop.

`STEPS` holds the functions that files of styles can name. Names are loaded when they are first
used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.settings import StyleLike
    from drapery.style.sheet import Sheet
    from drapery.styles.canvas import Canvas
    from drapery.styles.catalogue import combined_style, find_style, style_names
    from drapery.styles.step import StepKind, StyleStep, over_time
    from drapery.styles.steps import STEPS
    from drapery.styles.style import Style

__all__ = [
    "STEPS",
    "Canvas",
    "Sheet",
    "StepKind",
    "Style",
    "StyleLike",
    "StyleStep",
    "combined_style",
    "find_style",
    "over_time",
    "style_names",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "settings": ("StyleLike",),
        "styles.canvas": ("Canvas",),
        "styles.catalogue": ("combined_style", "find_style", "style_names"),
        "style.sheet": ("Sheet",),
        "styles.step": ("StepKind", "StyleStep", "over_time"),
        "styles.steps": ("STEPS",),
        "styles.style": ("Style",),
    },
)
