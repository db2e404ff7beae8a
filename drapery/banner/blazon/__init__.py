"""Banners in the words of English heraldry: `Azure, a bend Or` gives a design, and back."""

from drapery.banner.blazon.reading import parse_blazon
from drapery.banner.blazon.writing import write_blazon

__all__ = ["parse_blazon", "write_blazon"]
