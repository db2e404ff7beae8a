"""What a text resembles that no form can read, and what to give in its place."""

import re

_YAML = re.compile(r"^[ \t-]*[\w-]{1,40}:(?:[ \t]|$)", re.MULTILINE)
_BASE64 = re.compile(r"[A-Za-z0-9+/_-]{60,}={0,2}")
_PAGE = re.compile(r"<(?:!doctype|html|head|body|div|img|a)\b", re.IGNORECASE)
_JAVA = re.compile(r"\b(?:DyeColor|PatternType)\s*\.|\bBannerMeta\b")


def advice(text: str) -> str | None:
    """What the text is, and what to give in its place; None if that is not known."""
    start = text.strip()[:4000]
    if _JAVA.search(start):
        return (
            "program code whose patterns are not written out; write each as"
            " addPattern(new Pattern(DyeColor.LIME, PatternType.CREEPER))"
        )
    if _PAGE.match(start):
        return "a web page, which is not read; copy the banner's /give command from it"
    if _BASE64.fullmatch(start.replace("\n", "")):
        return (
            "an item packed in base64, which is not read; hold the item and paste what"
            " /data get entity @s SelectedItem says"
        )
    if len(_YAML.findall(start)) > 1 and "banner" in start.lower():
        return (
            "YAML of a plugin that is not known, or an item without layers; the known plugins are"
            " BentoBox, Bukkit, CommandPanels, CrazyCrates, DeluxeMenus, Denizen, EssentialsX and"
            " MythicMobs"
        )
    return None
