"""Every option with values that nobody means, by every door: a value, or a line that refuses it."""

import json
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any
from urllib.parse import quote

import fuzz_targets
import hostile
import pytest
from cost import limited_cost

from drapery import Banner
from drapery.batch.jobs import make_job
from drapery.batch.keys import DigestCache
from drapery.batch.manifest import read_manifest
from drapery.errors import DesignError, DraperyError, OptionError, PackError
from drapery.option import Option
from drapery.player_settings import PLAYER_OPTIONS, PlayerSettings
from drapery.serve.request_params import (
    MAX_REASONS,
    PictureLimits,
    ServiceConfig,
    Subject,
    parameters,
    read_request,
)
from drapery.settings import LOOP_OPTIONS, OPTIONS, Settings
from drapery.testing.cases import read_cases

LIMITS, CONFIG, DIGESTS = PictureLimits(), ServiceConfig(), DigestCache()

ALL = [*OPTIONS.values(), *PLAYER_OPTIONS.values(), *LOOP_OPTIONS.values()]
VALUES = (*hostile.VALUES, *hostile.changed_texts(60, seed=1))


def refusal(error: DraperyError) -> str:
    """The error's text, which is a line that a terminal can show."""
    line = str(error)
    assert 0 < len(line) < 4000 and "\n" not in line and "\r" not in line, line[:200]
    return line


@pytest.mark.parametrize("option", ALL, ids=lambda option: option.name)
def test_an_option_takes_a_value_or_refuses_it_in_a_line(option: Option) -> None:
    for value in VALUES:
        for read in (option.check, option.parse, lambda given: option.parse(given, Path("here"))):
            try:
                option.to_text(read(value))
            except OptionError as error:
                assert option.name in refusal(error)


@pytest.mark.parametrize("kind", [Settings, PlayerSettings])
def test_settings_take_a_value_or_refuse_it_in_a_line(kind: type[Any]) -> None:
    options = OPTIONS if kind is Settings else PLAYER_OPTIONS
    for name in options:
        for value in VALUES:
            try:
                kind(**{name: value})
            except DraperyError as error:
                refusal(error)


def jsonable(value: object) -> bool:
    return isinstance(value, str | bool | int | float | list | dict | None) and not (
        isinstance(value, int) and abs(value) > 10**4000
    )


DESIGNS = [value for value in VALUES if not isinstance(value, str) and value != 0]


@pytest.mark.parametrize("value", DESIGNS, ids=lambda value: type(value).__name__)
def test_a_design_that_is_no_text_is_refused_in_a_line(value: object, tmp_path: Path) -> None:
    with pytest.raises(DesignError, match=r"design .* is not a text; write it in quotes") as caught:
        Banner.parse(value)  # type: ignore[arg-type]
    refusal(caught.value)
    if not jsonable(value):
        return
    text = json.dumps(value)
    for name, words in {
        "a.jsonl": f'{{"design": {text}}}\n',
        "b.yaml": f"case:\n- {{name: a, design: {text}}}\n",
    }.items():
        file = tmp_path / name
        file.write_text(words, encoding="utf-8")
        try:
            read_manifest(file) if name == "a.jsonl" else read_cases(file)
        except DraperyError as error:
            refusal(error)


def test_errors_are_one_line_that_a_terminal_can_show() -> None:
    assert str(PackError("pack a\nb\x1b[31m\u2028 é …")) == "pack a b\\x1b[31m  é …"


# The service

QUERIES = {"banner": {"design": "red"}, "garment": {"name": "cape"}, "player": {"motion": "stand"}}
SWEPT = [
    (subject, part["name"]) for subject in QUERIES for part in parameters(True, LIMITS, subject)
]


@pytest.mark.parametrize(("subject", "name"), SWEPT)
def test_a_parameter_of_an_address_makes_a_job_or_reasons(subject: Subject, name: str) -> None:
    # Each name of a style that is not known makes a list of the styles of all packages.
    texts = [value for value in VALUES if isinstance(value, str)][:: 1 + 9 * (name == "style")]
    with limited_cost(10):
        for value in texts:
            found = read_request(
                [*(QUERIES[subject] | {name: value}).items()], ".gif", CONFIG, subject
            )
            if isinstance(found, list):
                assert 0 < len(found) <= MAX_REASONS
                assert all("\n" not in line and len(line) <= 300 for line in found), found
            else:
                make_job(found, DIGESTS)  # which names the files that are read


@pytest.fixture(scope="module")
def answer() -> Iterator[Callable[[str], Any]]:
    """What the service answers to an address, without drawing."""
    with fuzz_targets.undrawn_service() as client:
        yield client.get


@pytest.mark.parametrize(
    "motion", ["+".join(["walk"] * 9), "walk+", "walk:2,wave:1", "walk:0", "x"]
)
def test_a_motion_that_cannot_be_read_is_the_fault_of_the_address(
    answer: Callable[[str], Any], motion: str
) -> None:
    got = answer(f"/player.png?motion={quote(motion)}")
    assert got.status_code == 422 and "motion" in got.json()["detail"][0]


@pytest.mark.parametrize(
    "path",
    ["/banner.png/", "//banner.png", "/banner.png//", "/metrics/", "//evil.example/", "/docs/"],
)
def test_no_redirect_leads_to_the_host_of_a_request(answer: Callable[..., Any], path: str) -> None:
    got = answer(path, headers={"Host": "evil.example"}, follow_redirects=False)
    assert got.status_code == 404 and "location" not in got.headers


@pytest.mark.parametrize(
    "query", ["design=red&design=red", "design[]=red", "design=red&x=%00", "&" * 99]
)
def test_odd_queries_are_refused_with_reasons(answer: Callable[[str], Any], query: str) -> None:
    got = answer(f"/banner.png?{query}")
    assert got.status_code in (414, 422) and got.json()["detail"]
