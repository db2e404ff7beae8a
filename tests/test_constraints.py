"""The files of tested versions fit pyproject.toml, and what installs for the tests uses them."""

import re
import tomllib
from pathlib import Path

import pytest
from packaging.markers import default_environment
from packaging.requirements import Requirement
from packaging.specifiers import SpecifierSet
from packaging.utils import canonicalize_name
from packaging.version import Version

ROOT = Path(__file__).parent.parent
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
PROJECT = PYPROJECT["project"]
EXTRAS = PROJECT["optional-dependencies"]
RENEW = "write both files anew with `.ci/versions pin`"

PYTHONS = [
    word.rpartition(" ")[2]
    for word in PROJECT["classifiers"]
    if re.search(r"Python :: 3\.\d", word)
]
SYSTEMS = [
    {"sys_platform": "linux", "os_name": "posix", "platform_system": "Linux"},
    {"sys_platform": "darwin", "os_name": "posix", "platform_system": "Darwin"},
    {"sys_platform": "win32", "os_name": "nt", "platform_system": "Windows"},
]


def pins(name: str) -> list[Requirement]:
    lines = (ROOT / name).read_text("utf-8").splitlines()
    return [Requirement(line) for line in lines if not line.startswith("#")]


def needed(*extras: str) -> list[Requirement]:
    """What the package needs with these extras, and with those that they name."""
    found = [*PROJECT["dependencies"], *(line for extra in extras for line in EXTRAS[extra])]
    wanted = []
    for requirement in map(Requirement, found):
        if requirement.name == PROJECT["name"]:
            wanted += needed(*requirement.extras)
        else:
            wanted.append(requirement)
    return wanted


def applies(requirement: Requirement, environment: dict[str, str]) -> bool:
    return requirement.marker is None or requirement.marker.evaluate(environment)


@pytest.mark.parametrize("system", SYSTEMS, ids=lambda system: system["sys_platform"])
@pytest.mark.parametrize("python", PYTHONS)
def test_each_requirement_has_one_pin_within_its_bounds(
    python: str, system: dict[str, str]
) -> None:
    environment = dict(default_environment()) | system
    environment |= {"python_version": python, "python_full_version": f"{python}.9", "extra": ""}
    pinned = {
        canonicalize_name(each.name): each
        for each in pins("constraints.txt")
        if applies(each, environment)
    }
    assert len(pinned) == sum(applies(each, environment) for each in pins("constraints.txt"))
    for requirement in needed("dev", "docs", "release"):
        if applies(requirement, environment):
            pin = pinned.get(canonicalize_name(requirement.name))
            assert pin is not None, f"{requirement.name} has no pin; {RENEW}"
            (version,) = (each.version for each in pin.specifier)
            assert requirement.specifier.contains(version), f"{requirement}: {pin}; {RENEW}"


def test_the_build_takes_the_version_of_setuptools_that_is_pinned() -> None:
    (build,) = map(Requirement, PYPROJECT["build-system"]["requires"])
    (pin,) = (each for each in pins("constraints.txt") if each.name == build.name)
    (version,) = (each.version for each in pin.specifier)
    assert build.specifier.contains(version)
    # pip gives constraints to no build, so that the next major version would be taken unseen.
    assert not build.specifier.contains(f"{Version(version).major + 1}")


def test_the_lowest_versions_are_those_of_pyproject() -> None:
    extras = re.search(r'^extras="(.+)"$', (ROOT / ".ci/versions").read_text("utf-8"), re.M)
    assert extras
    lowest = {canonicalize_name(each.name): each.specifier for each in pins(".ci/lowest.txt")}
    for requirement in needed(*extras[1].split(",")):
        least = SpecifierSet(str(lowest[canonicalize_name(requirement.name)]))
        (version,) = (each.version for each in least)
        (bound,) = (each.version for each in requirement.specifier if each.operator == ">=")
        assert requirement.specifier.contains(version)
        # The lowest one that is there as a wheel may be a later one of the same series.
        series = (*Version(bound).release, 0)[:2]
        assert Version(version).release[:2] == series, f"{requirement}: {version}; {RENEW}"


@pytest.mark.parametrize("name", ["constraints.txt", ".ci/lowest.txt"])
def test_pins_are_plain(name: str) -> None:
    """One version each, from any registry: pip and uv read them."""
    text = (ROOT / name).read_text("utf-8")
    assert "://" not in text and "\n-" not in text
    for pin in pins(name):
        assert [each.operator for each in pin.specifier] == ["=="] and not pin.url


def test_all_that_installs_from_the_checkout_to_test_it_uses_the_pins() -> None:
    places = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", ROOT / ".ci/run"]
    places += [ROOT / ".devcontainer/devcontainer.json", *ROOT.glob(".github/workflows/*.yml")]
    lines = [
        (place.name, line.strip())
        for place in places
        for line in place.read_text("utf-8").replace("\\\n", " ").splitlines()
        if re.search(r"pip install.* (-e|--editable) ", line)
    ]
    assert len(lines) > 6
    assert [each for each in lines if "-c constraints.txt" not in each[1]] == []
