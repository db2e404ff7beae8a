"""Designs, dyes and patterns for labels, tooltips and screen readers."""

from drapery.option import Option
from drapery.studio.translation import translated


def dye_title(dye: str) -> str:
    """The dye's title: "Light blue" for `light_blue`."""
    return translated(dye.replace("_", " ").capitalize())


def view_title(view: str) -> str:
    """The name of a camera's view on the page."""
    return {"iso": "Corner", "gui": "Item"}.get(view, view.capitalize())


def option_help(option: Option) -> str:
    """What an option means, with its limits; in other languages than English only its numbers."""
    words = translated(option.help)
    if words == option.help:
        return option.describe()
    if option.bounds is None:
        return words
    low, high = option.bounds
    return f"{words} ({low:g} – {high:g} {translated(option.unit)})".replace(" )", ")")


def with_unit(option: Option, value: float) -> str:
    """A number with the unit of its option, for example `1 texel`."""
    is_symbol = len(option.unit) < 4  # such as m/s, which has no plural
    unit = option.unit if is_symbol or value != 1 else option.unit.removesuffix("s")
    return f"{value:g} {translated(unit)}".rstrip()


def choice_titles(option: Option) -> dict[str, str]:
    """The choices of an option as text with their titles; "" for None, if it may be None."""
    titles = {str(name): str(name).replace("-", " ") for name in option.choices}
    return {"": option.default_text} | titles if titles and option.default is None else titles


def named(name: str, description: str) -> str:
    """A garment or a scene in a list: its name and what it is, in other languages only that."""
    text = translated(description)
    return f"{name}: {description}" if text == description else text
