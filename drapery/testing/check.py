"""One check of a picture against its golden, on top of syrupy's snapshots."""

from pathlib import Path
from typing import Any

import pytest
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.single_file import SingleFileSnapshotExtension
from syrupy.location import PyTestLocation

from drapery.banner.design import Banner
from drapery.render.frame import Frame
from drapery.render.scene import Scene
from drapery.testing.explain import LayerNote, explain_change, layer_notes
from drapery.testing.failures import keep_failure
from drapery.testing.golden import (
    GoldenError,
    Tolerance,
    agrees,
    as_frame,
    decode,
    encode,
    fingerprint,
)

FOLDER = "goldens"


class _GoldenFile(SingleFileSnapshotExtension):
    """Where goldens lie; what is in them and when it matches is a subclass's."""

    @classmethod
    def dirname(cls, *, test_location: PyTestLocation) -> str:
        return str(Path(test_location.filepath).parent / FOLDER / test_location.basename)


class HashGolden(_GoldenFile):
    """A golden of which only size and hash are kept."""

    file_extension = "sha256"

    def serialize(self, data: Any, **_: Any) -> bytes:
        frame, _layers = data
        return fingerprint(frame)


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
    """Compare, or write where an update is asked for; the fault in one line, or None."""
    frame = _drawn(picture, backend)
    notes = _notes(design)
    extension = HashGolden if hashed else _picture_golden(Tolerance(*tolerance))
    update = request.config.getoption("--drapery-update")
    snapshot = _snapshot(request, extension, bool(update))
    label = _label(name, snapshot.num_executions, backend)
    if snapshot(name=label) == (frame, notes):
        return None
    result = list(snapshot.executions.values())[-1]
    return _fault(request.node.nodeid, label, result, frame, notes, report)


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
    """Syrupy makes its extensions itself, so a tolerance is a class attribute of one of them."""
    if tolerance not in _PICTURE_GOLDENS:
        _PICTURE_GOLDENS[tolerance] = type(
            "PictureGolden", (PictureGolden,), {"tolerance": tolerance}
        )
    return _PICTURE_GOLDENS[tolerance]


def _drawn(picture: Any, backend: str) -> Frame:
    if isinstance(picture, Scene):
        from drapery.render.backends import backend as backend_by_name

        return backend_by_name(backend)(picture)
    return as_frame(picture)


def _notes(design: tuple[Banner, tuple[str | Path, ...]] | None) -> list[LayerNote] | None:
    if design is None:
        return None
    from drapery.banner.packs import open_packs

    banner, packs = design
    return layer_notes(banner, open_packs(packs))


def _label(name: str | None, number: int, backend: str) -> str:
    label = name or f"{number + 1}"
    return label if backend in ("soft", "auto") else f"{label}-{backend}"


def _fault(
    test: str, label: str, result: Any, frame: Frame, notes: list[LayerNote] | None, report: Path
) -> str:
    path = result.snapshot_location
    accept = "; accept it with --drapery-update"
    if result.recalled_data is None:
        keep_failure(report, test, label, None, frame, "there is no golden yet")
        return f"golden {label!r}: no golden at {path}{accept}"
    if path.endswith(".sha256"):
        was = result.recalled_data.decode("ascii", "replace").strip()
        line = f"the hash changed from {was} to {fingerprint(frame).decode().strip()}"
        keep_failure(report, test, label, None, frame, line)
        return f"golden {label!r}: {line}{accept}"
    try:
        expected, before = decode(result.recalled_data)
    except GoldenError as error:
        keep_failure(report, test, label, None, frame, str(error))
        return (
            f"golden {label!r}: {path}: {error}; restore the file, or replace it with"
            " --drapery-update"
        )
    line = explain_change(expected, frame, before, notes)
    kept = keep_failure(report, test, label, expected, frame, line)
    return f"golden {label!r}: {line}; see {kept}{accept}"
