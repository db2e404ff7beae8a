"""Make the package for conda of a plain wheel: `python -m release.conda FILE.whl [-o dist]`.

`drapery-mc-VERSION-py_0.conda` is a package `noarch: python`: it holds the files of the wheel, and
the installer makes the commands and compiles the modules for its Python. Name, version, licence and
dependencies are those of the wheel, which has them from pyproject.toml; conda gives these packages
the same names. The bytes are the same on every run with the same Python, as those of
`release.build`. It needs no recipe and no channel; a feedstock of conda-forge would need a recipe,
which `grayskull` makes of the source archive.
"""

import argparse
import hashlib
import io
import json
import tarfile
import zipfile
from collections.abc import Mapping, Sequence
from configparser import ConfigParser
from email import message_from_bytes
from email.message import Message
from pathlib import Path

from conda_package_streaming.create import conda_builder
from packaging.requirements import Requirement

from release.build import epoch

BUILD = "py_0"
"""What conda calls the first build of a version for any Python."""
LICENSES = "licenses/"


def build(wheel: Path, out: Path) -> Path:
    """Write the package into a folder; returns the file.

    Raises SystemExit where the wheel holds what a package for any platform cannot hold.
    """
    with zipfile.ZipFile(wheel) as archive:
        files = {name: archive.read(name) for name in sorted(archive.namelist())}
    if not wheel.name.endswith("-none-any.whl") or any(".data/" in name for name in files):
        raise SystemExit(f"{wheel.name} is no plain wheel; give one of py3-none-any")
    installed = {f"site-packages/{name}": content for name, content in files.items()}
    info = description(files)
    info |= {
        "files": "".join(f"{name}\n" for name in installed).encode(),
        "paths.json": written(
            {"paths": [*map(entry, installed, installed.values())], "paths_version": 1}
        ),
    }
    index = json.loads(info["index.json"])
    stem = f"{index['name']}-{index['version']}-{BUILD}"
    out.mkdir(parents=True, exist_ok=True)
    made = out / f"{stem}.conda"
    made.unlink(missing_ok=True)
    with conda_builder(stem, out, compression_threads=0) as package:
        for name, content in (installed | {f"info/{name}": info[name] for name in info}).items():
            member = tarfile.TarInfo(name)
            member.size, member.mtime = len(content), epoch()
            package.addfile(member, io.BytesIO(content))
    set_times(made)
    return made


def description(files: Mapping[str, bytes]) -> dict[str, bytes]:
    """The files of info/ that say what a wheel with these files is, and its licences."""
    (found,) = (name for name in files if name.endswith(".dist-info/METADATA"))
    folder = found.removesuffix("METADATA")
    metadata = message_from_bytes(files[found])
    commands = ConfigParser(delimiters=("=",))
    commands.optionxform = str  # type: ignore[assignment,method-assign]
    commands.read_string(files[f"{folder}entry_points.txt"].decode())
    entry_points = [" = ".join(each) for each in commands["console_scripts"].items()]
    index = {
        "arch": None,
        "build": BUILD,
        "build_number": 0,
        "depends": dependencies(metadata),
        "license": metadata["License-Expression"],
        "name": metadata["Name"],
        "noarch": "python",
        "platform": None,
        "subdir": "noarch",
        "timestamp": epoch() * 1000,
        "version": metadata["Version"],
    }
    about = {"license": metadata["License-Expression"], "summary": metadata["Summary"]}
    for line in metadata.get_all("Project-URL", []):
        kind, _, address = line.partition(", ")
        if kind == "Homepage":
            about["home"] = address
    noarch = {"type": "python", "entry_points": entry_points}
    described = {
        "about.json": written(about),
        "index.json": written(index),
        "link.json": written({"noarch": noarch, "package_metadata_version": 1}),
    }
    for name, content in files.items():
        if name.startswith(folder + LICENSES):
            described[name.removeprefix(folder)] = content
    return described


def dependencies(metadata: Message) -> list[str]:
    """What a wheel with this metadata needs without extras, as conda writes it.

    Raises SystemExit where a dependency is not the same on every platform.
    """
    needed = [f"python {metadata['Requires-Python']}"]
    for each in map(Requirement, metadata.get_all("Requires-Dist", [])):
        if each.marker and "extra ==" in str(each.marker):
            continue
        if each.marker or each.extras or each.url:
            raise SystemExit(f"a package for any platform cannot need {each}")
        needed.append(f"{each.name} {each.specifier}".strip())
    return needed


def entry(name: str, content: bytes) -> dict[str, str | int]:
    """What info/paths.json says of a file."""
    digest = hashlib.sha256(content).hexdigest()
    size = len(content)
    return {"_path": name, "path_type": "hardlink", "sha256": digest, "size_in_bytes": size}


def written(value: Mapping[str, object]) -> bytes:
    """A value as a file of JSON."""
    return (json.dumps(value, indent=2, sort_keys=True) + "\n").encode()


def set_times(path: Path) -> None:
    """Write a zip archive again with the first time of the format: the writer takes the clock's."""
    with zipfile.ZipFile(path) as archive:
        members = {name: archive.read(name) for name in archive.namelist()}
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in members.items():
            archive.writestr(zipfile.ZipInfo(name), content)


def main(words: Sequence[str] | None = None) -> None:
    """The command."""
    parser = argparse.ArgumentParser("python -m release.conda", description=__doc__)
    parser.add_argument("wheel", type=Path)
    parser.add_argument("-o", "--out", type=Path, default=Path("dist"))
    given = parser.parse_args(words)
    made = build(given.wheel, given.out)
    print(f"{made}: {made.stat().st_size} bytes")


if __name__ == "__main__":
    main()
