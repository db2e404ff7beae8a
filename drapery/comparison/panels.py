"""Pictures that show where two pictures differ, alone or beside both of them."""

import numpy as np

from drapery.comparison.metrics import errors
from drapery.render import Frame, Pixels, contact_sheet, enlarge, on_checker


def difference_panel(expected: Pixels, actual: Pixels, gain: int = 8) -> Pixels:
    """The expected picture in faint grey with errors in red, multiplied by `gain`."""
    worst = errors(expected, actual).astype(np.int32)
    luminance = on_checker(expected)[..., :3].astype(np.int32).mean(axis=-1)
    faint = (210 + luminance * 45 / 255).astype(np.int32)
    strength = np.where(worst > 0, np.clip(worst * gain, 96, 255), 0)
    red = np.where(worst > 0, 255 - strength // 8, faint)
    rest = np.where(worst > 0, 224 - strength * 224 // 255, faint)
    panel = np.stack([red, rest, rest, np.full_like(red, 255)], axis=-1)
    return panel.astype(np.uint8)


def side_by_side(
    expected: Pixels, actual: Pixels, labels: tuple[str, str] = ("expected", "actual")
) -> Frame:
    """Both pictures and their difference; small pictures are enlarged."""
    scale = max(1, 256 // max(expected.shape[:2]))
    panels = (expected, actual, difference_panel(expected, actual))
    named = zip((*labels, "difference"), panels, strict=True)
    return contact_sheet([(label, enlarge(Frame(panel), scale).pixels) for label, panel in named])
