"""Banners in everyday English: `A red banner with a white cross`."""

from drapery.banner.design import Banner, Layer

WORDS = {
    "base": "field",
    "square_bottom_left": "square in the lower left corner",
    "square_bottom_right": "square in the lower right corner",
    "square_top_left": "square in the upper left corner",
    "square_top_right": "square in the upper right corner",
    "stripe_bottom": "stripe along the bottom",
    "stripe_top": "stripe along the top",
    "stripe_left": "stripe on the left",
    "stripe_right": "stripe on the right",
    "stripe_center": "upright stripe in the middle",
    "stripe_middle": "level stripe in the middle",
    "stripe_downright": "slanting stripe from the upper left",
    "stripe_downleft": "slanting stripe from the upper right",
    "small_stripes": "thin upright stripes",
    "cross": "slanting cross",
    "straight_cross": "cross",
    "triangle_bottom": "triangle at the bottom",
    "triangle_top": "triangle at the top",
    "triangles_bottom": "teeth along the bottom",
    "triangles_top": "teeth along the top",
    "diagonal_left": "upper left half",
    "diagonal_right": "upper right half",
    "diagonal_up_left": "lower left half",
    "diagonal_up_right": "lower right half",
    "circle": "disc",
    "rhombus": "diamond",
    "half_vertical": "left half",
    "half_vertical_right": "right half",
    "half_horizontal": "upper half",
    "half_horizontal_bottom": "lower half",
    "border": "border",
    "curly_border": "wavy border",
    "gradient": "fade from the top",
    "gradient_up": "fade from the bottom",
    "bricks": "bricks",
    "globe": "globe",
    "creeper": "creeper",
    "skull": "skull and bones",
    "flower": "flower",
    "mojang": "thing",
    "piglin": "snout",
    "flow": "spiral",
    "guster": "whirlwind",
}
"""What each pattern of the game shows, after its dye."""
_SEVERAL = {"small_stripes", "triangles_bottom", "triangles_top", "bricks"}


def plain_text(banner: Banner) -> str:
    """A banner or shield in a sentence without its full stop, from the lowest layer to the top."""
    subject = _with_article(f"{_dye(banner.base)} {banner.kind}").capitalize()
    parts = [_phrase(layer) for layer in banner.layers]
    if not parts:
        return subject
    *others, last = parts
    return f"{subject} with {', '.join(others)}{' and ' if others else ''}{last}"


def _phrase(layer: Layer) -> str:
    words = WORDS.get(layer.pattern, f"pattern {layer.pattern}")
    dyed = f"{_dye(layer.dye)} {words}"
    return dyed if layer.pattern in _SEVERAL else _with_article(dyed)


def _dye(name: str) -> str:
    return name.replace("_", " ")


def _with_article(words: str) -> str:
    return f"{'an' if words[0] in 'aeiou' else 'a'} {words}"
