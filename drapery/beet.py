"""A beet plugin: previews of a project's banner patterns, and a failed build when they change.

In `beet.json`:

    {"pipeline": ["drapery.beet"], "meta": {"drapery": {"goldens": "goldens"}}}
"""

import hashlib
import re
from collections import Counter
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any
from zipfile import ZipFile

from beet import BannerPattern, Context, ErrorMessage, PluginOptions, configurable
from beet.library.base import Pack

from drapery.banner import PATTERNS
from drapery.errors import DraperyError, counted
from drapery.settings import Settings
from drapery.testing.case_check import check_cases, update_cases
from drapery.testing.cases import Case, CaseFile
from drapery.testing.failures import clear_report, write_report

BANNER_TEXTURES = "minecraft:entity/banner/"


class DraperyOptions(PluginOptions):
    """The options in `meta.drapery`; paths are relative to the project.

    previews: folder for a picture of each pattern. goldens: folder of goldens; without it nothing
    is checked. update: write the goldens instead of checking them. report: folder for failures.
    base, dye: dyes of the banner and of the pattern. size: of a picture [pixels]. view: a named
    view of `drapery.render.VIEWS`. designs: more banners to draw, by name.
    """

    previews: str = "previews"
    goldens: str | None = None
    update: bool = False
    report: str = "drapery-report"
    base: str = "white"
    dye: str = "black"
    size: tuple[int, int] = (128, 160)
    view: str = "front"
    designs: dict[str, str] = {}  # noqa: RUF012 - a model of pydantic copies its defaults


def beet_default(ctx: Context) -> None:
    """The plugin, with the options of `meta.drapery`."""
    ctx.require(drapery)


@configurable("drapery", validator=DraperyOptions)
def drapery(ctx: Context, opts: DraperyOptions) -> None:
    """Draw the project's patterns; raise ErrorMessage if one differs from its golden."""
    folder = Path(ctx.directory)
    try:
        with TemporaryDirectory() as temporary:
            packs = _save_packs(ctx, Path(temporary))
            cases = _cases(ctx, opts, packs)
            if cases:
                _write_previews(cases, opts, folder)
                _check_goldens(cases, opts, folder)
    except DraperyError as error:
        raise ErrorMessage(str(error)) from None


def pattern_ids(ctx: Context) -> list[str]:
    """Patterns that the project adds, and patterns of the game whose textures it replaces."""
    added = list(ctx.data[BannerPattern])
    textures = (name.removeprefix(BANNER_TEXTURES) for name in ctx.assets.textures)
    return sorted({*added, *(name for name in textures if name in PATTERNS)})


def _save_packs(ctx: Context, folder: Path) -> tuple[str, ...]:
    paths = folder / "assets.zip", folder / "data.zip"
    packs: tuple[Pack[Any], Pack[Any]] = (ctx.assets, ctx.data)
    for pack, path in zip(packs, paths, strict=True):
        with ZipFile(path, "w") as file:
            pack.dump(file)
    return tuple(map(str, paths))


def _cases(ctx: Context, opts: DraperyOptions, packs: tuple[str, ...]) -> tuple[Case, ...]:
    designs = {name: f"{opts.base} {name}:{opts.dye}" for name in pattern_ids(ctx)} | opts.designs
    settings = Settings(packs=packs, size=opts.size, view=opts.view)
    return tuple(
        Case(name=file_name, design=design, settings=settings)
        for file_name, design in zip(_file_names(list(designs)), designs.values(), strict=True)
    )


def _file_names(names: list[str]) -> list[str]:
    """Each name as a file name; those that would share one get a digest of the name."""
    clean = [re.sub(r"[^A-Za-z0-9._-]", "-", name)[:80] for name in names]
    count = Counter(file_name.lower() for file_name in clean)
    return [
        file_name
        if count[file_name.lower()] == 1
        else f"{file_name}-{hashlib.sha256(name.encode()).hexdigest()[:8]}"
        for name, file_name in zip(names, clean, strict=True)
    ]


def _write_previews(cases: tuple[Case, ...], opts: DraperyOptions, folder: Path) -> None:
    for _ in update_cases(CaseFile(goldens=opts.previews, case=cases), folder):
        pass


def _check_goldens(cases: tuple[Case, ...], opts: DraperyOptions, folder: Path) -> None:
    if opts.goldens is None:
        return
    file = CaseFile(goldens=opts.goldens, case=cases)
    if opts.update:
        list(update_cases(file, folder))
        return
    report = folder / opts.report
    clear_report(report)
    faults = [o for o in check_cases(file, folder, report) if o.fault is not None]
    if faults:
        page = write_report(report)
        lines = "; ".join(f"{o.name}: {o.fault}" for o in faults[:5])
        raise ErrorMessage(
            f"{counted(len(faults), 'banner picture')} changed ({lines}); see {page}"
        )
