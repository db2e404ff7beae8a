"""A shape of one's own: a disc of cloth falls over a torus."""

from itertools import islice
from math import hypot

from drapery.cloth import Collider, Collisions, disc, simulate
from drapery.render import draw_models, make_mesh, make_model


class Torus:
    parameters, bounds = (0.3, 0.1), ((-0.4, -0.4, -0.4), (0.4, -0.2, 0.4))
    signed_distance = staticmethod(lambda p, q: hypot(hypot(p[0], p[2]) - q[0], p[1] + 0.3) - q[1])


cloth, torus = disc(12, 0.6), Collisions([Collider(Torus(), friction=0.6)])
state = next(islice(simulate(cloth, dt=1 / 120, collisions=torus), 120, None))
sheet = make_model(make_mesh(state.positions[0], cloth.triangles), colour="#b02e26")
draw_models([sheet], background="#b9cfe4").save("own_collider.png")
