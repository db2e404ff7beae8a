"""Any sequence of requests, hang-ups, killed workers and changed packs leaves right answers."""

import socket
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache
from pathlib import Path
from typing import Any

import httpx2 as httpx
import numpy as np
import psutil
import pytest
from hypothesis import HealthCheck, settings, strategies as st
from hypothesis.stateful import RuleBasedStateMachine, invariant, rule, run_state_machine_as_test
from pack_maker import CREEPER, META, folder_pack, mcmeta, plain
from served_pictures import pixels_of
from service_process import service, workers_of

from drapery import Banner, draw

OPTIONS: dict[str, Any] = {"size": (24, 32), "grid": (3, 5), "time": 0.1}
ADDRESS = "/banner.png?size=24x32&grid=3x5&time=0.1"
DEADLINE = 20.0
DESIGNS = st.sampled_from(["red", "white creeper:lime", "blue creeper:white border:black"])
SEEDS = st.integers(0, 3)
WRONG = st.sampled_from(["design=purpel", "design=red&size=0x0", "design=red&sed=1", "x" * 40_000])
PACK = {META: mcmeta(), CREEPER: plain(255, 255, 255, 255)}


class ServeMachine(RuleBasedStateMachine):
    """One service whose pack has a creeper of its own, and its clients."""

    base = ""
    process: Any = None
    client = httpx.Client(timeout=2 * DEADLINE, trust_env=False)
    pack = Path()
    tags: dict[tuple[str, int], str] = {}  # noqa: RUF012 (shared by all runs, as the service is)

    def __init__(self) -> None:
        super().__init__()
        self.silent: list[socket.socket] = []

    def teardown(self) -> None:
        """The service draws every picture once it is left alone."""
        for client in self.silent:
            client.close()
        end = time.monotonic() + DEADLINE
        while not self.ask_right("red", 9):
            assert time.monotonic() < end, "the service does not recover"

    def ask_right(self, design: str, seed: int) -> bool:
        """Whether the picture came; another answer must be an error that states its reason."""
        start = time.monotonic()
        answer = self.client.get(
            f"{self.base}{ADDRESS}&seed={seed}&design={design.replace(' ', '+')}"
        )
        assert time.monotonic() - start < DEADLINE + 2
        if answer.status_code == 200:
            assert np.array_equal(pixels_of(answer), self.expected(design, seed))
            self.tags[design, seed] = answer.headers["etag"]
            return True
        assert answer.status_code in (503, 504)
        assert answer.json()["detail"][0] and answer.headers["cache-control"] == "no-store"
        return False

    @classmethod
    @cache
    def expected(cls, design: str, seed: int) -> np.ndarray:
        """The picture with the pack as it was when the service started."""
        pack = cls.pack.with_name("unchanged")
        return draw(Banner.parse(design), packs=[pack], seed=seed, **OPTIONS).pixels

    @rule(design=DESIGNS, seed=SEEDS)
    def ask(self, design: str, seed: int) -> None:
        """One client waits for its picture."""
        self.ask_right(design, seed)

    @rule(design=DESIGNS, count=st.integers(2, 6))
    def ask_together(self, design: str, count: int) -> None:
        """Many clients ask at once, some for the same picture."""
        with ThreadPoolExecutor(count) as threads:
            list(threads.map(lambda number: self.ask_right(design, number % 3), range(count)))

    @rule(wrong=WRONG)
    def ask_wrongly(self, wrong: str) -> None:
        """A wrong address is refused with its reason."""
        answer = self.client.get(f"{self.base}/banner.png?{wrong}")
        assert answer.status_code in (414, 422) and answer.json()["detail"][0]

    @rule()
    def ask_again(self) -> None:
        """A picture that the client has is not sent again, whatever happened since."""
        for (design, seed), tag in list(self.tags.items())[:2]:
            url = f"{self.base}{ADDRESS}&seed={seed}&design={design.replace(' ', '+')}"
            assert self.client.get(url, headers={"if-none-match": tag}).status_code == 304

    @rule(design=DESIGNS, half=st.booleans())
    def hang_up(self, design: str, half: bool) -> None:
        """A client leaves after its request, or does not complete it."""
        host, port = self.base.removeprefix("http://").split(":")
        client = socket.create_connection((host, int(port)), timeout=5)
        head = f"GET {ADDRESS}&seed=7&design={design.split()[0]} HTTP/1.1\r\nHost: x\r\n"
        client.sendall(head.encode() + (b"" if half else b"\r\n"))
        self.silent.append(client)
        if not half:
            client.close()

    @rule(design=DESIGNS, seed=SEEDS)
    def kill(self, design: str, seed: int) -> None:
        """The system kills the worker, and a client asks at once."""
        for worker in workers_of(self.process):
            with suppress(psutil.NoSuchProcess):
                worker.kill()
        self.ask_right(design, seed)

    @rule(red=st.integers(0, 255), seed=SEEDS)
    def change_pack(self, red: int, seed: int) -> None:
        """The pack is edited; the service goes on with the one that it was started with."""
        folder_pack(self.pack, {CREEPER: plain(red, 0, 0, 255)})
        self.ask_right("white creeper:lime", seed)

    @invariant()
    def is_alive(self) -> None:
        """Health and metrics answer, and the process lives."""
        assert self.process.poll() is None
        assert self.client.get(f"{self.base}/healthz").status_code == 200
        assert "drapery_requests_total" in self.client.get(f"{self.base}/metrics").text


# The pack has one pattern only, which each picture says that is drawn here to compare.
@pytest.mark.filterwarnings("ignore:not in .*, taken from our own art")
@pytest.mark.filterwarnings("ignore:no texture comes from")
@pytest.mark.slow
def test_every_answer_is_right_or_states_its_reason() -> None:
    draw(Banner("red"), **OPTIONS)  # the worker finds the kernels in the cache
    with tempfile.TemporaryDirectory() as folder:
        pack, _ = (folder_pack(Path(folder, name), PACK) for name in ("pack", "unchanged"))
        words = ["--pack", str(pack), "--rate", "0", "--deadline", f"{DEADLINE:g}"]
        with service(*words) as (base, process):
            ServeMachine.base, ServeMachine.process, ServeMachine.pack = base, process, pack
            run_state_machine_as_test(
                ServeMachine,
                settings=settings(
                    max_examples=2,
                    stateful_step_count=12,
                    deadline=None,
                    derandomize=True,
                    database=None,
                    suppress_health_check=list(HealthCheck),
                ),
            )
