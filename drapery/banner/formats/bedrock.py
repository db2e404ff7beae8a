"""Bedrock's item or block entity, in SNBT or JSON. Dyes count from black; `Type:1` is ominous.

`{Name:"minecraft:banner",Damage:15,Count:1,tag:{Patterns:[{Pattern:"cre",Color:10}],Type:0}}`, or
`{id:"Banner",Base:15,Patterns:[…],Type:0}`. An item's `Damage` is its base.
"""

from drapery.banner.design import Banner, Layer
from drapery.banner.dyes import DYES
from drapery.banner.formats.snbt import write_snbt
from drapery.banner.formats.tree import OMINOUS, DataTree
from drapery.banner.formats.trees import recognises as is_tree
from drapery.banner.names import BEDROCK_CODES, shown
from drapery.banner.patterns import PATTERNS
from drapery.errors import DesignError

NAME = "bedrock"
TITLE = "Bedrock's item or block entity in SNBT or JSON"
EXAMPLE = '{id:"Banner",Base:15,Patterns:[{Pattern:"cre",Color:10},{Pattern:"flw",Color:0}],Type:0}'
SOURCE = "https://minecraft.wiki/w/Banner"


def recognises(text: str) -> bool:
    """Whether the text is a tree with Bedrock's type of banner."""
    return is_tree(text) and any(k in text for k in ("Type:", '"Type"'))


def write(banner: Banner) -> str:
    """The block entity. Raises DesignError for shields and the patterns of data packs."""
    return write_snbt(block_entity(banner))


def block_entity(banner: Banner) -> dict[str, DataTree]:
    """The block entity as a tree."""
    if banner.kind != "banner":
        raise DesignError("Bedrock's shields have no design: write the form 'give'")
    if banner == OMINOUS:
        return {"id": "Banner", "Base": 15, "Type": 1}
    layers = [_layer(layer, number) for number, layer in enumerate(banner.layers, 1)]
    base = 15 - DYES[banner.base].number
    return {"id": "Banner", "Base": base, "Patterns": layers, "Type": 0}


def _layer(layer: Layer, number: int) -> dict[str, DataTree]:
    pattern = PATTERNS.get(layer.pattern)
    if pattern is None:
        raise DesignError(f"layer {number}: Bedrock has no pattern {shown(layer.pattern)}")
    code = pattern.code or BEDROCK_CODES[pattern.name]
    return {"Pattern": code, "Color": 15 - DYES[layer.dye].number}
