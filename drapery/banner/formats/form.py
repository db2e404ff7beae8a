"""A form of banners as the registry lists it: its name, and how to recognise, read and write it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner


@dataclass(frozen=True)
class Form:
    """A form of text.

    name: what `--from` and `--as` take.
    title: a short description.
    example: a text of the form.
    recognises: whether a text is probably of this form; it is fast and never raises.
    read: all banners of a text, at least one; raises DesignError.
    write: the text of a banner; raises DesignError if the form cannot hold it. None if the form can
        only be read.
    source: where the form is defined: the address of a page or of a project.
    """

    name: str
    title: str
    example: str
    recognises: Callable[[str], bool]
    read: Callable[[str], list[FoundBanner]]
    write: Callable[[Banner], str] | None = None
    source: str = ""


@dataclass(frozen=True)
class BinaryForm:
    """A form of bytes, such as a region file.

    name: what `--from` takes.
    title: a short description.
    suffixes: endings of its files' names, such as `.mca`.
    recognises: whether the first bytes and the name of a file are of this form.
    read: all banners in the file, which may be none; raises DesignError for a broken file.
    write: the file of a banner; None if the form can only be read.
    source: where the form is defined.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    recognises: Callable[[bytes, str], bool]
    read: Callable[[bytes], Iterable[FoundBanner]]
    write: Callable[[Banner], bytes] | None = None
    source: str = ""


def single(parse: Callable[[str], Banner]) -> Callable[[str], list[FoundBanner]]:
    """A function that reads all banners, from one that parses a single banner."""
    return lambda text: [FoundBanner(parse(text))]
