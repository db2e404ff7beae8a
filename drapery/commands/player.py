"""`drapery player`: a player in a skin, with cape, elytra and garments of cloth."""

from typing import Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.garment import UNUSED, is_given, write_garment


@o.pictured(*UNUSED, "texture")
def run(
    context: typer.Context,
    out: Annotated[
        str,
        typer.Option(
            "-o", "--out", metavar="TARGET", help="A picture, animation, folder or 3-D file."
        ),
    ],
    skin: Annotated[
        str,
        typer.Option(metavar="FILE|NAME", help="A PNG file, 64 x 64 or 64 x 32, or dancer."),
    ] = "traveller",
    arms: Annotated[
        str, typer.Option(help="Arms: auto reads them from the skin, classic or slim.")
    ] = "auto",
    cape: Annotated[
        str | None, typer.Option(metavar="FILE", help="A cape: a PNG file, 64 x 32 or a multiple.")
    ] = None,
    elytra: Annotated[
        bool, typer.Option("--elytra", help="Wings of cloth, with the texture of --cape.")
    ] = False,
    wear: Annotated[
        list[str] | None,
        typer.Option(metavar="NAME|FILE", help="A garment, the innermost first; several are worn."),
    ] = None,
    motion: Annotated[
        str,
        typer.Option(
            metavar="NAME|FILE",
            help="walk, stand, run, sneak, jump, glide, swim, sit, wave, point, or a pose in JSON.",
        ),
    ] = "walk",
    speed: Annotated[float, typer.Option(help="Speed over the ground, 0 to 10 m/s.")] = 1.5,
    look: Annotated[
        str, typer.Option(metavar="LEFT,DOWN", help="Where the head turns [degrees].")
    ] = "0,0",
    shown: Annotated[str, typer.Option(help="What is shown: full, bust or head.")] = "full",
    seconds: o.SecondsOption = 4.0,
    fps: o.FpsOption = 20.0,
    **words: Any,
) -> None:
    """Draw a player in its skin, moving, with a cape and clothes of real cloth."""
    from pathlib import Path

    from drapery.errors import OptionError
    from drapery.garments import dressed_player, make_wearer

    try:
        yaw, pitch = (float(angle) for angle in look.split(","))
    except ValueError:
        raise OptionError(f"look {look!r} is not two angles; write it like 30,10") from None
    if skin.lower().endswith(".png"):
        skin = str(Path(skin).absolute())
    if motion.lower().endswith(".json"):
        motion = str(Path(motion).absolute())
    wearer = make_wearer(
        skin=skin, arms=arms, motion=motion, speed=speed, look=(yaw, pitch), shown=shown
    )
    player = dressed_player(wearer, cape=cape, elytra=elytra, wear=wear or ())
    given = {key: words[key] for key in words if is_given(context, key)}
    write_garment(player, out, player.settings(**o.options_of(given)), seconds, fps)
