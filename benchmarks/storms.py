"""Whether any allowed setting draws torn cloth: `python -m benchmarks.storms [--count 100]`.

Seeded random settings of everything that moves cloth (solver, fabric, grid, wind, gusts, thickness,
pins, contact, placement, kind, garments, players and their motions) are simulated. Every quarter of
a second the longest structural edge over its length at rest and the deepest particle in a solid are
measured, and at the end whether the cloth crosses itself (by ipctk, if it is installed). It prints
the worst of them and of the list SEEN, and draws the worst on a contact sheet (`--sheet FILE`):
numbers were right before where the picture was plainly wrong. Times are those of the processor.
"""

import argparse
import json
import sys
import time
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from benchmarks.contact import depth_in
from benchmarks.quick import add_quick, is_installed
from drapery import Banner, Frame, OptionError, Settings
from drapery.cloth import FABRICS, Cloth, Collider, max_stretch
from drapery.cloth.solvers.registry import SOLVERS
from drapery.cloth.strain import HELD_TO, MOST_STRETCH
from drapery.garments import PlayerSettings, find_garment, garment_names, player_of
from drapery.packs import open_packs
from drapery.player_settings import MOTIONS
from drapery.render import contact_sheet, draw_scene
from drapery.scenes import STEP, Dressed, Schedule, StagedBody
from drapery.style import body_of

Options = dict[str, Any]

LIMIT = MOST_STRETCH * (1 + HELD_TO)
"""An edge that is longer, over its length at rest, is torn."""
DEEPEST = 1e-3
"""How deep a particle may be in a solid [m]."""
LONGEST = 30.0
"""The most time of the processor for a still [s]."""
SECONDS, EVERY = 3.0, 15
"""Cloth moves for so long [s] and is measured after every so many steps."""
COLUMNS = 8


@dataclass(frozen=True)
class Storm:
    """what: the words of a garment or a player; none for a banner, shield or cape. options: of
    the picture."""

    what: Options
    options: Options

    @property
    def text(self) -> str:
        """The storm as a line of JSON."""
        return json.dumps({**self.what, **self.options})


CAPE: Options = {"kind": "cape", "thickness": 8.0, "contact": "all"}
SEEN = (
    Storm(
        {},
        {"solver": "implicit", "fabric": "silk", "grid": (31, 61), "wind": 20.0, "gusts": 1.0},
    ),
    Storm({}, {"solver": "desbrun", "fabric": "silk", "wind": 40.0}),
    Storm({}, {"solver": "pbd", "fabric": "silk", "wind": 20.0, "gusts": 2.0}),
    Storm({}, {"solver": "implicit", "fabric": "silk", "placement": "wall"}),
    Storm({}, {"solver": "implicit", "fabric": "wool", "wind": 20.0}),
    Storm({}, {"solver": "implicit", "fabric": "linen", "pins": "none"}),
    Storm({}, {"thickness": 8.0}),
    Storm({}, {"solver": "provot", "fabric": "leather", "thickness": 8.0, "wind": 0.0}),
    Storm(
        {},
        {"solver": "desbrun", "fabric": "linen", "grid": (5, 9), "thickness": 8.0, "wind": 0.0},
    ),
    Storm(
        {"garment": "poncho"},
        {"solver": "implicit", "wind": 8.5, "gusts": 2.0, "direction": 74.0, "seed": 881},
    ),
    Storm(
        {},
        {
            "kind": "cape",
            "thickness": 2.0,
            "grid": (16, 31),
            "pins": "three-corners",
            "contact": "all",
        },
    ),
    Storm({}, CAPE | {"fabric": "silk", "grid": (31, 31), "pins": "none"}),
    Storm({}, CAPE | {"wind": 6.6, "fabric": "leather", "grid": (3, 5), "direction": 0.0}),
    Storm({}, CAPE | {"fabric": "linen", "grid": (3, 5), "pins": "three-corners", "seed": 468}),
    Storm({}, CAPE | {"wind": 30.4, "fabric": "felt", "grid": (9, 9), "pins": "three-corners"}),
    Storm({}, CAPE | {"thickness": 2.0, "solver": "pbd", "grid": (5, 9), "wind": 0.0}),
    Storm({"player": {"wear": ("scarf",), "motion": "glide"}}, {"wind": 8.6, "direction": 180.0}),
    Storm(
        {"player": {"wear": ("skirt",), "motion": "sit", "speed": 1.0}},
        {"solver": "implicit", "wind": 40.0, "gusts": 1.0, "direction": 90.0, "seed": 370},
    ),
    Storm(
        {"garment": "freefall"},
        {"solver": "desbrun", "wind": 40.0, "gusts": 2.0, "direction": 90.0, "seed": 209},
    ),
)
"""Settings that were seen to tear."""


@dataclass(frozen=True)
class Measured:
    """stretch: the longest edge over its length at rest, at any measured moment, infinite for cloth
    that is not finite; 0 for a setting that is refused. depth: the deepest particle in a solid [m].
    crosses: whether the cloth crosses itself at the end. seconds: of the processor. frame: at the
    end."""

    storm: Storm
    stretch: float
    depth: float
    crosses: bool
    seconds: float
    frame: Frame | None

    @property
    def faults(self) -> list[str]:
        """What is wrong with it."""
        found = {
            "torn": self.stretch > LIMIT,
            "in a solid": self.depth > DEEPEST,
            "crosses": self.crosses,
            "slow": self.seconds > LONGEST,
        }
        return [name for name, wrong in found.items() if wrong]

    @property
    def badness(self) -> float:
        """Larger is worse: each figure over what it may be."""
        figures = self.stretch / LIMIT, self.depth / DEEPEST, self.seconds / LONGEST
        return max(figures) + self.crosses


def storms(count: int, seed: int, largest: int) -> Iterator[Storm]:
    """Settings that the same seed gives again. largest: the most particles of a side of a grid."""
    for number in range(count):
        random = Random(f"storm {seed} {number}")
        subject = random.choice(("banner",) * 5 + ("shield", "cape", "garment", "player"))
        yield _storm(subject, random, largest)


def _storm(subject: str, random: Random, largest: int) -> Storm:
    wind = random.choice((0.0, random.uniform(0, 12), random.uniform(8, 40), 40.0))
    options: Options = {
        "solver": random.choice(list(SOLVERS)),
        "wind": round(wind, 1),
        "gusts": random.choice((0.0, 0.4, 1.0, 2.0)),
        "direction": random.choice((None, 0.0, 90.0, 180.0, round(random.uniform(-180, 180)))),
        "seed": random.randrange(1000),
    }
    if subject == "garment":
        return Storm({"garment": random.choice(garment_names())}, options)
    if subject == "player":
        wear = random.choice([name for name in garment_names() if _is_for_players(name)])
        speed = random.choice((0.5, 1.0, 3.0))
        motion = random.choice(MOTIONS)
        return Storm({"player": {"wear": (wear,), "motion": motion, "speed": speed}}, options)
    longer = random.choice([n for n in (5, 9, 15, 21, 31, 41, 65, 129) if n <= largest])
    shape = max(2, longer // 2 + 1), longer
    options |= {
        "fabric": random.choice(list(FABRICS)),
        "grid": random.choice((shape, shape, shape[::-1], (longer, longer))),
        "thickness": random.choice((0.0, 0.5, 1.0, 2.0, 8.0)),
        "pins": random.choice((None, None, "top", "corners", "three-corners", "none")),
        "contact": random.choice(("none", "world", "all", "all")),
        "kind": subject,
    }
    if subject != "cape":
        options["placement"] = random.choice(("standing", "standing", "wall"))
    return Storm({}, options)


def _is_for_players(name: str) -> bool:
    who = find_garment(name).wearer
    return who is not None and who.kind == "player"


def measured(storm: Storm, seconds: float, *, crossings: bool) -> Measured:
    """Simulate a storm and measure it. crossings: whether to look for crossings."""
    start = time.process_time()
    settings = Settings(**{"size": (160, 200), "view": "hero", **storm.options})
    try:
        stretch, depth, cloths, scene = (_dressed if storm.what else _staged)(
            storm, settings, seconds
        )
    except OptionError as error:
        print(f"refused: {error}", file=sys.stderr)
        stretch = np.inf if "infinite" in str(error) else 0.0
        return Measured(storm, stretch, 0.0, False, time.process_time() - start, None)
    spent = time.process_time() - start
    crosses = crossings and any(_crosses_itself(*each) for each in cloths)
    return Measured(storm, stretch, depth, crosses, spent, draw_scene(scene))


def _staged(storm: Storm, settings: Settings, seconds: float) -> tuple[float, float, list, Any]:
    packs = open_packs(())
    design = None if settings.kind == "cape" else Banner.parse("white cross:red border:black")
    if settings.kind == "cape":
        settings = Settings(**{**settings.given_values, "texture": _cape_texture()})
    body = body_of(design, packs, settings)
    staged, stretch, depth = StagedBody(body, settings, curves=False), 0.0, -np.inf
    blown = [(drape.begin(STEP), drape.forces(None)) for drape in staged.drapes]
    met = [panel.cloth.make_collisions() for panel in body.panels]
    for _ in range(round(seconds / STEP) // EVERY):
        blown = [(moving.advance(forces, EVERY), forces) for moving, forces in blown]
        for (moving, _), collisions in zip(blown, met, strict=True):
            positions = moving.state.positions[0].astype(float)
            stretch = max(stretch, 1 + max_stretch(positions, moving.cloth))
            solids = collisions.colliders if collisions else ()
            depth = max(depth, _depth(positions, moving.cloth, solids, moving.state.time))
    cloths = [(each.cloth, each.state.positions[0].astype(float)) for each, _ in blown]
    motions = [each.state.positions for each, _ in blown]
    scene = next(staged.scenes(motions, Schedule.at([seconds], STEP)))
    return stretch, depth, cloths if settings.contact == "all" else [], scene


def _dressed(storm: Storm, settings: Settings, seconds: float) -> tuple[float, float, list, Any]:
    words = storm.what.get("player")
    garment = player_of(PlayerSettings(**words)) if words else find_garment(storm.what["garment"])
    dressed = Dressed(garment, open_packs(()), settings)
    every = EVERY * STEP
    times = [every * number for number in range(1, round(seconds / every) + 1)]
    sheets, stretch, depth = dressed.record(Schedule.at(times, dressed.step)), 0.0, -np.inf
    for sewn, motion in zip(dressed.cloths, sheets, strict=True):
        solids = dressed.colliders(sewn) if garment.collisions != "none" else ()
        for at, positions in zip(times, motion, strict=True):
            stretch = max(stretch, 1 + max_stretch(positions, sewn.cloth))
            depth = max(depth, _depth(positions, sewn.cloth, solids, at))
    cloths = [(sewn.cloth, motion[-1]) for sewn, motion in zip(dressed.cloths, sheets, strict=True)]
    last = Schedule.at(times[-1:], dressed.step)
    scene = next(dressed.scenes([motion[-1:] for motion in sheets], last))
    return stretch, depth, cloths if garment.collisions == "all" else [], scene


def _cape_texture() -> np.ndarray:
    texels = np.full((32, 64, 4), (150, 30, 40, 255), np.uint8)
    texels[::4, ::4, :3] = 230
    return texels


def _depth(positions: np.ndarray, cloth: Cloth, solids: tuple[Collider, ...], at: float) -> float:
    if not (cloth.inv_mass > 0).any():
        return -np.inf
    return max((depth_in(positions, cloth, each, at) for each in solids), default=-np.inf)


def _crosses_itself(cloth: Cloth, positions: np.ndarray) -> bool:
    import ipctk

    faces = np.asarray(cloth.triangles, int)
    mesh = ipctk.CollisionMesh(cloth.rest_positions, ipctk.edges(faces), faces)
    return bool(ipctk.has_intersections(mesh, positions))


def sheet_of(worst: list[Measured]) -> Frame:
    """The pictures of the worst, the worst first."""
    drawn = [(f"{each.stretch:.2f}", each.frame.pixels) for each in worst if each.frame is not None]
    return contact_sheet(drawn, columns=min(COLUMNS, len(drawn)))


def main() -> int:
    """Run the command line; returns 1 if a setting has a fault."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--count", type=int, default=100, help="of random settings")
    parser.add_argument("--seed", type=int, default=1, help="of other settings")
    parser.add_argument("--largest", type=int, default=31, help="side of a grid [particles]")
    parser.add_argument("--seconds", type=float, default=SECONDS, help="that cloth moves")
    parser.add_argument("--budget", type=float, default=600.0, help="time for all of it [s]")
    parser.add_argument("--worst", type=int, default=40, help="rows and pictures")
    parser.add_argument("--sheet", type=Path, help="PNG file of the worst")
    parser.add_argument("--seen", action="store_true", help="only the settings seen to tear")
    add_quick(parser)
    given = parser.parse_args()
    count, seconds = (1, 0.25) if given.quick else (given.count, given.seconds)
    asked = list(SEEN[2:3] if given.quick else SEEN)
    if not given.seen:
        asked += storms(count, given.seed, given.largest)
    warnings.simplefilter("ignore")
    found, begun, crossings = [], time.monotonic(), is_installed("ipctk")
    for storm in asked:
        if time.monotonic() - begun > given.budget:
            print(f"the budget of {given.budget:g} s ends after {len(found)} of {len(asked)}")
            break
        each = measured(storm, seconds, crossings=crossings)
        found.append(each)
        print(
            f"{each.stretch:8.3f} {each.seconds:6.1f} s {storm.text}", file=sys.stderr, flush=True
        )
    worst = sorted(found, key=lambda each: -each.badness)[: given.worst]
    table = Table("longest edge", "deepest [mm]", "crosses", "CPU [s]", "faults", "settings")
    for each in worst:
        table.add_row(
            f"{each.stretch:.3f}",
            f"{max(0.0, each.depth) * 1e3:.1f}",
            "yes" if each.crosses else "",
            f"{each.seconds:.1f}",
            ", ".join(each.faults),
            each.storm.text,
        )
    Console(width=180).print(table)
    faulty = [each for each in found if each.faults]
    kinds = {
        name: sum(name in each.faults for each in faulty) for each in faulty for name in each.faults
    }
    print(f"{len(faulty)} of {len(found)} settings have a fault: {kinds}")
    if given.sheet is not None:
        sheet_of(worst).save(given.sheet)
        print(f"the worst are in {given.sheet}, the worst first")
    return min(len(faulty), 1)


if __name__ == "__main__":
    sys.exit(main())
