"""A picture on the page, on which the four corners of its flag can be clicked."""

from base64 import b64encode
from collections.abc import Awaitable, Callable, Sequence
from functools import partial
from typing import Any

from nicegui import ui
from nicegui.element import Element

from drapery.arrays import Texels
from drapery.render import webp_bytes
from drapery.studio.widgets import KeptElements, set_props

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
        self.classes("photo").set_visibility(False)
        with self:
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

    def _mark(self, corner: Corner) -> Element:
        left, top = (100 * at / side for at, side in zip(corner, self._size, strict=True))
        return ui.element("span").classes("photo-corner").style(f"left: {left}%; top: {top}%")

    def _set_corners(self, corners: Sequence[Corner]) -> None:
        self._corners = [*corners]
        self._marks.show({place: partial(self._mark, place[1]) for place in enumerate(corners)})

    async def _click(self, event: Any) -> None:
        across, down = (min(1.0, max(0.0, float(share))) for share in event.args)
        before = self._corners if len(self._corners) < 4 else []
        self._set_corners([*before, (across * self._size[0], down * self._size[1])])
        if len(self._corners) == 4:
            await self._take(self._corners)
