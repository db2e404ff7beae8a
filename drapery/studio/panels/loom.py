"""The design as a recipe for the loom: the required items and the steps."""

from dataclasses import replace
from html import escape

from nicegui import ui

from drapery import Banner, DraperyError
from drapery.banner import (
    LOOM_LAYERS,
    CraftingItem,
    crafting_items,
    fits_loom,
    loom_steps,
    simplify,
)
from drapery.packs import Packs
from drapery.studio.art import face_address
from drapery.studio.descriptions import dye_title, pattern_title
from drapery.studio.icons import icon_address
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of, sketch_of
from drapery.studio.translation import translated
from drapery.studio.widgets import button, text_element, translated_text


def build(session: Session) -> None:
    """The recipe, and a button that leaves out layers that cannot be seen."""
    translated_text("Loom recipe", "h2").classes("heading")
    warning = text_element("", "p").classes("warning").props('role="status"')
    with ui.element("div").classes("line") as spare:
        hint = text_element("", "span").classes("hint grow")
        button(
            "Leave out layers that change nothing",
            lambda: simplify_design(session),
            text="Leave out",
        )
    recipe = ui.html("", sanitize=False).classes("recipe")

    def show() -> None:
        try:
            banner = banner_of(session.sketch)
            unseen = len(banner.layers) - len(simplify(banner, session.packs()).layers)
        except DraperyError:  # the live cloth says why
            return
        line = f"A loom makes at most {LOOM_LAYERS} layers; the design has {len(banner.layers)}."
        warning.set_text(translated(line))
        warning.set_visibility(not fits_loom(banner))
        hint.set_text(translated(f"Layers that change nothing that can be seen: {unseen}"))
        spare.set_visibility(unseen > 0)
        recipe.set_content(_recipe(session, banner))

    session.follow(show, "sketch", "packs")


def simplify_design(session: Session) -> None:
    """Leave out the layers that change no texel. Raises DesignError or PackError."""
    banner = simplify(banner_of(session.sketch), session.packs())
    session.lay_out(sketch_of(banner, session.sketch.title), same=True)


def _recipe(session: Session, banner: Banner) -> str:
    items = "".join(_item(one, session.packs()) for one in crafting_items(banner))
    rows = "".join(
        _row(
            face_address(session, replace(banner, layers=banner.layers[:number]), 2),
            _step_title(step.layer.dye, step.layer.pattern),
            step.item,
        )
        for number, step in enumerate(loom_steps(banner), 1)
    )
    first, second, none = (
        escape(translated(text)) for text in ("Items", "Steps", "None: the banner is plain.")
    )
    steps = f'<ol class="steps">{rows}</ol>' if rows else f'<p class="hint">{none}</p>'
    return f'<h3>{first}</h3><ul class="goods">{items}</ul><h3>{second}</h3>{steps}'


def _item(item: CraftingItem, packs: Packs) -> str:
    """One item with its icon and count; a hint says if it is kept, and where it comes from."""
    words = f"{item.count} {item.item.replace('_', ' ')}"
    hints = [] if item.consumed else [translated("kept")]
    hints += [item.source.replace("_", " ")] if item.source else []
    hint = f' <span class="hint">{escape(", ".join(hints))}</span>' if hints else ""
    picture = f'<img src="{icon_address(item.item, packs)}" alt="" width="24" height="24">'
    return f"<li>{picture}<span>{escape(words)}{hint}</span></li>"


def _row(address: str, did: str, item: str | None) -> str:
    needs = f'<span class="hint">with {escape(item.replace("_", " "))}</span>' if item else ""
    picture = f'<img src="{escape(address)}" alt="" width="30" height="60" loading="lazy">'
    return f"<li>{picture}<span><b>{escape(did)}</b>{needs}</span></li>"


def _step_title(dye: str, pattern: str) -> str:
    return f"{dye_title(dye)} {pattern_title(pattern)}"
