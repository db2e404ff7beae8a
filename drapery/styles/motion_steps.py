"""Steps that change how cloth moves: the positions of all moments of a picture or loop."""

from dataclasses import replace
from typing import Annotated

import numpy as np
from pydantic import Field

from drapery.styles.sheet import Sheet


def hold(
    sheet: Sheet,
    *,
    every: Annotated[int, Field(ge=1, le=60, description="frames that show one pose")] = 2,
) -> Sheet:
    """Show each pose for several frames, as hand-drawn animation does. A still does not change."""
    at = np.arange(len(sheet.positions)) // every * every
    return replace(sheet, positions=sheet.positions[at])
