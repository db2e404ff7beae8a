"""The service as a process that is attacked: silent clients, killed workers, SIGTERM."""

import re
import signal
import socket
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

import httpx2 as httpx
import psutil
import pytest
from service_process import service, workers_of

from drapery.errors import OptionError, OutputError
from drapery.serve import server
from drapery.serve.server import address_of, check_proxies, listen, make_server

SMALL = "design=red&size=24x32&grid=3x5&time=0.1"
SLOW = "size=256x256&grid=33x33&seconds=2&fps=20"


def get(url: str, timeout: float = 30, **more: Any) -> httpx.Response:
    return httpx.get(url, timeout=timeout, trust_env=False, **more)


@pytest.mark.usefixtures("untraced_processes")
@pytest.mark.slow
def test_a_service_whose_workers_die_says_so_recovers_and_ends() -> None:
    with service("--deadline", "3", "--rate", "0") as (base, process):
        # The first picture of a worker loads the kernels.
        _wait_until(lambda: get(f"{base}/banner.png?{SMALL}").status_code == 200, 60)
        assert get(f"{base}/readyz").status_code == 200
        stop = threading.Event()
        killer = threading.Thread(target=_kill_all, args=(process, stop))
        killer.start()
        _wait_until(lambda: get(f"{base}/readyz").status_code == 503)
        start = time.monotonic()
        answer = get(f"{base}/banner.png?{SMALL}&seed=1")
        assert time.monotonic() - start < 20
        assert answer.status_code == 503
        assert "ask again" in answer.json()["detail"][0]
        assert get(f"{base}/banner.png?{SMALL}").status_code == 200, "it was drawn before"
        assert get(f"{base}/healthz").status_code == 200
        assert "drapery_ready 0.0" in get(f"{base}/metrics").text
        time.sleep(1)
        stop.set()
        killer.join()
        _wait_until(lambda: get(f"{base}/readyz").status_code == 200, 60)
        _wait_until(lambda: get(f"{base}/banner.png?{SMALL}&seed=1").status_code == 200)


@pytest.mark.usefixtures("untraced_processes")
def test_sigterm_ends_a_service_whose_workers_die_and_whose_clients_wait() -> None:
    with service("--deadline", "60", "--rate", "0") as (base, process):
        get(f"{base}/banner.png?{SMALL}")
        stop = threading.Event()
        killer = threading.Thread(target=_kill_all, args=(process, stop))
        killer.start()
        clients = [_ask(base, f"/banner.gif?design=red&{SLOW}&seed={n}") for n in range(5)]
        time.sleep(1)
        try:
            process.send_signal(signal.SIGTERM)
            process.wait(10)
        finally:
            stop.set()
            killer.join()
            for client in clients:
                client.close()


@pytest.mark.slow
def test_sigterm_ends_a_service_in_work_and_leaves_no_process() -> None:
    with service("--rate", "0") as (base, process):
        get(f"{base}/banner.png?{SMALL}")
        clients = [_ask(base, f"/banner.gif?design=red&{SLOW}&seed={n}") for n in range(5)]
        time.sleep(0.5)
        workers = workers_of(process)
        assert workers
        process.send_signal(signal.SIGTERM)
        process.wait(10)
        psutil.wait_procs(workers, 5)
        assert not any(worker.is_running() for worker in workers)
        for client in clients:
            client.close()


def test_clients_that_hang_up_do_not_hold_the_queue() -> None:
    with service("--rate", "0") as (base, process):
        assert get(f"{base}/banner.png?{SMALL}").status_code == 200
        clients = [_ask(base, f"/banner.gif?design=red&{SLOW}&seed={n}") for n in range(60)]
        _wait_until(lambda: _waiting(base) > 30)
        for client in clients:
            client.close()
        _wait_until(lambda: _waiting(base) <= 1)
        assert get(f"{base}/banner.png?{SMALL}&seed=2").status_code == 200
        assert process.poll() is None


def test_an_answer_has_a_deadline() -> None:
    with service("--deadline", "0.5", "--rate", "0") as (base, _):
        answers = [
            _ask(base, f"/banner.gif?design=red&{SLOW}&seconds=3&seed={n}") for n in range(3)
        ]
        got = get(f"{base}/banner.gif?design=red&{SLOW}&seed=9")
        assert got.status_code in (503, 504)
        assert "0.5 s" in got.text or "no worker" in got.text
        for client in answers:
            client.close()


def _ask(base: str, path: str) -> socket.socket:
    """A client that sends a request and does not read the answer."""
    host, port = base.removeprefix("http://").split(":")
    client = socket.create_connection((host, int(port)))
    client.sendall(f"GET {path} HTTP/1.1\r\nHost: {host}\r\n\r\n".encode())
    return client


def _waiting(base: str) -> float:
    found = re.search(r"^drapery_waiting (\S+)$", get(f"{base}/metrics").text, re.MULTILINE)
    assert found
    return float(found[1])


def _kill_all(process: subprocess.Popen[str], stop: threading.Event) -> None:
    while not stop.is_set():
        for worker in workers_of(process):
            with suppress(psutil.NoSuchProcess):
                worker.kill()
        time.sleep(0.05)


def _wait_until(condition: Callable[[], bool], seconds: float = 20) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


async def echo(scope: dict[str, Any], receive: Any, send: Any) -> None:
    """An application that answers with the client's address."""
    if scope["type"] != "http":
        return
    await send({"type": "http.response.start", "status": 200, "headers": []})
    await send({"type": "http.response.body", "body": scope["client"][0].encode()})


@contextmanager
def running(*proxies: str, app: Any = echo) -> Iterator[tuple[str, Any]]:
    """The server in this process with an application, and its address."""
    listening = listen("127.0.0.1", 0)
    base, one = address_of(listening), make_server(app, proxies)
    one.config.lifespan = "off"
    thread = threading.Thread(target=one.run, args=([listening],))
    thread.start()
    try:
        _wait_until(lambda: one.started)
        yield base, one
    finally:
        one.should_exit = True
        thread.join(10)
        assert not thread.is_alive()


@pytest.mark.parametrize(
    ("proxies", "client"),
    [((), "127.0.0.1"), (("10.0.0.0/8",), "127.0.0.1"), (("127.0.0.1",), "203.0.113.7")],
)
def test_only_named_proxies_may_name_the_client(proxies: tuple[str, ...], client: str) -> None:
    with running(*proxies) as (base, _):
        got = get(base, headers={"X-Forwarded-For": "203.0.113.7"})
        assert got.text == client


def test_the_environment_does_not_name_proxies(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FORWARDED_ALLOW_IPS", "*")
    with running() as (base, _):
        assert get(base, headers={"X-Forwarded-For": "203.0.113.7"}).text == "127.0.0.1"


@pytest.mark.parametrize("text", ["*", "", "localhost", "10.0.0.1/8", "1.2.3", "a" * 5000])
def test_a_proxy_that_is_not_an_address_is_refused(text: str) -> None:
    with pytest.raises(OptionError, match=r"write 10\.0\.0\.1") as caught:
        check_proxies([text])
    assert len(str(caught.value)) < 200


def test_silent_connections_are_closed_and_others_answered(monkeypatch) -> None:
    monkeypatch.setattr(server, "HEAD_TIMEOUT", 0.7)
    with running() as (base, one):
        host, port = base.removeprefix("http://").split(":")
        silent = [socket.create_connection((host, int(port))) for _ in range(40)]
        half = [socket.create_connection((host, int(port))) for _ in range(40)]
        again = _ask(base, "/")
        assert b"200 OK" in again.recv(1000)
        for client in (*half, again):
            client.sendall(b"GET / HTTP/1.1\r\nHost:")
        for _ in range(3):
            assert get(base).status_code == 200
            for client in half:
                with suppress(OSError):
                    client.sendall(b" x")
            time.sleep(0.3)
        _wait_until(lambda: not one.server_state.connections)
        for client in (*silent, *half, again):
            client.close()


def test_clients_that_do_not_read_are_closed(monkeypatch: pytest.MonkeyPatch) -> None:
    async def long_answer(scope: Any, receive: Any, send: Any) -> None:
        await send({"type": "http.response.start", "status": 200, "headers": []})
        for _ in range(64):
            await send({"type": "http.response.body", "body": bytes(1 << 20), "more_body": True})
        await send({"type": "http.response.body", "body": b""})

    monkeypatch.setattr(server, "SEND_TIMEOUT", 0.7)
    with running(app=long_answer) as (base, one):
        deaf = [_ask(base, "/") for _ in range(10)]
        assert len(get(base).content) == 64 << 20
        _wait_until(lambda: not one.server_state.connections)
        for client in deaf:
            client.close()


@pytest.mark.parametrize("name", ["MAX_CONNECTIONS", "MAX_CONNECTIONS_OF_CLIENT"])
def test_connections_have_a_largest_number(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(server, name, 10)
    with running() as (base, one):
        host, port = base.removeprefix("http://").split(":")
        clients = [socket.create_connection((host, int(port))) for _ in range(30)]
        _wait_until(lambda: len(one.server_state.connections) == 10)
        for client in clients:
            client.close()
        _wait_until(lambda: not one.server_state.connections)
        assert get(base).status_code == 200


def test_a_head_has_a_longest_length() -> None:
    with running() as (base, one):
        host, port = base.removeprefix("http://").split(":")
        client = socket.create_connection((host, int(port)))
        with suppress(OSError):
            client.sendall(b"GET / HTTP/1.1\r\nX: " + b"x" * (4 * server.MAX_HEAD))
        _wait_until(lambda: not one.server_state.connections)
        client.close()


def test_a_port_in_use_and_a_host_that_is_none_are_named() -> None:
    with listen("127.0.0.1", 0) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(
            OutputError, match=f"cannot listen at 127.0.0.1:{port}: .*choose another"
        ):
            listen("127.0.0.1", port)
    for host in ("256.1.1.1", "no such host", "a" * 300):
        with pytest.raises(OutputError, match="cannot listen at"):
            listen(host, 0)
