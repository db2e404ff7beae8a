"""The pytest plugin: the fixtures `golden` and `golden_numbers`, their flags, a report of failures.

Goldens are in `goldens/<test file>/` beside the test. Each process that runs tests records which
goldens they name (`drapery.testing.usage`); workers of pytest-xdist send their record to the main
process, which lists or deletes the goldens that no test names.
"""

from collections.abc import Callable, Generator, Iterator, Sequence
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import pytest

from drapery.comparison import LIMIT_OPTIONS
from drapery.errors import DraperyError, counted

if TYPE_CHECKING:
    from drapery import Banner
    from drapery.comparison import Picture, Tolerance
    from drapery.testing.check import GoldenCheck, GoldenResult
    from drapery.testing.usage import GoldenUsage

Golden = Callable[..., None]
"""The type of the fixtures `golden(picture, name, *, tolerance, ...)` and `golden_numbers(numbers,
name, *, within)`."""

_FAULTS: pytest.StashKey[list[str]] = pytest.StashKey()
"""What the goldens of this try of a test found, until the test fails because of it."""
_LABELS: pytest.StashKey[list[str]] = pytest.StashKey()
"""The labels of the goldens of this try of a test."""
_USAGE: "pytest.StashKey[GoldenUsage]" = pytest.StashKey()
_NAMES: pytest.StashKey[dict[Path, dict[str, str]]] = pytest.StashKey()
"""For each folder of goldens the names of its files, by their names without case."""
_ENTRIES: pytest.StashKey[dict[str, list[str]]] = pytest.StashKey()
"""The ids of the report's failures, by the ids of their tests."""

_STALE: pytest.StashKey[bool] = pytest.StashKey()
"""Whether the report folder holds failures of an earlier run that cannot be removed."""

_MOST_LISTED = 10
"""The most unused goldens that are named."""


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("drapery", "golden images")
    group.addoption(
        "--drapery-update",
        action="store_true",
        help="write the pictures of this run as the new goldens",
    )
    group.addoption(
        "--drapery-variant",
        metavar="NAME",
        help="with --drapery-update: write them beside the present goldens, as further approved"
        " pictures of this name",
    )
    group.addoption(
        "--drapery-prune",
        action="store_true",
        help="delete the goldens that no test names, after a complete run without failures",
    )
    group.addoption(
        "--drapery-report",
        metavar="PATH",
        default="drapery-report",
        help="folder of failed pictures and their report (default: drapery-report), or the page"
        " itself as a file .html; the pictures are then in a folder beside it",
    )
    for name, option in LIMIT_OPTIONS.items():
        form: Literal["linelist", "string"] = "linelist" if option.several else "string"
        parser.addini(f"drapery_{name}", f"the default of golden({name}=)", form, default="")


def pytest_load_initial_conftests(parser: pytest.Parser, args: list[str]) -> None:
    # syrupy's flag, which other projects know; where syrupy is installed it is for its snapshots.
    if "--snapshot-update" in parser.parse_known_and_unknown_args(args)[1]:
        raise pytest.UsageError(
            "--snapshot-update is not a flag for goldens; use --drapery-update to accept pictures"
            " and --drapery-prune to delete unused goldens"
        )


def pytest_configure(config: pytest.Config) -> None:
    from drapery.testing.naming import VARIANT
    from drapery.testing.usage import GoldenUsage

    config.stash[_USAGE] = GoldenUsage()
    update, variant = config.getoption("--drapery-update"), config.getoption("--drapery-variant")
    if update and config.getoption("--drapery-prune"):
        raise pytest.UsageError(
            "--drapery-prune deletes goldens and --drapery-update writes them; run pytest twice"
        )
    if variant is not None and not update:
        raise pytest.UsageError("--drapery-variant does nothing without --drapery-update")
    if variant is not None and not VARIANT.fullmatch(variant):
        raise pytest.UsageError(
            f"--drapery-variant {variant!r} is not a name; use at most 32 of A-Z, a-z, 0-9, ._-"
        )


def pytest_sessionstart(session: pytest.Session) -> None:
    """Read which tests the report of earlier runs has."""
    config = session.config
    entries = config.stash.setdefault(_ENTRIES, {})
    folder, page = _report_places(config)
    if not folder.is_dir():
        return  # most runs; the import takes a tenth of a second
    from drapery.testing.failures import clear_report, failures_in

    try:
        for each in failures_in(folder):
            entries.setdefault(each.test, []).append(each.id)
    except DraperyError:  # another version wrote it, or a file is damaged
        if not _is_worker(config):
            _tidy(config, partial(clear_report, folder, page))


def pytest_itemcollected(item: pytest.Item) -> None:
    item.config.stash[_USAGE].collected += 1


def pytest_collection_finish(session: pytest.Session) -> None:
    usage = session.config.stash[_USAGE]
    usage.tests = {item.nodeid: (str(item.path), _test_name(item)) for item in session.items}
    if session.config.option.collectonly or not usage.chose_all(session.config.args):
        return
    files = {path for path, _ in usage.tests.values()}
    for test in [*session.config.stash[_ENTRIES]]:
        path = session.config.rootpath / test.partition("::")[0]
        # Tests that were renamed or deleted never run again.
        if "::" in test and test not in usage.tests and (str(path) in files or not path.exists()):
            _forget(session.config, test)


@pytest.hookimpl(tryfirst=True)
def pytest_runtest_setup(item: pytest.Item) -> None:
    """Each try of a test begins anew."""
    item.stash[_FAULTS] = []
    item.stash[_LABELS] = []
    _forget(item.config, item.nodeid)


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_pyfunc_call(pyfuncitem: pytest.Function) -> Generator[None, Any, Any]:
    """A test checks all its goldens, then fails with all that differ."""
    try:
        result = yield
    except BaseException as error:
        faults = _taken_faults(pyfuncitem)
        if not faults or not isinstance(error, pytest.skip.Exception):
            if faults:
                pyfuncitem.add_report_section("call", "golden pictures", "\n".join(faults))
            raise
    else:
        faults = _taken_faults(pyfuncitem)
    if faults:
        pytest.fail("\n".join(faults), pytrace=False)
    return result


@pytest.hookimpl(wrapper=True, tryfirst=True)
def pytest_runtest_makereport(item: pytest.Item) -> Generator[None, pytest.TestReport, Any]:
    report = yield
    if report.when == "call":
        if report.passed:
            item.config.stash[_USAGE].passed.add(item.nodeid)
        if not report.failed:  # it passed, or it is expected to fail
            _forget(item.config, item.nodeid)
    return report


@pytest.fixture
def golden(request: pytest.FixtureRequest) -> Iterator[Golden]:
    """Compare a picture with its golden file: `golden(picture, name="creeper")`.

    A test goes on after a picture that differs, and fails at its end with all of them.

    picture: a Frame, an Animation, a Pillow image, an array of uint8 or uint16, the path of a
        picture, or a scene to be drawn by `backend`.
    name: the golden's name within the test; by default its number. A name is used once in a test.
    hashed: store only size and SHA-256 instead of the picture; no limit can be given then.
    backend: each backend other than soft has separate goldens.
    banner, packs: the design that was drawn; a failure then names the layer that changed.
    limits: how much the picture may differ, by the names of the options of `drapery compare`:
        tolerance, pixels, ratio, colour, antialiasing, ignore, mask, flip, ssim, ciede2000. Their
        defaults are those of `drapery_tolerance` and so on in pytest's configuration; without any,
        nothing may differ, which is right for the soft backend.
    """

    def check(
        picture: Any,
        name: str | None = None,
        *,
        hashed: bool = False,
        backend: str = "soft",
        banner: "Banner | None" = None,
        packs: Sequence[str | Path] = (),
        **limits: Any,
    ) -> None:
        __tracebackhide__ = True
        _note(
            request.node,
            lambda: _check(
                request,
                _label(request.node, name, backend),
                picture,
                backend=backend,
                tolerance=_tolerance(request.config, limits, hashed),
                ending=".sha256" if hashed else ".png",
                design=None if banner is None else (banner, tuple(packs)),
            ),
        )

    yield check
    _fail_late(request.node)


@pytest.fixture
def golden_numbers(request: pytest.FixtureRequest) -> Iterator[Golden]:
    """Compare numbers with their golden file: `golden_numbers(positions, within=1e-6)`.

    A test goes on after numbers that differ, and fails at its end with all of them.

    numbers: an array, a number, a mapping of names to arrays, or the path of a file, such as a
        3-D model, of which the golden has the size and the SHA-256.
    name: the golden's name within the test, as of `golden`.
    within: the most by which a number may differ, in its own unit; by default it may not.
    """

    def check(numbers: Any, name: str | None = None, *, within: float = 0.0) -> None:
        __tracebackhide__ = True
        from drapery.testing.numbers import check_numbers, is_file

        def fault() -> str | None:
            label = _label(request.node, name, "soft")
            path = _golden_path(request, label, ".sha256" if is_file(numbers) else ".npz")
            result = check_numbers(_golden_check(request, label, path), numbers, within)
            return _told(request, label, result)

        _note(request.node, fault)

    yield check
    _fail_late(request.node)


def _note(item: pytest.Item, check: Callable[[], str | None]) -> None:
    """Keep the fault that a check finds until the end of the test."""
    __tracebackhide__ = True
    try:
        fault = check()
    except DraperyError as error:
        fault = str(error)
    if fault is not None:
        item.stash[_FAULTS].append(fault)


def _fail_late(item: pytest.Item) -> None:
    """Fail with what a call after the test has found, in another fixture."""
    faults = _taken_faults(item)
    if faults:
        pytest.fail("\n".join(faults), pytrace=False)


def _taken_faults(item: pytest.Item) -> list[str]:
    faults = item.stash.get(_FAULTS, [])
    item.stash[_FAULTS] = []
    return faults


def _label(item: pytest.Item, name: str | None, backend: str) -> str:
    """The label of a golden. Raises GoldenError if the test has used it."""
    used = item.stash[_LABELS]
    label = name or f"{len(used) + 1}"
    if backend not in ("soft", "auto"):
        label = f"{label}-{backend}"
    if label in used:
        from drapery.testing.golden import GoldenError

        raise GoldenError(f"golden {label!r} is named twice in this test; use another name")
    used.append(label)
    return label


def _drawn(picture: Any, backend: str) -> "Picture":
    from drapery.comparison import as_picture
    from drapery.render import Scene

    if isinstance(picture, Scene):
        from drapery.render import backend as backend_by_name

        picture = backend_by_name(backend)(picture)
    return as_picture(picture)


def _check(
    request: pytest.FixtureRequest,
    label: str,
    picture: Any,
    *,
    backend: str,
    tolerance: "Tolerance",
    ending: str,
    design: "tuple[Banner, tuple[str | Path, ...]] | None",
) -> str | None:
    from drapery.testing.passing import passes

    path = _golden_path(request, label, ending)
    if passes(path, picture, tolerance):
        return None
    from drapery.testing.check import check_golden

    check = _golden_check(request, label, path, tolerance)
    result = check_golden(check, _drawn(picture, backend), lambda: _notes(design))
    return _told(request, label, result)


def _golden_path(request: pytest.FixtureRequest, label: str, ending: str) -> Path:
    """Where the golden of a test lies, which the test names by this.

    Raises GoldenError if another golden's name differs only in case.
    """
    from drapery.testing.naming import golden_folder, golden_stem
    from drapery.testing.usage import same_but_for_case

    item, config = request.node, request.config
    path = golden_folder(item.path) / (golden_stem(_test_name(item), label) + ending)
    usage = config.stash[_USAGE]
    other = same_but_for_case(path, config.stash.setdefault(_NAMES, {}))
    if other is not None:
        from drapery.testing.golden import GoldenError

        # A file system that ignores case would keep one file for both.
        raise GoldenError(
            f"golden {label!r}: {path.name} differs from {other} only in case; use another name"
        )
    usage.named.add(str(path))
    return path


def _golden_check(
    request: pytest.FixtureRequest, label: str, path: Path, tolerance: "Tolerance | None" = None
) -> "GoldenCheck":
    """What to compare, and what the flags say to do where it differs. tolerance: of a picture."""
    from drapery.comparison import EXACT
    from drapery.testing.check import GoldenCheck

    config = request.config
    return GoldenCheck(
        test=request.node.nodeid,
        label=label,
        path=path,
        tolerance=tolerance or EXACT,
        update=bool(config.getoption("--drapery-update")),
        variant=config.getoption("--drapery-variant"),
        report=_report_places(config)[0],
        root=config.invocation_params.dir,
    )


def _told(request: pytest.FixtureRequest, label: str, result: "GoldenResult") -> str | None:
    """Count what was written or kept for the report; the fault in a line, or None."""
    item, config = request.node, request.config
    if result.written is not None:
        config.stash[_USAGE].written += 1
    elif result.failure is not None:
        config.stash[_ENTRIES].setdefault(item.nodeid, []).append(result.failure)
    if result.fault is None:
        return None
    remedy = f"; see {result.picture}" if result.picture else ""
    remedy += "; accept it with --drapery-update" if result.failure else ""
    return f"golden {label!r}: {result.fault}{remedy}"


def _tolerance(config: pytest.Config, limits: dict[str, Any], hashed: bool) -> "Tolerance":
    """The limits of a golden over those of the project. Raises OptionError."""
    from drapery.comparison import EXACT, read_tolerance
    from drapery.errors import OptionError

    if not limits.keys() <= LIMIT_OPTIONS.keys():
        from drapery.option_checks import unknown_names

        for fault in unknown_names(limits, frozenset(LIMIT_OPTIONS)):
            raise OptionError(fault)
    given = {name: value for name, value in limits.items() if value is not None}
    if hashed:
        if given:
            raise OptionError(f"{min(given)} does nothing for a hashed golden; leave one out")
        return EXACT
    project = {name: config.getini(f"drapery_{name}") for name in LIMIT_OPTIONS}
    project = {name: text for name, text in project.items() if text and name not in given}
    if "mask" in project:
        project["mask"] = config.rootpath / project["mask"]
    try:
        known = read_tolerance(project)
    except OptionError as error:
        raise OptionError(f"drapery_... in pytest's configuration: {error}") from None
    return read_tolerance(project | given) if given else known


def _notes(design: "tuple[Banner, tuple[str | Path, ...]] | None") -> Any:
    if design is None:
        return None
    from drapery.packs import open_packs
    from drapery.testing.explain import layer_notes

    banner, packs = design
    return layer_notes(banner, open_packs(packs))


def _test_name(item: pytest.Item) -> str:
    """The test's classes and name, such as TestBanner.test_red[hero]."""
    chain = [node.name for node in item.listchain() if isinstance(node, pytest.Class)]
    return ".".join([*chain, item.name])


def _forget(config: pytest.Config, test: str) -> None:
    """Remove what the report has of a test."""
    entries = config.stash[_ENTRIES].pop(test, ())
    if not entries:
        return
    from drapery.testing.failures import remove_failure

    folder, _ = _report_places(config)
    for id in entries:
        _tidy(config, partial(remove_failure, folder, id))


def _tidy(config: pytest.Config, remove: Callable[[], None]) -> None:
    """Remove what an earlier run has left; the first failure is a warning."""
    try:
        remove()
    except DraperyError as error:
        if not config.stash.get(_STALE, False):
            config.stash[_STALE] = True
            warning = pytest.PytestWarning(f"{error} with --drapery-report PATH")
            config.issue_config_time_warning(warning, 2)


def pytest_sessionfinish(session: pytest.Session) -> None:
    if _is_worker(session.config):
        output = session.config.workeroutput  # type: ignore[attr-defined]
        output["drapery_goldens"] = session.config.stash[_USAGE].as_dict()


@pytest.hookimpl(optionalhook=True)
def pytest_testnodedown(node: Any) -> None:
    """A worker of pytest-xdist has ended; its output has nothing if it crashed."""
    found = getattr(node, "workeroutput", {}).get("drapery_goldens")
    if found is not None:
        node.config.stash[_USAGE].add(found)


def pytest_terminal_summary(terminalreporter: Any, exitstatus: int, config: pytest.Config) -> None:
    if _is_worker(config):
        return
    usage = config.stash[_USAGE]
    if usage.written:
        terminalreporter.write_line(f"drapery: {counted(usage.written, 'golden')} written")
    _report_unused(terminalreporter, exitstatus, config)
    folder, page = _report_places(config)
    if config.stash.get(_STALE, False) or not folder.is_dir():
        return
    from drapery.testing.failures import write_report

    try:
        page = write_report(folder, page, root=config.invocation_params.dir)
    except DraperyError as error:
        terminalreporter.write_line(f"drapery: {error}")
        return
    if page is not None:
        terminalreporter.write_line(f"drapery: report of the failed pictures: {page}")


def _report_unused(terminalreporter: Any, exitstatus: int, config: pytest.Config) -> None:
    """List the goldens that no test names after a complete run, or delete them."""
    usage, prune = config.stash[_USAGE], config.getoption("--drapery-prune")
    reason = ""
    if exitstatus != pytest.ExitCode.OK:
        reason = "not all tests passed"
    elif config.option.collectonly or not usage.chose_all(config.args):
        reason = "not all tests of the files ran"
    if reason:
        if prune:
            terminalreporter.write_line(f"drapery: no golden is deleted, because {reason}")
        return
    unused = usage.unused()
    if prune:
        for path in unused:
            path.unlink(missing_ok=True)
        terminalreporter.write_line(f"drapery: {counted(len(unused), 'golden')} deleted")
    elif unused:
        verb = "is" if len(unused) == 1 else "are"
        terminalreporter.write_line(
            f"drapery: {counted(len(unused), 'golden')} {verb} named by no test;"
            " delete with --drapery-prune:"
        )
    shown = unused[:_MOST_LISTED]
    for path in shown:
        terminalreporter.write_line(f"  {path}")
    if len(unused) > len(shown):
        terminalreporter.write_line(f"  and {len(unused) - len(shown)} more")


def _is_worker(config: pytest.Config) -> bool:
    return hasattr(config, "workerinput")


def _report_places(config: pytest.Config) -> tuple[Path, Path | None]:
    """The folder of failed pictures, and the page if it is not in that folder."""
    path = config.rootpath / str(config.getoption("--drapery-report"))
    return (path.with_suffix(".files"), path) if path.suffix == ".html" else (path, None)
