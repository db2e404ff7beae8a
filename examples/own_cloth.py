"""A sheet of one's own on a line: a grid of cloth, held at three particles, in the wind."""

from itertools import islice

from drapery import extrude, simulate
from drapery.cloth import Gravity, Wind, grid
from drapery.render import draw_models, make_mesh, make_model

cloth = grid(25, 17, 1.5, 1.0, pins=[0, 12, 24])
states = simulate(cloth, forces=(Gravity(), Wind((1, 0, 4))), every=120)
positions = next(islice(states, 1, None)).positions[0]
sheet = make_model(extrude(make_mesh(positions, cloth.triangles), 0.02), colour="#b02e26")
draw_models([sheet], view="hero", size=(384, 288), background="#b9cfe4").save("sheet.png")
