"""What the door knows of a form: its name, how to tell it, how to read it, how to write it."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from drapery.banner.design import Banner
from drapery.banner.formats.found import FoundBanner


@dataclass(frozen=True)
class Form:
    """A form of text.

    name: what `--from` and `--as` take. title: what it is, for a table. example: a text of it.
    recognises: whether a text is (at least meant as) this form; cheap, never raises.
    read: all banners of a text, at least one; raises DesignError.
    write: the text of a banner; raises DesignError if the form cannot hold it. None: cannot write.
    """

    name: str
    title: str
    example: str
    recognises: Callable[[str], bool]
    read: Callable[[str], list[FoundBanner]]
    write: Callable[[Banner], str] | None = None


@dataclass(frozen=True)
class BinaryForm:
    """A form of bytes, such as a region file.

    suffixes: what its files end with, as `.mca`. recognises: by the first bytes and the file's
    name. read: all banners in the file, none is no error; raises DesignError for a broken file.
    """

    name: str
    title: str
    suffixes: tuple[str, ...]
    recognises: Callable[[bytes, str], bool]
    read: Callable[[bytes], Iterable[FoundBanner]]
    write: Callable[[Banner], bytes] | None = None


def single(parse: Callable[[str], Banner]) -> Callable[[str], list[FoundBanner]]:
    """A reader of all banners from a parser of one."""
    return lambda text: [FoundBanner(parse(text))]
