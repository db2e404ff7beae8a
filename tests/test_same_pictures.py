"""Forty requests over everything that Drapery draws, each with the hash of its picture.

They change only with the pictures: a change that means to make others, and has looked at them,
writes the file anew by `python -m benchmarks.same_pictures tests/same_pictures.txt --count 40`.
"""

import json
from pathlib import Path

import pytest
from picture_requests import SUBJECTS, Request, digest, requests

LINES = (Path(__file__).parent / "same_pictures.txt").read_text(encoding="utf-8").splitlines()


@pytest.mark.filterwarnings("ignore")  # a style without effect says so
@pytest.mark.parametrize("number", range(len(LINES)))
def test_a_picture_has_its_hash(number: int) -> None:
    hashed, text = LINES[number].split(" ", 1)
    assert digest(Request(*json.loads(text))) == hashed, text


def test_requests_are_the_same_for_ever() -> None:
    texts = [line.split(" ", 1)[1] for line in LINES]
    assert [request.text for request in requests(len(LINES))] == texts
    assert {json.loads(text)[0] for text in texts} == set(SUBJECTS)
