"""`drapery compare`: where designs, packs, layer modes, backends or pictures differ."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.compare_folders import REPORTS, compare as compare_folders, folders_of
from drapery.commands.notices import compile_notice
from drapery.comparison import LIMIT_OPTIONS
from drapery.errors import counted
from drapery.option import Subject

if TYPE_CHECKING:
    from drapery.comparison import Comparison, Variant
    from drapery.render import Frame

_READING = {"form": "from", "number": "number"}
"""How a design is read: the names of parameters and options."""


@o.pictured("still", Subject("banner"), without=("design",), more=LIMIT_OPTIONS)
def run(
    subjects: Annotated[
        list[str],
        typer.Argument(
            metavar="A [B]...",
            help="Designs, one design and packs, finished pictures, or two folders of them.",
            show_default=False,
        ),
    ],
    out: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--out",
            metavar="FILE",
            help="Side by side as a picture, flickering as an animation, a report as .html,"
            " figures as .json; of folders the last two.",
        ),
    ] = None,
    perceptual: Annotated[
        bool, typer.Option("--perceptual", help="SSIM, FLIP and CIEDE2000 as well.")
    ] = False,
    cost: Annotated[
        bool, typer.Option("--cost", help="Quads drawn and time for a frame as well.")
    ] = False,
    layers: Annotated[
        str, typer.Option(help="One mode, or stacked,flat to compare the two.")
    ] = "stacked",
    backend: Annotated[
        str, typer.Option(help="One backend, or soft,pyrender to compare the two.")
    ] = "auto",
    **words: Any,
) -> None:
    """Compare pictures with the first; exit code 0 same, 1 different, 2 bad input.

    Each --style is a picture of its own.
    """
    from drapery.comparison import compare_variants, draw_variants, is_picture, read_tolerance
    from drapery.render.encode import check_target
    from drapery.settings import NAMED_OPTIONS

    folders = folders_of(subjects)
    for target in out or []:
        check_target(target, *(REPORTS if folders else (*REPORTS, "still", "loop")))
    limits = read_tolerance({name: words.pop(name) for name in LIMIT_OPTIONS})
    if folders or any(is_picture(subject) for subject in subjects):
        named = {"layers": layers, "backend": backend}
        changed = {n: v for n, v in named.items() if v != NAMED_OPTIONS[n].default}
        _refuse_options(words | changed, cost)
    if folders:
        raise typer.Exit(compare_folders(folders, limits, out or (), perceptual=perceptual))
    modes, backends, styles = layers.split(","), backend.split(","), words.pop("style", ())
    first = {"layers": modes[0], "backend": backends[0]}
    settings = o.settings_of(words | first)
    reading = {name: words[name] for name in _READING}
    with compile_notice():
        chosen = draw_variants(subjects, settings, modes, backends, styles, **reading)
        pairs = compare_variants(chosen, limits, perceptual=perceptual)
        costs = {v.label: _cost(v) for v in chosen} if cost else {}
    for pair in pairs:
        print(pair.line())
    for label, figures in costs.items():
        quads = counted(round(figures["quads"]), "quad")
        print(f"{label}: {quads}, {figures['ms_per_frame']:.2f} ms a frame")
    for target in out or []:
        _write(target, pairs, costs)
    raise typer.Exit(0 if all(pair.difference.agrees for pair in pairs) else 1)


def _refuse_options(words: dict[str, Any], cost: bool) -> None:
    """Raise OptionError for options that do nothing for finished pictures."""
    from drapery.errors import OptionError
    from drapery.settings import NAMED_OPTIONS

    idle = ["--cost"] if cost else []
    idle += [f"--{flag}" for name, flag in _READING.items() if words[name] is not None]
    idle += [option.command_flag for name, option in NAMED_OPTIONS.items() if name in words]
    if idle:
        raise OptionError(f"{idle[0]} does nothing for finished pictures; leave it out")


def _cost(variant: "Variant") -> dict[str, float]:
    from drapery.comparison import cost_of

    measured = cost_of(variant)
    return {"quads": measured.quads, "ms_per_frame": measured.milliseconds}


def _write(target: Path, pairs: "list[Comparison]", costs: dict[str, dict[str, float]]) -> None:
    from PIL import Image

    from drapery.comparison import html_report, pair_entry, pair_facts, pair_sheet, write_text
    from drapery.file_formats import format_of
    from drapery.output_files import replacing
    from drapery.render import Animation
    from drapery.render.contact import stack_frames
    from drapery.render.encode.quick_png import quick_png_bytes

    format = format_of(target, *REPORTS, "still", "loop")
    kind = format.kind(timed=False)
    if kind == "still":
        sheet = stack_frames([pair_sheet(pair) for pair in pairs])
        if format.name != "PNG":
            sheet.save(target)
            return
        with replacing(target) as beside:
            beside.write_bytes(quick_png_bytes(Image.fromarray(sheet.pixels)))
    elif kind == "loop":
        Animation(_flicker(pairs), 2.0).save(target)
    elif kind == "page":
        entries = [pair_entry(pair) for pair in pairs]
        summary = " ".join(
            f"{label}: {counted(round(c['quads']), 'quad')}, {c['ms_per_frame']:.2f} ms a frame."
            for label, c in costs.items()
        )
        write_text(target, html_report("Comparison", summary, entries))
    else:
        facts = [pair_facts(pair) for pair in pairs]
        write_text(target, json.dumps({"pairs": facts, "cost": costs}, indent=2) + "\n")


def _flicker(pairs: "list[Comparison]") -> "tuple[Frame, ...]":
    from drapery.comparison import padded
    from drapery.render import Frame

    frames = [pairs[0].first.frame.pixels, *(pair.other.frame.pixels for pair in pairs)]
    room = frames[0]
    for pixels in frames[1:]:
        room, _ = padded(room, pixels)
    return tuple(Frame(padded(pixels, room)[0]) for pixels in frames)
