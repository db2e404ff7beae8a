"""Styles: how cloth is to look, as named chains of steps that anyone can write.

```python
from drapery import Banner, draw
from drapery.styles import Style, find_style

banner = Banner.parse("white creeper:lime border:black")
draw(banner, style="ink").save("ink.png")
draw(banner, style=Style.load("my.toml") | find_style("tattered")).save("mine.png")
```

A `Style` holds `StyleStep`s of four kinds. Each is a plain function with keyword parameters:

- `motion` steps change the positions of a `Piece` of cloth at all moments of a loop;
- `shape` steps change a `Piece` and its positions at one moment, or make a `Mesh` of them;
- `material` steps change the `Material` of the cloth;
- `picture` steps change a `Canvas`, the picture with its `Buffers` (depth, normal, model), or all
  canvases of a loop.

`STEPS` holds the functions that files of styles can name. Names are loaded when they are first
used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.settings import StyleLike as StyleLike
    from drapery.style.piece import Piece as Piece
    from drapery.styles.canvas import Canvas as Canvas
    from drapery.styles.catalogue import (
        combined_style as combined_style,
        find_style as find_style,
        style_names as style_names,
    )
    from drapery.styles.step import (
        StepKind as StepKind,
        StyleStep as StyleStep,
        over_time as over_time,
    )
    from drapery.styles.steps import STEPS as STEPS
    from drapery.styles.style import Style as Style
else:
    import_lazily(__name__)
