"""What a field must be is said by the type of its fault, not in pydantic's words."""

from pathlib import Path
from typing import Annotated, Any, Literal

import pytest
from pydantic import BaseModel, Field, ValidationError, field_validator

from drapery.model_faults import said_of, wanted


class Table(BaseModel):
    choice: Literal["a", "b c", "d"] = "a"
    one: Literal[1] = 1
    number: Annotated[float, Field(strict=True, ge=0, le=10)] = 1.0
    open: Annotated[float, Field(gt=0, lt=10)] = 1.0
    count: Annotated[int, Field(strict=True)] = 1
    word: Annotated[str, Field(pattern="^a+$", max_length=5)] = "a"
    title: Annotated[str, Field(min_length=2)] = "aa"
    flag: bool = True
    items: Annotated[tuple[int, ...], Field(min_length=1, max_length=2)] = (1,)
    path: Path = Path()
    inner: dict[str, int] = {}
    own: int = 0

    @field_validator("own")
    @classmethod
    def _is_even(cls, value: int) -> int:
        if value % 2:
            raise ValueError("own is odd; use an even one")
        return value


def fault(**given: Any) -> Any:
    with pytest.raises(ValidationError) as raised:
        Table(**given)
    return raised.value.errors()[0]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"choice": "x"}, "be 'a', 'b c' or 'd'"),
        ({"one": 2}, "be 1"),
        ({"number": "x"}, "be a number"),
        ({"number": -1.0}, "be greater than or equal to 0"),
        ({"number": 11.0}, "be less than or equal to 10"),
        ({"open": 0}, "be greater than 0"),
        ({"open": 10}, "be less than 10"),
        ({"count": 1.5}, "be a whole number"),
        ({"word": 1}, "be a text"),
        ({"word": "b"}, "match the pattern ^a+$"),
        ({"word": "a" * 6}, "have at most 5 characters"),
        ({"title": "a"}, "have at least 2 characters"),
        ({"flag": "x"}, "be true or false"),
        ({"items": 1}, "be a list"),
        ({"items": ()}, "have at least 1 values"),
        ({"items": (1, 2, 3)}, "have at most 2 values"),
        ({"path": 1}, "be the path of a file"),
        ({"inner": 1}, "be a table"),
    ],
)
def test_what_a_field_must_be(given: dict[str, Any], words: str) -> None:
    found = fault(**given)
    assert said_of(found) is None
    assert wanted(found) == words


def test_a_message_of_our_own_stays() -> None:
    assert said_of(fault(own=1)) == "own is odd; use an even one"


def test_a_fault_of_a_later_pydantic_has_words_too() -> None:
    assert wanted({"type": "not_yet_known", "msg": "Some words"}) == "be another value"
