"""`drapery studio`: a page on which to design a banner and watch it wave."""

from pathlib import Path
from typing import Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import adopt_warnings, say

SHORTEST_TOKEN = 8


def run(
    port: Annotated[int, typer.Option(help="The port; 0 chooses one.")] = 8080,
    host: Annotated[
        str, typer.Option(help="The address to listen at; one open to others needs --token.")
    ] = "127.0.0.1",
    token: Annotated[
        str | None, typer.Option(help="The token that visitors must know; at least 8 characters.")
    ] = None,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
    library: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="The file of saved designs.", show_default="your own"),
    ] = None,
    browser: Annotated[
        bool, typer.Option("--open/--no-open", help="Open the page in a browser.")
    ] = True,
) -> None:
    """Open the studio: design a banner on a page and watch it wave."""
    from drapery import BackendError, Settings
    from drapery.option import within

    _check(host, token)
    within("port", port, 0, 65535)
    settings = Settings(packs=tuple(packs or ()), format=format)
    try:
        from drapery.studio import app
        from drapery.studio.session import StudioConfig
    except ImportError as error:
        raise BackendError(
            f'the studio needs an extra ({error.name}); pip install "drapery-mc[studio]"'
        ) from None
    from drapery.packs import open_packs

    open_packs(settings.packs, format=format)
    adopt_warnings()

    def ready(address: str) -> None:
        say(f"the studio is at {address}; Ctrl+C ends it")
        if browser:
            _open(address)

    app.run(StudioConfig(settings, library), host=host, port=port, token=token, ready=ready)


def _check(host: str, token: str | None) -> None:
    from drapery import OptionError

    if token is not None and (len(token) < SHORTEST_TOKEN or not token.isascii()):
        raise OptionError(f"token: give at least {SHORTEST_TOKEN} plain characters")
    if token is None and host not in ("localhost", "127.0.0.1", "::1"):
        raise OptionError(f"host {host} is open to others; give a --token that they must know")


def _open(address: str) -> None:
    """Show the page, in a thread: some browsers hold the caller until they are closed."""
    import threading
    import webbrowser

    threading.Thread(target=webbrowser.open, args=(address,), daemon=True).start()
