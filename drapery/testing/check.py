"""One check of a picture against its golden, on top of syrupy's snapshots."""

import hashlib
from pathlib import Path
from typing import Any

import pytest
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.base import AbstractSyrupyExtension
from syrupy.extensions.single_file import SingleFileSnapshotExtension
from syrupy.location import PyTestLocation

from drapery import Banner
from drapery.errors import OutputError
from drapery.render import Animation, Scene
from drapery.testing.explain import LayerNote, explain_change, layer_notes
from drapery.testing.failures import GoldenUpdate, keep_failure
from drapery.testing.golden import (
    GoldenError,
    Picture,
    Tolerance,
    agrees,
    as_frame,
    decode,
    encode,
    fingerprint,
)

FOLDER = "goldens"
MAX_NAME = 200
"""The most bytes of a golden's name; file systems take 255 with the ending."""


class _GoldenFile(SingleFileSnapshotExtension):
    """The place and name of a golden file; subclasses define its contents."""

    @classmethod
    def dirname(cls, *, test_location: PyTestLocation) -> str:
        return str(Path(test_location.filepath).parent / FOLDER / test_location.basename)

    @classmethod
    def get_snapshot_name(cls, *, test_location: PyTestLocation, index: Any = 0) -> str:
        """Test and golden name as a file name; a digest replaces what a file name cannot hold."""
        whole = AbstractSyrupyExtension.get_snapshot_name(test_location=test_location, index=index)
        clean = super().get_snapshot_name(test_location=test_location, index=index)
        short = clean.encode()[:MAX_NAME].decode(errors="ignore")
        if short == whole:
            return whole
        return f"{short}-{hashlib.sha256(whole.encode()).hexdigest()[:8]}"


class HashGolden(_GoldenFile):
    """A golden that holds only size and hash."""

    file_extension = "sha256"

    def serialize(self, data: Any, **_: Any) -> bytes:
        drawn, _layers = data
        return fingerprint(drawn)


class PictureGolden(_GoldenFile):
    """A golden that is a PNG."""

    file_extension = "png"
    tolerance = Tolerance()

    def serialize(self, data: Any, **_: Any) -> bytes:
        return encode(*data)

    def matches(self, *, serialized_data: Any, snapshot_data: Any) -> bool:
        if serialized_data == snapshot_data:
            return True
        try:
            expected, _ = decode(snapshot_data)
        except GoldenError:
            return False
        return agrees(expected, decode(serialized_data)[0], self.tolerance)


def check_golden(
    request: pytest.FixtureRequest,
    picture: Any,
    *,
    name: str | None,
    tolerance: tuple[int, int],
    hashed: bool,
    backend: str,
    design: tuple[Banner, tuple[str | Path, ...]] | None,
    report: Path,
) -> str | None:
    """Compare with the golden, or write it in an update; the fault in one line, or None."""
    drawn = _drawn(picture, backend)
    notes = _notes(design)
    extension = HashGolden if hashed else _picture_golden(Tolerance(*tolerance))
    snapshot = _snapshot(request, extension, bool(request.config.getoption("--drapery-update")))
    label = _label(name, snapshot.num_executions, backend)
    location = snapshot.extension.get_location(test_location=snapshot.test_location, index=label)
    _check_case(request.config, label, Path(location))
    if snapshot(name=label) == (drawn, notes):
        return None
    result = list(snapshot.executions.values())[-1]
    content = fingerprint(drawn) if hashed else encode(drawn, notes)
    update = GoldenUpdate(Path(result.snapshot_location or location), content)
    return _fault(request.node.nodeid, label, result, drawn, notes, report, update)


_NAMES: pytest.StashKey[dict[Path, dict[str, str]]] = pytest.StashKey()
"""For each folder of goldens the names of its files, by their names without case."""


def _check_case(config: pytest.Config, label: str, path: Path) -> None:
    """Raise GoldenError for a file whose name differs from another only in case.

    A file system that ignores case would keep one file for both.
    """
    folders = config.stash.setdefault(_NAMES, {})
    if path.parent not in folders:
        folders[path.parent] = {file.name.casefold(): file.name for file in path.parent.glob("*")}
    other = folders[path.parent].setdefault(path.name.casefold(), path.name)
    if other != path.name:
        raise GoldenError(
            f"golden {label!r}: {path.name} differs from {other} only in case; use another name"
        )


def _snapshot(
    request: pytest.FixtureRequest, extension: type[_GoldenFile], update: bool
) -> SnapshotAssertion:
    """The test's snapshot; one for each test, so that unnamed goldens are numbered."""
    option = request.config.option
    store = request.node.stash.setdefault(_SNAPSHOTS, {})
    if extension not in store:
        store[extension] = SnapshotAssertion(
            session=request.config._syrupy,  # type: ignore[attr-defined]
            extension_class=extension,
            test_location=PyTestLocation(request.node),
            update_snapshots=update or option.update_snapshots,
            update_new_snapshots_only=option.update_new_snapshots_only,
        )
    snapshot: SnapshotAssertion = store[extension]
    return snapshot


_SNAPSHOTS: pytest.StashKey[dict[type[_GoldenFile], SnapshotAssertion]] = pytest.StashKey()
_PICTURE_GOLDENS: dict[Tolerance, type[PictureGolden]] = {Tolerance(): PictureGolden}


def _picture_golden(tolerance: Tolerance) -> type[PictureGolden]:
    """A class with this tolerance, since syrupy makes the objects of its extensions."""
    if tolerance not in _PICTURE_GOLDENS:
        _PICTURE_GOLDENS[tolerance] = type(
            "PictureGolden", (PictureGolden,), {"tolerance": tolerance}
        )
    return _PICTURE_GOLDENS[tolerance]


def _drawn(picture: Any, backend: str) -> Picture:
    if isinstance(picture, Animation):
        return picture
    if isinstance(picture, Scene):
        from drapery.render import backend as backend_by_name

        return backend_by_name(backend)(picture)
    return as_frame(picture)


def _notes(design: tuple[Banner, tuple[str | Path, ...]] | None) -> list[LayerNote] | None:
    if design is None:
        return None
    from drapery.packs import open_packs

    banner, packs = design
    return layer_notes(banner, open_packs(packs))


def _label(name: str | None, number: int, backend: str) -> str:
    label = name or f"{number + 1}"
    return label if backend in ("soft", "auto") else f"{label}-{backend}"


def _fault(
    test: str,
    label: str,
    result: Any,
    drawn: Picture,
    notes: list[LayerNote] | None,
    report: Path,
    update: GoldenUpdate,
) -> str:
    path = result.snapshot_location
    if result.exception is not None:
        reason = getattr(result.exception, "strerror", None) or str(result.exception)
        return f"golden {label!r}: {path}: {reason}; make the file readable and writable"

    def failed(line: str, expected: Picture | None = None) -> str:
        try:
            picture = keep_failure(report, test, label, expected, drawn, line, update)
        except OutputError as error:
            return f"golden {label!r}: {line}; {error}"
        return f"golden {label!r}: {line}; see {picture}; accept it with --drapery-update"

    if result.recalled_data is None:
        return failed(f"no golden at {path}")
    if path.endswith(".sha256"):
        was = result.recalled_data.decode("ascii", "replace").strip()
        return failed(f"the hash changed from {was} to {fingerprint(drawn).decode().strip()}")
    try:
        expected, before = decode(result.recalled_data)
    except GoldenError as error:
        return failed(f"{path}: {error}; restore the file")
    return failed(explain_change(expected, drawn, before, notes), expected)
