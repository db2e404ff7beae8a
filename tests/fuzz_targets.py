"""Every reader of input from outside, with valid inputs and a way to change them."""

import atexit
import contextlib
import io
import os
import random
import sys
import tempfile
import warnings
import zipfile
from collections.abc import Callable, Iterable, Iterator, Sequence
from functools import cache, partial
from pathlib import Path
from typing import Any
from unittest import mock
from urllib.parse import quote, urlencode

import fuzz_files
import fuzzing
import hostile
import numpy as np
import pack_maker
import page_reader
from fuzzing import Target

from drapery import Banner, cli
from drapery.banner import GIVE_FORMS, ItemDetails, write_give
from drapery.banner.formats import FORMS, datapack, parse_banner, structure
from drapery.batch.manifest import ManifestError, read_manifest
from drapery.errors import DesignError, DraperyError, OptionError
from drapery.packs import open_packs
from drapery.player_settings import PLAYER_OPTIONS
from drapery.settings import OPTIONS
from drapery.testing.cases import read_cases

GIVE = '/give @p white_banner[banner_patterns=[{pattern:"creeper",color:"lime"}]]'
PACK = {
    "pack.mcmeta": pack_maker.mcmeta(46, overlays={"entries": []}, filter={"block": []}),
    pack_maker.CREEPER: pack_maker.plain(255, 0, 0, 255),
    pack_maker.CREEPER + ".mcmeta": b'{"animation": {"frametime": 2, "frames": [0]}}',
    pack_maker.NEW_BASE: pack_maker.png(pack_maker.noise(1)),
    pack_maker.SHIELD + "creeper.png": pack_maker.png(np.zeros((64, 64), np.uint8)),
}
DATA_PACK = {
    "pack.mcmeta": b'{"pack": {"pack_format": 48, "description": ""}}',
    "data/a/function/kit.mcfunction": b"say hi\n" + GIVE.encode() + b"\n",
    "data/a/loot_table/b.json": FORMS["loot-table"].example.encode(),
    "data/a/structure/hall.nbt": structure.write([Banner("red")]),
    "data/a/thing.snbt": b"{Items:[{id:'minecraft:red_banner'}]}",
}
MANIFESTS = {
    "csv": "design,name,size,wind\nwhite creeper:lime,a,32x32,5\nred,b,,\n",
    "jsonl": '{"design": "red", "size": "32x32"}\n{"design": "white creeper:lime"}\n',
    "yaml": "- design: &d white creeper:lime\n  size: 32x32\n- {design: *d, seed: 3}\n",
}
CASES = {
    "toml": '[defaults]\nsize = "32x32"\n[[case]]\nname = "a"\ndesign = "red"\nwind = 5\n',
    "yaml": "defaults: {size: 32x32}\ncase:\n- {name: a, design: red, wind: 5}\n",
}
COMMANDS = {
    "show": [GIVE, "white creeper:lime\n--as\njson", "red\n--number\n1\n--from\nshorthand"],
    "render": [
        "white\n--size\n32x32\n--wind\n5\n--seed\n3\n--view\niso\n--background\n#aabbcc",
        f"{GIVE}\n--grid\n9x9\n--pixel\n4\n--layers\nflat\n--rotation\n3\n--format\n75",
    ],
}
"""Words on lines of their own; none of these draws, since the target's folder does not exist."""


def targets() -> dict[str, Target]:
    """All readers by name."""
    readers, samples = fuzzing.binary_readers(), fuzzing.binary_samples()
    found = {name: Target(readers[name], samples[name], fuzzing.mutate_bytes) for name in readers}
    readers, texts = fuzzing.text_readers(), fuzzing.text_samples()
    found |= {name: Target(readers[name], texts[name], fuzzing.mutate_text) for name in readers}
    return found | other_targets()


def other_targets() -> dict[str, Target]:
    """Readers of other things than designs."""
    found = {
        "pack": Target(_read_pack, [_zipped(PACK)], partial(_mutate_pack, PACK)),
        "data pack": Target(
            _read_data_pack, [_zipped(DATA_PACK)], partial(_mutate_pack, DATA_PACK)
        ),
    }
    for ending, text in MANIFESTS.items():
        found[f"manifest.{ending}"] = Target(_file_reader(ending, _jobs), [text], _mutate_text)
    for ending, text in CASES.items():
        found[f"cases.{ending}"] = Target(_file_reader(ending, _cases), [text], _mutate_text)
    for name, samples in COMMANDS.items():
        found[f"command {name}"] = Target(_command(name), samples, fuzzing.mutate_text)
    found |= fuzz_files.file_targets(_folder())
    with contextlib.suppress(ImportError):  # the service is an extra
        queries = [
            urlencode({"design": GIVE, "size": "32x32", "seed": 3}),
            "design=red&wind=9&time=1",
        ]
        found["query"] = Target(_query_reader(), queries, fuzzing.mutate_text)
        addresses = [f"/banner.png?{query}" for query in queries]
        addresses += [
            "/player.gif?motion=walk%2Bwave&wear=cape&seconds=1",
            "/garment.png?name=cape",
        ]
        found["service"] = Target(
            _answers, [*addresses, "/metrics", "/openapi.json"], _mutate_address
        )
    if page_reader.NODE is not None:
        found["page"] = page_target()
        found["designer"] = designer_target()
    return found


@contextlib.contextmanager
def undrawn_service() -> Iterator[Any]:
    """A client of the service, which answers a sound address with the word `drawn`."""
    from fastapi.testclient import TestClient

    from drapery.serve import app as service

    async def drawn(*_: object) -> bytes:
        return b"drawn"

    app = service.make_app(rate=0)
    with contextlib.ExitStack() as running:
        with mock.patch.object(service, "JobQueue"):
            client = running.enter_context(TestClient(app))
        # Of this service alone: other tests in this process draw with one of their own.
        app.state.service.draw = drawn
        yield client


_SERVICE = contextlib.ExitStack()
atexit.register(_SERVICE.close)


@cache
def _client() -> Any:
    return _SERVICE.enter_context(undrawn_service())


def _answers(address: str) -> Iterable[Any]:
    """The answer of the service to an address, which is a picture or a reason."""
    path, mark, query = address.partition("?")
    url = quote(path, safe="/%.") + mark + quote(query, safe="=&%+;:,[]")
    got = _client().get(url.encode("ascii").decode(), follow_redirects=False)
    assert got.status_code == 200 or 400 <= got.status_code < 500, (got.status_code, got.text)
    if got.status_code != 200:
        raise OptionError(str(got.json()["detail"]))
    return [got.content]


def _mutate_address(rng: random.Random, samples: Sequence[str]) -> str:
    """An address with other bytes, or with a value for one of its parameters that nobody means."""
    if rng.random() < 0.5:
        text = fuzzing.mutate_text(rng, samples, 3)
        return "/" + text.encode("utf-8", "replace").decode().lstrip("/")
    path, _, query = rng.choice(samples).partition("?")
    parts = [part.partition("=")[0] for part in query.split("&")]
    names = [*filter(None, parts), *OPTIONS, *PLAYER_OPTIONS, "design", "seconds", "fps"]
    value = rng.choice((*hostile.TEXTS, *hostile.changed_texts(1, rng.randrange(10**6))))
    return f"{path}?{query}&{rng.choice(names)}={quote(value)}"


def page_target() -> Target:
    """The component's reader: of designs, hashes and attributes, each text after what it is."""
    designs = [GIVE, *(FORMS[form].example for form in PAGE_FORMS)]
    samples = [
        *(f"design {text}" for text in designs),
        *(f"hash #{quote(each)}" for each in designs),
    ]
    samples += ["kind wall", "wind 4.5", "direction -90"]
    return Target(_read_in_page, samples, _mutate_for_page)


def designer_target() -> Target:
    """The designer's reader of pasted texts, which it writes again as commands of all versions."""
    details = ItemDetails("@a", 3, {"text": "Flag", "bold": True}, ("a line",))
    designs = [GIVE, *(FORMS[form].example for form in (*PAGE_FORMS, "summon", "bedrock"))]
    samples = [*designs, *(f"https://example.com/#{quote(each)}" for each in designs)]
    samples += [write_give(Banner("red"), form, details) for form in GIVE_FORMS]
    return Target(_read_in_designer, samples, fuzzing.mutate_text)


PAGE_FORMS = (
    *("shorthand", "json", "give", "give-legacy", "give-1.12", "item", "setblock"),
    "loom-assistant",
    *("planet-minecraft", "needcoolshoes", "minecraft-tools", "gamergeeks"),
)
"""The forms that pages read."""


def _mutate_for_page(rng: random.Random, samples: Sequence[str]) -> str:
    what, _, text = rng.choice(samples).partition(" ")
    same = [other.partition(" ")[2] for other in samples if other.startswith(what)]
    return f"{what} {fuzzing.mutate_text(rng, [text, *same] if rng.random() < 0.5 else [text], 2)}"


def _read_in_designer(given: str) -> Iterable[Any]:
    """What the designer reads, whose texts Python reads again as the same design."""
    answer = page_reader.read_in_page("pasted", given)
    assert answer.seconds < 1, f"{answer.seconds:.2f} s in the page"
    if answer.error:
        assert answer.error == "DesignError", answer
        raise DesignError(answer.message)
    design = answer.found["design"]
    with warnings.catch_warnings(action="ignore"):
        with contextlib.suppress(DraperyError):
            assert page_reader.plain(parse_banner(given)) == design, answer
        for text in filter(None, answer.found["texts"]):
            assert page_reader.plain(parse_banner(text)) == design, (answer, text)
    return [design]


def _read_in_page(given: str) -> Iterable[Any]:
    """What the page reads, which is what Python reads where both read something."""
    what, _, text = given.partition(" ")
    answer = page_reader.read_in_page(what, text)
    assert answer.seconds < 1, f"{answer.seconds:.2f} s in the page"
    if answer.error:
        assert answer.error == ("DesignError" if what in ("design", "hash") else "Error"), answer
        raise DesignError(answer.message)
    if what == "design":
        with contextlib.suppress(DraperyError), warnings.catch_warnings(action="ignore"):
            assert page_reader.plain(parse_banner(text)) == answer.found, answer
    return [answer.found]


def _folder() -> Path:
    global _FOLDER
    if _FOLDER is None:
        holder = tempfile.TemporaryDirectory()
        atexit.register(holder.cleanup)
        _FOLDER = Path(holder.name)
    return _FOLDER


_FOLDER: Path | None = None


def _mutate_text(rng: random.Random, samples: Sequence[str]) -> bytes:
    # A row takes a millisecond, so that the bound on time is one on rows too.
    return fuzzing.mutate_text(rng, samples)[:2000].encode("utf-8", "surrogatepass")


def _file_reader(
    ending: str, read: Callable[[Path], Iterable[Any]]
) -> Callable[[bytes], Iterable[Any]]:
    def write_and_read(data: bytes | str) -> Iterable[Any]:
        path = _folder() / f"input.{ending}"
        path.write_bytes(data if isinstance(data, bytes) else data.encode())
        return read(path)

    return write_and_read


def _jobs(path: Path) -> Iterable[Any]:
    try:
        return read_manifest(path)
    except ManifestError as error:
        raise OptionError(str(error.faults[0])) from None


def _cases(path: Path) -> Iterable[Any]:
    return read_cases(path).case


def _query_reader() -> Callable[[str], Iterable[Any]]:
    from drapery.serve.request_params import ServiceConfig, parse_query, read_request

    config = ServiceConfig()

    def read(text: str) -> Iterable[Any]:
        query = parse_query(text.encode("utf-8", "surrogatepass"))
        requests = [read_request(query, ending, config) for ending in (".png", ".gif")]
        taken = [each for each in requests if not isinstance(each, list)]
        for reasons in requests:  # some options are of stills alone
            if isinstance(reasons, list) and not taken:
                raise OptionError(reasons[0])
        return taken

    return read


def _command(name: str) -> Callable[[str], Iterable[Any]]:
    def run(text: str) -> Iterable[Any]:
        target = ["-o", "missing/out.png"] if name == "render" else []
        line, errors = ["drapery", name, *target, *text.split("\n"), *target], io.StringIO()
        with _standard_streams(line, errors):
            try:
                cli.main()
            except SystemExit as ended:
                code = ended.code
        said = errors.getvalue()
        assert code in (0, 2), f"exit code {code}: {said}"
        assert all(line.startswith("drapery: ") for line in said.splitlines()), said
        if code and "the folder missing does not exist" not in said:
            raise OptionError(said.rstrip("\n"))
        return [text]

    return run


@contextlib.contextmanager
def _standard_streams(line: list[str], errors: io.StringIO) -> Iterator[None]:
    here = Path.cwd()
    os.chdir(_folder())
    nothing = io.TextIOWrapper(io.BytesIO(), encoding="utf-8")
    try:
        with (
            mock.patch.object(sys, "argv", line),
            mock.patch.object(sys, "stdin", nothing),
            contextlib.redirect_stdout(io.StringIO()),
            contextlib.redirect_stderr(errors),
        ):
            yield
    finally:
        os.chdir(here)


def _read_pack(data: bytes) -> Iterable[Any]:
    path = _folder() / "pack.zip"
    path.write_bytes(data)
    packs = open_packs([path])
    return [packs.sheet("creeper"), *packs.patterns()[:1]]


def _read_data_pack(data: bytes) -> Iterable[Any]:
    path = _folder() / "data.zip"
    path.write_bytes(data)
    errors: list[DesignError] = []
    found = list(datapack.in_zip(path, errors.append))
    if errors and not found:
        raise errors[0]
    return found


def _mutate_pack(sound: dict[str, bytes], rng: random.Random, samples: Sequence[bytes]) -> bytes:
    if rng.random() < 0.3:
        return fuzzing.change_bytes(rng, rng.choice(samples), samples)
    files = dict(sound)
    name = rng.choice(list(files))
    files[name] = fuzzing.change_bytes(rng, files[name], list(sound.values()))
    return _zipped(files)


def _zipped(files: dict[str, bytes]) -> bytes:
    data = io.BytesIO()
    with zipfile.ZipFile(data, "w", zipfile.ZIP_DEFLATED) as pack:
        for name, content in files.items():
            pack.writestr(name, content)
    return data.getvalue()
