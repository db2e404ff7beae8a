"""The values of a program in JavaScript as trees: objects, lists, texts, numbers, expressions."""

import re
import warnings
from collections.abc import Callable, Iterator
from typing import NoReturn

from drapery.banner.formats.leftovers import Expression
from drapery.banner.formats.scripts import places
from drapery.banner.formats.snbt import MAX_TOKENS, scalar
from drapery.banner.formats.tree import DataTree
from drapery.banner.names import shown
from drapery.errors import DesignError

MAX_DEPTH = 64
"""Most objects and lists inside each other."""


def parse_object(text: str) -> DataTree:
    """The tree of a text that is one object or list. Raises DesignError with the place."""
    text = without_comments(text)
    parser = ValueParser(text, 0, places(text))
    tree = parser.value(0)
    if parser.text[parser.at :].strip(" \t\r\n;"):
        parser.fail("the text goes on after the object; leave the rest out")
    warn_of(parser.skipped)
    return tree


def warn_of(skipped: list[str]) -> None:
    """Warn of the first entry of an object whose key or value is no text."""
    if skipped:
        more = f", and {len(skipped) - 1} more" if len(skipped) > 1 else ""
        warnings.warn(f"{skipped[0]} is not read, since it is an expression{more}", stacklevel=3)


_TOKEN = re.compile(
    r"""\s*("(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|`(?:[^`\\]|\\.)*`|\.\.\.|[][{}(),:;]"""
    r"""|[^\s"'`\][{}(),:;]+|["'`]|\Z)""",
    re.DOTALL,
)
_COMMENT = re.compile(
    r"""("(?:[^"\\\n]|\\.)*(?:"|\\?(?=\n|\Z))|'(?:[^'\\\n]|\\.)*(?:'|\\?(?=\n|\Z))"""
    r"""|`(?:[^`\\]|\\.)*(?:`|\\?\Z))|//[^\n]*|/\*.*?(?:\*/|\Z)""",
    re.DOTALL,
)
"""A comment, or a string as far as it goes, so that each part of a text is passed over once."""

_ESCAPE = re.compile(r"\\(?:x([0-9a-fA-F]{2})|u([0-9a-fA-F]{4})|(\r?\n)|(.))", re.DOTALL)
_LETTERS = {"b": "\b", "t": "\t", "n": "\n", "f": "\f", "r": "\r", "v": "\v", "0": "\0"}
_WORD = re.compile(r"[\w$.:#+-]+")
_KEY = re.compile(r"[\w$#*.+-]+")
_CONSTANTS = {"true": True, "false": False, "null": None, "undefined": None}
_OPEN, _CLOSE = ("{", "[", "("), ("}", "]", ")")


def without_comments(text: str) -> str:
    """The text with blanks for its comments, so that places stay the same."""
    return _COMMENT.sub(lambda match: match[1] or re.sub(r"[^\n]", " ", match[0]), text)


class ValueParser:
    """Reads one value from a place on.

    at: how far it has come. skipped: the entries with keys that are not in the text, in words.
    """

    def __init__(self, text: str, start: int, place_of: Callable[[int], str]) -> None:
        self.text, self.at, self._place_of = text, start, place_of
        self.skipped: list[str] = []
        self._tokens = 0

    def fail(self, what: str) -> NoReturn:
        raise DesignError(f"{self._place_of(self.at)}: {what}")

    def token(self) -> str:
        """The next token, which stays the next one; empty at the end."""
        match = _TOKEN.match(self.text, self.at)
        return match[1] if match else ""

    def take(self) -> str:
        """The next token, which is passed over."""
        match = _TOKEN.match(self.text, self.at)
        if match is None or not match[1]:
            self.fail("the text ends within an object or list; close its brackets")
        self._tokens += 1
        if self._tokens > MAX_TOKENS:
            self.fail(f"over {MAX_TOKENS} words and brackets; shorten the text")
        if match[1] in ('"', "'", "`"):
            self.fail("a quote that is not closed; close it")
        self.at = match.end()
        return match[1]

    def value(self, depth: int) -> DataTree:
        """The value that begins here: a tree, or an Expression."""
        if depth > MAX_DEPTH:
            self.fail(f"brackets nest over {MAX_DEPTH} deep; no banner needs that")
        start = self.at
        token = self.token()
        tree: DataTree
        if token == "{":
            tree = self._object(depth)
        elif token == "[":
            tree = list(self._list(depth))
        elif token in (",", ";", *_CLOSE):
            self.fail(f"unexpected {shown(token)}; write a value before it")
        elif token == "(":
            return self._expression(start)
        else:
            tree = _literal(self.take())
        return tree if self.token() in (",", ";", "", *_CLOSE) else self._expression(start)

    def _object(self, depth: int) -> dict[str, DataTree]:
        tree: dict[str, DataTree] = {}
        self.take()
        while self.token() != "}":
            key, value = self._property(depth)
            tree.pop(key, None)  # a later entry is the value, at its own place
            tree[key] = value
            self._pass_comma("}")
        self.take()
        return tree

    def _property(self, depth: int) -> tuple[str, DataTree]:
        start, key = self.at, self.take()
        if key == "..." or key == "[":
            self.at = start
            value = self._expression(start)
            self.skipped.append(f"{self._place_of(start)}: {shown(value, 40)}")
            return f"{value}"[:80], value
        if key[0] not in "\"'" and not _KEY.fullmatch(key):
            self.fail(f"{shown(key, 20)} is no key; write it in quotes")
        following = self.token()
        if following in (",", "}"):  # { base } is { base: base }
            return _unquoted(key), Expression(key)
        if following == ":":
            self.take()
            return _unquoted(key), self.value(depth + 1)
        return _unquoted(key), self._expression(start)  # a method

    def _list(self, depth: int) -> Iterator[DataTree]:
        self.take()
        while self.token() != "]":
            start = self.at
            yield self._expression(start) if self.token() == "..." else self.value(depth + 1)
            self._pass_comma("]")
        self.take()

    def _pass_comma(self, close: str) -> None:
        if self.token() in (",", ""):
            self.take()
        elif self.token() != close:
            self.fail(f"unexpected {shown(self.token(), 20)}; write ',' or '{close}' before it")

    def _expression(self, start: int) -> "Expression":
        """What goes on from `start` to the next comma or closing bracket outside of brackets."""
        depth = 0
        while depth or self.token() not in (",", ";", "", *_CLOSE):
            token = self.take()
            depth += (token in _OPEN) - (token in _CLOSE)
        return Expression(" ".join(self.text[start : self.at].split()))


def _literal(token: str) -> DataTree:
    if token[0] in "\"'" or (token[0] == "`" and "${" not in token):
        return _unquoted(token)
    if token in _CONSTANTS:
        return _CONSTANTS[token]
    return scalar(token) if _WORD.fullmatch(token) else Expression(token)


def _unquoted(token: str) -> str:
    return _ESCAPE.sub(_character, token[1:-1]) if token[0] in "\"'`" else token


def _character(match: "re.Match[str]") -> str:
    code = match[1] or match[2]
    return chr(int(code, 16)) if code else "" if match[3] else _LETTERS.get(match[4], match[4])
