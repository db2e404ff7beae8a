"""What all tests share: strict numerics, a real pack, the command line."""

import gc
import os
import signal
import sys
import threading
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from firefox_browser import firefox
from hypothesis import settings
from studio_browser import chromium, compiled_kernels, running_studio, studio
from tracing import PROCESSES, trace_no_compiler
from workers import (
    pytest_cmdline_main,
    pytest_collection_modifyitems,
    pytest_ignore_collect,
    pytest_report_header,
    pytest_sessionstart,
    pytest_xdist_auto_num_workers,
    pytest_xdist_make_scheduler,
)

from drapery import Settings, cli

# For `assets.drawing`, which draws our art and is not installed. Last, so that the installed
# package comes first.
sys.path.append(str(Path(__file__).parents[1]))

# Fixtures and hooks are found by their names here.
__all__ = [
    "chromium",
    "compiled_kernels",
    "firefox",
    "pytest_cmdline_main",
    "pytest_collection_modifyitems",
    "pytest_ignore_collect",
    "pytest_report_header",
    "pytest_sessionstart",
    "pytest_xdist_auto_num_workers",
    "pytest_xdist_make_scheduler",
    "running_studio",
    "studio",
]

# How long one example takes is the machine's business on a shared machine, not the example's.
settings.register_profile("shared machine", deadline=None)
settings.load_profile("shared machine")


def pytest_configure() -> None:
    """A suite that a shell starts in the background ignores SIGINT, and one under nohup SIGHUP; so
    would the programs that tests start and interrupt."""
    trace_no_compiler()
    if threading.current_thread() is not threading.main_thread():
        return
    usual = {"SIGINT": signal.default_int_handler, "SIGHUP": signal.SIG_DFL}
    for name, handler in usual.items():
        number = getattr(signal, name, None)  # Windows has no SIGHUP
        if number is not None and signal.getsignal(number) == signal.SIG_IGN:
            signal.signal(number, handler)


GIVE = (
    '/give @p minecraft:white_banner[banner_patterns=[{pattern:"creeper",color:"lime"},'
    '{pattern:"border",color:"black"}]]'
)
"""A banner as a person copies it out of the game."""


@pytest.fixture(autouse=True)
def strict_numerics() -> None:
    """No test may pass by way of an overflow or an invalid operation."""
    np.seterr(over="raise", divide="raise", invalid="raise", under="ignore")


@pytest.fixture
def untraced_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    """Coverage does not trace the processes that the test starts, whose lines other tests run."""
    monkeypatch.delenv(PROCESSES, raising=False)


@pytest.fixture(scope="session")
def real_pack() -> Path:
    folder = os.environ.get("DRAPERY_TEST_PACKS")
    if not folder:
        pytest.skip("DRAPERY_TEST_PACKS names no folder with real packs")
    pack = Path(folder) / "pixel-perfection-ce"
    if not pack.is_dir():
        pytest.skip(f"no pixel-perfection-ce in {folder}")
    return pack


Run = Callable[..., tuple[int, str, str]]


@pytest.fixture
def drapery(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Run the command line in this process: (exit code, standard output, standard error)."""

    def run(*words: str | Path) -> tuple[int, str, str]:
        monkeypatch.setattr("sys.argv", ["drapery", *map(str, words)])
        thresholds = gc.get_threshold()
        try:
            with pytest.raises(SystemExit) as ended:
                cli.main()
        finally:  # `main` changes both, for a process that ends soon
            gc.set_threshold(*thresholds)
            gc.unfreeze()
        out, err = capsys.readouterr()
        return int(ended.value.code or 0), out, err

    return run


@pytest.fixture(scope="session")
def playable() -> Callable[..., Settings]:
    """Settings that a page can play with the kernels that tests build as WebAssembly."""
    for module in ("ziglang", "wasmtime"):
        pytest.importorskip(module, reason=f"{module} is not installed (drapery-mc[dev])")
    from wasm_player import built_module, quick_settings

    built_module()
    return quick_settings
