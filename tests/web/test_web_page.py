"""Pages and packages with live cloth: what is in their files, and what is refused."""

import base64
import gzip
import json
import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from conftest import Run
from node_program import NODE, run_node

from drapery import Banner, OptionError
from drapery.packs import open_packs
from drapery.render import VIEWS
from drapery.scenes import StagedBody, played_body
from drapery.settings import Settings
from drapery.style import body_of
from drapery.web import package, page
from drapery.web.bundle import DESIGNER_ENTRY, DESIGNER_PUBLIC, ENTRY, beside, bundled_module
from drapery.web.gallery import ITEMS, gallery_text
from drapery.web.messages import unpack
from drapery.web.scene_file import fabric_bytes, pictured_scene, scene_bytes
from drapery.web.tables import languages
from drapery.web.wasm.plan import plans_of

DESIGN = Banner.parse("white creeper:lime border:black")
SIZE = (320, 480)
STUDIO = ENTRY.parents[2] / "studio"
Playable = Callable[..., Settings]


def files_of(text: str) -> dict[str, bytes]:
    """The files in a page, by name."""
    found = re.findall(r'data-drapery="([\w.-]+)">([^<]*)</script>', text)
    return {name: gzip.decompress(base64.b64decode(data)) for name, data in found}


@pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")
def test_the_bundle_is_one_module_that_imports_nothing(tmp_path: Path) -> None:
    text = bundled_module()
    assert "import {" not in text and "</script" not in text
    names = "DesignError, DraperyBanner, DraperyCape, DraperyElytra, DraperyPlayer, readDesign"
    assert text.endswith(f"export {{ {names} }};\n")
    (tmp_path / "bundle.mjs").write_text(text, encoding="utf-8")
    run_node("--check", tmp_path / "bundle.mjs")


@pytest.mark.parametrize(
    ("entry", "public"),
    [(DESIGNER_ENTRY, DESIGNER_PUBLIC), (STUDIO / "live_viewer.js", ("LiveViewer",))],
)
def test_no_two_modules_of_a_bundle_share_a_name(entry: Path, public: tuple[str, ...]) -> None:
    text = bundled_module(entry, public)
    names = re.findall(r"^(?:async )?(?:function|class|const|let) (\w+)", text, re.M)
    assert "</script" not in text, "a page may hold it"
    assert len(set(names)) == len(names) and not re.search(r"^import |^\s*/\*\*.*\*/$", text, re.M)


def test_the_bundle_has_every_module_that_the_element_imports() -> None:
    text = bundled_module()
    for module in [*ENTRY.parent.glob("*.js"), *(ENTRY.parent.parent / "wasm").glob("*.js")]:
        for name in re.findall(r"^export (?:class|function|const) (\w+)", module.read_text(), re.M):
            assert re.search(rf"^(class|function|async function|const) {name}\b", text, re.M), name


def test_a_scene_begins_as_the_cloth_hangs(playable: Playable) -> None:
    packs, settings = open_packs(()), playable(size=SIZE)
    header, arrays = unpack(gzip.decompress(scene_bytes(DESIGN, packs, settings)))
    staged = StagedBody(body_of(DESIGN, packs, settings), settings, curves=False)
    meshes = np.concatenate([mesh.positions for mesh in staged.at_rest()])
    np.testing.assert_array_equal(arrays["positions"], meshes.astype(np.float32).reshape(-1))
    ((first, count),) = header["grip"]
    assert first + count == header["vertices"] == len(meshes)
    assert header["sheets"][:2] == ["", "base"] and len(header["sheets"]) == 44
    assert len(arrays["plan0"]) > 1000


def test_a_style_of_materials_keeps_the_design_of_the_page(
    playable: Playable, tmp_path: Path
) -> None:
    (tmp_path / "old.toml").write_text('[[material]]\nstep = "age"\n', encoding="utf-8")
    settings = playable(size=SIZE, style=str(tmp_path / "old.toml"))
    header, arrays = unpack(gzip.decompress(scene_bytes(DESIGN, open_packs(()), settings)))
    flag = arrays["vertexMaterials"][header["grip"][0][0]]
    assert header["sheets"] is None and arrays["materials"].reshape(-1, 4)[flag, 1] == 1
    with pytest.raises(OptionError, match="the package shows any design"):
        package.write_component(tmp_path / "dist", settings)


@pytest.mark.parametrize("fabric", ["wool", "silk", "leather"])
def test_the_plans_of_all_fabrics_are_one_small_file(playable: Playable, fabric: str) -> None:
    packs, settings = open_packs(()), playable(size=SIZE)
    packed = fabric_bytes(packs, settings)
    assert len(packed) < 20_000
    _, plans = unpack(gzip.decompress(packed))
    own, wanted = (
        plans_of(played_body(body_of(DESIGN, packs, each), each))[0]
        for each in (settings, settings.changed(fabric=fabric))
    )
    found = plans[fabric] ^ np.frombuffer(own.ljust(len(plans[fabric]), b"\0"), np.uint8)
    assert found.tobytes().rstrip(b"\0") == wanted


def test_a_scene_has_the_cameras_and_the_light_of_python(playable: Playable) -> None:
    packs, settings = open_packs(()), playable(size=SIZE)
    header, _ = unpack(gzip.decompress(scene_bytes(DESIGN, packs, settings)))
    assert list(header["views"]) == list(VIEWS)
    assert header["views"]["front"] == header["camera"]
    dark = playable(size=SIZE, daylight=0.3, view="iso")
    other, _ = unpack(gzip.decompress(scene_bytes(DESIGN, packs, dark)))
    assert header["views"]["iso"] == other["camera"]
    assert header["daylights"][3] == other["tint"]
    assert header["daylights"][10] == header["tint"]


@pytest.mark.parametrize(
    ("options", "reason"),
    [({"view": "hero"}, "cast shadows need Python"), ({"shadow": True}, "translucent materials")],
)
def test_a_scene_says_why_it_has_no_picture(
    playable: Playable, options: dict[str, object], reason: str
) -> None:
    files = pictured_scene("wall", DESIGN, open_packs(()), playable(size=SIZE, **options))
    assert list(files) == ["wall.bin"]
    header, _ = unpack(gzip.decompress(files["wall.bin"]))
    assert reason in header["noPicture"] and "still" not in header


def test_a_page_has_all_that_it_needs(playable: Playable) -> None:
    text = page.page_text(DESIGN, playable(size=SIZE))
    assert len(text) < 300_000
    files = files_of(text)
    assert set(files) == {"standing.bin", "cloth.bin"}
    header, _ = unpack(files["standing.bin"])
    assert "drapery web --component" in header["noPicture"] and "still" not in header
    assert 'design="white creeper:lime border:black"' in text
    assert re.findall(r'(?:src|href)="([^"]{,22})', text) == ["data:image/webp;base64"]
    assert page.page_text(DESIGN, playable(size=SIZE)) == text


def test_a_package_names_its_files(
    playable: Playable, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(package, "POSES", {"sneak": 0.0})
    package.write_component(tmp_path / "dist", playable())
    made = {path.name: path.read_bytes() for path in (tmp_path / "dist").iterdir()}
    described = json.loads(made["package.json"])
    exported = [each for each in described["exports"].values() if isinstance(each, dict)]
    named = {each[key].removeprefix("./") for each in exported for key in ("types", "default")}
    assert {described["main"], described["types"]} < named < {*described["files"]}
    files = {name for name in made if name.endswith(".bin")}
    players = {f"{worn}-sneak{arms}.bin" for worn in ("cape", "elytra") for arms in ("", "-slim")}
    parts = "", "-still", "-fabrics"
    scenes = {f"{name}{part}.bin" for name in page.PLACEMENTS for part in parts}
    words = {f"{code}.bin" for code in languages() if code != "en"} | {"words.bin"}
    worn_as = "cape", "tabard", "shield"  # of the designer
    wearers = {f"wearer-{worn}{arms}.bin" for worn in worn_as for arms in ("", "-slim")}
    assert files == scenes | players | wearers | words | {"cloth.bin", "shield.bin"}
    assert set(made) == files | named | {"README.md", "package.json"}
    for module in ("drapery-banner.js", "drapery-designer.js"):
        found = re.findall(
            r'new URL\("\./([\w-]+\.bin)", import\.meta\.url\)', made[module].decode()
        )
        assert sorted(found) == sorted(files), "bundlers find literals"
    inline = dict(
        re.findall(r'^  "([\w-]+\.bin)": "(.*)",$', made["drapery-inline.js"].decode(), re.M)
    )
    held = {name: base64.b64decode(text) for name, text in inline.items()}
    assert len(held.pop("cloth.bin")) < len(made["cloth.bin"]), "it has no players"
    assert held == {name: made[name] for name in files - players - wearers - {"cloth.bin"}}


@pytest.mark.skipif(NODE is None, reason="node is not installed (apt: nodejs)")
def test_an_import_without_a_dom_defines_nothing(tmp_path: Path) -> None:
    text = bundled_module(DESIGNER_ENTRY, DESIGNER_PUBLIC, beside(["cloth.bin"]))
    (tmp_path / "bundle.mjs").write_text(text, encoding="utf-8")
    program = 'import("./bundle.mjs").then((m) => console.log(m.readDesign("red").base))'
    (tmp_path / "main.mjs").write_text(program, encoding="utf-8")
    assert run_node(tmp_path / "main.mjs").strip() == "red"


@pytest.mark.parametrize(
    ("design", "options", "fault"),
    [
        ("shield white", {}, "a page shows cloth that moves"),
        ("white", {"placement": "item"}, "a page shows cloth that moves"),
        ("white", {"pose": "vanilla"}, "a page shows cloth that moves"),
        ("white", {"style": "felt"}, "style felt has shape steps"),
        ("white", {"style": "pixel-art"}, "style pixel-art has motion steps"),
    ],
)
def test_what_a_page_cannot_show_is_refused(
    design: str, options: dict[str, object], fault: str
) -> None:
    with pytest.raises(OptionError, match=fault):
        scene_bytes(Banner.parse(design), open_packs(()), Settings(**options))  # type: ignore[arg-type]


def test_a_gallery_has_a_scene_and_a_command_for_each_item(playable: Playable) -> None:
    items = [item for item in ITEMS if item.name in ("wall", "cape", "gale", "elytra-sneak")]
    text = gallery_text(playable(), items)
    names = {"wall.bin", "cape.bin", "gale.bin", "elytra-sneak.bin", "cloth.bin"}
    assert set(files_of(text)) == names
    assert text.count("<drapery-banner ") == 3 and 'kind="gale"' in text and 'wind="12"' in text
    shown = re.sub("</?span>", "", text)  # around each word, which no line breaks after its dash
    assert "drapery web --texture cape.png --kind cape -o cape.html" in shown
    assert '<drapery-elytra alt="Elytra on a sneaking player" pose="sneak"><img' in text
    assert "drapery player --elytra --motion sneak --speed 0 --rotation 7" in shown
    with pytest.raises(OptionError, match=r"gallery, cape: pbr needs the renderer"):
        gallery_text(playable(pbr=True), items[1:2])


def test_the_command_refuses_targets_and_designs_that_do_not_fit(drapery: Run) -> None:
    code, _, err = drapery("web", "white", "-o", "banner.png")
    assert code == 2 and "banner.png: PNG holds no page; use .html or .htm" in err
    code, _, err = drapery("web", "white", "--gallery", "-o", "gallery.html")
    assert code == 2 and "the gallery has designs of its own" in err
    for flag in ("--component", "--designer"):
        code, _, err = drapery("web", "white", flag, "-o", "dist")
        assert code == 2 and "the package shows any design" in err
    code, _, err = drapery("web", "--gallery", "--designer", "-o", "dist")
    assert code == 2 and "use one of them" in err
