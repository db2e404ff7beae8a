"""Cloth as data: garments, flags, sails and tents as files of TOML or objects of Python.

```python
from drapery import draw
from drapery.garments import find_garment

draw(find_garment("cape"), size=(320, 480)).save("cape.png")
```

A `Garment` has pieces of cloth, seams, pins and a wearer; `Garment.load` reads a file, whose
fields the guide to garments lists. Names are imported when they are first used.
"""

from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if TYPE_CHECKING:
    from drapery.garments.assembly import SewnCloth as SewnCloth, tailor as tailor
    from drapery.garments.catalogue import (
        find_garment as find_garment,
        garment_names as garment_names,
    )
    from drapery.garments.model import (
        ClothTexture as ClothTexture,
        DiscPiece as DiscPiece,
        Garment as Garment,
        GarmentBlock as GarmentBlock,
        GarmentMesh as GarmentMesh,
        GarmentPin as GarmentPin,
        GarmentPole as GarmentPole,
        GarmentSeam as GarmentSeam,
        GarmentWearer as GarmentWearer,
        GridPiece as GridPiece,
        PolygonPiece as PolygonPiece,
        RingPiece as RingPiece,
        StripPiece as StripPiece,
    )
    from drapery.garments.motions import motion_names as motion_names
    from drapery.garments.players import (
        check_skin as check_skin,
        dressed_player as dressed_player,
        make_wearer as make_wearer,
        player_of as player_of,
        skin_names as skin_names,
    )
    from drapery.garments.profiles import (
        is_profile_file as is_profile_file,
        is_profile_text as is_profile_text,
    )
    from drapery.player_settings import PlayerSettings as PlayerSettings
else:
    import_lazily(__name__)
