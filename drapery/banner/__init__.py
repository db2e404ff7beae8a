"""What a banner is, how it is written down, and the pictures it is made of."""

from drapery.banner.design import Banner, Layer, use_parser

__all__ = ["Banner", "Layer"]


def _parse(text: str) -> Banner:
    # The forms are imported when the first text is read: they take a while.
    from drapery.banner.formats import parse_banner

    return parse_banner(text)


use_parser(_parse)
