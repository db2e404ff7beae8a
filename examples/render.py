"""A design becomes a picture of cloth, and its plain face."""

from drapery import Banner, draw, draw_face

banner = Banner.parse("blue gradient_up:light_blue rhombus:yellow flower:white border:black")
draw(banner, view="hero", wind=6, size=(256, 320)).save("banner.png")
draw_face(banner).save("face.png")
