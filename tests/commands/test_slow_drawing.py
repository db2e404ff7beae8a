"""What takes long says so on a terminal."""

import io
import sys
import threading

import pytest

from drapery.commands import notices


class Terminal(io.StringIO):
    """A stream of text that passes for a terminal, and tells when something was written to it."""

    def __init__(self, is_terminal: bool = True) -> None:
        super().__init__()
        self.is_terminal, self.told = is_terminal, threading.Event()

    def isatty(self) -> bool:
        return self.is_terminal

    def write(self, text: str) -> int:
        written = super().write(text)
        if "drawing ..." in self.getvalue():
            self.told.set()
        return written


def test_a_picture_that_takes_long_says_so_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(notices, "SLOW", 0.0)
    monkeypatch.setattr(sys, "stderr", terminal)
    with notices.drawing():
        terminal.told.wait()
    assert "0:00:00" in terminal.getvalue()


@pytest.mark.parametrize(("slow", "is_terminal"), [(0.0, False), (1e6, True)])
def test_it_says_nothing_elsewhere_or_before(
    slow: float, is_terminal: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    stream, before = Terminal(is_terminal), set(threading.enumerate())
    monkeypatch.setattr(notices, "SLOW", slow)
    monkeypatch.setattr(sys, "stderr", stream)
    with notices.drawing():
        pass
    assert stream.getvalue() == ""
    # A thread that another test left may end meanwhile.
    assert set(threading.enumerate()) <= before
