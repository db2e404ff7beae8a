"""Data packs as a folder or a zip: every banner with its file, and no alarm for other files."""

import json
import shutil
import warnings
import zipfile
from pathlib import Path

import pytest
import world_maker as make

from drapery.banner.formats import FoundBanner, datapack, parse_banner, read_designs
from drapery.banner.formats.structure import write as write_structure
from drapery.errors import DesignError

LIME = parse_banner("red creeper:lime")
GIVE = 'give @s red_banner[banner_patterns=[{pattern:"creeper",color:"lime"}]]'
ITEM = {
    "id": "minecraft:red_banner",
    "components": {"minecraft:banner_patterns": [{"pattern": "creeper", "color": "lime"}]},
}
POOL = {"elements": [{"element": {"location": "a:banner_hall"}, "weight": 1}], "name": "a:banners"}
FILES: dict[str, str | bytes] = {
    "pack.mcmeta": '{"pack": {"pack_format": 48, "description": "banners"}}',
    "data/a/advancement/hero.json": json.dumps({"display": {"icon": ITEM}, "criteria": {}}),
    "data/a/banner_pattern/x.json": '{"asset_id": "a:x", "translation_key": "banner.x"}',
    "data/a/function/deep/kit.mcfunction": f"say banner\n{GIVE}\n",
    "data/a/function/none.mcfunction": "# red_banner\nclear @s red_banner\n",
    "data/a/structure/banner_hall.nbt": write_structure([LIME]),
    "data/a/tags/item/banners.json": '{"values": ["minecraft:red_banner"]}',
    "data/a/worldgen/template_pool/hall.json": json.dumps(POOL),
    "data/a/worldgen/configured_feature/banner.json": '{"config": {"Name": "red_banner"}}',
    "over/data/a/function/kit.mcfunction": GIVE,
    "assets/a/lang/en_us.json": '{"a.banner": "Banner"}',
    "README.md": GIVE,
}
PLACES = [
    "data/a/advancement/hero.json.display.icon",
    "data/a/function/deep/kit.mcfunction line 2 red_banner",
    "data/a/structure/banner_hall.nbt block 0,0,0",
    "over/data/a/function/kit.mcfunction line 1 red_banner",
]


def written(folder: Path, files: dict[str, str | bytes]) -> Path:
    for name, content in files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return folder


def zipped(path: Path, files: dict[str, str | bytes], top: str = "") -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            archive.writestr(top + name, content)
    return path


@pytest.fixture(params=["folder", "zip", "zip with a top folder"])
def pack(request: pytest.FixtureRequest, tmp_path: Path) -> Path:
    if request.param == "folder":
        return written(tmp_path / "pack", FILES)
    return zipped(tmp_path / "pack.zip", FILES, "pack-main/" if "top" in request.param else "")


def test_every_banner_of_a_pack_has_its_file(pack: Path) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        found = read_designs(pack)
    assert found == [FoundBanner(LIME, place) for place in PLACES]
    assert read_designs(str(pack)) == found


def test_what_cannot_be_read_is_warned_of_with_its_file(tmp_path: Path) -> None:
    broken: dict[str, str | bytes] = {
        "data/a/function/a.mcfunction": "say hi\ngive @s red_banner[banner_pattern=[]]\n",
        "data/a/function/b.mcfunction": b"\xff banner",
        "data/a/loot_table/c.json": '{"pools": [banner}',
        "data/a/structure/d.nbt": b"\x0a\0\0\x08 banner",
        "data/a/item_modifier/e.json": json.dumps({"entries": [ITEM["components"]]}),
    }
    for path in (
        written(tmp_path / "pack", FILES | broken),
        zipped(tmp_path / "pack.zip", FILES | broken),
    ):
        with pytest.warns(UserWarning) as caught:
            assert len(read_designs(path)) == len(PLACES)
        said = [str(one.message) for one in caught]
        names = sorted(broken, key=lambda name: name.split("/", 2)[2])
        assert [name for name, line in zip(names, said, strict=True) if name not in line] == []
        assert "line 2: banner_pattern: not a component" in said[0]


def test_a_behaviour_pack_of_bedrock(tmp_path: Path) -> None:
    entry = {
        "type": "item",
        "name": "minecraft:banner",
        "functions": [{"function": "set_banner_details", "type": 1}],
    }
    files: dict[str, str | bytes] = {
        "manifest.json": '{"format_version": 2}',
        "functions/kit.mcfunction": "give @s banner 1 1\n",
        "loot_tables/raid.json": "// banner\n" + json.dumps({"pools": [{"entries": [entry]}]}),
        "structures/hall.mcstructure": make.raw_nbt(
            make.mcstructure((1, 1, 1), {(0, 0, 0): make.bedrock_entity(make.RED)}), "little"
        ),
    }
    for path in (written(tmp_path / "pack", files), zipped(tmp_path / "a.mcpack", files)):
        found = read_designs(path)
        assert [one.where for one in found] == [
            "functions/kit.mcfunction line 1 banner",
            "loot_tables/raid.json.pools[0].entries[0]",
            "structures/hall.mcstructure block 0,0,0",
        ]


def test_a_zip_without_a_data_pack_says_what_to_do(tmp_path: Path) -> None:
    zipped(tmp_path / "a.zip", {"level.dat": b"", "region/r.0.0.mca": b""})
    zipped(tmp_path / "b.zip", {"pack.mcmeta": "{}", "assets/a/b.png": b""})
    zipped(tmp_path / "c.zip", {"pack.mcmeta": "{}", "data/a/function/b.mcfunction": "say hi"})
    (tmp_path / "d.zip").write_bytes((tmp_path / "c.zip").read_bytes()[:-9])
    for name, part in (
        *(("a", "a zip without a data pack; unpack it"), ("b", "a zip without a data pack")),
        *(("c", "no banner in the pack"), ("d", "complete zip")),
    ):
        with pytest.raises(DesignError, match=part) as caught:
            read_designs(tmp_path / f"{name}.zip")
        assert f"{name}.zip" in str(caught.value) and "\n" not in str(caught.value)


def test_a_folder_without_pack_mcmeta_is_a_folder_of_designs(tmp_path: Path) -> None:
    folder = written(tmp_path / "pack", FILES)
    (folder / "pack.mcmeta").unlink()
    (folder / "a.txt").write_text("red")
    shutil.rmtree(folder / "over")
    with pytest.warns(UserWarning, match=r"data \(a folder; give it by itself\)"):
        assert [one.where for one in read_designs(folder)] == ["a.txt"]


def world(folder: Path) -> Path:
    level = make.nbt_file({"Data": {"Player": {"Item": make.item(make.LIME)}}})
    make.save(folder / "level.dat", level)
    written(folder / "datapacks" / "kits", FILES)
    zipped(folder / "datapacks" / "hall.zip", FILES, "hall-1.0/")
    written(folder / "datapacks" / "half", {"data/a/function/kit.mcfunction": GIVE})
    return folder


def test_data_packs_of_a_world_are_read_with_it(tmp_path: Path) -> None:
    """Found by hand: only the structures of a world's data packs were read."""
    with pytest.warns(UserWarning) as caught:
        found = read_designs(world(tmp_path / "world"))
    assert [one.where for one in found] == [
        "level.dat.Data.Player.Item",
        *(f"datapacks/hall.zip/{place}" for place in PLACES),
        *(f"datapacks/kits/{place}" for place in PLACES),
    ]
    assert [one.banner for one in found] == [make.LIME, *[LIME] * 8]
    (warning,) = caught
    assert str(warning.message).startswith("datapacks/half: not a data pack, since it lacks")


def test_a_broken_pack_of_a_world_is_reported_and_the_others_are_read(tmp_path: Path) -> None:
    folder = world(tmp_path / "world")
    (folder / "datapacks" / "hall.zip").write_bytes(b"PK\x03\x04 and no more")
    (folder / "datapacks" / "half").rename(tmp_path / "half")
    (folder / "datapacks" / "linked").symlink_to(tmp_path / "half")
    with pytest.warns(UserWarning) as caught:
        assert len(read_designs(folder)) == 5
    told = [str(warning.message) for warning in caught]
    assert told[0].startswith("datapacks/hall.zip: ") and "complete zip" in told[0]
    assert told[1] == "datapacks/linked: a link; give the pack itself"


def test_packs_of_a_world_share_one_bound_on_size(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    size = sum(len(content) for content in FILES.values())
    monkeypatch.setattr(datapack, "MAX_UNPACKED", size * 3 // 2)
    with pytest.raises(DesignError, match="MiB unpacked; split"):
        read_designs(world(tmp_path / "world"))


@pytest.mark.parametrize("kind", ["a world", "a data pack", "a zip", "a binary file"])
def test_a_form_of_text_is_refused_for_what_is_not_a_text(kind: str, tmp_path: Path) -> None:
    """Found by hand: `--from give` with a data pack or a world was ignored in silence."""
    path = {
        "a world": lambda: world(tmp_path / "world"),
        "a data pack": lambda: written(tmp_path / "pack", FILES),
        "a zip": lambda: zipped(tmp_path / "pack.zip", FILES),
        "a binary file": lambda: make.save(tmp_path / "a.nbt", write_structure([LIME])),
    }[kind]()
    with pytest.raises(DesignError) as caught:
        read_designs(path, form="give")
    assert str(caught.value) == (
        f"{path}: {kind}, which cannot be read as the form 'give';"
        " leave the form out, so that it is recognised"
    )


def test_a_template_pool_alone_is_refused_with_what_to_give(tmp_path: Path) -> None:
    """Found by hand: the message asked for an item's id."""
    written(tmp_path, {"pool.json": json.dumps(POOL)})
    with pytest.raises(DesignError) as caught:
        read_designs(tmp_path / "pool.json")
    assert str(caught.value) == (
        f"{tmp_path / 'pool.json'}: a template pool, which only names structures; give the folder"
        " of its data pack, or a structure such as 'data/a/structure/banner_hall.nbt'"
    )
