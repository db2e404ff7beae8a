"""The error that names what a banner cannot show."""

from difflib import get_close_matches

from drapery.banner.blazon.vocabulary import NOT_SHOWN, normal, terms
from drapery.errors import DesignError

_MOST = 6
_MOST_WORDS = 3
_LONGEST = 40
REMEDY = (
    "use ordinaries (chief, base, pale, fess, bend, cross, saltire, chevron, pile, canton,"
    " bordure, roundel, lozenge) and the charges creeper, skull, flower, thing, globe, snout,"
    " flow, guster"
)


def refusal(problems: list[str]) -> DesignError:
    """The error that names all problems, in one line."""
    first = problems[:_MOST]
    named = [problem if "(" in problem else _with_hint(problem) for problem in first]
    more = f" and {len(problems) - _MOST} more" if len(problems) > _MOST else ""
    return DesignError(f"a banner cannot show {', '.join(named)}{more}; {REMEDY}")


def _with_hint(problem: str) -> str:
    """The problem, a quoted text, with what comes close to it."""
    words = normal(problem.strip("'\"")).replace("-", " ")[:200]
    short = " ".join(problem[1:-1].split())
    quoted = repr(short if len(short) <= _LONGEST else short[: _LONGEST - 1] + "…")
    for parts in (words, *words.split()[:_MOST_WORDS]):
        singular = parts.removesuffix("s")
        near = NOT_SHOWN.get(parts) or NOT_SHOWN.get(singular)
        if near:
            return f"{quoted} (the nearest is {near})"
        close = get_close_matches(parts[:_LONGEST], _spellings(), 1, 0.75) if len(parts) > 3 else []
        if close:
            return f"{quoted} (did you mean '{close[0]}'?)"
    return quoted


def _spellings() -> list[str]:
    kinds = ("NOUN", "TINCTURE", "DIVISION")
    return [words for words, term in terms().items() if term.kind in kinds and len(words) > 3]
