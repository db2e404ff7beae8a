"""The variants to compare: designs, packs, layer modes, backends, or finished pictures."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery.comparison.metrics import eight_bits
from drapery.comparison.picture import Picture, as_picture, read_picture
from drapery.errors import OptionError
from drapery.file_formats import endings_read
from drapery.render import Frame
from drapery.settings import Options, Settings

# What draws and reads designs is imported where it is used: pictures are compared without it.
if TYPE_CHECKING:
    from drapery.banner.design import Banner
    from drapery.styles import StyleLike

Axes = dict[str, list[tuple[str, dict[str, Any]]]]
"""The values of each thing that may vary: their labels, and the settings that they change."""


@dataclass(frozen=True)
class Variant:
    """One variant of a comparison: its label, its picture, and how to draw its first layers.

    label: its name in the comparison.
    picture: the whole picture.
    banner: the design; None for a finished picture.
    settings: how it is drawn; None for a finished picture.
    """

    label: str
    picture: Picture
    banner: "Banner | None" = None
    settings: Settings | None = None

    def with_layers(self, count: int) -> Frame:
        """The picture with the first `count` layers; a finished picture has no others."""
        if self.banner is None:
            return self.frame
        return self.drawn(replace(self.banner, layers=self.banner.layers[:count]))

    def drawn(self, banner: "Banner") -> Frame:
        """Another design with the same options."""
        from drapery.pictures import draw

        return draw(banner, self.settings)

    @property
    def frame(self) -> Frame:
        """The picture, or the first frame of a loop, with 8 bits a channel."""
        return Frame(eight_bits(self.picture.frames[0]))


def variant_of(
    label: str, subject: "Banner | Frame", settings: Settings | None, options: Options
) -> Variant:
    """A design drawn with these options, or a finished picture. Raises the errors of `draw`."""
    if isinstance(subject, Frame):
        return Variant(label, as_picture(subject))
    from drapery.pictures import draw

    chosen = (settings or Settings()).changed(**options)
    return Variant(label, as_picture(draw(subject, chosen)), subject, chosen)


def draw_variants(
    subjects: Sequence[str],
    settings: Settings,
    layer_modes: Sequence[str] = (),
    backends: Sequence[str] = (),
    styles: "Sequence[StyleLike]" = (),
    *,
    form: str | None = None,
    number: int | None = None,
) -> list[Variant]:
    """Draw the variants of a comparison.

    subjects: two or more pictures; or one or more designs, and packs to draw them with.
    settings: the options of all pictures that are drawn.
    layer_modes: one for each variant; empty for the one of the settings.
    backends: one for each variant; empty for the one of the settings.
    styles: one for each variant; empty for those of the settings.
    form: of the designs, see `drapery.banner.parse_banner`.
    number: which banner to use, from 1, if a text holds several.

    Raises OptionError unless exactly one of designs, packs, layer modes, backends and styles
    varies.
    """
    pictures = [subject for subject in subjects if is_picture(subject)]
    if pictures:
        if len(pictures) < len(subjects) or len(pictures) < 2:
            raise OptionError(f"{pictures[0]} is a picture; compare it only with other pictures")
        return [Variant(Path(p).name, read_picture(Path(p))) for p in pictures]
    from drapery.styles import find_style

    packs = [subject for subject in subjects if is_pack(subject)]
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


def _banner(text: str, form: str | None, number: int | None) -> "Banner":
    from drapery.banner.formats import read_designs
    from drapery.banner.formats.registry import choose_banner

    found = read_designs(text, form=form)
    return choose_banner(found, number if len(found) > 1 else None)


def _drawn(
    banners: "list[tuple[str, Banner]]",
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
    base = settings.changed(**fixed)
    ((axis, values),) = varied.items()
    from drapery.pictures import draw

    made = []
    for number, (label, changes) in enumerate(values):
        banner = banners[number if axis == "designs" else 0][1]
        changed = base.changed(**changes)
        made.append(Variant(label, as_picture(draw(banner, changed)), banner, changed))
    return made


def is_picture(subject: str) -> bool:
    """Whether a text is the path of a picture that can be compared."""
    return subject.lower().endswith(endings_read()) and Path(subject).is_file()


def is_pack(subject: str) -> bool:
    """Whether a text is the path of a resource pack."""
    path = Path(subject) if len(subject) < 1024 else Path()
    return (
        (path / "pack.mcmeta").is_file()
        or (path / "assets").is_dir()
        or (path.suffix.lower() in (".zip", ".jar") and path.is_file())
    )
