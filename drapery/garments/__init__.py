"""Cloth as data: garments, flags, sails and tents as files of TOML or objects of Python.

```python
from drapery import draw
from drapery.garments import find_garment

draw(find_garment("cape"), size=(320, 480)).save("cape.png")
```

A `Garment` has pieces of cloth, seams, pins and a wearer; `Garment.load` reads a file. See
`docs/guides/garments.md`. Names are imported when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import lazy_names

if TYPE_CHECKING:
    from drapery.garments.assembly import SewnCloth, SewnPiece, tailor
    from drapery.garments.catalogue import find_garment, garment_names
    from drapery.garments.model import (
        ClothTexture,
        DiscPiece,
        Garment,
        GarmentBlock,
        GarmentMesh,
        GarmentPin,
        GarmentPole,
        GarmentSeam,
        GarmentWearer,
        GridPiece,
        PolygonPiece,
        RingPiece,
        StripPiece,
    )
    from drapery.garments.motions import motion_names
    from drapery.garments.players import (
        check_skin,
        dressed_player,
        make_wearer,
        player_of,
        skin_names,
    )
    from drapery.garments.profiles import is_profile_file, is_profile_text
    from drapery.player_settings import PlayerSettings

__all__ = [
    "ClothTexture",
    "DiscPiece",
    "Garment",
    "GarmentBlock",
    "GarmentMesh",
    "GarmentPin",
    "GarmentPole",
    "GarmentSeam",
    "GarmentWearer",
    "GridPiece",
    "PlayerSettings",
    "PolygonPiece",
    "RingPiece",
    "SewnCloth",
    "SewnPiece",
    "StripPiece",
    "check_skin",
    "dressed_player",
    "find_garment",
    "garment_names",
    "is_profile_file",
    "is_profile_text",
    "make_wearer",
    "motion_names",
    "player_of",
    "skin_names",
    "tailor",
]

__getattr__, __dir__ = lazy_names(
    __name__,
    {
        "garments.catalogue": ("find_garment", "garment_names"),
        "garments.model": (
            "ClothTexture",
            "DiscPiece",
            "Garment",
            "GarmentBlock",
            "GarmentMesh",
            "GarmentPin",
            "GarmentPole",
            "GarmentSeam",
            "GarmentWearer",
            "GridPiece",
            "PolygonPiece",
            "RingPiece",
            "StripPiece",
        ),
        "garments.motions": ("motion_names",),
        "garments.players": (
            "check_skin",
            "dressed_player",
            "make_wearer",
            "player_of",
            "skin_names",
        ),
        "garments.profiles": ("is_profile_file", "is_profile_text"),
        "player_settings": ("PlayerSettings",),
        "garments.assembly": ("SewnCloth", "SewnPiece", "tailor"),
    },
)
