"""Removes what surrounds a copied text: quotes, backticks, angle brackets, a Markdown link."""

import re

_FENCE = re.compile(r"```[\w-]*\n?(.*?)\n?```", re.DOTALL)
_LINK = re.compile(r"!?\[[^\]\n]*\]\(<?(https?://[^\s<>]+?)>?(?: \"[^\"]*\")?\)")
_PAIRS = (
    ("`", "`"),
    ("“", "”"),
    ("„", "“"),
    ("„", "”"),
    ("«", "»"),
    ("‘", "’"),
    ('"', '"'),
    ("'", "'"),
)
_INVISIBLE = str.maketrans({"\u00a0": " ", "\u202f": " ", "\u3000": " "})
_DROPPED = str.maketrans(dict.fromkeys("\u200b\u200e\u200f\u2060\ufeff", ""))
_DOUBLE = str.maketrans(dict.fromkeys("“”„‟″«»", '"'))
_SINGLE = str.maketrans(dict.fromkeys("‘’‚‛′", "'"))
_MOST_LAYERS = 4


def unwrap(text: str) -> str:
    """The text without what surrounds it, and with straight quotes in a command.

    A code fence, backticks, quotes, `<address>` and `[words](address)` around the whole text are
    removed. Typographic quotes become straight where the text has brackets and no straight
    quotes, and so do quotes that all have a backslash before them.
    """
    if not text.isascii():
        text = text.translate(_INVISIBLE).translate(_DROPPED)
    for _ in range(_MOST_LAYERS):
        inner = _without_one(text.strip())
        if inner is None:
            break
        text = inner
    return _straight(text) if "{" in text or "[" in text else text


def _without_one(text: str) -> str | None:
    """The text without its outermost wrapping, or None if it has none."""
    if match := _FENCE.fullmatch(text) or _LINK.fullmatch(text):
        return match[1]
    if text.startswith("<http") and text.endswith(">"):
        return text[1:-1]
    if text.startswith('\\"') and text.endswith('\\"') and len(text) > 4:
        return text[2:-2]
    if text.startswith('"/') and text.endswith('"'):
        return text[1:-1]
    for left, right in _PAIRS:
        inner = text[1:-1]
        wrapped = len(text) > 2 and text[0] == left and text[-1] == right
        if wrapped and not {left, right}.intersection(inner.replace(f"\\{right}", "")):
            return inner
    return None


def _straight(text: str) -> str:
    if '"' not in text:
        text = text.translate(_DOUBLE)
    elif '\\"' in text and text.count('"') == text.count('\\"'):
        text = text.replace('\\"', '"').replace("\\\\", "\\")
    return text if "'" in text else text.translate(_SINGLE)


def without_suffix(text: str) -> str | None:
    """The text without an amount or a size at its end, such as `,8` or `:256`; None without."""
    text = text.rstrip()
    match = re.search(r"[,:]\s*[0-9]{1,4}\Z", text[-8:])
    return text[: len(text) - len(match[0])] if match else None
