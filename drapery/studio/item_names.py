"""The name that an item has in a command or in a save, which becomes the title of the design."""

import re

from drapery.studio.sketch import MAX_TITLE

_KEY = r"(?:custom_name|item_name|\bName)[\"']?\s*[=:]\s*"
_COMPONENT = r"['\"]?\{[^{}]{0,200}?\\?[\"']?text\\?[\"']?\s*:\s*\\?[\"'](?P<text>[^\"'\\]{1,200})"
_STRING = r"'\\?\"(?P<quoted>[^\"\\]{1,200})|[\"'](?P<plain>[^\"'\\{}\[\]]{1,200})"
_NAME = re.compile(f"{_KEY}(?:{_COMPONENT}|{_STRING})")


def item_name(text: str) -> str:
    """The first name of an item in a text, or "".

    It reads a plain text component, as JSON (before 1.21.5) or SNBT (since), of one part.
    """
    found = _NAME.search(text)
    if found is None:
        return ""
    name = next(filter(None, found.groups()), "").strip()
    return name[:MAX_TITLE] if name.isprintable() and ":" not in name else ""
