"""The formats of picture, animation, 3-D and page files, and where loops are posted: tables that
every part reads."""

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from itertools import count
from pathlib import Path
from types import MappingProxyType
from typing import Literal, TypeAlias

from drapery.errors import OptionError

Kind: TypeAlias = Literal["still", "loop", "model", "page", "data"]
"""What a file holds."""

MAX_FPS = 1000
"""The most frames/s of a format without a limit of its own."""

KIND_NAMES: dict[Kind, str] = {
    "still": "picture",
    "loop": "animation",
    "model": "3-D file",
    "page": "page",
    "data": "figures",
}


@dataclass(frozen=True)
class FileFormat:
    """A format of files.

    name: in messages and on pages.
    endings: how names of its files end, the usual one first; "/" is a folder.
    kinds: what its files may hold when they are written; empty for a format that is only read.
    usual: what a file holds where the caller writes several kinds; None for a loop where a length
        is asked for, and the first kind where none is.
    media_type: its name in HTTP.
    single: whether it is one file, with no other beside it.
    alpha: the transparency of its pixels: of 256 steps, of two, or none: its writer lays them over
        the matte, or white.
    matte: whether half-transparent pixels can be drawn over a colour.
    lossy: whether a quality may be asked for, at which it loses something; AVIF always does.
    moving: whether a 3-D file holds the motion of a loop.
    max_side: the largest width and height [px]; 0 for no limit of the format.
    max_fps: the most frames/s.
    extra: the extra that its writer needs.
    writer: the function below `drapery.render` that writes it, such as `encode.tiff.write_tiff`: of
        the path, the frames, their rate (None for a still) and the matte; `quality` where lossy.
    reader: Pillow's name of it, for pictures that are read. Uploads of the service and the studio
        are read in it too, so its decoder must be fast: one in Python takes seconds for a million
        pixels.
    about: what files hold, in a few words.
    """

    name: str
    endings: tuple[str, ...]
    kinds: tuple[Kind, ...] = ()
    usual: Kind | None = None
    media_type: str = ""
    single: bool = True
    alpha: Literal["full", "bit", "none"] = "full"
    matte: bool = False
    lossy: bool = False
    moving: bool = False
    max_side: int = 0
    max_fps: float = MAX_FPS
    extra: str = ""
    writer: str = ""
    reader: str = ""
    about: str = ""

    @property
    def ending(self) -> str:
        """The usual ending."""
        return self.endings[0]

    def kind(self, *, timed: bool = True) -> Kind:
        """What a file holds where the caller writes all kinds. timed: a length is asked for."""
        if self.usual is not None:
            return self.usual
        return "loop" if timed and "loop" in self.kinds else self.kinds[0]


FORMATS = (
    FileFormat(
        *("PNG", (".png",), ("still", "loop"), "still", "image/png"),
        writer="encode.png.write_png",
        reader="PNG",
        about="without loss",
    ),
    FileFormat(
        *("APNG", (".apng",), ("loop", "still"), "loop", "image/apng"),
        writer="encode.png.write_png",
        reader="PNG",
        about="without loss",
    ),
    FileFormat(
        *("WebP", (".webp",), ("still", "loop"), None, "image/webp"),
        lossy=True,
        max_side=16_383,
        writer="encode.webp.write_webp",
        reader="WEBP",
        about="without loss, unless `--quality` is given",
    ),
    FileFormat(
        *("AVIF", (".avif",), ("still", "loop"), None, "image/avif"),
        lossy=True,
        max_side=65_535,
        writer="encode.avif.write_avif",
        reader="AVIF",
        about="loses a little: quality 80, unless `--quality` is given",
    ),
    FileFormat(
        *("GIF", (".gif",), ("loop", "still"), "loop", "image/gif"),
        alpha="bit",
        matte=True,
        max_side=65_535,
        max_fps=50,
        writer="encode.gif.write_gif",
        reader="GIF",
        about="up to 255 colours are exact",
    ),
    FileFormat(
        *("TIFF", (".tif", ".tiff"), ("still",), None, "image/tiff"),
        writer="encode.tiff.write_tiff",
        reader="TIFF",
        about="without loss; for print",
    ),
    FileFormat(
        *("MP4", (".mp4",), ("loop",), None, "video/mp4"),
        alpha="none",
        matte=True,
        extra="video",
        writer="encode.video.write_mp4",
        about="H.264; the background is white unless another is given",
    ),
    FileFormat(
        *("WebM", (".webm",), ("loop",), None, "video/webm"),
        matte=True,
        extra="video",
        writer="encode.video.write_webm",
        about="VP9",
    ),
    FileFormat(
        *("sprite sheet", (".sheet.png",), ("loop",)),
        single=False,
        writer="encode.sheet.write_sheet",
        about="all frames in one PNG, and NAME.sheet.json beside it",
    ),
    FileFormat(
        *("folder", ("/",), ("loop",)),
        single=False,
        writer="encode.sequence.write_sequence",
        about="frame_0000.png and so on",
    ),
    FileFormat(
        *("GLB", (".glb",), ("model",), None, "model/gltf-binary"),
        moving=True,
        writer="export.gltf.glb_files",
        about="meshes, texture and camera; a loop as morph targets",
    ),
    FileFormat(
        *("OBJ", (".obj",), ("model",), None, "model/obj"),
        single=False,
        writer="export.obj.obj_files",
        about="one pose, with NAME.mtl and NAME_texture.png beside it",
    ),
    FileFormat(
        *("PLY", (".ply",), ("model",), None, "application/octet-stream"),
        writer="export.ply.ply_files",
        about="one pose; colours at its vertices, as the format has no textures",
    ),
    FileFormat(
        *("Blockbench", (".bbmodel",), ("model",), None, "application/json"),
        writer="export.blockbench.bbmodel_files",
        about="one pose, texture inside",
    ),
    FileFormat(
        *("Bedrock geometry", (".geo.json",), ("model",), None, "application/json"),
        single=False,
        writer="export.blockbench.bedrock_files",
        about="one pose, with NAME_texture.png beside it",
    ),
    FileFormat(
        *("HTML", (".html", ".htm"), ("page",), None, "text/html; charset=utf-8"),
        about="live cloth, or a sheet of pictures; it needs no other file",
    ),
    FileFormat(
        *("JSON", (".json",), ("data",), None, "application/json"),
        about="the figures of a comparison",
    ),
    FileFormat("JPEG", (".jpg", ".jpeg"), media_type="image/jpeg", reader="JPEG"),
    FileFormat("BMP", (".bmp",), media_type="image/bmp", reader="BMP"),
)
"""All formats. To add one, write its row and the function that `writer` names."""

READERS = tuple(dict.fromkeys(each.reader for each in FORMATS if each.reader))
"""Pillow's names of the formats of pictures that are read."""
LOOP_READERS = tuple(each.reader for each in FORMATS if each.reader and "loop" in each.kinds)
"""Those of formats whose files may hold several frames."""


@cache
def formats_of(*kinds: Kind) -> tuple[FileFormat, ...]:
    """The formats that can hold one of some kinds."""
    return tuple(each for each in FORMATS if not set(kinds).isdisjoint(each.kinds))


@cache
def endings_of(*kinds: Kind) -> tuple[str, ...]:
    """The endings of files that can hold one of some kinds."""
    return tuple(ending for each in formats_of(*kinds) for ending in each.endings)


def endings_read(readers: tuple[str, ...] = READERS) -> tuple[str, ...]:
    """The endings of pictures that are read. readers: Pillow's names of their formats."""
    return tuple(ending for each in FORMATS if each.reader in readers for ending in each.endings)


def known_format(name: str, *kinds: Kind) -> FileFormat | None:
    """The format that can hold one of some kinds, by the longest ending that a file's name has.

    A name without ending, or with a slash at its end, is a folder. None if there is no such format.
    """
    path = Path(name.lower())
    is_folder = name.endswith(("/", "\\")) or not path.suffix
    text = f"{path.name}/" if is_folder else path.name
    return next((f for end, f in _by_length(*kinds) if text.endswith(end) and text != end), None)


def format_of(path: str | Path, *kinds: Kind) -> FileFormat:
    """The format of a file that is to hold one of some kinds, by its name; see `known_format`.

    A folder that exists holds the frames of a loop, whatever its name; where a picture may be
    written too, only if its name is none of a file. Raises OptionError for an ending that no file
    of these kinds has.
    """
    found = known_format(str(path), *kinds)
    if "/" in endings_of(*kinds) and Path(path).is_dir() and not (found and "still" in kinds):
        found = known_format(f"{path}/", *kinds)
    if found is not None:
        return found
    wanted = " or ".join(KIND_NAMES[kind] for kind in kinds)
    other = known_format(str(path), *KIND_NAMES)
    if other is None:
        fault = f"no {wanted} is written with this ending"
    else:
        fault = f"{'without an ending it' if other.ending == '/' else other.name} holds no {wanted}"
    *first, last = ("/ for a folder" if each == "/" else each for each in endings_of(*kinds))
    raise OptionError(f"{path}: {fault}; use {' or '.join([', '.join(first), last])}")


@cache
def _by_length(*kinds: Kind) -> tuple[tuple[str, FileFormat], ...]:
    """The endings of files of some kinds and their formats, the longest first."""
    found = [(ending, each) for each in formats_of(*kinds) for ending in each.endings]
    return tuple(sorted(found, key=lambda one: -len(one[0])))


@dataclass(frozen=True)
class Destination:
    """Where loops are posted, and what it takes.

    max_bytes: the largest file. size: the largest picture there, width and height [pixels].
    endings: of the files that it plays. max_samples: the most pixels of all frames together.
    about: where the limits come from.
    """

    max_bytes: int
    size: tuple[int, int]
    endings: tuple[str, ...]
    max_samples: int
    about: str


DESTINATIONS = MappingProxyType(
    {
        "discord-emoji": Destination(
            256_000, (128, 128), (".gif", ".webp"), 1 << 40, "an emoji has less than 256 kB"
        ),
        "discord": Destination(
            8_000_000,
            (720, 720),
            (".gif", ".webp", ".mp4", ".webm"),
            1 << 40,
            "uploads of every account may have 8 MB",
        ),
        "wiki": Destination(
            4_000_000,
            (640, 640),
            (".gif",),
            12_500_000,
            "MediaWiki moves no thumbnail of more than 12.5 million pixels, $wgMaxAnimatedGifArea",
        ),
        "github": Destination(
            10_000_000,
            (960, 960),
            (".gif", ".webp", ".apng"),
            1 << 40,
            "pictures in texts may have 10 MB",
        ),
    }
)
"""Where loops are posted, by name."""


def frame_delays(fps: float, ticks_per_second: int) -> Iterator[int]:
    """Each frame's time in ticks; their sum is never more than half a tick from the true time."""
    step = ticks_per_second / Fraction(fps)
    for frame in count():
        yield round(step * (frame + 1)) - round(step * frame)
