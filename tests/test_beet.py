"""The beet plugin in a real beet project: previews, goldens, and a build that fails."""

import json
from pathlib import Path

import numpy as np
import pytest
from beet import BannerPattern, ErrorMessage, Texture, run_beet
from PIL import Image

# Packs of one pattern take all else from our own art, and say so.
pytestmark = [
    pytest.mark.filterwarnings("ignore:not in .* taken from our own art"),
    pytest.mark.filterwarnings("ignore:no texture comes from"),
]


def project(folder: Path, **options: object) -> dict[str, object]:
    """A project with one new pattern and one pattern of the game that is redrawn."""
    sprite = np.zeros((64, 64, 4), np.uint8)
    sprite[10:30, 4:40] = 255
    ours = folder / "assets/loom/textures/entity/banner/knot.png"
    game = folder / "assets/minecraft/textures/entity/banner/creeper.png"
    for path in (ours, game):
        path.parent.mkdir(parents=True, exist_ok=True)
        if not path.exists():
            Image.fromarray(sprite).save(path)
    pattern = folder / "data/loom/banner_pattern/knot.json"
    pattern.parent.mkdir(parents=True, exist_ok=True)
    pattern.write_text(json.dumps({"asset_id": "loom:knot", "translation_key": "loom.knot"}))
    meta = {"drapery": {"size": [48, 64], **options}}
    return {
        "resource_pack": {"load": ["."]},
        "data_pack": {"load": ["."]},
        "pipeline": ["drapery.beet"],
        "meta": meta,
    }


def build(folder: Path, **options: object) -> None:
    with run_beet(project(folder, **options), directory=folder) as ctx:
        assert "loom:knot" in ctx.data[BannerPattern]
        assert "loom:entity/banner/knot" in ctx.assets[Texture]


def test_previews_goldens_and_a_failing_build(tmp_path: Path) -> None:
    build(tmp_path, goldens="goldens", update=True, designs={"both": "red loom:knot:white"})
    names = {path.name for path in (tmp_path / "previews").iterdir()}
    assert names == {"loom-knot.png", "creeper.png", "both.png"}
    with Image.open(tmp_path / "previews/loom-knot.png") as preview:
        assert preview.size == (48, 64)
        assert (np.asarray(preview)[..., :3].max(axis=-1) < 40).any()  # the black pattern shows
    kept = (tmp_path / "goldens/loom-knot.png").read_bytes()
    build(tmp_path, goldens="goldens", designs={"both": "red loom:knot:white"})

    sprite = tmp_path / "assets/loom/textures/entity/banner/knot.png"
    texels = np.asarray(Image.open(sprite)).copy()
    texels[20, 10] = 0
    Image.fromarray(texels).save(sprite)
    with pytest.raises(ErrorMessage, match=r"layer 1 \(loom:knot, black\) has 1 changed texel"):
        build(tmp_path, goldens="goldens")
    assert (tmp_path / "drapery-report/index.html").exists()
    assert (tmp_path / "goldens/loom-knot.png").read_bytes() == kept


def test_bad_options_stop_the_build_in_one_line(tmp_path: Path) -> None:
    with pytest.raises(ErrorMessage, match="view 'below' is not known"):
        build(tmp_path, view="below")


def test_patterns_whose_names_are_cleaned_alike_have_pictures_of_their_own(tmp_path: Path) -> None:
    designs = {"a/b": "red", "a:b": "blue", "A/b": "lime", "c": "white"}
    build(tmp_path, designs=designs)
    names = sorted(path.name for path in (tmp_path / "previews").iterdir())
    assert len(names) == 6 and "c.png" in names
    assert len({name.lower() for name in names}) == 6
