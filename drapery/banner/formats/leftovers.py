"""What looks like a design but is not read: such an input is refused, and never a plain banner.

A plain banner is a common result of a misspelt key, since the reader skips what it does not know.
So wherever no layer was read, the keys beside the place of the layers are checked here.
"""

import re
import warnings
from collections.abc import Container, Iterable, Iterator, Mapping
from difflib import get_close_matches
from typing import Any, TypeAlias

from drapery.banner.names import is_dye, shown
from drapery.errors import DesignError

_COMPONENTS_WORDS = """
attribute_modifiers banner_patterns base_color bees block_entity_data block_state blocks_attacks
break_sound bucket_entity_data bundle_contents can_break can_place_on charged_projectiles
consumable container container_loot creative_slot_lock custom_data custom_model_data custom_name
damage damage_resistant damage_type death_protection debug_stick_state dye dyed_color
enchantable enchantment_glint_override enchantments entity_data equippable fire_resistant
firework_explosion fireworks food glider hide_additional_tooltip hide_tooltip instrument
intangible_projectile item_model item_name jukebox_playable kinetic_weapon lock
lodestone_tracker lore map_color map_decorations map_id map_post_processing max_damage
max_stack_size minimum_attack_charge note_block_sound ominous_bottle_amplifier piercing_weapon
pot_decorations potion_contents potion_duration_scale profile provides_banner_patterns
provides_trim_material rarity recipes repair_cost repairable stored_enchantments
suspicious_stew_effects swing_animation tool tooltip_display tooltip_style trim unbreakable
use_cooldown use_effects use_remainder weapon writable_book_content written_book_content
"""
COMPONENTS = frozenset(_COMPONENTS_WORDS.split())
"""The components of the game's items, up to 26.1. https://minecraft.wiki/w/Data_component_format"""

_HOLDING = frozenset(
    {"bundle_contents", "charged_projectiles", "container", "trim", "use_remainder"}
)
"""Components that hold other items, whose designs are their own, or patterns of another sort."""

STATES = frozenset({"rotation", "facing", "waterlogged"})
"""The properties of the game's banners as blocks."""

_LAYERS = re.compile(
    r"""(?<!provides_banner_)patterns\\*["']?\s*[=:~]+\s*(?:\[\s*(?:\d+:)?[{\[$"']|\$[(⟨])"""
    r"""|pattern\\*["']?\s*[:=](?:(?!colou?r|pattern)[^{}\[\]]){1,80}colou?r\\*["']?\s*[:=]"""
    r"""|colou?r\\*["']?\s*[:=](?:(?!colou?r|pattern)[^{}\[\]]){1,80}pattern\\*["']?\s*[:=]""",
    re.IGNORECASE,
)
_KEY = re.compile("pattern|layer|design", re.IGNORECASE)

PARAMETER = re.compile("\\$⟨(\\w{1,80})⟩")
"""A macro's parameter, `$(dye)`, in the spelling that `literal_macro` gives it."""


def looks_like_design(text: str) -> bool:
    """Whether a text contains the layers of a banner, in the spelling of any version."""
    return _LAYERS.search(text) is not None


def literal_macro(line: str) -> str:
    """A macro line as a command of the same length: each `$(dye)` becomes one word."""
    return re.sub(r"\$\((\w{1,80})\)", "$⟨\\1⟩", line.replace("$", " ", 1))


class Expression(str):
    """The source of a value that a program computes, such as `dark ? 'red' : 'blue'`."""


def holds_expression(tree: object) -> bool:
    """Whether a tree is or holds an Expression."""
    return isinstance(tree, Expression) or any(
        isinstance(node, Expression) for _, node in _within(tree)
    )


def check_literal(value: object, at: str, what: str) -> None:
    """Raise DesignError for a value that is a macro's parameter, which has no value here, or an
    expression.
    """
    if isinstance(value, Expression):
        raise DesignError(
            f"{at}: the {what} is the expression {shown(value, 40)}; write a {what} in its place"
        )
    parameter = PARAMETER.search(value) if isinstance(value, str) else None
    if parameter:
        raise DesignError(
            f"{at}: the {what} is the macro's parameter $({parameter[1]});"
            f" write a {what} in its place"
        )


def check_components(components: Mapping[str, Any], at: str) -> None:
    """Raise DesignError for a component without layers that the game does not know.

    Components of other namespaces are the business of mods, unless they look like a design.
    """
    for key, value in components.items():
        name = key.removeprefix("!").removeprefix("minecraft:")
        check_literal(name, at or "components", "component")
        if name in ("banner_patterns", "base_color") and value is None and key[0] != "!":
            raise DesignError(f"{_under(at, key)}: the component has no value; write {key}=…")
        known = name in COMPONENTS or name in STATES or ":" in name
        if known and (name in _HOLDING or not _is_design(key, value)):
            continue
        close = get_close_matches(name[:40].lower(), ("banner_patterns", "base_color"), 1, 0.6)
        hint = f"; did you mean '{close[0]}'?" if close else ""
        raise DesignError(
            f"{_under(at, key)}: not a component of the game{hint or ';'} write layers as"
            ' [banner_patterns=[{pattern:"creeper",color:"lime"}]]'
        )


def check_keys(tree: Mapping[str, Any], at: str, read: Container[str] = ()) -> None:
    """Raise DesignError for a key without layers that looks like those of a design.

    read: keys that were read already.
    """
    for key, value in tree.items():
        if key not in read and _is_design(key, value):
            raise DesignError(
                f"{_under(at, key)}: this design cannot be read here; write the layers of an item"
                " as components:{banner_patterns:[…]}, and those of a block as patterns:[…]"
            )


def check_base(tree: object, at: str) -> None:
    """Raise DesignError for a base dye that lies too deep, where an item has none of its own."""
    for place, value in _within(tree):
        name = str(place[1]).removeprefix("minecraft:").lower()
        if name == "base_color" or (name == "base" and _is_dye(value)):
            raise DesignError(
                f"{_text(place, at)}: this base dye cannot be read here; write it at the item"
            )


def check_read(tree: object, layers_read: Iterable[int]) -> None:
    """Raise DesignError for layers in a text that no reader took, beside a plain banner.

    layers_read: how many layers each banner of the text has. Warns of a damage value, which was a
    banner's dye, that belongs to no item.
    """
    counts = list(layers_read)
    if not counts:
        return
    places = []
    for place, node in [((None, ""), tree), *_within(tree)]:
        if not isinstance(node, dict):
            continue
        if _has_layer_keys(node):
            places.append(place)
        if "Damage" in node and _ITEM_NAMES.isdisjoint(node) and place[1] not in _DETAILS:
            place = (place, "Damage")
            warnings.warn(f"{_text(place, '')}: the value belongs to no item", stacklevel=2)
    if len(places) > sum(counts) and min(counts) == 0:
        first = _text(places[0], "")
        raise DesignError(f"{first}: no banner has this layer; write it below the item's id")


def _is_dye(value: object) -> bool:
    return is_dye(value) if isinstance(value, str) else value in range(16)


_ITEM_NAMES = frozenset({"id", "Name", "item", "name"})
_DETAILS = frozenset({"tag", "components"})

_Place: TypeAlias = tuple["_Place | None", str | int]
"""The place of a value in a tree: its parent's place and its key. It becomes a text only in an
error, since a hostile text can have many long paths."""


def _within(tree: object) -> Iterator[tuple[_Place, object]]:
    """All that lies within a tree, but not in items that an item holds."""
    nodes: list[tuple[_Place | None, object]] = [(None, tree)]
    while nodes:
        parent, node = nodes.pop()
        keyed: Iterable[tuple[Any, object]] = ()
        if isinstance(node, dict):
            keyed = node.items()
        elif isinstance(node, list):
            keyed = enumerate(node)
        children: list[tuple[_Place, object]] = [
            ((parent, key), value)
            for key, value in keyed
            if str(key).removeprefix("minecraft:") not in _HOLDING
        ]
        yield from children
        nodes += children[::-1]


def _text(place: _Place, at: str) -> str:
    keys: list[str | int] = []
    step: _Place | None = place
    while step is not None:
        step, key = step
        keys.append(key)
    for key in keys[:16][::-1]:
        at = f"{at}[{key}]" if isinstance(key, int) else _under(at, key)
    return at.lstrip(".")


def _has_layer_keys(node: Mapping[Any, Any]) -> bool:
    keys = {str(key).lower() for key in node}
    return "pattern" in keys and not keys.isdisjoint(("color", "colour"))


def _is_design(key: str, value: object) -> bool:
    name = key.rpartition(":")[2]
    if isinstance(value, Expression) and key.startswith((".", "[")):
        return True  # what an object is spread from, or a computed key
    if not value or name == "provides_banner_patterns":
        return False
    return bool(_KEY.search(name)) or _holds_layers(value)


def _holds_layers(value: object) -> bool:
    """Whether a tree has a compound with a pattern and a colour, or a text with such."""
    nodes = [value]
    while nodes:
        node = nodes.pop()
        if isinstance(node, str) and looks_like_design(node):
            return True
        if isinstance(node, dict):
            if _has_layer_keys(node):
                return True
            nodes.extend(node.values())
        elif isinstance(node, list):
            nodes.extend(node)
    return False


def _under(at: str, key: str) -> str:
    key = key if len(key) <= 40 and key.isprintable() else shown(key)
    return f"{at}.{key}" if at else key
