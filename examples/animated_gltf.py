"""A waving banner as a 3-D file with morph targets, for Blender and the web."""

from drapery import Banner, save_model

banner = Banner.parse("white creeper:lime border:black")
save_model(banner, "banner.glb", seconds=2, fps=10, wind=6)
