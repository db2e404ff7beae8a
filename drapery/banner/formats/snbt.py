"""SNBT and the game's commands: text to a plain tree by the grammar in `snbt.lark`, and back."""

import re
from collections.abc import Iterator
from functools import cache
from importlib.resources import files
from typing import TYPE_CHECKING, Any, NoReturn

from drapery.banner.formats.tree import DataTree
from drapery.banner.names import shown
from drapery.errors import DesignError

if TYPE_CHECKING:
    from lark import Lark, Token
    from lark.exceptions import UnexpectedInput

MAX_TEXT = 1 << 20
"""Most characters of a text."""

MAX_DEPTH = 512
"""Most brackets inside each other; the game's own parser has the same limit."""

MAX_TOKENS = 120_000
"""Most words, strings and brackets; a thousand banners of six layers have about 70,000."""


class Brackets(dict[str, DataTree]):
    """The contents of `[name=value,…]`: components, a block's state, or a selector's filters."""


Part = Any
"""A part of a command: a word (a str: lark's Token, with its column), Brackets, or a compound."""


def parse_snbt(text: str, *, line: int = 1) -> DataTree:
    """The tree of an SNBT text. Typed numbers become int and float, typed arrays lists.

    line: the number of the text's first line, for errors.

    Raises DesignError with line, column and what was expected, and for texts over the limits.
    """
    return _parse(text, "tree", line)


def parse_command(text: str, *, line: int = 1) -> list[Part]:
    """The parts of a command or of an item argument, in order, by the same rules."""
    parts: list[Part] = _parse(text, "command", line)
    return parts


class TypedInt(int):
    """An int whose text names its type, such as `5b` or `true`; `write_snbt` writes that text."""

    text: str


class TypedFloat(float):
    """A float whose text names its type, such as `1.5f`; `write_snbt` writes that text."""

    text: str


class TypedList(list[DataTree]):
    """A typed array, such as `[I;1,2]`, whose letter `write_snbt` writes."""

    letter: str


def write_snbt(tree: DataTree) -> str:
    """The shortest SNBT of a tree, as in the game's commands: `{pattern:"creeper"}`.

    Numbers and arrays that were read keep their types.
    """
    if isinstance(tree, dict):
        return "{" + ",".join(f"{_key(k)}:{write_snbt(v)}" for k, v in tree.items()) + "}"
    if isinstance(tree, list):
        kind = f"{tree.letter};" if isinstance(tree, TypedList) else ""
        return f"[{kind}" + ",".join(map(write_snbt, tree)) + "]"
    if isinstance(tree, str):
        text = tree.replace("\\", "\\\\").replace('"', '\\"')
        return '"' + _CONTROL.sub(lambda match: f"\\x{ord(match[0]):02x}", text) + '"'
    if isinstance(tree, bool):
        return "true" if tree else "false"
    return tree.text if isinstance(tree, (TypedInt, TypedFloat)) else str(tree)


_CONTROL = re.compile(r"[\x00-\x1f\x7f]")


def _key(key: str) -> str:
    return key if re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", key) else write_snbt(key)


def _parse(text: str, start: str, line: int) -> Any:
    if len(text) > MAX_TEXT:
        raise DesignError(f"the text has {len(text)} characters, over {MAX_TEXT}: shorten it")
    from lark.exceptions import UnexpectedInput

    try:
        return _parser().parse(text, start)
    except UnexpectedInput as error:
        _explain(error, text, line)
    except _FaultError as fault:
        raise DesignError(f"{_where(fault.token, line)}: {fault}") from None


@cache
def _parser() -> "Lark":
    from lark import Lark

    grammar = files(__package__).joinpath("snbt.lark").read_text("utf-8")
    return Lark(
        grammar,
        parser="lalr",
        start=["tree", "command"],
        transformer=_build(),
        postlex=_Limits(),
        maybe_placeholders=False,
    )


class _FaultError(Exception):
    """A fault at a token that the grammar does not detect."""

    def __init__(self, token: Any, message: str) -> None:
        super().__init__(message)
        self.token = token


class _Limits:
    """Counts tokens and depth while the text is read, and ends at the limits."""

    always_accept = ()

    def process(self, stream: "Iterator[Token]") -> "Iterator[Token]":
        depth = 0
        for number, token in enumerate(stream):
            if token.type in ("LBRACE", "LSQB"):
                depth += 1
            elif token.type in ("RBRACE", "RSQB"):
                depth -= 1
            if depth > MAX_DEPTH:
                raise _FaultError(token, f"nested over {MAX_DEPTH} deep: no banner needs that")
            if number >= MAX_TOKENS:
                raise _FaultError(token, f"over {MAX_TOKENS} words and brackets: shorten the text")
            yield token


def _build() -> Any:
    """The functions that build the tree, by the names of the grammar's rules."""
    from lark import Transformer

    class Build(Transformer[Any, Any]):
        def tree(self, c: list[Any]) -> DataTree:
            return c[0]

        def command(self, c: list[Any]) -> list[Part]:
            return c

        def word(self, c: list[Any]) -> Part:
            return c[0]

        def string(self, c: list[Any]) -> str:
            return _unquoted(c[0])

        def key_word(self, c: list[Any]) -> str:
            return str(c[0])

        def identifier(self, c: list[Any]) -> str:
            return f"{c[0]}:{c[1]}"

        def scalar(self, c: list[Any]) -> DataTree:
            return scalar(c[0])

        def call(self, c: list[Any]) -> DataTree:
            return _call(c[0], c[1:])

        def pair(self, c: list[Any]) -> tuple[str, DataTree]:
            return c[0], c[1]

        def scoped_pair(self, c: list[Any]) -> tuple[str, DataTree]:
            return f"{c[0]}:{c[1]}", c[2]

        def entry(self, c: list[Any]) -> tuple[str, DataTree]:
            return c[0], c[1] if len(c) > 1 else None

        def numbered(self, c: list[Any]) -> DataTree:
            return c[1]

        def pairs(self, c: list[Any]) -> list[Any]:
            return _joined(c)

        entries = elements = pairs

        def compound(self, c: list[Any]) -> dict[str, DataTree]:
            return dict(c[0]) if c else {}

        def brackets(self, c: list[Any]) -> Brackets:
            return _brackets(c[0] if c else [])

        def list(self, c: Any) -> DataTree:
            return c[0] if c else []

        def array(self, c: Any) -> DataTree:
            if c[0] not in ("B", "I", "L"):
                raise _FaultError(c[0], f"{shown(c[0])} is not a type of array; use B, I or L")
            array = TypedList(c[1] if len(c) > 1 else [])
            array.letter = str(c[0])
            return array

    return Build()


def _brackets(entries: list[tuple[str, DataTree]]) -> Brackets:
    names = [name.removeprefix("minecraft:") for name, _ in entries]
    if names.count("banner_patterns") > 1:
        raise DesignError("banner_patterns: the component is given twice; write it once")
    return Brackets(entries)


def _joined(children: list[Any]) -> list[Any]:
    """`items: item | items "," item`: the first child grows, so that long lists stay linear."""
    if len(children) == 1:
        return [children[0]]
    children[0].append(children[1])
    grown: list[Any] = children[0]
    return grown


_INTEGER = re.compile(
    r"([+-]?)(?:0[xX]([0-9a-fA-F_]+)|0[bB]([01_]+)|([0-9][0-9_]*))[uUsS]?[bBsSiIlL]?"
)
_FLOAT = re.compile(
    r"([+-]?(?:[0-9][0-9_]*\.?[0-9_]*|\.[0-9][0-9_]*)(?:[eE][+-]?[0-9][0-9_]*)?)[fFdD]?"
)
_LONGEST_NUMBER = 80


def scalar(word: str) -> DataTree:
    """The value of a bare word: `5b` and `0x5` are 5, `true` is 1, `creeper` is itself."""
    word = str(word)
    if word in ("true", "false"):
        return _typed_int(int(word == "true"), word)
    if len(word) > _LONGEST_NUMBER:
        return word
    try:
        if match := _INTEGER.fullmatch(word):
            number = _integer(*match.groups(default=""))
            return _typed_int(number, word) if word[-1].isalpha() else number
        if match := _FLOAT.fullmatch(word):
            return _float(match[1], word)
    except ValueError:  # nothing but underscores
        pass
    return word


def _typed_int(number: int, word: str) -> TypedInt:
    typed = TypedInt(number)
    typed.text = word
    return typed


def _float(digits: str, word: str) -> float:
    number = TypedFloat(digits.replace("_", ""))
    number.text = word
    return number


def _integer(sign: str, hexadecimal: str, binary: str, decimal: str) -> int:
    base = 16 if hexadecimal else 2 if binary else 10
    return int(sign + (hexadecimal or binary or decimal).replace("_", ""), base)


def _call(name: "Token", arguments: list[DataTree]) -> DataTree:
    """`bool(x)` and `uuid("…")`, the two functions of 1.21.5."""
    argument = arguments[0] if len(arguments) == 1 else None
    if name == "bool" and isinstance(argument, (int, float)):
        return _typed_int(int(argument != 0), "true" if argument else "false")
    if name == "uuid" and isinstance(argument, str):
        return _uuid(name, argument)
    raise _FaultError(
        name, f"{shown(str(name))} is not a function of SNBT; use bool(1) or uuid('…')"
    )


def _uuid(name: "Token", text: str) -> list[int]:
    """Four signed numbers of 32 bits, highest first."""
    digits = text.replace("-", "")
    if not re.fullmatch("[0-9a-fA-F]{32}", digits):
        raise _FaultError(name, f"{shown(text)} is not a UUID")
    words = [int(digits[place : place + 8], 16) for place in range(0, 32, 8)]
    array = TypedList(word - (1 << 32) if word >> 31 else word for word in words)
    array.letter = "I"
    return array


_ESCAPE = re.compile(
    r"\\(?:x([0-9a-fA-F]{2})|u([0-9a-fA-F]{4})|U([0-9a-fA-F]{8})|N\{([^}]{1,80})\}|(.))", re.DOTALL
)
_LETTERS = {"b": "\b", "s": " ", "t": "\t", "n": "\n", "f": "\f", "r": "\r"}


def _unquoted(token: "Token") -> str:
    """The text between the quotes, with its escapes resolved, as since 1.21.5."""
    inner = token[1:-1]
    if "\\" not in inner:
        return inner
    return _ESCAPE.sub(lambda match: _escape(token, match), inner)


def _escape(token: "Token", match: "re.Match[str]") -> str:
    code = match[1] or match[2] or match[3]
    try:
        if code:
            return chr(int(code, 16))
        if match[4]:
            import unicodedata

            return unicodedata.lookup(match[4])
    except (ValueError, OverflowError, KeyError):
        raise _FaultError(token, f"{shown(match[0])} is not a character") from None
    return _LETTERS.get(match[5], match[5])


_EXPECTED = {
    "COMMA": "','",
    "COLON": "':'",
    "SEMICOLON": "';'",
    "EQUAL": "'='",
    "RBRACE": "'}'",
    "RSQB": "']'",
    "RPAR": "')'",
    "$END": "the end",
    "WORD": "a name or value",
    "COMMAND_WORD": "a word",
}


def _explain(error: "UnexpectedInput", text: str, line: int) -> NoReturn:
    """Raise a one-line error with the place and what was expected there."""
    from lark.exceptions import UnexpectedCharacters

    token = getattr(error, "token", None)
    if token is not None and token.type == "$END":
        place, what = len(text.rstrip()), "the text ends too early"
    else:
        place = min(error.pos_in_stream or 0, len(text))
        what = f"unexpected {text[place : place + 1]!r}"
    where = _where_at(text, place, line)
    if isinstance(error, UnexpectedCharacters) and text[place : place + 1] in ("'", '"'):
        raise DesignError(
            f"{where}: a quote that is not closed {_excerpt(text, place)}; close it"
        ) from None
    raise DesignError(f"{where}: {what} {_excerpt(text, place)}{_wanted(error)}") from None


def _wanted(error: "UnexpectedInput") -> str:
    expected = next(
        filter(None, (getattr(error, k, None) for k in ("accepts", "allowed", "expected"))), ()
    )
    # If a value may end here, the other ways to continue it are not worth a hint.
    idle = {"COLON", "EQUAL", "SEMICOLON", "LPAR"} if "COMMA" in expected else set()
    names = [name for key, name in _EXPECTED.items() if key in expected and key not in idle]
    return f"; expected {' or '.join(names)}" if names else ""


def _excerpt(text: str, place: int) -> str:
    before, after = text[max(place - 20, 0) : place], text[place : place + 12]
    lead = "…" if place > 20 else ""
    trail = "…" if len(text) > place + 12 else ""
    line = f"at {lead}{before}⟨here⟩{after}{trail}"
    return "".join(c if c.isprintable() else " " for c in line)


def _where_at(text: str, place: int, line: int) -> str:
    rows = text.count("\n", 0, place)
    column = place - text.rfind("\n", 0, place)
    return f"line {line + rows}, column {column}"


def _where(token: "Token", line: int) -> str:
    return f"line {line - 1 + (token.line or 1)}, column {token.column}"
