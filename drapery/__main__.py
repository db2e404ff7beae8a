"""`python -m drapery` is the command line."""

from drapery.cli import main

main()
