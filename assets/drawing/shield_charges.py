"""The eight named charges for the shield's painted field of 10 x 20 texels.

They are the banner's charges at half the size, redrawn texel by texel with the same signs.
"""

CREEPER = """
......
......
##..##
##..##
..##..
.####.
.####.
.o..o.
"""

SKULL = """
........
.+####+.
.######.
.::##::.
.o#::#o.
..#oo#..
........
#......#
##+..+##
..+##+..
##+..+##
o......o
"""

FLOWER = """
..#++#..
...##...
#.#..#.#
+#.##.#+
+#.oo.#+
#.#..#.#
...##...
..#++#..
"""

GLOBE = """
........
...##...
.##..##.
###.##.#
#.##.#.+
#.##...+
#..#...+
##.+..+#
.##+.##.
...##...
"""

PIGLIN = """
+######+
#......#
#.#..#.#
#.#..#.#
#......#
+######+
"""

FLOW = """
........
.+####+.
+......#
#.+##+.#
#.#..#.#
#.##.#.#
+....#.#
.+##+..#
.......#
...+##+.
...#....
...+....
"""

GUSTER = """
........
..+##+..
..#++#..
...##...
..+oo+..
........
+######+
.#oooo#.
........
.+####+.
..#oo#..
........
...##...
...o+...
"""

THING = """
......+.
.+##..#.
+#####..
##+...#.
##....+#
##.....+
###.....
+##+...+
.+#####.
"""

SHIELD_CHARGES: dict[str, str] = {
    "globe": GLOBE,
    "creeper": CREEPER,
    "skull": SKULL,
    "flower": FLOWER,
    "mojang": THING,
    "piglin": PIGLIN,
    "flow": FLOW,
    "guster": GUSTER,
}
"""The drawings by pattern id."""
