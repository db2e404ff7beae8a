"""What packs are said to hold, and the real pack."""

import subprocess
import sys
from pathlib import Path

import pytest
from pack_maker import (
    BANNER,
    CREEPER,
    META,
    NEW_BASE,
    folder_pack,
    mcmeta,
    plain,
    strip,
    zip_pack,
)

from drapery.banner.design import Banner, Layer
from drapery.banner.packs import open_packs
from drapery.banner.packs.contents import describe_packs
from drapery.banner.patterns import PATTERN_NAMES
from drapery.banner.sprites import FLAG_REGIONS, composite, flag_layers

MAPS = ("", "_n", "_s")


def test_a_report_says_what_a_pack_has_lacks_and_overrides(tmp_path: Path) -> None:
    entry = {"directory": "new", "formats": 46}
    low = folder_pack(tmp_path / "low", {CREEPER: plain(1, 0, 0, 255)})
    files = {
        META: mcmeta(46, overlays={"entries": [entry]}),
        CREEPER: strip(1, 2),
        CREEPER + ".mcmeta": '{"animation": {}}',
        BANNER + "creeper_n.png": plain(1, 1, 1, 1),
        "new/" + BANNER + "skull.png": plain(1, 1, 1, 200),
        BANNER + "flower.png": b"no picture",
        NEW_BASE: plain(1, 1, 1, 255),
        "assets/g/textures/entity/banner/owl.png": plain(1, 1, 1, 1, side=32),
    }
    report_low, report = describe_packs([low, zip_pack(tmp_path / "top.zip", files)])
    assert report_low.has == ("creeper",) and len(report_low.lacks) == 42
    assert set(report.has) == {"creeper", "skull", "flower"}
    assert not set(report.has) & set(report.lacks) and len(report.has + report.lacks) == 43
    assert report.added == ("g:owl",) and report.bases == ("banner_base",)
    assert report.overrides == (("creeper", str(low)),)
    assert report.sides == ((8, 1), (32, 1), (64, 1))
    assert report.normal_maps == report.animated == ("creeper",)
    assert report.format == 46 and report.overlays == ("new",) and report.description == "a test"
    (problem,) = report.problems
    assert "flower.png is not a PNG file" in problem


def test_wrong_checksums_are_one_note_for_a_pack(tmp_path: Path) -> None:
    wrong = bytearray(plain(1, 1, 1, 90))
    wrong[-13] ^= 1
    files = {f"{BANNER}{name}.png": bytes(wrong) for name in PATTERN_NAMES}
    (report,) = describe_packs([folder_pack(tmp_path / "a", files)])
    (note,) = (line for line in report.notes if "checksum" in line)
    assert "border.png (IDAT)" in note and "and 38 more" in note and not report.problems


MEASURED = """
import sys, time
from pathlib import Path
from drapery.packs import describe_packs
start = time.process_time()
(report,) = describe_packs([sys.argv[1]])
print(len(report.sides), len(report.unchecked), len(report.problems))
status = Path("/proc/self/status")
lines = status.read_text().splitlines() if status.exists() else ["VmHWM: 0 kB"]
(peak,) = (int(line.split()[1]) for line in lines if line.startswith("VmHWM:"))
print(time.process_time() - start, peak / 1024)
"""
"""The peak is 0 where the system does not say it: `resource` counts the parent's memory too."""


@pytest.mark.slow
def test_a_report_on_gigabytes_of_texels_takes_bounded_memory_and_time(
    tmp_path: Path, untraced_processes: None
) -> None:
    strip = plain(9, 9, 9, 99, side=4096)
    meta = '{"animation": {"width": 2048, "height": 2048}}'
    sheets = {BANNER + f"{name}{ending}.png": strip for name in PATTERN_NAMES for ending in MAPS}
    metas = {BANNER + f"{name}.png.mcmeta": meta for name in PATTERN_NAMES}
    pack = zip_pack(tmp_path / "large.zip", sheets | metas)
    assert pack.stat().st_size < 1 << 20
    command = [sys.executable, "-c", MEASURED, str(pack)]
    run = subprocess.run(command, check=True, capture_output=True, text=True)
    counts, measures = run.stdout.splitlines()
    seconds, mebibytes = map(float, measures.split())
    assert seconds < 60 and mebibytes < 600
    sides, unchecked, problems = map(int, counts.split())
    assert (sides, problems) == (1, 0) and 0 < unchecked < 43


def test_the_real_pack_renders_front_back_and_edges(real_pack: Path) -> None:
    packs, ours = open_packs([real_pack]), open_packs()
    for pattern in PATTERN_NAMES:
        sheet = packs.sheet(pattern)
        assert sheet.shape == (64, 64, 4)
        is_own = pattern in ("flow", "guster")
        assert (packs.level(pattern) == 0) == is_own
        assert (sheet == ours.sheet(pattern)).all() == is_own
        flag = composite(flag_layers(Banner("white", (Layer(pattern, "red"),)), packs))
        plain_flag = composite(flag_layers(Banner("white"), packs))
        for side in ("front", "back"):
            region = FLAG_REGIONS[side]
            assert (region.crop(flag) != region.crop(plain_flag)).any(), (pattern, side)
    for name, region in FLAG_REGIONS.items():
        white = region.crop(composite(flag_layers(Banner("white"), packs)))
        red_cloth = region.crop(composite(flag_layers(Banner("red"), packs)))
        assert (white != red_cloth).any(axis=2).mean() > 0.9, name
    (line,) = packs.warnings()
    assert line.endswith("flow, guster")


def test_the_real_packs_report(real_pack: Path) -> None:
    (report,) = describe_packs([real_pack])
    assert report.lacks == ("flow", "guster") and len(report.shields) == 41
    assert report.sides == ((64, 41),) and report.problems == () and report.format == 6
    assert report.bases == ("banner_base", "shield_base", "shield_base_nopattern")


def test_old_masks_in_the_real_packs_shields_are_reported(real_pack: Path) -> None:
    packs = open_packs([real_pack])
    packs.sheet("creeper", "shield")
    assert "creeper (shield)" in packs.warnings()[0] and "black" in packs.warnings()[0]
    old = open_packs([real_pack], format=4)
    assert (old.sheet("creeper", "shield")[..., 3] == 0).mean() > 0.9
    assert old.warnings() == ()
