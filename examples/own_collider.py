"""A shape of one's own: a disc of cloth falls over a torus."""

from itertools import islice
from math import hypot

from drapery.cloth import Collider, Collisions, disc, simulate
from drapery.render import draw_models, make_mesh


class Torus:
    parameters, bounds = (0.3, 0.1), ((-0.4, -0.4, -0.4), (0.4, -0.2, 0.4))

    @staticmethod
    def signed_distance(point, parameters):
        return hypot(hypot(point[0], point[2]) - parameters[0], point[1] + 0.3) - parameters[1]


cloth, torus = disc(12, 0.6), Collisions([Collider(Torus(), friction=0.6)])
state = next(islice(simulate(cloth, dt=1 / 120, collisions=torus), 120, None))
draw_models([make_mesh(state.positions[0], cloth.triangles)]).save("own_collider.png")
