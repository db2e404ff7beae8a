"""Code of a server's plugin: `meta.addPattern(new Pattern(DyeColor.LIME, PatternType.CREEPER))`.

Java or Kotlin with Bukkit's classes. The base is in `new ItemStack(Material.RED_BANNER)`, or
`setBaseColor`. Nothing is run: patterns are read in the order of the text.
"""

import re
from dataclasses import dataclass, field

from drapery.banner.design import Banner, Layer
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.scripts import arguments, places
from drapery.banner.formats.tree import base_of, check_count
from drapery.banner.names import bukkit_pattern, dye_name, pattern_id, shown
from drapery.errors import DesignError

NAME = "java"
TITLE = "code of a plugin with Bukkit's classes, Java or Kotlin"
EXAMPLE = """ItemStack banner = new ItemStack(Material.WHITE_BANNER);
BannerMeta meta = (BannerMeta) banner.getItemMeta();
meta.addPattern(new Pattern(DyeColor.LIME, PatternType.CREEPER));
banner.setItemMeta(meta);"""
SOURCE = "https://hub.spigotmc.org/javadocs/spigot/org/bukkit/inventory/meta/BannerMeta.html"

_STEP = re.compile(
    r"(?:\b(?P<item>\w{1,60})\s{0,9}=\s{0,9}(?:new\s{1,9})?)?"
    r"\b(?:\w{0,30}(?:Stack|Builder|Item)(?:\.of)?|setType)\s{0,9}\(\s{0,9}"
    r"(?:[A-Za-z.]{0,60}\.)?(?P<material>\w{0,30}BANNER)\b(?=(?P<more>[^;\n]{0,60}))"
    r"|\b(?P<meta>\w{1,60})\s{0,9}=\s{0,9}(?:\([\w.]{1,80}\)\s{0,9})?"
    r"(?P<of>\w{1,60})\s{0,9}\.\s{0,9}(?:getItemMeta|itemMeta|getState|state)\b"
    r"|(?:\b(?P<on>\w{1,60})\s{0,9})?\.\s{0,9}"
    r"(?P<call>addPatterns?|setPatterns?|removePattern|setBaseColor)\s{0,9}\("
)
_COMMENT = re.compile(r'("(?:[^"\\\n]|\\.)*")|//[^\n]*|/\*.*?(?:\*/|\Z)', re.DOTALL)
_LAYER = re.compile(
    r"(?:new\s{1,9})?(?:[\w.]{1,60}\.)?Pattern\s{0,9}\(\s{0,9}(?:[\w.]{1,60}\.)?DyeColor\.(\w{1,20})"
    r"\s{0,9},\s{0,9}(?:[\w.]{1,60}\.)?PatternType\.(\w{1,40})\s{0,9}\)"
)
_DYE = re.compile(r"(?:[\w.]{1,60}\.)?DyeColor\.(\w{1,20})")
_DATA = re.compile(r",\s*\(\s*(?:short|byte)\s*\)\s*([0-9]{1,2})")


@dataclass
class _CodeBanner:
    """A banner that the code makes. line: where."""

    line: str
    base: str | None = None
    layers: list[Layer] = field(default_factory=list)


def recognises(text: str) -> bool:
    """Whether the text adds a pattern by Bukkit's classes."""
    if "PatternType." not in text and "BannerMeta" not in text:
        return False
    return _LAYER.search(text) is not None or any(
        match["material"] for match in _STEP.finditer(text)
    )


def read(text: str) -> list[FoundBanner]:
    """All banners of the code, one for each item. Raises DesignError with the line."""
    text = _COMMENT.sub(lambda match: match[1] or re.sub(r"[^\n]", " ", match[0]), text)
    place_of = places(text)
    made: list[_CodeBanner] = []
    names: dict[str | None, _CodeBanner] = {}
    count = 0
    for match in _STEP.finditer(text):
        line = place_of(match.end())
        if match["material"]:
            made.append(_CodeBanner(line, _base(match, line)))
            names[None] = names[match["item"]] = made[-1]
        elif match["meta"] and match["of"] in names:
            names[match["meta"]] = names[match["of"]]
        elif match["call"]:
            banner = names.get(match["on"]) or (made[0] if len(made) == 1 else None)
            if banner is None:
                banner = names[match["on"]] = _CodeBanner(line)
                made.append(banner)
            given = _arguments(text, match.end(), line)
            count += len(_LAYER.findall(", ".join(given)))
            _change(banner, match["call"], given, line)
    if not made:
        raise DesignError(f"no banner in the code: write it as {' '.join(EXAMPLE.split())}")
    if count < len(_LAYER.findall(text)):
        raise DesignError(
            f"{made[0].line}: the code has patterns that it keeps before it adds them; write each"
            " as meta.addPattern(new Pattern(DyeColor.LIME, PatternType.CREEPER))"
        )
    return [_found(banner) for banner in made]


def _base(match: "re.Match[str]", line: str) -> str | None:
    """The base dye of an item; up to 1.12 the damage value of `BANNER`."""
    data = _DATA.search(match["more"])
    if match["material"] != "BANNER" or data is None:
        return base_of(match["material"])
    return dye_name(int(data[1]), line, inverted=True)


def _arguments(text: str, start: int, line: str) -> list[str]:
    found = arguments(text, start)
    if found is None:
        raise DesignError(f"{line}: the call is not closed; add ')'")
    return found[0]


def _change(banner: _CodeBanner, call: str, given: list[str], line: str) -> None:
    words = ", ".join(given)
    if call == "setBaseColor":
        dye = _DYE.fullmatch(words)
        if dye is None:
            raise DesignError(f"{line}: {shown(words)} is not a dye; write it as DyeColor.RED")
        banner.base = dye_name(dye[1], line)
        return
    layers = [_layer(match, line) for match in _LAYER.finditer(words)]
    index = int(given[0]) if given and given[0].isdecimal() and len(given[0]) < 4 else None
    wanted = {"addPattern": len(layers) == 1, "setPattern": len(layers) == 1 and index is not None}
    is_clear = wanted.get(call, bool(layers)) or (call == "removePattern" and index is not None)
    rest = _LAYER.sub("", words)
    if not is_clear or "Pattern" in rest or (call != "setPatterns" and re.search("[A-Za-z]", rest)):
        raise DesignError(
            f"{line}: {shown(words)} is not a layer that is written out; write it as"
            " new Pattern(DyeColor.LIME, PatternType.CREEPER)"
        )
    if call == "setPatterns":
        banner.layers = layers
    elif index is None:
        banner.layers += layers
    elif index >= len(banner.layers):
        raise DesignError(f"{line}: there is no layer {index}; the first has the number 0")
    else:
        banner.layers[index : index + 1] = layers
    check_count(len(banner.layers), line)


def _layer(match: "re.Match[str]", line: str) -> Layer:
    return Layer(pattern_id(match[2], line, bukkit=True), dye_name(match[1], line))


def _found(banner: _CodeBanner) -> FoundBanner:
    if banner.base is None:
        raise DesignError(
            f"{banner.line}: the base dye is missing: write new ItemStack(Material.WHITE_BANNER)"
            " for the item, in the text"
        )
    return FoundBanner(Banner(banner.base, tuple(banner.layers)), banner.line)


def write(banner: Banner) -> str:
    """The code in Java. Raises DesignError for shields and the patterns of data packs."""
    if banner.kind != "banner":
        raise DesignError("shields have no BannerMeta: write another form, such as 'bukkit'")
    lines = [f"ItemStack banner = new ItemStack(Material.{banner.base.upper()}_BANNER);"]
    lines.append("BannerMeta meta = (BannerMeta) banner.getItemMeta();")
    for number, layer in enumerate(banner.layers, 1):
        name = bukkit_pattern(layer.pattern, f"layer {number}")
        pattern = f"new Pattern(DyeColor.{layer.dye.upper()}, PatternType.{name})"
        lines.append(f"meta.addPattern({pattern});")
    lines.append("banner.setItemMeta(meta);")
    return "\n".join(lines)
