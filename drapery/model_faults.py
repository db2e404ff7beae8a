"""What a value of a pydantic model must be, by the type of its fault: pydantic's own texts differ
between versions.

See "Validation Errors", https://docs.pydantic.dev/latest/errors/validation_errors/.
"""

import re
from collections.abc import Mapping
from typing import Any


def said_of(fault: Mapping[str, Any]) -> str | None:
    """The message of a check of ours that a fault is of, or None. fault: of `errors()`."""
    context = fault.get("ctx", {})
    if fault["type"] == "value_error":
        return str(context["error"])
    return str(context["said"]) if "said" in context else None


def wanted(fault: Mapping[str, Any]) -> str:
    """What goes on after `it should`, such as `be a number`. fault: of `errors()`."""
    context, kind = fault.get("ctx", {}), fault["type"]
    if kind == "literal_error":
        *first, last = re.findall(r"'[^']*'|[^\s',]+(?=,|$| or )", str(context["expected"]))
        return f"be {', '.join(first)} or {last}" if first else f"be {last}"
    if kind in _BOUNDED:
        words, name = _BOUNDED[kind]
        bound = context[name]
        return words.format(f"{bound:g}" if isinstance(bound, float) else bound)
    return _KINDS.get(kind, "be another value")


_BOUNDED = {
    "greater_than": ("be greater than {}", "gt"),
    "greater_than_equal": ("be greater than or equal to {}", "ge"),
    "less_than": ("be less than {}", "lt"),
    "less_than_equal": ("be less than or equal to {}", "le"),
    "string_pattern_mismatch": ("match the pattern {}", "pattern"),
    "string_too_long": ("have at most {} characters", "max_length"),
    "string_too_short": ("have at least {} characters", "min_length"),
    "too_long": ("have at most {} values", "max_length"),
    "too_short": ("have at least {} values", "min_length"),
    "is_instance_of": ("be a {}", "class"),
}
"""The words of a fault with a bound, and the name of the bound in its context."""

_NUMBERS = ("float_type", "float_parsing", "finite_number")
_WHOLE = ("int_type", "int_parsing", "int_from_float", "int_parsing_size")
_TABLES = ("dict_type", "model_type", "model_attributes_type")
_KINDS = {
    **dict.fromkeys(_NUMBERS, "be a number"),
    **dict.fromkeys(_WHOLE, "be a whole number"),
    **dict.fromkeys(_TABLES, "be a table"),
    **dict.fromkeys(("bool_type", "bool_parsing"), "be true or false"),
    **dict.fromkeys(("list_type", "tuple_type"), "be a list"),
    "path_type": "be the path of a file",
    "string_type": "be a text",
}
