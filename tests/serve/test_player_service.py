"""Players over HTTP and in batches: the same pictures as `draw`, and a reason for every refusal."""

import io
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from served_pictures import pixels_of
from skin_maker import marked
from starlette.testclient import TestClient

from drapery import draw
from drapery.batch.jobs import make_job
from drapery.batch.keys import DigestCache
from drapery.batch.manifest import ManifestError, PictureRequest, read_manifest
from drapery.batch.pool import JobLimits
from drapery.errors import OptionError
from drapery.garments import PlayerSettings, player_of
from drapery.serve.app import make_app
from drapery.serve.request_params import ServiceConfig, pictures_in, read_request
from drapery.serve.uploads import MAX_UPLOAD, SkinUploads
from drapery.settings import Settings

SMALL = "size=24x32&shown=bust&motion=stand&time=0&view=front"


def png(texels: np.ndarray) -> bytes:
    file = io.BytesIO()
    Image.fromarray(texels).save(file, "png")
    return file.getvalue()


@pytest.fixture(scope="module")
def skins(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("skins")
    (folder / "marked.png").write_bytes(png(marked()))
    return folder


@pytest.fixture(scope="module")
def client(skins: Path) -> Iterator[TestClient]:
    config = ServiceConfig(Settings(size=(24, 32)), skins=pictures_in(skins))
    with TestClient(make_app(config, workers=1, limits=JobLimits(60.0, 1 << 30), rate=0)) as made:
        yield made


def test_listed_and_uploaded_skins_make_the_picture_of_draw(
    client: TestClient, skins: Path
) -> None:
    player = player_of(PlayerSettings(skin="marked.png", shown="bust", motion="stand"), skins)
    wanted = draw(player, size=(24, 32), time=0.0, view="front").pixels
    listed = client.get(f"/player.png?skin=marked&{SMALL}")
    sent = client.post(f"/player.png?{SMALL}", content=png(marked()))
    for got in (listed, sent):
        assert np.array_equal(pixels_of(got), wanted)
    again = client.post(f"/player.png?{SMALL}", content=png(marked()))
    assert again.headers["etag"] == sent.headers["etag"]


def test_bodies_that_are_not_skins_are_refused(client: TestClient) -> None:
    large = client.post("/player.png", content=b"x" * (MAX_UPLOAD + 1))
    assert large.status_code == 413 and "make it smaller" in large.text
    wide = np.zeros((1024, 1024, 4), np.uint8)
    for body in (b"", b"GIF89a", png(marked()[:, :48]), png(wide)):
        got = client.post("/player.png", content=body)
        assert got.status_code == 422 and len(got.json()["detail"]) == 1, got.text
        assert "/" not in got.json()["detail"][0].replace("512 px", "")
    paths = client.get("/openapi.json").json()["paths"]
    assert (
        set(paths["/player.png"]) == {"get", "post"}
        and "requestBody" in (paths["/player.gif"]["post"])
    )


@pytest.mark.parametrize(
    ("query", "said"),
    [
        ({"skin": "/etc/passwd"}, "skin '/etc/passwd' is not known; use one of: traveller"),
        ({"skin": "../marked.png"}, "is not known"),
        ({"skin": "/tmp/{a}.png"}, "is not known"),
        ({"skin": "/tmp/profile.json"}, "is not known"),
        ({"skin": '{name:"Kay"}'}, "profile of 'Kay' names no texture"),
        ({"skin": "{" + "a" * 8000}, "skin has over 8000 characters"),
        ({"cape": "cape.png"}, "cape 'cape.png' is not known; the service has none"),
        ({"wear": "/tmp/x.toml"}, "wear '/tmp/x.toml' is not known"),
        ({"wear": "cape;" * 5}, "wear 5 is out of range; use 0 to 4 garments"),
        ({"motion": "/tmp/pose.json"}, "motion names a file"),
        ({"motion": "walk+/tmp/pose.JSON"}, "motion names a file"),
        ({"head": "red " * 2500}, "head has over 8000 characters"),
        ({"speed": "99"}, "speed 99 is out of range; use 0 to 10 m/s"),
        ({"arms": "wide"}, "arms 'wide' is not known; use one of: auto, classic, slim"),
        ({"design": "red"}, "'design' is not an option"),
    ],
)
def test_an_address_names_no_file_and_stays_in_its_limits(query: dict[str, str], said: str) -> None:
    found = read_request(tuple(query.items()), ".png", ServiceConfig(), "player")
    assert isinstance(found, list) and said in found[0], found


def test_a_profile_in_an_address_names_textures_of_packs() -> None:
    query = (("skin", '{texture:"entity/player/dancer"}'),)
    found = read_request(query, ".png", ServiceConfig(), "player")
    assert not isinstance(found, list)


def test_a_skin_is_in_the_address_or_in_the_body(tmp_path: Path) -> None:
    path = SkinUploads(tmp_path / "sent").put(png(marked()))
    found = read_request((("skin", "dancer"),), ".png", ServiceConfig(), "player", path)
    assert found == ["skin is in the address and in the body; leave one out"]


def test_only_the_last_uploads_stay_on_the_disk(tmp_path: Path) -> None:
    uploads = SkinUploads(tmp_path, kept=2)
    sent = [png(np.roll(marked(), shift, axis=1)) for shift in (0, 1, 2)]
    first, second = uploads.put(sent[0]), uploads.put(sent[1])
    assert uploads.put(sent[0]) == first
    third = uploads.put(sent[2])
    assert first.exists() and third.exists() and not second.exists()


def test_names_of_listed_pictures_are_names_of_addresses(tmp_path: Path) -> None:
    (tmp_path / "a b.png").touch()
    with pytest.raises(OptionError, match="use letters, digits"):
        pictures_in(tmp_path)
    with pytest.raises(OptionError, match="cannot be read"):
        pictures_in(tmp_path / "none")


def test_rows_of_a_manifest_are_players(tmp_path: Path) -> None:
    (tmp_path / "skin.png").write_bytes(png(marked()))
    text = "skin,shown,head,view,wear\nskin.png,bust,red creeper:lime,front,cape;scarf\n"
    (tmp_path / "m.csv").write_text(text)
    (request,) = read_manifest(tmp_path / "m.csv")
    assert isinstance(request, PictureRequest)
    player = player_of(
        PlayerSettings(
            skin="skin.png", shown="bust", head="red creeper:lime", wear=("cape", "scarf")
        ),
        tmp_path.absolute(),
    )
    assert request.banner == player
    assert request.settings == player.settings(view="front")
    before = make_job(request, DigestCache()).key
    (tmp_path / "skin.png").write_bytes(png(marked(32)))
    assert make_job(request, DigestCache()).key != before


@pytest.mark.parametrize(
    ("row", "said"),
    [
        ({"skin": "none.png"}, "none.png"),
        ({"skin": "dancer", "design": "red"}, "a player takes no design or garment"),
        (
            {"skin": "dancer", "texture": "x.png"},
            "texture does nothing for a player; for a cape use",
        ),
        ({"skin": "dancer", "grid": "3x5"}, "grid does nothing for a garment"),
        ({"skin": "dancer", "armor": "mud"}, "armor 'mud' is not known"),
        ({"skin": "dancer", "armor": "iron"}, "armor iron: no pack has"),
        ({"motion": "fly"}, "motion 'fly' is not known"),
    ],
)
def test_faults_of_players_have_their_line(row: dict[str, str], said: str, tmp_path: Path) -> None:
    (tmp_path / "m.jsonl").write_text(json.dumps({"skin": "dancer"}) + "\n" + json.dumps(row))
    with pytest.raises(ManifestError) as caught:
        read_manifest(tmp_path / "m.jsonl")
    assert [fault.place for fault in caught.value.faults] == ["line 2"]
    assert said in str(caught.value)
