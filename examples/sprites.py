"""A game's sprites: a loop from each of four directions, a pixel for each large one."""

from drapery import Banner, Settings
from drapery.render import save_sprites
from drapery.sheets import draw_sprites

settings = Settings(style="pixel-art", size=(128, 128), wind=6)
loops = draw_sprites(Banner.parse("red cross:white"), settings, directions=4)
save_sprites(loops, fps=8, path="banner.sheet.png")
