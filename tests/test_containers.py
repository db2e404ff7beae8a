"""The files for containers: their commands, ports, paths and checks are those of the program.

No container is built or run here.
"""

import ipaddress
import json
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
import yaml
from docs_blocks import check_command

from drapery.serve.app import make_app
from drapery.studio.guard import HEALTH

ROOT = Path(__file__).parent.parent
COMPOSE: dict[str, Any] = yaml.safe_load((ROOT / "release/compose.yaml").read_text("utf-8"))
SERVICES = {name: each for name, each in COMPOSE["services"].items() if "command" in each}
FILE = (ROOT / "release/Containerfile").read_text("utf-8")
(PORT,) = re.findall(r"(?m)^EXPOSE (\d+)$", FILE)


def typed(command: str) -> str:
    """A command as the container runs it, with a token in place of the variable."""
    return f"drapery {re.sub(r'[$][{]DRAPERY_TOKEN:[^}]*[}]', 'password', command)}"


def test_the_container_serves_where_its_check_asks() -> None:
    (words,) = re.findall(r"(?m)^CMD (\[.*\])$", FILE)
    command = typed(" ".join(json.loads(words)))
    check_command(command)
    assert f"--host 0.0.0.0 --port {PORT}" in command
    (asked,) = re.findall(rf"http://127\.0\.0\.1:{PORT}(/\w+)'", FILE)
    assert asked == HEALTH
    assert asked in {getattr(route, "path", "") for route in make_app(workers=1).routes}


def test_the_container_copies_nothing_that_git_ignores() -> None:
    """`COPY . .` would take the history, modules of npm and kernels of another processor."""
    lines = (ROOT / ".dockerignore").read_text("utf-8").splitlines()
    left_out = {line.removeprefix("**/") for line in lines if not line.startswith("#")}
    ignored = (ROOT / ".gitignore").read_text("utf-8").split()
    assert {".git", *(line.strip("/") for line in ignored)} <= left_out


def test_docker_builds_without_the_option_of_podman() -> None:
    """docker has no `--format`; podman keeps the health check only with it."""
    page = (ROOT / "docs/guides/wikis-and-bots.md").read_text("utf-8")
    built = re.findall(r"(?m)^(podman|docker) build (.*)-f release/Containerfile ", page)
    assert built == [("podman", "--format docker "), ("docker", "")]


def test_the_container_installs_extras_that_there_are() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    (extras,) = re.findall(r'"\.\[([\w,]+)\]"', FILE)
    assert {"serve", "studio"} <= set(extras.split(",")) <= set(project["optional-dependencies"])


@pytest.mark.parametrize("name", SERVICES)
def test_a_service_runs_a_command_of_the_program(name: str) -> None:
    service = SERVICES[name]
    check_command(typed(service["command"]))
    assert f"--host 0.0.0.0 --port {PORT} " in service["command"]
    assert service["read_only"] and service["tmpfs"] == "/tmp" and service["image"] == "drapery"


def test_the_library_lies_in_a_volume_that_the_user_may_write() -> None:
    (volume,) = SERVICES["studio"]["volumes"]
    source, folder = volume.split(":")
    assert source in COMPOSE["volumes"]
    assert f"--library {folder}/" in SERVICES["studio"]["command"]
    (user,) = re.findall(r"(?m)^USER (.*)$", FILE)
    assert f"chown {user} {folder}\n" in FILE


def test_the_proxy_leads_to_each_service() -> None:
    text = COMPOSE["configs"]["caddy"]["content"]
    led = re.findall(r"handle_path /(\w+)/\* \{\s+reverse_proxy (\w+):(\d+)", text)
    assert sorted(led) == sorted((name, name, PORT) for name in SERVICES)
    assert set(COMPOSE["services"]["proxy"]["depends_on"]) == set(SERVICES)
    assert "header_up X-Forwarded-Prefix /studio\n" in text, "the studio's pages name their prefix"
    (opened,) = COMPOSE["services"]["proxy"]["ports"]
    assert text.startswith(f":{opened.split(':')[1]} {{")


def test_the_service_trusts_the_network_of_the_proxy_alone() -> None:
    (network,) = COMPOSE["networks"]["default"]["ipam"]["config"]
    command = SERVICES["pictures"]["command"]
    (trusted,) = re.findall(r"--trusted-proxy (\S+)", command)
    assert ipaddress.ip_network(trusted) == ipaddress.ip_network(network["subnet"])
    assert "--workers 2 " in command
