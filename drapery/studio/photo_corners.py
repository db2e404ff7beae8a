"""A picture on the page, on which the four corners of its flag are clicked, or moved by keys."""

from base64 import b64encode
from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery.arrays import Texels
from drapery.render import webp_bytes
from drapery.studio.translation import translated
from drapery.studio.widgets import KeptElements, button, hint, on, set_props

LONGEST = 640
"""The longest side of the picture that is sent to the page [pixels]."""
QUALITY = 80
"""The quality of its colours."""
CORNERS = "Upper left corner", "Upper right corner", "Lower right corner", "Lower left corner"
STEP = 0.01
"""How far an arrow key moves a corner, as a share of the picture; with Shift, ten times as far."""
PLACE = "(e) => emit([e.offsetX / e.target.width, e.offsetY / e.target.height])"
KEY = """(e) => {
  const arrows = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]};
  const steps = {...arrows, Enter: []}[e.key];
  if (!steps) return;
  e.preventDefault();
  emit(steps.map((each) => each * (e.shiftKey ? 10 : 1)));
}"""

Corner = tuple[float, float]


class PhotoCorners(Element):
    """The picture that was sent last. Four clicks on it are the corners of its flag.

    Each corner can be moved with the arrow keys, and Enter takes them; a button places all four for
    who clicks none.

    take: gets them in pixels of the picture: upper left, upper right, lower right, lower left, as
    they were clicked. The next click begins again.
    """

    def __init__(self, take: Callable[[Sequence[Corner]], Awaitable[None]]) -> None:
        super().__init__("div")
        self._take = take
        self._size = (1, 1)
        self._corners: list[Corner] = []
        self.set_visibility(False)
        with self:
            with ui.element("div").classes("line"):
                text = "Place four corners"
                button(text, self._place, text=text)
                hint("Arrow keys move a corner, with Shift ten times as far; Enter takes them.")
            with ui.element("div").classes("photo"):
                self._picture = ui.element("img").on("click", self._click, js_handler=PLACE)
                self._marks: KeptElements[Element] = KeptElements(ui.element("div"))

    def show(self, pixels: Texels, name: str) -> None:
        """Show a picture, uint8 [H, W, 4], under the user's name of its file."""
        height, width = pixels.shape[:2]
        step = -(-max(height, width) // LONGEST)
        data = b64encode(webp_bytes(pixels[::step, ::step], quality=QUALITY)).decode()
        self._size = width, height
        set_props(self._picture, {"src": f"data:image/webp;base64,{data}", "alt": name})
        self._set_corners([])
        self.set_visibility(True)

    def _mark(self, number: int) -> Element:
        """A corner that has the focus tells a screen reader its place whenever that changes."""
        mark = ui.element("span").classes("photo-corner").props("role=slider tabindex=0")
        mark.props.update({"aria-label": translated(CORNERS[number]), "data-corner": number})
        return on(mark, "keydown", partial(self._press, number), js_handler=KEY)

    def _set_corners(self, corners: Sequence[Corner]) -> None:
        """Show corners, whose places are shares of the picture's sides."""
        self._corners = [*corners]
        marks = {number: partial(self._mark, number) for number in range(len(corners))}
        for mark, corner in zip(self._marks.show(marks), corners, strict=True):
            left, top = (round(100 * share) for share in corner)
            place = translated("{left} % from the left, {top} % from the top")
            text = place.format(left=left, top=top)
            style = f"left: {100 * corner[0]}%; top: {100 * corner[1]}%"
            set_props(mark, {"style": style, "aria-valuenow": left, "aria-valuetext": text})

    def _place(self) -> None:
        self._set_corners([(0.25, 0.25), (0.75, 0.25), (0.75, 0.75), (0.25, 0.75)])

    async def _press(self, number: int, steps: Any) -> None:
        """Move a corner by steps to the right and down; by none, take all."""
        if not steps:
            await self._take_all()
            return
        moved = zip(self._corners[number], steps, strict=True)
        across, down = (_share(share + STEP * float(by)) for share, by in moved)
        self._set_corners([*self._corners[:number], (across, down), *self._corners[number + 1 :]])

    async def _click(self, event: Any) -> None:
        across, down = map(_share, event.args)
        before = self._corners if len(self._corners) < len(CORNERS) else []
        self._set_corners([*before, (across, down)])
        await self._take_all()

    async def _take_all(self) -> None:
        width, height = self._size
        if len(self._corners) == len(CORNERS):
            await self._take([(across * width, down * height) for across, down in self._corners])


def _share(value: Any) -> float:
    return min(1.0, max(0.0, float(value)))
