"""A picture on the page, on which the four corners of its flag can be clicked."""

from base64 import b64encode
from collections.abc import Awaitable, Callable, Sequence
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery.packs import Texels
from drapery.render import webp_bytes
from drapery.studio.widgets import set_props

LONGEST = 640
"""The longest side of the picture that is sent to the page [pixels]."""
QUALITY = 80
"""The quality of its colours."""
PLACE = "(e) => emit([e.offsetX / e.target.width, e.offsetY / e.target.height])"

Corner = tuple[float, float]


class PhotoCorners(Element):
    """The picture that was sent last. Four clicks on it are the corners of its flag.

    take: gets them in pixels of the picture: upper left, upper right, lower right, lower left, as
    they were clicked. The next click begins again.
    """

    def __init__(self, take: Callable[[Sequence[Corner]], Awaitable[None]]) -> None:
        super().__init__("div")
        self._take = take
        self._size = (1, 1)
        self._corners: list[Corner] = []
        self._marks: list[Element] = []
        self.classes("photo").set_visibility(False)
        with self:
            self._picture = ui.element("img").on("click", self._click, js_handler=PLACE)

    def show(self, pixels: Texels, name: str) -> None:
        """Show a picture, uint8 [H, W, 4], under the user's name of its file."""
        height, width = pixels.shape[:2]
        step = -(-max(height, width) // LONGEST)
        data = b64encode(webp_bytes(pixels[::step, ::step], quality=QUALITY)).decode()
        self._size = width, height
        set_props(self._picture, {"src": f"data:image/webp;base64,{data}", "alt": name})
        self._forget()
        self.set_visibility(True)

    def _forget(self) -> None:
        self._corners = []
        for mark in self._marks:
            mark.delete()
        self._marks = []

    async def _click(self, event: Any) -> None:
        across, down = (min(1.0, max(0.0, float(share))) for share in event.args)
        if len(self._corners) == 4:
            self._forget()
        self._corners.append((across * self._size[0], down * self._size[1]))
        with self:
            mark = ui.element("span").classes("photo-corner")
            mark.style(f"left: {100 * across:.2f}%; top: {100 * down:.2f}%")
        self._marks.append(mark)
        if len(self._corners) == 4:
            await self._take(self._corners)
