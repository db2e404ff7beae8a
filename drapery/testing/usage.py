"""Which goldens the tests of a run name, and which goldens no test names."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from drapery.testing.naming import ENDINGS, FOLDER, may_belong, without_variant


@dataclass
class GoldenUsage:
    """What the tests of a run did with goldens.

    collected: the number of tests that were found, before any was left out.
    tests: file and name of each test that was to run, by its id. passed: the ids of those that did.
    named: the paths of the goldens that tests named. written: the number of goldens written.
    """

    collected: int = 0
    tests: dict[str, tuple[str, str]] = field(default_factory=dict)
    passed: set[str] = field(default_factory=set)
    named: set[str] = field(default_factory=set)
    written: int = 0

    def as_dict(self) -> dict[str, Any]:
        """The record in types that a worker of pytest-xdist can send."""
        return {
            "collected": self.collected,
            "tests": self.tests,
            "passed": sorted(self.passed),
            "named": sorted(self.named),
            "written": self.written,
        }

    def add(self, other: Mapping[str, Any]) -> None:
        """Add the record of a worker; each worker collects all tests and runs a part of them."""
        self.collected = max(self.collected, other["collected"])
        self.tests |= other["tests"]
        self.passed.update(other["passed"])
        self.named.update(other["named"])
        self.written += other["written"]

    def chose_all(self, args: Sequence[str]) -> bool:
        """Whether all tests of each file were to run.

        args: the files, folders and tests that pytest was given.
        """
        return self.collected == len(self.tests) and not any("::" in arg for arg in args)

    def unused(self) -> list[Path]:
        """The goldens that no test names, after a run in which all tests of each file ran.

        A test that was skipped or did not pass keeps what may be its goldens, and a file of tests
        that was not collected keeps all.
        """
        return [path for folder in self._folders() for path in self._unused_in(folder)]

    def _folders(self) -> Iterator[Path]:
        """The folders of goldens beside the files of tests."""
        for parent in sorted({Path(file).parent for file, _ in self.tests.values()}):
            if (parent / FOLDER).is_dir():
                yield from sorted(path for path in (parent / FOLDER).iterdir() if path.is_dir())

    def _unused_in(self, folder: Path) -> Iterator[Path]:
        parent, name = folder.parent.parent, folder.name
        ids = [
            id
            for id, (file, _) in self.tests.items()
            if Path(file).parent == parent and Path(file).stem == name
        ]
        if not ids and any(path.stem == name for path in parent.iterdir() if path.is_file()):
            return
        keeping = [self.tests[id][1] for id in ids if id not in self.passed]
        for path in sorted(folder.iterdir()):
            # Only what the fixture names so: another program may have a folder `goldens` here.
            if path.suffix not in ENDINGS or "[" not in path.stem or not path.is_file():
                continue
            known = {str(path), str(without_variant(path))} & self.named
            if not known and not any(may_belong(path.stem, test) for test in keeping):
                yield path


def same_but_for_case(path: Path, known: dict[Path, dict[str, str]]) -> str | None:
    """The name of another file whose name differs only in case, or None.

    known: for each folder the names of its files by their names without case; it learns the path.
    """
    if path.parent not in known:
        known[path.parent] = {file.name.casefold(): file.name for file in path.parent.glob("*")}
    other = known[path.parent].setdefault(path.name.casefold(), path.name)
    return None if other == path.name else other
