"""The words by which the page finds a pattern: its names everywhere, and what people call it."""

from functools import cache

from drapery.banner import PATTERNS, game_languages, game_titles

_EVERYDAY = """
base: full whole solid plain background fill
square_bottom_left: corner square block canton bottom left lower
square_bottom_right: corner square block canton bottom right lower
square_top_left: corner square block canton top left upper
square_top_right: corner square block canton top right upper
stripe_bottom: horizontal stripe bar bottom lower ground floor
stripe_top: horizontal stripe bar top upper head
stripe_left: vertical stripe bar left side
stripe_right: vertical stripe bar right side
stripe_center: vertical stripe bar center centre middle line pole
stripe_middle: horizontal stripe bar center centre middle line belt
stripe_downright: diagonal stripe bar slash sash falling
stripe_downleft: diagonal stripe bar slash sash rising
small_stripes: vertical stripes bars lines pinstripes prison
cross: x diagonal cross scotland crossed
straight_cross: plus cross england church
triangle_bottom: triangle mountain pyramid arrow up tent hill
triangle_top: triangle arrow down v tooth
triangles_bottom: zigzag teeth saw spikes jagged sawtooth grass bottom
triangles_top: zigzag teeth saw spikes jagged sawtooth top
diagonal_left: diagonal half triangle corner top left split
diagonal_up_right: diagonal half triangle corner bottom right split
diagonal_up_left: diagonal half triangle corner bottom left split
diagonal_right: diagonal half triangle corner top right split
circle: dot ball disc disk round sun moon spot circle japan
rhombus: diamond gem square rotated kite
half_vertical: half vertical left side split
half_vertical_right: half vertical right side split
half_horizontal: half horizontal top upper split sky
half_horizontal_bottom: half horizontal bottom lower split sea
border: frame edge outline rim box
curly_border: frame edge outline zigzag wavy lace stamp teeth
gradient: fade blend shade ombre sky dusk top
gradient_up: fade blend shade ombre glow dawn bottom
bricks: brick wall stone masonry house castle
globe: earth world planet map
creeper: face monster mob
skull: pirate bones jolly roger death skeleton crossbones wither head totenkopf
flower: daisy plant blossom rose sun
mojang: thing logo apple
piglin: pig snout nose
flow: flw wind swirl spiral wave breeze trial
guster: gus wind swirl breeze face trial
"""


@cache
def search_words() -> dict[str, str]:
    """For each of the game's patterns its id, codes, titles in all languages and everyday words.

    All are in lower case, with a space between two words.
    """
    words = {name: [name, name.replace("_", " ")] for name in PATTERNS}
    for name, pattern in PATTERNS.items():
        words[name] += [pattern.code or "", pattern.title.lower()]
    for line in _EVERYDAY.strip().splitlines():
        name, _, everyday = line.partition(": ")
        words[name].append(everyday)
    for language in game_languages():
        for name, title in game_titles(language)[1].items():
            words[name].append(title.lower())
    return {name: " ".join(dict.fromkeys(filter(None, each))) for name, each in words.items()}
