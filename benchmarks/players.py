"""Players, measured: `python -m benchmarks.players [busts|loop|contact]`.

busts  100 skins as busts of 128 x 128, one after another as a worker of a batch draws them:
       planned, drawn and stored. The time of one core; two cores draw twice as many.
loop   a walk of 4 s with a cape, 300 x 600, 20 frames/s, as a GIF: motion, frames and file.
contact  capes, wings and skirts at a run of 4 m/s for 4 s: at how many moments, 20 a second, a
       particle or the middle of a face is inside the body, and how deep at most.
Times are those of the processor, which other work on the machine changes little.
"""

import argparse
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.quick import add_quick
from drapery.batch.jobs import plan, run_job
from drapery.batch.manifest import read_manifest
from drapery.batch.stores import open_store
from drapery.garments import PlayerSettings, player_of
from drapery.packs import open_packs
from drapery.pictures import draw_scenes
from drapery.render import Frame, save_animation, save_frame
from drapery.scenes import Dressed, Schedule, loop
from drapery.testing.garment_check import deepest

COUNT = 100
"""Busts."""
FRAMES = 80


def skins(folder: Path, count: int) -> list[dict[str, object]]:
    """Rows of a manifest, each with a skin of its own, half of them with a second layer."""
    base = open_packs(()).texture("entity/player/traveller")
    rows: list[dict[str, object]] = []
    for number in range(count):
        texels = base.copy()
        texels[..., :3] = (texels[..., :3].astype(int) * (100 + number) // 200).astype(np.uint8)
        if number % 2:
            texels[8:12, 40:48] = (90, 60, 30, 255)
        save_frame(Frame(texels), folder / f"{number}.png")
        rows.append({"skin": str(folder / f"{number}.png"), "shown": "bust", "motion": "stand"})
    return rows


def busts(view: str, count: int) -> None:
    """Print how many busts a second one core draws."""
    with TemporaryDirectory() as made, TemporaryDirectory() as drawn:
        rows = [
            {**row, "view": view, "size": "128x128", "time": 0.5}
            for row in skins(Path(made), count)
        ]
        store = open_store(drawn)
        for words in ("first run, with imports", "warm"):
            start = time.process_time()
            jobs = plan(read_manifest(rows))
            planned = time.process_time()
            results = [run_job(job, store) for job in jobs]
            end = time.process_time()
            failed = [result.error for result in results if result.error]
            assert not failed, failed[0]
            print(
                f"busts, {view}, {words}: {(planned - start) / count * 1e3:.1f} ms to plan,"
                f" {(end - planned) / count * 1e3:.1f} ms to draw and store,"
                f" {count / (end - start):.0f} a second on one core"
            )


def walking_loop(view: str, frames: int) -> None:
    """Print what a walking loop with a cape takes."""
    player = player_of(PlayerSettings(wear=("cape",)))
    packs = open_packs(())
    settings = player.settings(size=(300, 600), view=view)
    with TemporaryDirectory() as folder:
        for words in ("first run, with imports", "warm"):
            times = [time.process_time()]
            scenes = list(loop(player, packs, settings, frames, 20.0))
            times.append(time.process_time())
            drawn_frames = list(draw_scenes(scenes, packs, settings, loop=True))
            times.append(time.process_time())
            save_animation(drawn_frames, 20.0, Path(folder, "walk.gif"), total=frames)
            times.append(time.process_time())
            motion, drawn, written = np.diff(times)
            print(
                f"loop, {view}, {words}: {motion:.2f} s motion, {drawn:.2f} s frames,"
                f" {written:.2f} s file, {times[-1] - times[0]:.2f} s in all"
            )


def contact(name: str, moments: int) -> None:
    """Print how deep a garment enters its wearer at a run."""
    player = player_of(PlayerSettings(wear=(name,), motion="run", speed=4.0))
    dressed = Dressed(player, open_packs(()), player.settings())
    times = [frame / 20 for frame in range(1, moments + 1)]
    depths = [
        max(
            deepest(sewn, sheet[number], dressed.colliders(sewn), time)
            for sewn, sheet in zip(dressed.cloths, sheets, strict=True)
        )
        for sheets in [
            dressed.record(Schedule.at(times, dressed.step, every=round(1 / (20 * dressed.step))))
        ]
        for number, time in enumerate(times)
    ]
    inside = sum(depth > 0 for depth in depths)
    print(
        f"contact, {name}: inside at {inside} of {moments} moments,"
        f" at most {max(depths) * 1e3:.2f} mm"
    )


def main() -> None:
    """See the module."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", nargs="?", choices=("busts", "loop", "contact"))
    add_quick(parser)
    given = parser.parse_args()
    what, count, frames = given.what, *((2, 4) if given.quick else (COUNT, FRAMES))
    if what in (None, "busts"):
        for view in ("iso", "hero"):
            busts(view, count)
    if what in (None, "loop"):
        for view in ("back", "hero"):
            walking_loop(view, frames)
    if what in (None, "contact"):
        for name in ("cape", "elytra", "skirt"):
            contact(name, frames)


if __name__ == "__main__":
    main()
