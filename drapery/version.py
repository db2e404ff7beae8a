"""The version of the package."""

__version__: str = "0.1.0"
"""The version, which `pyproject.toml` repeats for the distribution `drapery-mc`."""
