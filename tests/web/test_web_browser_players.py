"""Players with capes and elytra in a real browser: they move, and wear textures of the page."""

import base64
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from PIL import Image
from studio_browser import wait_until
from web_sites import CANVAS, changes, first_picture, is_live, open_site, served, warnings

from drapery.settings import Settings
from drapery.web import package

CAPE = "document.querySelector('drapery-cape')"
ELYTRA = "document.querySelector('drapery-elytra')"
PAGE = """<!doctype html><html lang="en"><title>Players</title>
<script type="module" src="drapery-banner.js"></script><main>
<drapery-cape cape="{cape}" skin="{skin}" direction="180"></drapery-cape>
<drapery-elytra></drapery-elytra>
<drapery-cape id="bad" cape="missing.png"><img alt="My cape" src="{cape}"></drapery-cape>
</main></html>
"""


def data_url(texels: np.ndarray) -> str:
    """A picture as an address."""
    file = io.BytesIO()
    Image.fromarray(texels).save(file, "PNG")
    return f"data:image/png;base64,{base64.b64encode(file.getvalue()).decode()}"


@pytest.fixture(scope="module")
def players(playable: Any, tmp_path_factory: pytest.TempPathFactory) -> Iterator[str]:
    """The address of a page with players."""
    folder: Path = tmp_path_factory.mktemp("players")
    settings: Settings = playable(size=(320, 480))
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(package, "POSES", {"walk": 1.5})
        package.write_component(folder, settings)
    cape, skin = np.zeros((32, 64, 4), np.uint8), np.full((64, 64, 4), 255, np.uint8)
    cape[:] = 200, 0, 200, 255
    skin[...] = 0, 200, 0, 255
    skin[20:32, 54:56] = 0
    text = PAGE.format(cape=data_url(cape), skin=data_url(skin))
    (folder / "players.html").write_text(text, encoding="utf-8")
    yield from served(folder)


def test_a_cape_and_elytra_move_in_the_textures_of_the_page(chromium: Any, players: str) -> None:
    open_site(chromium, f"{players}/players.html", ready=False)
    wait_until(lambda: is_live(chromium, CAPE) and is_live(chromium, ELYTRA))
    before = {name: first_picture(chromium, name) for name in (CAPE, ELYTRA)}
    red, green, blue, _ = np.moveaxis(before[CAPE].astype(int), -1, 0)
    assert 0.02 < ((red > 60) & (green < 20) & (blue > 60)).mean() < 0.4, "the cape is violet"
    assert 0.02 < ((red < 20) & (green > 60) & (blue < 20)).mean() < 0.6, "the skin is green"
    for name, picture in before.items():
        wait_until(lambda name=name, picture=picture: changes(chromium, picture, name))
    assert chromium.execute_script(f"return {CAPE}.{CANVAS}.ariaLabel") == "player with cape"
    bad = "document.querySelector('#bad')"
    assert chromium.execute_script(f"return {bad}.querySelector('img').checkVisibility()")
    lines = [line for line in warnings(chromium) if "missing.png" in line]
    assert len(lines) == 1 and "cannot be loaded" in lines[0]
