"""How `pytest` spreads the whole suite over processes; `conftest.py` has these hooks.

A run of single files, or of tests chosen by name, needs no other process; `-m quick` takes two, and
`-n` says another number. Tests of pages run apart, with `-m page`, and so do slow ones, with
`-m slow`: browsers, WebAssembly and one test in three hundred take two fifths of the time.
"""

import os
from pathlib import Path

import pytest
from compile_kernels import compile_all

FOR_PAGES = {"chromium", "firefox", "playable"}
"""The fixtures of browsers and of WebAssembly; a test that takes one is marked `page`."""
APART = ("page", "slow")
"""The marks of tests that a run of the whole suite leaves out."""
PAGES = "test_studio_page"
"""The studio's tests in a browser wait for it and for a server, with deadlines: one worker runs
them all, one after another."""
QUICK = "quick"
"""With `-m quick`, the one picture and its kernels are made beside all other tests."""
LONGEST = (
    *("test_default_picture", "test_cloth_bounds", "test_testing_outside", "test_batch_run"),
    *("test_batch_server", "test_cloth_bending", "test_render_soft", "test_typing"),
)
"""Files that begin so come first, so that no worker is alone with them at the end."""
MOST = 8
"""The most workers by default."""


@pytest.hookimpl(tryfirst=True)
def pytest_cmdline_main(config: pytest.Config) -> None:
    """Before pytest-xdist reads its options, say what they are by default."""
    option = config.option
    if not config.pluginmanager.hasplugin("xdist") or is_worker(config):
        return
    # pytest-cov has read its options already: without -n it measures this process alone.
    if option.numprocesses is None and not getattr(option, "cov_source", None):
        if is_whole(config):
            option.numprocesses = "auto"  # with --pdb, pytest-xdist takes none
        elif option.markexpr == QUICK:
            option.numprocesses = 2  # one waits for the kernels of the picture
    if option.dist == "no":
        option.dist = "loadfile"
    option.loadscopereorder = False


def is_worker(config: pytest.Config) -> bool:
    """Whether this process is a worker, which reads the same options and starts none."""
    return hasattr(config, "workerinput") or "PYTEST_XDIST_WORKER" in os.environ


def is_whole(config: pytest.Config) -> bool:
    """Whether folders are run, and all of their tests."""
    option = config.option
    chosen = ("keyword", "markexpr", "lf", "stepwise", "collectonly")
    if any(getattr(option, name, None) for name in chosen):
        return False
    return all(Path(word).is_dir() for word in config.args)


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """With `-m quick`, import only the files that have such tests: all take half a minute."""
    if config.option.markexpr != QUICK or collection_path.suffix != ".py":
        return None
    return "mark.quick" not in collection_path.read_text(encoding="utf-8") or None


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_auto_num_workers() -> int | None:
    """One more than processors, because tests often wait for other processes."""
    if "PYTEST_XDIST_AUTO_NUM_WORKERS" in os.environ:
        return None
    return min((os.cpu_count() or 1) + 1, MOST)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> object:
    """As `--dist loadfile`, but all files of the page's tests go to one worker."""
    if config.option.dist != "loadfile":
        return None
    from xdist.scheduler import LoadFileScheduling

    class Files(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            file = nodeid.partition("::")[0]
            return PAGES if Path(file).name.startswith(PAGES) else file

    return Files(config, log)


def pytest_report_header(config: pytest.Config) -> list[str] | None:
    if not is_whole(config):
        return None
    lines = [f"without the tests that `pytest -m {name}` runs" for name in APART]
    if not config.pluginmanager.hasplugin("xdist"):
        lines.append('one by one, without pytest-xdist; `pip install -e ".[dev]"` installs it')
    return lines


@pytest.hookimpl(tryfirst=True)
def pytest_sessionstart(session: pytest.Session) -> None:
    """Compile kernels once, before pytest-xdist starts workers that would each do it. A part of the
    tests compiles what it needs."""
    config = session.config
    if getattr(config.option, "tx", None) and is_whole(config) and not is_worker(config):
        compile_all()


@pytest.hookimpl(tryfirst=True)  # before `-m` chooses
def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Mark tests of pages, leave what runs apart out of a whole run, and begin with long files."""
    for item in items:
        if FOR_PAGES.intersection(getattr(item, "fixturenames", ())):
            item.add_marker("page")
    if is_whole(config):
        apart = [item for item in items if any(map(item.get_closest_marker, APART))]
        config.hook.pytest_deselected(items=apart)
        left_out = set(apart)
        items[:] = [item for item in items if item not in left_out]

    def place(item: pytest.Item) -> int:
        starts = (number for number, name in enumerate(LONGEST) if item.path.name.startswith(name))
        return next(starts, len(LONGEST))

    items.sort(key=place)
