"""A garment from text: a towel on a line, with stripes and a trim."""

from pathlib import Path

from drapery import draw
from drapery.garments import Garment

text = """
texture = { dye = "cyan", stripes = ["white"], trim = "blue" }
pole = [{ start = [-10, 30, 0], end = [10, 30, 0] }]
pin = [{ piece = "towel", at = "top" }]
piece = [{ name = "towel", shape = "grid", size = [16, 24], points = [9, 13], place = [0, 29, 0] }]
"""
Path("towel.toml").write_text(text, encoding="utf-8")
draw(Garment.load("towel.toml"), view="hero", wind=3, size=(256, 320)).save("towel.png")
