"""The pytest plugin: the fixture `golden`, `--drapery-update`, and a report of failures.

Goldens are in `goldens/<test file>/` beside the test. syrupy names them, finds those that no test
uses any more, and collects the results of pytest-xdist's workers.
"""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from drapery.errors import DraperyError

if TYPE_CHECKING:
    from drapery import Banner

Golden = Callable[..., None]
"""The type of the fixture `golden`: `golden(picture, name, *, tolerance, pixels, ...)`."""

_STALE: pytest.StashKey[bool] = pytest.StashKey()
"""Whether the report folder holds failures of an earlier run that cannot be removed."""


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("drapery", "golden images")
    group.addoption(
        "--drapery-update",
        action="store_true",
        help="write the pictures of this run as the new goldens",
    )
    group.addoption(
        "--drapery-report",
        metavar="PATH",
        default="drapery-report",
        help="folder of failed pictures and their report (default: drapery-report), or the page"
        " itself as a file .html; the pictures are then in a folder beside it",
    )


def pytest_sessionstart(session: pytest.Session) -> None:
    if _is_worker(session.config):
        return
    from drapery.testing.failures import clear_report

    try:
        clear_report(*_report_places(session.config))
    except DraperyError as error:
        session.config.stash[_STALE] = True
        warning = pytest.PytestWarning(f"{error} with --drapery-report PATH")
        session.config.issue_config_time_warning(warning, 2)


def pytest_terminal_summary(terminalreporter: Any, config: pytest.Config) -> None:
    if _is_worker(config) or config.stash.get(_STALE, False):
        return
    from drapery.testing.failures import write_report

    try:
        page = write_report(*_report_places(config))
    except DraperyError as error:
        terminalreporter.write_line(f"drapery: {error}")
        return
    if page is not None:
        terminalreporter.write_line(f"drapery: report of the failed pictures: {page}")


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Golden:
    """Compare a picture with its golden file: `golden(picture, name="creeper")`.

    picture: a Frame, an Animation, a Pillow image, a uint8 array, or a scene to be drawn by
        `backend`.
    name: the golden's name within the test; by default its number.
    tolerance, pixels: channel errors up to `tolerance` (0..255) do not count, and `pixels` pixels
        of each frame may have larger errors; both are 0 by default, which is right for the soft
        backend.
    hashed: store only size and SHA-256 instead of the picture.
    backend: each backend other than soft has separate goldens.
    banner, packs: the design that was drawn; a failure then names the layer that changed.
    """
    try:
        from drapery.testing.check import check_golden
    except ModuleNotFoundError as missing:
        pytest.fail(f'golden needs {missing.name}: pip install "drapery[testing]"', pytrace=False)

    def check(
        picture: Any,
        name: str | None = None,
        *,
        tolerance: int = 0,
        pixels: int = 0,
        hashed: bool = False,
        backend: str = "soft",
        banner: "Banner | None" = None,
        packs: Sequence[str | Path] = (),
    ) -> None:
        __tracebackhide__ = True
        try:
            fault = check_golden(
                request,
                picture,
                name=name,
                tolerance=(tolerance, pixels),
                hashed=hashed,
                backend=backend,
                design=None if banner is None else (banner, tuple(packs)),
                report=_report_places(request.config)[0],
            )
        except DraperyError as error:
            fault = str(error)
        if fault is not None:
            pytest.fail(fault, pytrace=False)

    return check


def _is_worker(config: pytest.Config) -> bool:
    return hasattr(config, "workerinput")


def _report_places(config: pytest.Config) -> tuple[Path, Path | None]:
    """The folder of failed pictures, and the page if it is not in that folder."""
    path = config.rootpath / str(config.getoption("--drapery-report"))
    return (path.with_suffix(".files"), path) if path.suffix == ".html" else (path, None)
