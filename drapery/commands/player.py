"""`drapery player`: a player in a skin, with cape, elytra and garments of cloth."""

from typing import Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.garment import write_garment
from drapery.option import Subject
from drapery.player_settings import PLAYER_OPTIONS, PlayerSettings


@o.pictured(subject=Subject("player"), more=PLAYER_OPTIONS)
def run(
    context: typer.Context,
    out: Annotated[
        str,
        typer.Option(
            "-o",
            "--out",
            metavar="TARGET",
            help="A picture, animation, folder, 3-D file or .html page.",
        ),
    ],
    **words: Any,
) -> None:
    """Draw a player in its skin, moving, with a cape and clothes of real cloth."""
    from drapery.garments import player_of

    chosen = {
        name: option.parse((words.pop(name) or ()) if option.several else words.pop(name))
        for name, option in PLAYER_OPTIONS.items()
    }
    player = player_of(PlayerSettings(**chosen))
    o.check_given(context, out)
    settings = player.settings(**o.options_of(words))
    write_garment(player, out, settings, o.loop_options_of(words))
