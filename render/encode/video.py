"""MP4 (H.264) and WebM (VP9) by PyAV, in 4:2:0 with the BT.709 colours that players expect."""

from collections.abc import Iterable, Iterator
from fractions import Fraction
from functools import cache, partial
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from drapery.arrays import HasPixels, Pixels
from drapery.errors import BackendError, OutputError
from drapery.render.encode.ahead import encode_ahead
from drapery.render.encode.palette import Matte, over_matte

WHITE = (255, 255, 255)
BT709, LIMITED_RANGE = 1, 1
H264 = "libx264"
# A fixed number of threads, since the output of the encoders depends on it.
X264 = {"crf": "13", "preset": "superfast", "tune": "animation"}
# Bits go to what stays in the picture, which halves the file of a fast preset.
X264_PARAMETERS = "mbtree=1:rc-lookahead=20"
VP9 = {"crf": "16", "b": "0", "deadline": "good", "cpu-used": "4"}


def write_mp4(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: Matte | None
) -> None:
    """An MP4. The background is the matte, or white. Raises BackendError if PyAV is missing."""
    parameters = X264_PARAMETERS + (":asm=AVX2" if _has_avx512() else "")
    options = {**X264, "x264-params": parameters}
    _write_video(path, "mp4", H264, options, frames, fps or 1, matte or WHITE)


def write_webm(
    path: Path, frames: Iterable[HasPixels], fps: float | None, matte: Matte | None
) -> None:
    """A WebM; it has alpha without a matte. Raises BackendError if PyAV is missing."""
    _write_video(path, "webm", "libvpx-vp9", VP9, frames, fps or 1, matte)


def _write_video(
    path: Path,
    muxer: str,
    codec: str,
    options: dict[str, str],
    frames: Iterable[HasPixels],
    fps: float,
    matte: Matte | None,
) -> None:
    """Write a video, which has alpha without a matte if its first frame has.

    Odd sizes grow by repeating the last row or column.
    """
    av = _load_av()
    first, frames = _peek(frames)
    flags = {"fflags": "+bitexact"}
    if codec == H264:
        # The index comes first, so that a page can play the file before it has all of it.
        flags["movflags"] = "+faststart"
    alpha = matte is None and bool((first.pixels[..., 3] < 255).any())
    try:
        with av.open(str(path), "w", format=muxer, options=flags) as container:
            stream = container.add_stream(codec, Fraction(fps).limit_denominator(1001), options)
            _describe(stream, first.pixels, "yuva420p" if alpha else "yuv420p")
            convert = partial(_video_frame, av, stream.pix_fmt, None if alpha else matte or WHITE)
            for frame in encode_ahead(frames, convert):
                container.mux(stream.encode(frame))
            container.mux(stream.encode())
    except av.FFmpegError as error:
        raise OutputError(f"cannot write {path}: {error.strerror}") from error


@cache
def _has_avx512() -> bool:
    """Whether this is Linux on a processor with AVX-512, with whose code x264 (core 165) gives
    other bytes for the same frames in one of thirty short videos."""
    file = Path("/proc/cpuinfo")
    return file.exists() and "avx512f" in file.read_text(encoding="utf-8", errors="replace")


def _load_av() -> Any:
    try:
        import av
    except ImportError as error:
        raise BackendError(
            'video needs PyAV, which is not installed: pip install "drapery-mc[video]"'
        ) from error
    return av


def _peek(frames: Iterable[HasPixels]) -> tuple[HasPixels, Iterator[HasPixels]]:
    rest = iter(frames)
    first = next(rest)
    return first, chain([first], rest)


def _describe(stream: Any, pixels: Pixels, pixel_format: str) -> None:
    height, width = pixels.shape[:2]
    stream.width, stream.height = width + width % 2, height + height % 2
    stream.pix_fmt = pixel_format
    context = stream.codec_context
    context.thread_count = 2
    context.bit_rate = 0
    context.colorspace = context.color_primaries = context.color_trc = BT709
    context.color_range = LIMITED_RANGE


def _video_frame(av: Any, pixel_format: str, matte: Matte | None, frame: HasPixels) -> Any:
    pixels = frame.pixels if matte is None else over_matte(frame.pixels, matte)
    height, width = pixels.shape[:2]
    if height % 2 or width % 2:
        pixels = np.pad(pixels, ((0, height % 2), (0, width % 2), (0, 0)), mode="edge")
    # The frame reads the array's memory, and the conversion alone copies it.
    rgb = av.VideoFrame.from_numpy_buffer(np.ascontiguousarray(pixels), "rgba")
    return rgb.reformat(
        format=pixel_format, dst_colorspace="ITU709", src_color_range="JPEG", dst_color_range="MPEG"
    )
