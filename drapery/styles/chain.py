"""Bounds on a chain of steps, which is judged before anything is drawn.

Each step is cheap by itself; what a file may repeat is bounded here: the sizes of large pixels
multiply, and the costs of the steps of one kind add up.
"""

from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass

from drapery.styles.canvas import MAX_LARGE
from drapery.styles.step import StepKind, StyleStep

MAX_PIXEL = 64
"""The largest side of a large pixel, after all steps that enlarge them [pixels]."""
MAX_COST = 100
"""The most that the steps of one kind cost together; see `step.costs`."""


@dataclass(frozen=True)
class ChainFault:
    """Why a chain is refused: the step that exceeds a bound, and a line about it.

    number: of the step among those of its kind, from 0.
    """

    kind: StepKind
    number: int
    message: str


def chain_fault(steps: Iterable[StyleStep]) -> ChainFault | None:
    """The first step with which a chain exceeds MAX_PIXEL or MAX_COST; None if none does.

    Steps that follow large pixels work on as many fewer pixels, and cost as much less.
    """
    counts: Counter[StepKind] = Counter()
    costs: defaultdict[StepKind, float] = defaultdict(float)
    side = least = 1
    for step in steps:
        kind, number = step.kind, counts[step.kind]
        counts[kind] += 1
        costs[kind] += step.cost / least**2 if kind == "picture" else step.cost
        if makes_pixels(step):
            size = dict(step.parameters)["size"]
            if size:
                side, least = side * size, least * size
            elif side == 1:  # of the picture's own choice, which large pixels are already
                side, least = MAX_LARGE, 2
        where = f"{kind} step {number + 1} ({step.name})"
        if side > MAX_PIXEL:
            remedy = f"use sizes whose product is at most {MAX_PIXEL}"
            return ChainFault(kind, number, f"{where} makes pixels of {side} x {side}; {remedy}")
        if costs[kind] > MAX_COST:
            costly = f"brings the cost of the {kind} steps to {costs[kind]:.0f}"
            remedy = f"at most {MAX_COST} is drawn: leave out steps"
            return ChainFault(kind, number, f"{where} {costly}; {remedy}")
    return None


def makes_pixels(step: StyleStep) -> bool:
    """Whether a step makes large pixels."""
    from drapery.styles.pixel_steps import pixels  # a style without a step needs none

    return step.function is pixels
