"""Forty requests over everything that Drapery draws, each with the hash of its picture.

They change only with the pictures: a change that means to make others, and has looked at them,
writes the file anew by `python -m benchmarks.same_pictures tests/same_pictures.txt --count 40`.
"""

import json
from pathlib import Path

import picture_requests
import pytest
from picture_requests import SUBJECTS, Request, added, digest, requests

from benchmarks.same_pictures import compare

LINES = (Path(__file__).parent / "same_pictures.txt").read_text(encoding="utf-8").splitlines()
COUNT = 40
"""Of requests with a number; those that were `added` may follow."""


LONG = 17
"""The number of a request for 16 s of thin cloth by an explicit solver."""
NUMBERS = [
    pytest.param(number, marks=pytest.mark.slow) if number == LONG else number
    for number in range(len(LINES))
]


@pytest.mark.filterwarnings("ignore")  # a style without effect says so
@pytest.mark.parametrize("number", NUMBERS)
def test_a_picture_has_its_hash(number: int) -> None:
    hashed, text = LINES[number].split(" ", 1)
    assert digest(Request(*json.loads(text))) == hashed, text


def test_requests_are_the_same_for_ever() -> None:
    texts = [line.split(" ", 1)[1] for line in LINES]
    assert [request.text for request in requests(COUNT)] == texts[:COUNT]
    assert {json.loads(text)[0] for text in texts} == set(SUBJECTS)


def test_a_new_garment_or_style_adds_a_request_and_changes_no_other(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    before = [request.text for request in requests(COUNT)]
    known = {request.text for request in added()}
    for names, new in (("garment_names", "towel"), ("style_names", "plaid")):
        found = [new, *getattr(picture_requests, names)()]
        monkeypatch.setattr(picture_requests, names, found.copy)
    assert [request.text for request in requests(COUNT)] == before
    towel, plaid = (request for request in added() if request.text not in known)
    assert towel.what["garment"] == "towel" and plaid.options["style"] == ["plaid"]


def test_requests_are_compared_by_what_they_ask_for() -> None:
    before = ['a ["banner",{},{}]', 'b ["garment",{},{}]', 'c ["loop",{},{}]']
    now = ['a ["banner",{},{}]', 'd ["cape",{},{}]', 'refused: no wind ["garment",{},{}]']
    assert compare(before, now) == (2, now[2:])
