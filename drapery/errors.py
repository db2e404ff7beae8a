"""Errors for users: one line with the input, the place in it and the remedy."""

import shlex
from unicodedata import category

MAX_SHOWN = 48
"""The most characters of a value in a message."""

_BARE = frozenset("_-:./")
"""Characters beside letters and digits that no shell reads as more than themselves."""
_IN_QUOTES = _BARE | frozenset(" ,#'()[]{}<>|&;=+*?~^@")
"""Those that it reads so within double quotes. PowerShell parts a bare word at a comma."""


def counted(number: float, noun: str, plural: str = "") -> str:
    """A number with its noun, such as `1 golden` or `2 goldens`. plural: one without an s."""
    written = f"{number:g}" if isinstance(number, float) else f"{number}"
    return f"{written} {noun if number == 1 else plural or f'{noun}s'}"


def shown(value: object) -> str:
    """A value as a message quotes it: on one line, of at most 48 characters."""
    try:
        text = f"{value:g}" if isinstance(value, float) else " ".join(repr(value).split())
    except ValueError:  # Python does not write whole numbers of over 4300 digits
        return "of thousands of digits"
    return text if len(text) <= MAX_SHOWN else text[: MAX_SHOWN - 4] + " ..."


def quoted(word: str) -> str:
    """A word of a command for a shell; in double quotes if possible, as Windows knows no others."""
    marks = {each for each in word if category(each)[0] not in "LMN"}
    if word and marks <= _BARE:
        return word
    return f'"{word}"' if word and marks <= _IN_QUOTES else shlex.quote(word)


class DraperyError(Exception):
    """A fault that the user can correct. Its message is one line; commands then exit with 2.

    Names of files and texts in a message may hold anything: white space becomes a space, and other
    characters that cannot be printed, such as those that steer a terminal, are escaped.
    """

    def __str__(self) -> str:
        return _on_one_line(super().__str__())


def _on_one_line(text: str) -> str:
    if text.isprintable():
        return text
    return "".join(
        each if each.isprintable() else " " if each.isspace() else repr(each)[1:-1]
        for each in text.strip()
    )


class DesignError(DraperyError):
    """A text or file that cannot be read as a banner."""


class PackError(DraperyError):
    """A resource pack, or a file in it, that cannot be used."""


class OptionError(DraperyError):
    """An option or argument with a value that is not allowed."""


class BackendError(DraperyError):
    """A renderer, or the compiler of kernels, that cannot run on this machine."""


class OutputError(DraperyError):
    """A target that cannot be written."""
