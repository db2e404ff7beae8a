"""The viewport: what its event loop and its threads share is neither lost nor waited for."""

import threading
import time
from collections.abc import Iterator

import pytest

from drapery.studio.session import Session


@pytest.fixture
def session() -> Iterator[Session]:
    opened = Session()
    opened.viewport._turn(0)  # makes the live cloth
    yield opened
    opened.close()


def test_a_viewer_does_not_wait_for_a_long_turn(session: Session) -> None:
    """Else it would not see the note which says that the turn is long."""
    viewport, began, end = session.viewport, threading.Event(), threading.Event()
    viewport.do(lambda live: (began.set(), end.wait(20)))
    turn = threading.Thread(target=viewport._turn, args=(0,))
    turn.start()
    assert began.wait(20)
    start = time.monotonic()
    assert viewport.shown() is None and time.monotonic() < start + 5
    end.set()
    turn.join()
    assert viewport.shown() is not None


def test_no_input_is_lost_while_turns_are_made(session: Session) -> None:
    viewport, seen, done = session.viewport, [], threading.Event()

    def turns() -> None:
        while not done.is_set():
            viewport._turn(0)

    thread = threading.Thread(target=turns)
    thread.start()
    for number in range(2000):
        viewport.do(lambda live, number=number: seen.append(number))
    done.set()
    thread.join()
    viewport._turn(0)
    assert seen == [*range(2000)]


def test_no_version_is_counted_twice(session: Session) -> None:
    viewport = session.viewport
    before = viewport.version
    counts = [
        threading.Thread(target=lambda: [viewport._count_change() for _ in range(5000)])
        for _ in range(4)
    ]
    for thread in counts:
        thread.start()
    for thread in counts:
        thread.join()
    assert viewport.version == before + 20_000
