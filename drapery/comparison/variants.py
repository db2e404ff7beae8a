"""The variants to compare: designs, packs, layer modes, backends, or finished pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from drapery.banner.design import Banner
from drapery.banner.formats import read_designs
from drapery.banner.formats.registry import choose_banner
from drapery.errors import OptionError
from drapery.picture_file import opened_picture
from drapery.pictures import draw
from drapery.render import Frame
from drapery.settings import Options, Settings
from drapery.styles import StyleLike, find_style
from drapery.user_files import read_user_file

PICTURE_ENDINGS = (".png", ".gif", ".webp", ".apng")
MAX_PICTURE_SIDE = 16384
MAX_PICTURE_PIXELS = 8192 * 8192
MAX_PICTURE_FILE = 512 << 20

Axes = dict[str, list[tuple[str, dict[str, Any]]]]
"""The values of each thing that may vary: their labels, and the settings that they change."""


@dataclass(frozen=True)
class Variant:
    """One variant of a comparison: its label, its picture, and how to draw its first layers.

    frame: the whole picture.
    banner, settings: None for a finished picture.
    """

    label: str
    frame: Frame
    banner: Banner | None = None
    settings: Settings | None = None

    def with_layers(self, count: int) -> Frame:
        """The picture with the first `count` layers; the whole one for a finished picture."""
        if self.banner is None or self.settings is None:
            return self.frame
        return draw(replace(self.banner, layers=self.banner.layers[:count]), self.settings)

    @property
    def layer_count(self) -> int:
        return 0 if self.banner is None else len(self.banner.layers)


def variant_of(
    label: str, subject: Banner | Frame, settings: Settings | None, options: Options
) -> Variant:
    """A design drawn with these options, or a finished picture. Raises the errors of `draw`."""
    if isinstance(subject, Frame):
        return Variant(label, subject)
    chosen = settings or Settings()
    chosen = replace(chosen, **options)
    return Variant(label, draw(subject, chosen), subject, chosen)


def draw_variants(
    subjects: Sequence[str],
    settings: Settings,
    layer_modes: Sequence[str] = (),
    backends: Sequence[str] = (),
    styles: Sequence[StyleLike] = (),
    *,
    form: str | None = None,
    number: int | None = None,
) -> list[Variant]:
    """Draw the variants of a comparison.

    subjects: two or more pictures; or one or more designs, and packs to draw them with.
    styles: one for each variant.
    form, number: the form of the designs, and which banner to use if a text holds several.
    Raises OptionError unless exactly one of designs, packs, layer modes, backends and styles
    varies.
    """
    pictures = [subject for subject in subjects if _is_picture(subject)]
    if pictures:
        if len(pictures) < len(subjects) or len(pictures) < 2:
            raise OptionError(f"{pictures[0]} is a picture; compare it only with other pictures")
        return [Variant(Path(p).name, _load(Path(p))) for p in pictures]
    packs = [subject for subject in subjects if _is_pack(subject)]
    designs = [subject for subject in subjects if subject not in packs]
    banners = [(text, _banner(text, form, number)) for text in designs]
    axes: Axes = {
        "designs": [(text, {}) for text, _ in banners] if len(banners) > 1 else [],
        "packs": [(Path(p).name, {"packs": (*settings.pack_paths, p)}) for p in packs],
        "layers": [(mode, {"layers": mode}) for mode in layer_modes],
        "backends": [(name, {"backend": name}) for name in backends],
        "styles": [(find_style(style).name, {"style": style}) for style in styles],
    }
    return _drawn(banners, settings, axes)


def _banner(text: str, form: str | None, number: int | None) -> Banner:
    found = read_designs(text, form=form)
    return choose_banner(found, number if len(found) > 1 else None)


def _drawn(
    banners: list[tuple[str, Banner]],
    settings: Settings,
    axes: Axes,
) -> list[Variant]:
    if not banners:
        raise OptionError(
            "no design is named; give one beside the packs, like 'white creeper:lime'"
        )
    varied = {name: values for name, values in axes.items() if len(values) > 1}
    if len(varied) != 1:
        found = " and ".join(varied) or "nothing"
        raise OptionError(
            f"a comparison varies one thing, and here {found} would vary; give two designs, two"
            " packs, two styles, --layers stacked,flat or --backend soft,pyrender"
        )
    fixed = {
        k: v for name, values in axes.items() if len(values) == 1 for k, v in values[0][1].items()
    }
    base = replace(settings, **fixed)
    ((axis, values),) = varied.items()
    made = []
    for number, (label, changes) in enumerate(values):
        banner = banners[number if axis == "designs" else 0][1]
        changed = replace(base, **changes)
        made.append(Variant(label, draw(banner, changed), banner, changed))
    return made


def _is_picture(subject: str) -> bool:
    return subject.lower().endswith(PICTURE_ENDINGS) and Path(subject).is_file()


def _is_pack(subject: str) -> bool:
    path = Path(subject) if len(subject) < 1024 else Path()
    return (
        (path / "pack.mcmeta").is_file()
        or (path / "assets").is_dir()
        or (path.suffix.lower() in (".zip", ".jar") and path.is_file())
    )


def _load(path: Path) -> Frame:
    data = read_user_file(path, MAX_PICTURE_FILE, shorter="compare smaller pictures")
    limits = {"max_pixels": MAX_PICTURE_PIXELS, "max_side": MAX_PICTURE_SIDE}
    with opened_picture(data, str(path), **limits) as image:
        return Frame(np.asarray(image.convert("RGBA")))
