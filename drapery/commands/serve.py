"""`drapery serve`: pictures of banners over HTTP."""

from pathlib import Path
from typing import Annotated

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, say


def run(
    host: Annotated[str, typer.Option(help="The address to listen at.")] = "127.0.0.1",
    port: Annotated[int, typer.Option(help="The port; 0 chooses one.")] = 8000,
    packs: o.PackOption = None,
    format: o.FormatOption = None,
    workers: Annotated[
        int | None, typer.Option(help="Processes that draw.", show_default="one a core")
    ] = None,
    rate: Annotated[float, typer.Option(help="Requests a minute of a client; 0: any.")] = 600.0,
    timeout: Annotated[float, typer.Option(help="Seconds that one picture may take.")] = 20.0,
    deadline: Annotated[
        float, typer.Option(help="Seconds that an answer may take, waiting included.")
    ] = 30.0,
    memory: Annotated[int, typer.Option(help="MiB that one picture may take.")] = 1024,
    cache: Annotated[int, typer.Option(help="MiB of pictures that are cached in memory.")] = 64,
    side: Annotated[int, typer.Option(help="The widest and tallest picture in pixels.")] = 1024,
    skins: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Skins that /player may name: PNG files."),
    ] = None,
    capes: Annotated[
        Path | None,
        typer.Option(metavar="FOLDER", help="Capes that /player may name: PNG files."),
    ] = None,
    trusted_proxy: Annotated[
        list[str] | None,
        typer.Option(
            metavar="ADDRESS",
            help="An address or network whose X-Forwarded-For names the client.",
        ),
    ] = None,
) -> None:
    """Answer /banner.png?design=…, /garment.png?name=… and /player.png?skin=…, and the same with
    .gif and other endings; /openapi.json lists them and the parameters. With DRAPERY_SECRET in the
    environment, it answers only addresses that `drapery sign` has signed."""
    import os

    from drapery.errors import BackendError
    from drapery.option import within
    from drapery.packs import open_packs
    from drapery.settings import MAX_SIDE, Settings

    try:
        from drapery.serve.app import make_app
        from drapery.serve.server import address_of, check_proxies, listen, run_server
    except ImportError:
        raise BackendError('the service needs an extra; pip install "drapery-mc[serve]"') from None
    from drapery.batch.pool import JobLimits, warm_up
    from drapery.serve.request_params import PictureLimits, ServiceConfig, pictures_in
    from drapery.serve.signatures import SECRET, check_secret

    count = (os.cpu_count() or 1) if workers is None else workers
    within("port", port, 0, 65535)
    within("workers", count, 1, 512, "processes")
    within("rate", rate, 0, 1e6, "requests a minute")
    within("timeout", timeout, 0.1, 3600, "s")
    within("deadline", deadline, 0.1, 3600, "s")
    within("memory", memory, 16, 1 << 20, "MiB")
    within("cache", cache, 1, 1 << 20, "MiB")
    within("side", side, 16, MAX_SIDE, "pixels")
    proxies = check_proxies(trusted_proxy or ())
    secret = check_secret(os.environ.get(SECRET, ""))
    base = Settings(packs=tuple(packs or ()), format=format, size=(min(256, side), min(320, side)))
    open_packs(base.packs, format=format)
    listed = [{} if folder is None else pictures_in(folder) for folder in (skins, capes)]
    listening = listen(host, port)
    with compile_notice():
        warm_up()
    app = make_app(
        ServiceConfig(base, PictureLimits(side=side), *listed),
        workers=count,
        limits=JobLimits(timeout, memory << 20),
        rate=rate,
        cache=cache << 20,
        deadline=deadline,
        secret=secret,
    )
    say(f"listening at {address_of(listening)}; /openapi.json lists the parameters")
    run_server(app, listening, proxies)
