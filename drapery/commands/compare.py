"""`drapery compare`: where designs, packs, layer modes, backends or pictures differ."""

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice

if TYPE_CHECKING:
    from drapery.comparison import Comparison, Variant
    from drapery.render import Frame

ENDINGS = (".png", ".gif", ".html", ".json")


@o.pictured("design", "texture")
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
    tolerance: Annotated[int, typer.Option(help="Channel errors up to this do not count.")] = 0,
    pixels: Annotated[int, typer.Option(help="Number of pixels that may differ more.")] = 0,
    ratio: Annotated[float, typer.Option(help="Share of the pixels that may differ more.")] = 0.0,
    colour: Annotated[
        float | None,
        typer.Option(help="Only perceived differences above this count, 0 to 1; 0.1 is usual."),
    ] = None,
    antialiasing: Annotated[
        bool, typer.Option(help="Whether pixels of smoothed edges count.")
    ] = True,
    ignore: Annotated[
        list[str] | None,
        typer.Option(metavar="X,Y,W,H", help="A box of pixels that does not count."),
    ] = None,
    mask: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="A picture whose bright pixels do not count."),
    ] = None,
    limit: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME=VALUE", help="flip=0.05, ssim=0.98 or ciede2000=1 as a limit."),
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
    from drapery.comparison import (
        Tolerance,
        compare_variants,
        draw_variants,
        eight_bits,
        painted,
        read_picture,
    )
    from drapery.settings import Settings

    for target in out or []:
        _check_target(target)
    limits = Tolerance(
        *(tolerance, pixels, ratio, colour, antialiasing),
        ignore=tuple(_box(text) for text in ignore or ()),
        **_limits(limit or ()),
    )
    hidden = None if mask is None else painted(eight_bits(read_picture(mask).frames[0]))
    modes, backends, styles = layers.split(","), backend.split(","), words.pop("style") or ()
    first = {"layers": modes[0], "backend": backends[0]}
    settings = Settings(**o.options_of(words | first))
    reading = {name: words[name] for name in ("form", "number")}
    with compile_notice():
        chosen = draw_variants(subjects, settings, modes, backends, styles, **reading)
        pairs = compare_variants(chosen, limits, mask=hidden, perceptual=perceptual)
        costs = {v.label: _cost(v) for v in chosen} if cost else {}
    for pair in pairs:
        print(pair.line())
    for label, figures in costs.items():
        print(f"{label}: {figures['quads']} quads, {figures['ms_per_frame']:.2f} ms a frame")
    for target in out or []:
        _write(target, pairs, costs)
    raise typer.Exit(0 if all(pair.difference.agrees for pair in pairs) else 1)


def _box(text: str) -> tuple[int, int, int, int]:
    """Raises OptionError."""
    from drapery.errors import OptionError

    parts = text.split(",")
    if len(parts) != 4 or not all(part.strip().isdecimal() and len(part) < 8 for part in parts):
        raise OptionError(f"ignore {text[:40]!r} is not a box; write it like 10,20,64,32")
    left, top, width, height = map(int, parts)
    return left, top, width, height


def _limits(texts: Sequence[str]) -> dict[str, Any]:
    """Raises OptionError."""
    from drapery.errors import OptionError

    found = {}
    for text in texts:
        name, _, value = text.partition("=")
        try:
            found[name] = float(value)
        except ValueError:
            name = ""
        if name not in ("flip", "ssim", "ciede2000"):
            raise OptionError(
                f"limit {text[:40]!r} is not known; write flip=0.05, ssim=0.98 or ciede2000=1"
            )
    return found


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
