"""Minecraft banners as pictures of real cloth.

    from drapery import Banner, draw

    draw(Banner.parse("white creeper:lime border:black"), view="hero").save("banner.png")

`drapery.banner` reads and writes designs and composites their sheets, `drapery.packs` opens
resource packs and makes them in memory, `drapery.cloth` simulates cloth, `drapery.style` gives a
simulated cloth its thickness and textures, `drapery.styles` changes how it looks, `drapery.render`
draws meshes, `drapery.garments` cuts garments and dresses players, `drapery.scenes` hangs cloth
before a camera and plays ready-made scenes, `drapery.comparison` and `drapery.sheets` compare and
list pictures, `drapery.match` finds designs that look like a picture, `drapery.batch` draws a
manifest of pictures, `drapery.testing` checks pictures against golden ones, `drapery.arrays` names
the types of arrays. Names are loaded when they are first used.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from drapery.lazy import import_lazily

if not Path(__path__[0], "render").is_dir():
    # In a checkout `assets` and `render` lie beside this package, and Python that is started there
    # finds it before the package that is installed.
    __path__.append(str(Path(__path__[0]).parent))

if TYPE_CHECKING:
    from drapery.banner.design import Banner as Banner, Layer as Layer
    from drapery.banner.formats import (
        FoundBanner as FoundBanner,
        parse_banners as parse_banners,
        read_designs as read_designs,
    )
    from drapery.banner.packs import Packs as Packs
    from drapery.cloth import simulate as simulate
    from drapery.comparison.pairs import Comparison as Comparison, compare as compare
    from drapery.errors import (
        BackendError as BackendError,
        DesignError as DesignError,
        DraperyError as DraperyError,
        OptionError as OptionError,
        OutputError as OutputError,
        PackError as PackError,
    )
    from drapery.pictures import (
        animate as animate,
        draw as draw,
        draw_face as draw_face,
        iter_frames as iter_frames,
        save_model as save_model,
    )
    from drapery.render.frame import Animation as Animation, Frame as Frame
    from drapery.settings import Settings as Settings
    from drapery.style.extrusion import extrude as extrude
    from drapery.version import __version__ as __version__
else:
    import_lazily(__name__)
