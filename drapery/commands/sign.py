"""`drapery sign`: addresses that a service with a secret answers."""

from typing import Annotated

import typer


def run(
    addresses: Annotated[
        list[str],
        typer.Argument(metavar="ADDRESS...", help="As https://HOST/banner.png?design=white."),
    ],
) -> None:
    """Print addresses of pictures with their signatures.

    A `drapery serve` with the same DRAPERY_SECRET in its environment answers them.
    """
    import os

    from drapery.serve.signatures import SECRET, sign_address

    secret = os.environ.get(SECRET, "")
    for line in [sign_address(address, secret) for address in addresses]:
        print(line)
