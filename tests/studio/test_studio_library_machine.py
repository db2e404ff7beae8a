"""Any sequence of acts on a library leaves in its file what a plain dictionary would hold."""

import tempfile
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import settings, strategies as st
from hypothesis.stateful import (
    Bundle,
    RuleBasedStateMachine,
    consumes,
    initialize,
    invariant,
    multiple,
    rule,
)

pytest.importorskip("nicegui")

from drapery.banner.formats import parse_banner
from drapery.errors import DesignError, DraperyError
from drapery.settings import Settings
from drapery.studio.library import Library
from drapery.studio.records import Design
from drapery.studio.sketch import sketch_of

TITLES = st.text("abé🐢 %'", max_size=6)
TAGS = st.lists(st.sampled_from(["red", "ship", "Żółw"]), unique=True, max_size=3).map(tuple)


class LibraryMachine(RuleBasedStateMachine):
    """Acts on one library through two open files, and the designs that it should hold."""

    numbers = Bundle("numbers")

    @initialize()
    def open(self) -> None:
        """Two open files of one library."""
        self.folder = tempfile.TemporaryDirectory()
        self.path = Path(self.folder.name, "library.sqlite")
        self.files = [Library(self.path), Library(self.path)]
        self.designs: dict[int, Design] = {}
        self.turn = 0

    def teardown(self) -> None:
        """Remove the file."""
        self.folder.cleanup()

    @property
    def library(self) -> Library:
        """The two files take turns."""
        self.turn += 1
        return self.files[self.turn % 2]

    @rule(target=numbers, title=TITLES, tags=TAGS, dye=st.sampled_from(["red", "white"]))
    def add(self, title: str, tags: tuple[str, ...], dye: str) -> int:
        """A new design gets a number of its own."""
        sketch = sketch_of(parse_banner(f"{dye} creeper:lime"), title)
        number = self.library.add(Design(sketch, Settings(), tags))
        assert number not in self.designs
        self.designs[number] = self.library.get(number)
        return number

    @rule(number=numbers, title=TITLES)
    def rename(self, number: int, title: str) -> None:
        """Only the title changes."""
        old = self.designs[number]
        self.library.change(replace(old, sketch=replace(old.sketch, title=title)))
        new = self.library.get(number)
        assert new == replace(old, sketch=new.sketch, changed=new.changed)
        self.designs[number] = new

    @rule(number=numbers, tags=TAGS)
    def tag(self, number: int, tags: tuple[str, ...]) -> None:
        """Only the tags change."""
        old = self.designs[number]
        self.library.change(replace(old, tags=tags))
        new = self.library.get(number)
        assert new == replace(old, tags=new.tags, changed=new.changed)
        assert {tag.lower() for tag in new.tags} == {tag.lower() for tag in tags}
        self.designs[number] = new

    @rule(number=consumes(numbers))
    def remove(self, number: int) -> None:
        """A removed design is gone for both files."""
        assert self.library.remove(number) == self.designs.pop(number)
        for library in self.files:
            with pytest.raises(DesignError):
                library.get(number)

    @rule()
    def reopen(self) -> None:
        """What was written is there after the program has ended."""
        self.files = [Library(self.path), Library(self.path)]

    @rule()
    def load_its_own_export(self) -> None:
        """An import of what is there already adds nothing."""
        assert self.library.load(self.library.dump())[0] == 0

    @rule(target=numbers, cut=st.integers(1, 400))
    def load_a_broken_export(self, cut: int) -> object:
        """A broken import adds nothing."""
        data = self.library.dump()
        with pytest.raises(DraperyError):
            self.library.load(data[: -min(cut, len(data))])
        return multiple()

    @invariant()
    def holds_what_it_should(self) -> None:
        """Both files hold the same designs as the dictionary."""
        if hasattr(self, "files"):
            for library in self.files:
                found, count = library.search(limit=1000)
                assert count == len(self.designs)
                assert {each.number: each for each in found} == self.designs


LibraryMachine.TestCase.settings = settings(
    max_examples=15, stateful_step_count=15, deadline=None, derandomize=True
)
TestLibrary = LibraryMachine.TestCase
