"""Reads a blazon by the grammar in `blazon.lark`."""

from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any

from drapery.banner.blazon.building import BlazonField, Charge, build
from drapery.banner.blazon.problems import refusal
from drapery.banner.blazon.terms import Spoken, read_terms
from drapery.banner.design import Banner
from drapery.errors import DesignError

if TYPE_CHECKING:
    from lark import Lark, Token
    from lark.exceptions import UnexpectedInput


def parse_blazon(text: str) -> Banner:
    """The banner of an English blazon, such as `Azure, a bend Or`.

    Layers are in the order of the text; what a charge is between lies below it. Dexter is the
    viewer's left. Raises DesignError that names every term that a banner cannot show.
    """
    from lark.exceptions import UnexpectedInput

    terms = read_terms(text)
    try:
        # The transformer gives what `start` returns, not a tree.
        parsed: Any = _parser().parse(text)
    except UnexpectedInput as error:
        if terms.unknown:
            raise refusal([f"{words!r}" for words in terms.unknown]) from None
        raise DesignError(_explained(error, terms.spoken)) from None
    openings = [one.words.lower() for one in terms.spoken if one.term.kind == "OPENING"]
    is_shield = any("shield" in words for words in openings)
    field, charges = parsed
    return build(field, charges, terms.unknown, "shield" if is_shield else "banner")


def _explained(error: "UnexpectedInput", spoken: list[Spoken]) -> str:
    """What is wrong with the order of the terms."""
    token = getattr(error, "token", None)
    if token is not None and token.type != "$END":
        place = next(n for n, one in enumerate(spoken) if one.start == token.value.start)
        here = f"{spoken[place].words!r} is not expected"
        before = f" after {spoken[place - 1].words!r}" if place else " at the beginning"
    else:
        here, before = "the blazon ends too early", f" after {spoken[-1].words!r}"
    return f"{here}{before}; write a field, then charges with tinctures, as in 'Azure, a bend Or'"


@cache
def _parser() -> "Lark":
    from lark import Lark
    from lark.lexer import Lexer, Token

    class TermLexer(Lexer):
        """Gives the grammar the terms as tokens, each with a Spoken as its value."""

        def __init__(self, config: object) -> None:
            del config

        def lex(self, data: str) -> "Iterator[Token]":  # type: ignore[override]
            for one in read_terms(data).spoken:
                yield Token(one.term.kind, one, one.start)

    grammar = files(__package__).joinpath("blazon.lark").read_text("utf-8")
    return Lark(
        grammar, parser="lalr", lexer=TermLexer, transformer=_build(), maybe_placeholders=False
    )


def _build() -> Any:
    """The functions that make the field and the charges, by the names of the grammar's rules."""
    from lark import Transformer

    class BlazonBuilder(Transformer[Any, Any]):
        def start(self, c: list[Any]) -> tuple[BlazonField, list[Charge]]:
            field = next(part for part in c if isinstance(part, BlazonField))
            return field, self.group(c)

        def plain(self, c: list[Any]) -> BlazonField:
            return BlazonField(None, (c[0].value,))

        def divided(self, c: list[Any]) -> BlazonField:
            tinctures = tuple(one.value for one in c[1:] if one.type == "TINCTURE")
            return BlazonField(c[0].value, tinctures)

        def clause(self, c: list[Any]) -> list[Charge]:
            charges: list[Charge] = c[-1]
            return charges

        def group(self, c: list[Any]) -> list[Charge]:
            return [charge for part in c if isinstance(part, list) for charge in part]

        over = group

        def between(self, c: list[Any]) -> list[Charge]:
            return [*c[2], *c[0]]

        def between_first(self, c: list[Any]) -> list[Charge]:
            return [*c[1], *c[2]]

        def on(self, c: list[Any]) -> list[Charge]:
            return [*c[1], *(charge.on(c[1][-1]) for charge in c[2])]

        def on_between(self, c: list[Any]) -> list[Charge]:
            return [*c[3], *c[1], *(charge.on(c[1][-1]) for charge in c[4])]

        def upon(self, c: list[Any]) -> list[Charge]:
            is_above = c[1].value.term.value in ("surmounted by", "debruised by")
            return [*c[0], *(one if is_above else one.on(c[0][-1]) for one in c[2])]

        def charge(self, c: list[Any]) -> list[Charge]:
            return [Charge.of([one.value for one in c])]

        masoned = charge

    return BlazonBuilder()
