"""The 43 patterns: ids, the short codes of older versions, and English titles."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Pattern:
    """One pattern of the game.

    name: its id.
    code: its short name before 1.20.5, None if it had none.
    title: its English name.
    """

    name: str
    code: str | None
    title: str


_TABLE = """
base b Field
square_bottom_left bl Base Dexter Canton
square_bottom_right br Base Sinister Canton
square_top_left tl Chief Dexter Canton
square_top_right tr Chief Sinister Canton
stripe_bottom bs Base
stripe_top ts Chief
stripe_left ls Pale Dexter
stripe_right rs Pale Sinister
stripe_center cs Pale
stripe_middle ms Fess
stripe_downright drs Bend
stripe_downleft dls Bend Sinister
small_stripes ss Paly
cross cr Saltire
straight_cross sc Cross
triangle_bottom bt Chevron
triangle_top tt Inverted Chevron
triangles_bottom bts Base Indented
triangles_top tts Chief Indented
diagonal_left ld Per Bend Sinister
diagonal_up_right rd Per Bend Sinister Inverted
diagonal_up_left lud Per Bend Inverted
diagonal_right rud Per Bend
circle mc Roundel
rhombus mr Lozenge
half_vertical vh Per Pale
half_vertical_right vhr Per Pale Inverted
half_horizontal hh Per Fess
half_horizontal_bottom hhb Per Fess Inverted
border bo Bordure
curly_border cbo Bordure Indented
gradient gra Gradient
gradient_up gru Base Gradient
bricks bri Field Masoned
globe glb Globe
creeper cre Creeper Charge
skull sku Skull Charge
flower flo Flower Charge
mojang moj Thing
piglin pig Snout
flow - Flow
guster - Guster
"""


def _row(line: str) -> Pattern:
    name, code, title = line.split(maxsplit=2)
    return Pattern(name, None if code == "-" else code, title)


PATTERNS: dict[str, Pattern] = {
    pattern.name: pattern for pattern in map(_row, _TABLE.strip().splitlines())
}
"""Every pattern of the game by id."""

PATTERN_NAMES: tuple[str, ...] = tuple(PATTERNS)
"""The ids of all patterns of the game, in the order of its list."""

BY_CODE: dict[str, Pattern] = {p.code: p for p in PATTERNS.values() if p.code is not None}
"""The patterns that have a code of the versions before 1.20.5, by that code."""
