"""What strangers send names only what they sent: no file, folder or address of this machine.

Every field that can hold a name gets the name of a file that exists outside. It must be refused in
one line, or mean something else; in either case nothing outside is opened or listed.
"""

import asyncio
import json
import re
import sys
from collections.abc import AsyncIterator, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

import pack_maker
import pytest
from PIL import Image

from drapery import DraperyError
from drapery.errors import OptionError
from drapery.garments import find_garment, model as garment_model
from drapery.garments.model import GarmentTable
from drapery.settings import NAMED_OPTIONS

pytest.importorskip("nicegui")

from drapery.scenes import repeating_garment
from drapery.studio.session import Session

WATCHED = "outside-of-all-that-was-sent"
_seen: list[str] = []
_watching = [False]


def _watch(event: str, arguments: tuple[Any, ...]) -> None:
    is_file = event in ("open", "os.listdir", "os.scandir") and WATCHED in str(arguments[0])
    if _watching[0] and (is_file or event == "socket.connect"):
        _seen.append(f"{event} {arguments}")


sys.addaudithook(_watch)


@contextmanager
def nothing_outside_is_opened() -> Iterator[None]:
    _seen.clear()
    _watching[0] = True
    try:
        yield
    finally:
        _watching[0] = False
    assert not _seen, _seen[0]


@pytest.fixture(scope="module")
def outside(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with a sound file of each kind, which is also a resource pack."""
    folder = tmp_path_factory.mktemp(WATCHED)
    Image.new("RGBA", (64, 32), (255, 0, 0, 255)).save(folder / "x.png")
    (folder / "x.toml").write_text('description = "outside"\n[[color]]\nstep = "posterize"\n')
    (folder / "x.json").write_text('{"head": [0, 9, 0]}')
    (folder / "x.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (folder / "x.gpl").write_text("GIMP Palette\n0 0 0 a\n9 9 9 b\n")
    (folder / "pack.mcmeta").write_bytes(pack_maker.mcmeta(46))
    (folder / "assets").mkdir()
    return folder


def names_of(outside: Path) -> list[str]:
    """Ways to name the folder and its files, from anywhere."""
    up = "../" * 12 + str(outside).lstrip("/")
    whole = [str(outside), *(f"{outside}/x.{ending}" for ending in ("png", "toml", "json", "obj"))]
    more = [f"{up}/x.png", f"{up}/x", f"block/{up}/x", f"walk+{outside}/x.json"]
    foreign = [f"file://{outside}/x.png", f"https://example.com/{WATCHED}.png"]
    windows = [f"C:\\{WATCHED}\\x.png", f"\\\\host\\{WATCHED}\\x.png", f"C:{WATCHED}.png"]
    return [*whole, *more, *foreign, *windows]


# Garments

PIECE = {"name": "shawl", "size": [8, 8], "points": [3, 3], "place": [0, 20, 0]}
TABLES: dict[str, dict[str, Any]] = {
    "Garment": {"piece": [PIECE]},
    "ClothTexture": {"piece": [PIECE]},
    "GridPiece": {"piece": [PIECE]},
    "GarmentWearer": {"piece": [PIECE], "wearer": {"kind": "player"}},
    "GarmentMesh": {"piece": [PIECE], "mesh": [{"file": "x.obj"}]},
    "GarmentPin": {"piece": [PIECE], "pin": [{"piece": "shawl", "at": "top"}]},
    "GarmentSeam": {"piece": [PIECE], "seam": [{"join": ["shawl.left", "shawl.right"]}]},
    "GarmentBlock": {"piece": [PIECE], "block": [{"cell": [0, 0, 0]}]},
}
"""For each table with texts: a sound file that has one. Others have only numbers."""
PLACES = {
    "GridPiece": ("piece", 0),
    "GarmentWearer": ("wearer",),
    "GarmentMesh": ("mesh", 0),
    "GarmentPin": ("pin", 0),
    "GarmentSeam": ("seam", 0),
    "GarmentBlock": ("block", 0),
}


def text_fields() -> Iterator[tuple[str, str]]:
    """Each table of a garment's file and each of its fields that a text can set."""
    tables = [
        each
        for each in vars(garment_model).values()
        if isinstance(each, type) and issubclass(each, GarmentTable) and each is not GarmentTable
    ]
    shared = garment_model.GarmentPiece.model_fields
    for table in tables:
        for name, field in table.model_fields.items():
            is_own = table is garment_model.GridPiece or name not in shared
            if is_own and re.search(r"\b(str|Path|Any|Banner)\b", str(field.annotation)):
                yield table.__name__, name


def documents(table: str, field: str, names: list[str]) -> Iterator[dict[str, Any]]:
    """Files of garments whose field has each name."""
    for name in names:
        if table == "ClothTexture":
            yield {**TABLES[table], "texture": {field: name}}
            yield {"piece": [{**PIECE, "texture": {field: name}}]}
        elif (table, field) == ("Garment", "picture"):
            for option in NAMED_OPTIONS:
                yield {**TABLES[table], field: {option: name}}
                yield {**TABLES[table], field: {option: [name, name]}}
        else:
            tree = json.loads(json.dumps(TABLES[table]))
            inner = tree
            for part in PLACES.get(table, ()):
                inner = inner[part]
            inner[field] = [name, name] if field == "join" else name
            yield tree


def toml(tree: dict[str, Any]) -> str:
    """A tree as TOML; JSON's texts, numbers and lists are TOML's too."""

    def value(of: Any) -> str:
        if isinstance(of, dict):
            return "{" + ", ".join(f"{name} = {value(each)}" for name, each in of.items()) + "}"
        return "[" + ", ".join(map(value, of)) + "]" if isinstance(of, list) else json.dumps(of)

    return "".join(f"{name} = {value(each)}\n" for name, each in tree.items())


def send(session: Session, text: str, purpose: str = "garment", name: str = "a.toml") -> int:
    async def pieces() -> AsyncIterator[bytes]:
        yield text.encode()

    return asyncio.run(session.uploads.receive(pieces(), purpose, name)).number


def test_every_table_of_a_garment_with_texts_is_tried() -> None:
    pieces = {"StripPiece", "RingPiece", "DiscPiece", "PolygonPiece"}  # no text of their own
    tried = {table for table, field in text_fields() if field != "shape"} - {"GarmentPiece"}
    assert tried - pieces == set(TABLES)


@pytest.mark.parametrize(("table", "field"), [*text_fields()])
def test_a_garment_that_is_sent_names_no_file_of_the_studio(
    table: str, field: str, outside: Path
) -> None:
    if table not in TABLES or (table, field) == ("Garment", "folder"):
        return
    session = Session()
    try:
        for tree in documents(table, field, names_of(outside)):
            session.garment_store.names.clear()
            number = send(session, toml(tree))
            with nothing_outside_is_opened():
                try:
                    path = session.garment_store.adopt(number, "garment")
                except DraperyError as error:
                    assert "\n" not in str(error) and len(str(error)) < 1000
                    continue
                garment = find_garment(path)
                with suppress(DraperyError):  # such as a block that no pack has
                    session.adjust(**garment.picture)
                    repeating_garment(garment, session.packs(), session.settings)
    finally:
        session.close()


def test_a_sent_garment_may_say_how_its_picture_looks_with_styles_by_name() -> None:
    session = Session()
    tree = {"piece": [PIECE], "picture": {"wind": 3, "style": ["pixel-art"], "view": "iso"}}
    path = session.garment_store.adopt(send(session, toml(tree)), "garment")
    assert find_garment(path).picture["wind"] == 3
    named = {"piece": [PIECE], "picture": {"packs": ["/any"], "style": ["/any/x.toml"]}}
    with pytest.raises(OptionError, match="garment a names '/any', which was not sent; leave it"):
        session.garment_store.adopt(send(session, toml(named)), "garment")
    session.close()
