"""Colours as parameters of steps. Imports pydantic, which pictures without a style do not need."""

from typing import Annotated

from pydantic import Field

from drapery.styles.colours import COLOUR_PATTERN

Colour = Annotated[str, Field(pattern=COLOUR_PATTERN)]
"""A parameter that is a colour."""
