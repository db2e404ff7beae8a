"""`drapery compare`: where designs, packs, layer modes, backends or pictures differ."""

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice
from drapery.comparison import LIMIT_OPTIONS

if TYPE_CHECKING:
    from drapery.comparison import Comparison, Variant
    from drapery.render import Frame

ENDINGS = (".png", ".gif", ".html", ".json")


@o.pictured("design", "texture", more=LIMIT_OPTIONS)
def run(
    subjects: Annotated[
        list[str],
        typer.Argument(
            metavar="A [B]...",
            help="Designs, one design and packs, or finished pictures.",
            show_default=False,
        ),
    ],
    out: Annotated[
        list[Path] | None,
        typer.Option(
            "-o",
            "--out",
            metavar="FILE",
            help="Side by side as .png, flickering as .gif, a report as .html, figures as .json.",
        ),
    ] = None,
    perceptual: Annotated[
        bool, typer.Option("--perceptual", help="SSIM, FLIP and CIEDE2000 (extra: compare).")
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
    from drapery.comparison import compare_variants, draw_variants, read_tolerance
    from drapery.settings import Settings

    for target in out or []:
        _check_target(target)
    limits = read_tolerance({name: words.pop(name) for name in LIMIT_OPTIONS})
    modes, backends, styles = layers.split(","), backend.split(","), words.pop("style") or ()
    first = {"layers": modes[0], "backend": backends[0]}
    settings = Settings(**o.options_of(words | first))
    reading = {name: words[name] for name in ("form", "number")}
    with compile_notice():
        chosen = draw_variants(subjects, settings, modes, backends, styles, **reading)
        pairs = compare_variants(chosen, limits, perceptual=perceptual)
        costs = {v.label: _cost(v) for v in chosen} if cost else {}
    for pair in pairs:
        print(pair.line())
    for label, figures in costs.items():
        print(f"{label}: {figures['quads']} quads, {figures['ms_per_frame']:.2f} ms a frame")
    for target in out or []:
        _write(target, pairs, costs)
    raise typer.Exit(0 if all(pair.difference.agrees for pair in pairs) else 1)


def _cost(variant: "Variant") -> dict[str, float]:
    from drapery.comparison import cost_of

    measured = cost_of(variant)
    return {"quads": measured.quads, "ms_per_frame": measured.milliseconds}


def _check_target(target: Path) -> None:
    """Check a target before anything is drawn. Raises OptionError or OutputError."""
    from drapery.errors import OptionError
    from drapery.render import check_writable

    if target.suffix.lower() not in ENDINGS:
        raise OptionError(f"{target}: the ending of a comparison is one of {', '.join(ENDINGS)}")
    check_writable(target)


def _write(target: Path, pairs: "list[Comparison]", costs: dict[str, dict[str, float]]) -> None:
    from drapery.comparison import html_report, pair_entry, pair_facts, pair_sheet, write_text
    from drapery.render import Animation, stack_frames

    ending = target.suffix.lower()
    if ending == ".png":
        stack_frames([pair_sheet(pair) for pair in pairs]).save(target)
    elif ending == ".gif":
        Animation(_flicker(pairs), 2.0).save(target)
    elif ending == ".html":
        entries = [pair_entry(pair) for pair in pairs]
        summary = " ".join(
            f"{label}: {c['quads']:.0f} quads, {c['ms_per_frame']:.2f} ms a frame."
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
