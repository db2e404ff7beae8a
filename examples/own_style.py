"""A style of one's own: torn, in two tones, with thick lines."""

from drapery import Banner, draw
from drapery.styles import STEPS, Style, StyleStep, find_style

tones = StyleStep("picture", STEPS["picture"]["shade"], {"bands": 2})
lines = StyleStep("picture", STEPS["picture"]["outline"], {"width": 3.0, "colour": "#20102a"})
comic = Style("comic", (tones, lines), light="flat", samples=4)
draw(Banner.parse("orange creeper:black"), style=find_style("tattered") | comic).save("comic.png")
