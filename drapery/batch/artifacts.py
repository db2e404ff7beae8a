"""Packs and textures as bytes, which are sent once to each worker on other machines."""

import io
import tempfile
import threading
import zipfile
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from drapery.batch.jobs import Job
from drapery.batch.keys import DigestCache
from drapery.errors import OutputError, PackError
from drapery.user_files import open_user_file

MAX_BYTES = 1 << 30


@dataclass(frozen=True)
class Artifact:
    """A file, or a folder as a zip. digest: of its content."""

    name: str
    digest: str
    data: bytes


def paths_of(job: Job) -> tuple[Path, ...]:
    """The packs and the texture that a job needs."""
    texture = job.settings.texture_path
    return (*map(Path, job.settings.pack_paths), *(() if texture is None else (Path(texture),)))


def bundle(path: Path, digests: DigestCache) -> Artifact:
    """A pack or texture as an artifact. Raises PackError."""
    try:
        data = _zipped(path) if path.is_dir() else _bytes(path)
    except OSError as error:
        raise PackError(f"pack {path} cannot be read: {error.strerror}; check the path") from None
    if len(data) > MAX_BYTES:
        raise PackError(f"pack {path} is over {MAX_BYTES >> 20} MiB; remove files not needed")
    name = path.name if path.is_file() else f"{path.name}.zip"
    return Artifact(name, digests.of(path)[:16], data)


def _bytes(path: Path) -> bytes:
    with open_user_file(path) as file:
        return file.read(MAX_BYTES + 1)


def unbundle(artifact: Artifact) -> Path:
    """Write the artifact as a file of this machine, once; its path. Raises OutputError."""
    try:
        folder = _folder() / artifact.digest
        folder.mkdir(exist_ok=True)
        path = folder / artifact.name
        if not path.exists() or path.stat().st_size != len(artifact.data):
            with tempfile.NamedTemporaryFile(dir=folder, delete=False) as file:
                file.write(artifact.data)
            Path(file.name).replace(path)
    except OSError as error:
        raise OutputError(
            f"cannot store pack {artifact.name}: {error.strerror}; free space in the folder for"
            " temporary files"
        ) from None
    return path


def resolved(job: Job, artifacts: tuple[Artifact, ...]) -> Job:
    """The job with the paths that its packs and texture have on this machine."""
    if not artifacts:
        return job
    here = [unbundle(artifact) for artifact in artifacts]
    count = len(job.settings.pack_paths)
    texture = here[count] if here[count:] else None
    settings = job.settings.changed(packs=tuple(here[:count]), texture=texture)
    return replace(job, settings=settings)


def _folder() -> Path:
    """This process's folder of artifacts; it is private, so its files can be trusted."""
    with _lock:
        return Path(temporary_folder().name)


_lock = threading.Lock()


@cache
def temporary_folder() -> tempfile.TemporaryDirectory[str]:
    """The folder of this process, which is removed when it ends."""
    return tempfile.TemporaryDirectory(prefix="drapery-packs-", ignore_cleanup_errors=True)


def _zipped(folder: Path) -> bytes:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as file:
        for path in sorted(folder.rglob("*")):
            if path.is_file() and ".git" not in path.relative_to(folder).parts:
                # Without times, so that the same pack gives the same artifact.
                info = zipfile.ZipInfo(path.relative_to(folder).as_posix())
                file.writestr(info, _bytes(path), zipfile.ZIP_DEFLATED)
    return buffer.getvalue()
