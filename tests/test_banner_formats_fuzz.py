"""A slice of the fuzzing: a changed text gives banners or one line, soon."""

import fuzzing
import pytest

from drapery.banner.formats import FORMS, parse_banner, write_banner
from drapery.errors import DesignError

DESIGNS = ["red", "white creeper:lime border:black", "shield blue acme:x:red flow:lime"]


def samples(form: str) -> list[str]:
    texts = [FORMS[form].example]
    for design in DESIGNS:
        try:
            texts.append(write_banner(parse_banner(design), form))
        except DesignError:
            continue
    return texts


@pytest.mark.parametrize("form", FORMS)
def test_changed_texts_are_read_or_refused(form: str):
    tally = fuzzing.fuzz(FORMS[form].read, samples(form), fuzzing.mutate_text, 300, seed=2)
    assert not tally.failures, tally.failures[0]
    assert tally.count == 300 and len(tally.outcomes) > 3


def test_changed_texts_of_no_told_form_are_read_or_refused():
    from drapery.banner.formats import parse_banners

    texts = [text for form in FORMS for text in samples(form)]
    tally = fuzzing.fuzz(parse_banners, texts, fuzzing.mutate_text, 1500, seed=3)
    assert not tally.failures, tally.failures[0]
