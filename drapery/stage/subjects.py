"""From a subject and its settings to scenes: one way for banners, shields, capes and garments.

subject = subject_of(Banner.parse("red cross:white"), open_packs(()), Settings(wind=6))
scenes = stage(subject, Schedule.at([0.0, 0.5, 1.0], subject.step))
"""

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Protocol

from drapery.arrays import Vectors
from drapery.banner.design import Banner
from drapery.banner.packs import Packs
from drapery.render.scene import Scene
from drapery.settings import Settings
from drapery.stage.bodies import StagedBody
from drapery.stage.recording import Schedule
from drapery.style.kinds import body_of

if TYPE_CHECKING:
    from drapery.garments.model import Garment


class StagedSubject(Protocol):
    """What is drawn with its settings, and how its cloth moves.

    step: the longest time step of its cloth [s].
    tolerance: see `Schedule.still`.
    """

    @property
    def step(self) -> float:
        """The longest time step of its cloth [s]."""

    @property
    def tolerance(self) -> float:
        """The share of a step by which steps may be longer, see `Schedule.still`."""

    def record(
        self, at: Schedule, on_moment: Callable[[int, int], object] | None = None
    ) -> Sequence[Vectors]:
        """Where each of its cloths is at the moments of a schedule [m], each of shape [F, N, 3].

        at: the moments.
        on_moment: see `recording.record`.

        Raises OptionError for cloth that cannot be moved.
        """

    def scenes(self, motions: Sequence[Vectors], at: Schedule) -> Iterator[Scene]:
        """The scene of each picture of a schedule.

        motions: where each cloth is in them [m], each of shape [F, N, 3].
        at: the moments.

        Raises OptionError or PackError for what cannot be drawn.
        """


def subject_of(
    design: "Banner | Garment | None", packs: Packs, settings: Settings, period: float | None = None
) -> StagedSubject:
    """A design or garment in its staging.

    design: None for a cape or elytra.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the picture.
    period: of a loop [s], after which all motion repeats.

    Raises OptionError or PackError for what cannot be drawn.
    """
    if design is None or isinstance(design, Banner):
        return StagedBody(body_of(design, packs, settings), settings)
    # Imported here: pictures of banners need no pydantic.
    from drapery.stage.dressing import Dressed

    return Dressed(design, packs, settings, period)


def stage(
    subject: StagedSubject, at: Schedule, on_moment: Callable[[int, int], object] | None = None
) -> Iterator[Scene]:
    """The scenes of a schedule, when all cloth has moved.

    subject: what is drawn.
    at: the moments.
    on_moment: see `recording.record`.

    Raises OptionError or PackError for what cannot be drawn.
    """
    return subject.scenes(subject.record(at, on_moment), at)


def still(design: "Banner | Garment | None", packs: Packs, settings: Settings) -> Scene:
    """The scene after the cloth has been in the wind for `settings.time` seconds.

    design: None for a cape or elytra.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the picture.

    Raises OptionError or PackError for what cannot be drawn.
    """
    subject = subject_of(design, packs, settings)
    return next(stage(subject, Schedule.still(settings.time, subject.step, subject.tolerance)))


def loop(
    design: "Banner | Garment | None",
    packs: Packs,
    settings: Settings,
    count: int,
    fps: float,
    on_moment: Callable[[int, int], object] | None = None,
) -> Iterator[Scene]:
    """The scenes of a seamless loop: the last is followed by the first.

    The wind repeats after the loop's length, and the cloth has settled into that period. A body
    that does not move is shown from all around.

    design: None for a cape or elytra.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the pictures.
    count: number of scenes.
    fps: [frames/s].
    on_moment: see `stage`.

    Raises OptionError or PackError for what cannot be drawn.
    """
    subject = subject_of(design, packs, settings, count / fps)
    return stage(subject, Schedule.loop(count, fps, subject.step, subject.tolerance), on_moment)


def moments(
    design: "Banner | Garment | None", packs: Packs, settings: Settings, times: Sequence[float]
) -> Iterator[Scene]:
    """A scene at each of some times of one motion, its cloth at the nearest time steps.

    design: None for a cape or elytra.
    packs: resource packs, see `drapery.packs.open_packs`.
    settings: the options of the pictures.
    times: when the scenes are [s].

    Raises OptionError or PackError for what cannot be drawn.
    """
    subject = subject_of(design, packs, settings)
    return stage(subject, Schedule.at(times, subject.step))
