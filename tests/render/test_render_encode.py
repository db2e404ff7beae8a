"""Pictures written to files come back as they were, and a failed writing changes nothing."""

import json
import resource
import time
from collections.abc import Iterator
from fractions import Fraction
from io import BytesIO
from pathlib import Path

import av
import numpy as np
import pytest
from PIL import Image, ImageSequence

from drapery.comparison import read_picture
from drapery.errors import BackendError, OptionError, OutputError
from drapery.file_formats import frame_delays
from drapery.render.encode import avif, save_animation, save_frame
from drapery.render.encode.palette import ColourTable, over_matte, reduced, variance_cut
from drapery.render.encode.quick_png import quick_png_bytes
from drapery.render.frame import Animation, Frame

ANIMATED = ["a.gif", "a.apng", "a.png", "a.webp", "a.avif", "a.mp4", "a.webm", "a.sheet.png"]
ANIMATED += ["frames/"]
LOSSLESS = ["a.apng", "a.png", "a.webp"]


def square_wandering(count: int = 6, colours: int = 40) -> list[Frame]:
    """A coloured square that moves over a transparent ground, a soft pixel at its corner."""
    palette = np.random.default_rng(7).integers(0, 256, (colours, 3), dtype=np.uint8)
    frames = []
    for number in range(count):
        pixels = np.zeros((24, 33, 4), np.uint8)
        cells = (np.add.outer(16 * np.arange(16), np.arange(16)) + number) % colours
        top, left = number % 8, 3 * number % 16
        square = pixels[top : top + 16, left : left + 16]
        square[..., :3], square[..., 3] = palette[cells], 255
        square[0, 0, 3] = 90
        frames.append(Frame(pixels))
    return frames


def noise(count: int = 3, alpha: int | None = None) -> list[Frame]:
    random = np.random.default_rng(3)
    pixels = random.integers(0, 256, (count, 17, 23, 4), dtype=np.uint8)
    if alpha is not None:
        pixels[..., 3] = alpha
    return [Frame(p) for p in pixels]


def decoded(path: Path) -> list[np.ndarray]:
    with Image.open(path) as image:
        return [np.asarray(f.convert("RGBA")) for f in ImageSequence.Iterator(image)]


def hidden(pixels: np.ndarray, threshold: int = 128) -> np.ndarray:
    """With one bit of alpha; wholly transparent pixels have no colour."""
    seen = pixels[..., 3:] >= threshold
    return np.where(seen, np.concatenate([pixels[..., :3], 255 * seen], axis=-1), 0)


@pytest.mark.parametrize("size", [(1, 1), (127, 5), (128, 3), (300, 11)])
def test_a_png_that_is_written_quickly_comes_back_exactly(size: tuple[int, int]) -> None:
    pixels = np.random.default_rng(5).integers(0, 256, (*size, 4), np.uint8)
    for picture in (pixels, pixels // 64 * 64, pixels[:, ::-1]):
        for image in (Image.fromarray(picture), Image.fromarray(picture[..., :3])):
            data = quick_png_bytes(image)
            assert np.array_equal(np.asarray(Image.open(BytesIO(data))), np.asarray(image))
            assert data == quick_png_bytes(image.copy())


@pytest.mark.parametrize("name", ["a.png", "a.apng", "a.webp", "a.tif"])
def test_a_still_comes_back_exactly(tmp_path: Path, name: str) -> None:
    frame = noise(1)[0]
    save_frame(frame, tmp_path / name)
    assert np.array_equal(decoded(tmp_path / name)[0], frame.pixels)


@pytest.mark.parametrize("name", LOSSLESS)
@pytest.mark.parametrize("frames", [noise(), square_wandering()], ids=["noise", "moving"])
def test_lossless_animations_come_back_exactly(
    tmp_path: Path, name: str, frames: list[Frame]
) -> None:
    save_animation(frames, 20, tmp_path / name)
    back = decoded(tmp_path / name)
    assert len(back) == len(frames)
    assert all(np.array_equal(a, b.pixels) for a, b in zip(back, frames, strict=True))


def test_pillow_animates_what_it_would_have_written_itself(tmp_path: Path) -> None:
    frames = square_wandering()
    images = [Image.fromarray(frame.pixels) for frame in frames]
    images[0].save(tmp_path / "pillow.apng", "PNG", save_all=True, append_images=images[1:])
    save_animation(frames, 10, tmp_path / "ours.apng")
    for one, other in zip(
        decoded(tmp_path / "pillow.apng"), decoded(tmp_path / "ours.apng"), strict=True
    ):
        assert np.array_equal(one, other)


def test_a_gif_of_few_colours_is_exact_and_does_not_smear(tmp_path: Path) -> None:
    frames = square_wandering()
    save_animation(frames, 20, tmp_path / "a.gif")
    for back, frame in zip(decoded(tmp_path / "a.gif"), frames, strict=True):
        assert np.array_equal(hidden(back), hidden(frame.pixels))


def test_a_gif_keeps_255_colours_over_an_opaque_ground(tmp_path: Path) -> None:
    frames = square_wandering(colours=254)
    for frame in frames:
        frame.pixels[frame.pixels[..., 3] < 255] = (1, 2, 3, 255)
    save_animation(frames, 20, tmp_path / "a.gif")
    for back, frame in zip(decoded(tmp_path / "a.gif"), frames, strict=True):
        assert np.array_equal(back, frame.pixels)


def test_a_gif_whose_every_frame_has_few_colours_is_exact(tmp_path: Path) -> None:
    random = np.random.default_rng(5)
    frames = []
    for _ in range(4):
        pixels = np.full((15, 18, 4), 255, np.uint8)
        pixels[..., :3] = random.integers(0, 256, (250, 3))[random.integers(0, 250, (15, 18))]
        frames.append(Frame(pixels))
    save_animation(frames, 20, tmp_path / "a.gif")
    for back, frame in zip(decoded(tmp_path / "a.gif"), frames, strict=True):
        assert np.array_equal(back, frame.pixels)


def test_a_gif_of_many_colours_keeps_the_common_ones_and_stays_near(tmp_path: Path) -> None:
    ramp = np.linspace(0, 255, 64).astype(np.uint8)
    pixels = np.full((128, 64, 4), 255, np.uint8)
    pixels[:64, :, :3] = np.stack(np.broadcast_arrays(ramp[:, None], ramp, 200), axis=-1)
    pixels[64:, :, :3] = (93, 17, 201)
    save_animation([Frame(pixels)] * 2, 20, tmp_path / "a.gif")
    back = decoded(tmp_path / "a.gif")[0].astype(int)
    assert np.array_equal(back[64:], pixels[64:])
    assert np.abs(back - pixels).max() < 24


def test_a_matte_takes_the_half_transparent_pixels_of_a_gif(tmp_path: Path) -> None:
    pixels = np.array([[[255, 0, 0, 0], [255, 0, 0, 102], [255, 0, 0, 255]]], np.uint8)
    save_frame(Frame(pixels), tmp_path / "a.gif", matte=(0, 0, 255))
    back = decoded(tmp_path / "a.gif")[0][0]
    assert back[0, 3] == 0
    assert back[1].tolist() == [102, 0, 153, 255]
    assert back[2].tolist() == [255, 0, 0, 255]


@pytest.mark.parametrize("fps", [20, 24, 29.97, 50, 3])
def test_delays_add_up(fps: float) -> None:
    times = [t for t, _ in zip(frame_delays(fps, 100), range(997), strict=False)]
    assert abs(sum(times) - 997 * 100 / fps) <= 0.5
    assert max(times) - min(times) <= 1


@pytest.mark.parametrize("name", ["a.gif", "a.apng", "a.webp"])
def test_durations_and_endless_loop(tmp_path: Path, name: str) -> None:
    save_animation(square_wandering(24), 24, tmp_path / name)
    with Image.open(tmp_path / name) as image:
        assert image.info["loop"] == 0
        durations = []
        for number in range(image.n_frames):
            image.seek(number)
            image.load()
            durations.append(image.info["duration"])
    assert len(durations) == 24
    assert sum(durations) == pytest.approx(1000, abs=1e-6)


def test_20_frames_a_second_are_5_centiseconds(tmp_path: Path) -> None:
    save_animation(square_wandering(), 20, tmp_path / "a.gif")
    with Image.open(tmp_path / "a.gif") as image:
        assert {f.info["duration"] for f in ImageSequence.Iterator(image)} == {50}


def test_unchanged_frames_are_stored_and_cost_little(tmp_path: Path) -> None:
    frame = noise(1, alpha=255)[0]
    for name in ("a.gif", "a.apng", "a.webp"):
        save_animation([frame], 10, tmp_path / f"1{name}")
        save_animation([frame] * 5, 10, tmp_path / name)
        back = decoded(tmp_path / name)
        assert all(np.array_equal(back[0], other) for other in back)
        grown = (tmp_path / name).stat().st_size - (tmp_path / f"1{name}").stat().st_size
        assert grown < 1500


def test_frames_in_a_folder(tmp_path: Path) -> None:
    frames = noise(12)
    folder = tmp_path / "frames"
    save_animation(frames, 20, f"{folder}/")
    assert sorted(p.name for p in folder.iterdir()) == [f"frame_{i:04d}.png" for i in range(12)]
    assert all(
        np.array_equal(decoded(folder / f"frame_{i:04d}.png")[0], f.pixels)
        for i, f in enumerate(frames)
    )


def test_a_folder_keeps_what_is_not_ours(tmp_path: Path) -> None:
    folder = tmp_path / "shots.v1"
    folder.mkdir()
    (folder / "notes.txt").write_text("mine")
    save_animation(noise(5), 20, folder)
    save_animation(noise(2), 20, folder)
    names = sorted(p.name for p in folder.iterdir())
    assert names == ["frame_0000.png", "frame_0001.png", "notes.txt"]
    assert [p.name for p in tmp_path.iterdir()] == ["shots.v1"]


def test_a_sheet_and_its_index_agree(tmp_path: Path) -> None:
    frames = noise(7)
    Animation(tuple(frames), 24).save(tmp_path / "a.sheet.png")
    sheet = decoded(tmp_path / "a.sheet.png")[0]
    index = json.loads((tmp_path / "a.sheet.json").read_text())
    assert index["meta"]["image"] == "a.sheet.png"
    assert index["meta"]["size"] == {"w": sheet.shape[1], "h": sheet.shape[0]}
    assert sum(entry["duration"] for entry in index["frames"].values()) == round(7000 / 24)
    for entry, frame in zip(index["frames"].values(), frames, strict=True):
        box = entry["frame"]
        part = sheet[box["y"] : box["y"] + box["h"], box["x"] : box["x"] + box["w"]]
        assert np.array_equal(part, frame.pixels)


def smooth(count: int, size: tuple[int, int] = (33, 47)) -> list[Frame]:
    """Smooth pictures: 4:2:0 halves the colours' resolution, so sharp edges may not come back."""
    y, x = np.mgrid[: size[0], : size[1]]
    frames = []
    for number in range(count):
        planes = [4 * x + 3 * number, 6 * y, 255 - 2 * x - 3 * y, np.full(size, 255)]
        frames.append(Frame(np.stack(planes, axis=-1).clip(0, 255).astype(np.uint8)))
    return frames


@pytest.mark.parametrize("name", ["a.mp4", "a.webm"])
def test_a_video_comes_back_nearly(tmp_path: Path, name: str) -> None:
    frames = smooth(10)
    save_animation(iter(frames), 25, tmp_path / name)
    with av.open(str(tmp_path / name)) as container:
        stream = container.streams.video[0]
        assert stream.average_rate == 25
        back = [
            f.reformat(format="rgb24", src_colorspace="ITU709").to_ndarray()
            for f in container.decode(stream)
        ]
    assert len(back) == 10
    for picture, frame in zip(back, frames, strict=True):
        assert picture.shape == (34, 48, 3)
        error = np.abs(picture[:33, :47].astype(int) - frame.pixels[..., :3])
        assert error.mean() < 3 and error.max() < 16


@pytest.mark.parametrize("step", [1, 2])
def test_a_picture_over_a_matte_is_exact_at_each_alpha(step: int) -> None:
    chance = np.random.default_rng(0)
    pixels = chance.integers(0, 256, (80, 60, 4), np.uint8)[:, ::step]
    pixels[:20, :, 3], pixels[20:30, :, 3] = 0, 255
    alpha = pixels[..., 3:].astype(int)
    exact = (alpha * pixels[..., :3] + (255 - alpha) * [12, 255, 7] + 127) // 255
    laid = over_matte(pixels, (12, 255, 7))
    assert np.array_equal(laid[..., :3], exact) and (laid[..., 3] == 255).all()


def test_a_video_lies_on_its_matte(tmp_path: Path) -> None:
    clear = Frame(np.zeros((16, 16, 4), np.uint8))
    for name, matte, want in [
        ("a.mp4", None, (255, 255, 255)),
        ("b.mp4", (40, 90, 200), (40, 90, 200)),
        ("b.webm", (40, 90, 200), (40, 90, 200)),
    ]:
        save_animation([clear] * 3, 20, tmp_path / name, matte=matte)
        with av.open(str(tmp_path / name)) as container:
            picture = next(container.decode(video=0))
        rgb = picture.reformat(format="rgb24", src_colorspace="ITU709").to_ndarray()
        assert np.abs(rgb.astype(int) - want).max() <= 3


def alpha_of(picture: av.VideoFrame) -> np.ndarray:
    """As it was decoded: the conversion to RGBA reads beside the plane of a small picture."""
    plane = picture.planes[3]
    rows = np.frombuffer(plane, np.uint8).reshape(plane.height, plane.line_size)
    return rows[:24, :33].copy()


def test_a_webm_keeps_its_alpha(tmp_path: Path) -> None:
    frames = square_wandering(4)
    save_animation(frames, 20, tmp_path / "a.webm")
    with av.open(str(tmp_path / "a.webm")) as container:
        stream = container.streams.video[0]
        decoder = av.CodecContext.create("libvpx-vp9", "r")
        alphas = [alpha_of(f) for packet in container.demux(stream) for f in decoder.decode(packet)]
    assert len(alphas) == 4
    for alpha, frame in zip(alphas, frames, strict=True):
        assert np.abs(alpha.astype(int) - frame.pixels[..., 3]).mean() < 0.5


@pytest.mark.parametrize("name", ANIMATED)
def test_same_frames_same_bytes(tmp_path: Path, name: str) -> None:
    for run in ("one", "two"):
        (tmp_path / run).mkdir()
        target = f"{tmp_path / run}/{name}"
        save_animation(square_wandering(), 20, target)
    files = sorted(p.relative_to(tmp_path / "one") for p in (tmp_path / "one").rglob("*.*"))
    assert files
    for file in files:
        assert (tmp_path / "one" / file).read_bytes() == (tmp_path / "two" / file).read_bytes()


def failing(error: BaseException, after: int = 3) -> Iterator[Frame]:
    yield from square_wandering(after)
    raise error


@pytest.mark.parametrize("name", ANIMATED)
@pytest.mark.parametrize("error", [ValueError("no"), OSError(2, "No such file", "skin.png")])
def test_a_failure_leaves_nothing(tmp_path: Path, name: str, error: Exception) -> None:
    with pytest.raises(type(error)) as caught:
        save_animation(failing(error), 20, f"{tmp_path}/{name}")
    assert caught.value is error
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ANIMATED)
@pytest.mark.parametrize("error", [ValueError, KeyboardInterrupt])
def test_a_failure_leaves_an_older_target_as_it_was(
    tmp_path: Path, name: str, error: type[BaseException]
) -> None:
    target = f"{tmp_path}/{name}"
    save_animation(square_wandering(5), 20, target)
    before = {p: p.read_bytes() for p in tmp_path.rglob("*.*")}
    with pytest.raises(error):
        save_animation(failing(error(), 2), 20, target)
    assert {p: p.read_bytes() for p in tmp_path.rglob("*.*")} == before


def test_ctrl_c_leaves_the_finished_frames_in_a_new_folder(tmp_path: Path) -> None:
    frames = square_wandering(20)
    with pytest.raises(KeyboardInterrupt):
        save_animation(failing(KeyboardInterrupt(), 20), 20, f"{tmp_path}/frames/")
    kept = sorted((tmp_path / "frames").iterdir())
    assert 10 < len(kept) <= 20
    for path, frame in zip(kept, frames, strict=False):
        assert np.array_equal(decoded(path)[0], frame.pixels)


def test_ctrl_c_changes_nothing_in_a_folder_of_frames(tmp_path: Path) -> None:
    save_animation(square_wandering(30), 20, f"{tmp_path}/frames/")
    before = {path: path.stat().st_ino for path in (tmp_path / "frames").iterdir()}
    with pytest.raises(KeyboardInterrupt):
        save_animation(failing(KeyboardInterrupt(), 20), 20, f"{tmp_path}/frames/")
    assert {path: path.stat().st_ino for path in (tmp_path / "frames").iterdir()} == before


def test_a_video_has_the_same_bytes_each_time(tmp_path: Path) -> None:
    """x264 chooses code by the processor, and some of it gave other bytes now and then."""
    found = set()
    for _ in range(40):
        save_animation(square_wandering(8), 10, tmp_path / "a.mp4")
        found.add((tmp_path / "a.mp4").read_bytes())
    assert len(found) == 1


@pytest.mark.parametrize("name", ["a.png", "a.gif", "a.apng", "a.webp", "a.mp4", "a.sheet.png"])
def test_a_full_disk_is_one_clear_line(tmp_path: Path, name: str) -> None:
    soft, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (600, hard))
    try:
        with pytest.raises(OutputError, match=r"cannot write .*a") as caught:
            save_animation(noise(6), 20, tmp_path / name)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, (soft, hard))
    assert "\n" not in str(caught.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["no/a.gif", "no/frames/", "file/a.png", "file/", "dir.gif"])
def test_bad_places_are_refused_before_drawing(tmp_path: Path, name: str) -> None:
    (tmp_path / "file").write_text("")
    (tmp_path / "dir.gif").mkdir()

    def never() -> Iterator[Frame]:
        raise AssertionError("drawn")
        yield

    if name == "dir.gif":
        with pytest.raises(OutputError, match="is a folder"):
            save_frame(noise(1)[0], tmp_path / name)
    else:
        with pytest.raises(OutputError, match=r"cannot write"):
            save_animation(never(), 20, f"{tmp_path}/{name}")


def test_bad_options_are_refused(tmp_path: Path) -> None:
    frames = noise(2)
    with pytest.raises(
        OptionError, match=r"a\.bmp: no picture is written with this ending; use \.png, \.apng"
    ):
        save_frame(frames[0], tmp_path / "a.bmp")
    with pytest.raises(OptionError, match=r"a\.avi: .* use \.png.*\.mp4.* / for a folder"):
        save_animation(frames, 20, tmp_path / "a.avi")
    for fps in (0, -1, float("nan"), float("inf"), 1e9):
        with pytest.raises(OptionError, match="fps"):
            save_animation(frames, fps, tmp_path / "a.apng")
    with pytest.raises(OptionError, match=r"GIF shows at most 50; use \.apng or \.webp"):
        save_animation(frames, 60, tmp_path / "a.gif")
    with pytest.raises(OptionError, match="at least one frame"):
        save_animation([], 20, tmp_path / "a.gif")
    with pytest.raises(OptionError, match="frame 2 is 33x24, the first 23x17"):
        save_animation([*frames, *square_wandering(1)], 20, tmp_path / "a.webp")
    with pytest.raises(OutputError, match="over 16384"):
        wide = Frame(np.zeros((1, 6000, 4), np.uint8))
        tall = Frame(np.zeros((6000, 6000, 4), np.uint8))
        save_animation([tall] * 9, 20, tmp_path / "a.sheet.png")
        save_animation([wide] * 3, 20, tmp_path / "a.sheet.png")
    assert list(tmp_path.iterdir()) == []


def test_video_without_its_library_says_how_to_get_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(__import__("sys").modules, "av", None)
    with pytest.raises(BackendError, match=r'pip install "drapery-mc\[video\]"'):
        save_animation(square_wandering(), 20, tmp_path / "a.mp4")


def test_progress_counts_every_frame(tmp_path: Path) -> None:
    seen: list[tuple[int, int | None]] = []
    save_animation(
        iter(square_wandering(4)),
        20,
        tmp_path / "a.apng",
        total=4,
        progress=lambda done, total: seen.append((done, total)),
    )
    assert seen == [(1, 4), (2, 4), (3, 4), (4, 4)]


def test_frames_are_drawn_only_a_little_ahead(tmp_path: Path) -> None:
    """A long animation never lies in memory as a whole: frames die soon after they are drawn."""
    import weakref

    alive: list[weakref.ref[Frame]] = []

    def drawn() -> Iterator[Frame]:
        for frame in (Frame(np.full((8, 8, 4), n, np.uint8)) for n in range(64)):
            alive.append(weakref.ref(frame.pixels))  # type: ignore[arg-type]
            assert sum(ref() is not None for ref in alive) < 16
            yield frame

    for name in ("a.apng", "a.webp", "a.gif", "a.mp4", "frames/"):
        alive.clear()
        save_animation(drawn(), 20, f"{tmp_path}/{name}")
        assert len(alive) == 64


def test_the_colour_table_counts_and_remembers() -> None:
    table = ColourTable()
    pixels = noise(1, alpha=255)[0].pixels
    pixels[0, 0] = 0
    places = table.places(pixels, None)
    assert places[0, 0] == 0 and table.counts.sum() == pixels[..., 0].size
    assert np.array_equal(table.colours()[places][1:], pixels[1:, :, :3])


def test_a_palette_never_has_more_than_256_entries() -> None:
    random = np.random.default_rng(11)
    colours = random.integers(0, 256, (5000, 3), dtype=np.uint8)
    counts = random.integers(1, 100_000, 5000)
    palette, place = reduced(colours, counts)
    assert len(palette) <= 256 and place.max() < len(palette) and place[0] == 0
    assert len(variance_cut(colours, counts, 17)) == 17


def test_a_palette_has_the_weighted_means_of_groups_that_are_far_apart() -> None:
    reds = np.array([0, 10, 200, 202, 200])
    colours = np.stack([reds, 0 * reds, 0 * reds], axis=-1).astype(np.uint8)
    palette = variance_cut(colours, np.array([3, 1, 1, 1, 0]), 2)
    assert sorted(palette.tolist()) == [[3, 0, 0], [201, 0, 0]]
    assert len(variance_cut(colours, np.array([3, 1, 1, 1, 1]), 9)) == 4


def test_fraction_rates_are_exact_in_apng(tmp_path: Path) -> None:
    save_animation(square_wandering(2), 30, tmp_path / "a.apng")
    data = (tmp_path / "a.apng").read_bytes()
    start = data.index(b"fcTL") + 4 + 20
    delay = Fraction(*(int.from_bytes(data[start + i : start + i + 2]) for i in (0, 2)))
    assert delay == Fraction(1, 30)


def test_png_files_say_that_their_colours_are_srgb(tmp_path: Path) -> None:
    save_frame(noise()[0], tmp_path / "a.png")
    save_animation(noise(), 10, tmp_path / "a.apng")
    for name in ("a.png", "a.apng"):
        assert (tmp_path / name).read_bytes()[33:46] == b"\0\0\0\1sRGB\0\xae\xce\x1c\xe9"


def test_the_index_of_an_mp4_comes_first(tmp_path: Path) -> None:
    save_animation(noise(), 10, tmp_path / "a.mp4")
    data = (tmp_path / "a.mp4").read_bytes()
    assert data.index(b"moov") < data.index(b"mdat")


def disc(count: int = 4) -> list[Frame]:
    """A soft disc that moves over a transparent ground."""
    y, x = np.mgrid[:96, :128]
    frames = []
    for number in range(count):
        away = np.hypot(x - 50 - 9 * number, y - 48)
        pixels = np.stack([x + y, 255 - x, y * 2, np.clip(40 - away, 0, 1) * 255], axis=-1)
        frames.append(Frame(pixels.astype(np.uint8)))
    return frames


def test_a_quality_makes_webp_smaller_and_keeps_its_transparency(tmp_path: Path) -> None:
    frames, sizes = disc(), []
    for quality in (None, 90, 40):
        for name, save in (
            ("a.webp", lambda path, q: save_animation(frames, 10, path, quality=q)),
            ("b.webp", lambda path, q: save_frame(frames[0], path, quality=q)),
        ):
            save(tmp_path / name, quality)
            for found, frame in zip(decoded(tmp_path / name), frames, strict=False):
                seen = frame.pixels[..., 3] > 0
                assert np.array_equal(found[..., 3], frame.pixels[..., 3])
                away = np.abs(found[seen].astype(int) - frame.pixels[seen])[:, :3].mean()
                assert away == 0 if quality is None else 0 < away < 8
        sizes.append((tmp_path / "a.webp").stat().st_size)
    assert sizes[0] > sizes[1] > sizes[2]
    assert len(decoded(tmp_path / "a.webp")) == len(frames)


def test_avif_loses_little_shows_each_frame_for_its_time_and_has_no_time_of_day(
    tmp_path: Path,
) -> None:
    frames, written = disc(), set()
    for seconds in (0.0, 1.1):
        time.sleep(seconds)
        save_animation(frames, 12, tmp_path / "a.avif")
        written.add((tmp_path / "a.avif").read_bytes())
    assert len(written) == 1
    save_frame(frames[0], tmp_path / "b.avif")
    loop, still = read_picture(tmp_path / "a.avif"), read_picture(tmp_path / "b.avif")
    assert loop.delays == (0.083, 0.084, 0.083, 0.083) and loop.plays == 0
    assert len(still.frames) == 1
    for found, frame in zip((*loop.frames, *still.frames), (*frames, frames[0]), strict=True):
        solid = frame.pixels[..., 3] == 255
        away = np.abs(found.astype(int) - frame.pixels)
        assert away[solid][:, :3].mean() < 2
        assert away[..., 3].mean() < 1


def test_avif_says_so_where_its_frames_are_too_many_or_pillow_cannot_write_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(avif, "MAX_PIXELS", 2 * 96 * 128)
    with pytest.raises(OptionError, match=r"too many for AVIF, .*or \.webp"):
        save_animation(disc(3), 10, tmp_path / "a.avif")
    monkeypatch.setattr(avif.features, "check", lambda name: False)
    with pytest.raises(BackendError, match=r"built without AVIF; .* or write \.webp"):
        save_animation(disc(2), 10, tmp_path / "a.avif")
    assert list(tmp_path.iterdir()) == []


def test_a_quality_that_does_nothing_is_refused(tmp_path: Path) -> None:
    for name in ("a.png", "a.gif", "a.apng", "folder/"):
        with pytest.raises(OptionError, match=r"quality does nothing for .*it is for WebP"):
            save_animation(disc(), 10, tmp_path / name, quality=50)
    for quality in (0, 101, 2.5, True):
        with pytest.raises(OptionError, match="quality"):
            save_frame(disc()[0], tmp_path / "a.webp", quality=quality)
    assert list(tmp_path.iterdir()) == []
