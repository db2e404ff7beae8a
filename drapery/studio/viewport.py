"""What the viewer of a tab shows: scenes that the browser plays, or a picture by the renderer.

The server makes a scene when the page asks for its address. What the browser does itself, such as
another design on the flag or a turn of the wind, changes no address.
"""

import hashlib
import math
import threading
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from drapery import Banner, DraperyError, OptionError, __version__
from drapery.banner import write_banner
from drapery.garments import Garment
from drapery.option import Subject
from drapery.packs import Packs, open_packs
from drapery.scenes import find_scene
from drapery.settings import OPTIONS, Settings, applicable
from drapery.studio.art import pattern_names
from drapery.studio.chosen_scene import scene_choice
from drapery.studio.document import Document
from drapery.studio.exports import make
from drapery.studio.pack_store import PackStore
from drapery.studio.played import PlayedScene, SceneFile, built_module, scene_file
from drapery.studio.sketch import banner_of
from drapery.studio.snippets import ExportRequest, subject_of
from drapery.styles import combined_style
from drapery.web.scene_file import MAX_SIDE

LONGEST = 60.0
"""The latest moment of a pause that becomes the picture's `time` [s].

A picture is simulated from the start, so a later moment would take too long.
"""
IN_BROWSER = ("wind", "direction", "view", "daylight")
"""The options that the browser applies to a scene."""
OF_PICTURES = ("time", "size", "samples")
"""The options that a scene does not have."""
BY_VIEW = ("light", "ground")
"""The options whose default depends on the view."""
OF_MOTION = tuple(
    name
    for name, option in OPTIONS.items()
    if name not in OF_PICTURES and not {"motion", "wind", "shape"}.isdisjoint(option.affects)
)
"""The options that decide how the cloth moves."""
SIZE = 480
"""The width and height that the cameras of scenes frame, and the longer side of a picture that
moves [pixels]."""
REDUCED = (("stress", ("side", "7")),)
"""Parameters of scenes that would take too long with their defaults."""


@dataclass(frozen=True)
class ViewportRequest:
    """What the live cloth shows, in addition to the settings of a picture.

    on: whether the wind blows. paused: whether time stands still. scene: a ready-made scene, shown
    in place of the design. garment: the name of a garment, shown in place of the banner. skin: the
    name or path of a skin, whose player is shown with the garment and the design.
    beside: packs for a second view of the design, side by side with the first; None shows only one
    view.
    """

    on: bool = True
    paused: bool = False
    scene: str | None = None
    garment: str | None = None
    skin: str | None = None
    beside: tuple[str | Path, ...] | None = None

    @property
    def shown(self) -> dict[str, str]:
        """What takes the place of the banner, by its kind."""
        found = {"scene": self.scene, "garment": self.garment, "skin": self.skin}
        return {kind: name for kind, name in found.items() if name}


class Viewport:
    """What the viewer of a tab shows.

    request: what it shows. paused_at: the `time` that the last pause has set, or None.
    banner_options: the options of the banner that a garment's replace while it is shown.
    """

    def __init__(self, document: Document, packs: PackStore) -> None:
        self.request = ViewportRequest()
        self.paused_at: float | None = None
        self.banner_options: dict[str, Any] = {}
        self._document = document
        self._pack_store = packs
        self._starts = self._looks = 0
        self._kept: dict[str, PlayedScene | ExportRequest] = {}
        self._playing, self._drawing = threading.Lock(), threading.Lock()  # one at a time of each
        self._beside: tuple[object, Packs] | None = None
        document.on_close(self.close)

    def update(self, **options: Any) -> None:
        """Change the request; notifies "scene" if it differs.

        Raises OptionError or PackError; then nothing changes.
        """
        before, after = self.request, replace(self.request, **options)
        self._open_beside(after.beside)
        self.request = after
        if after != before:
            self._document.notify("scene")

    def reset(self) -> None:
        """Let the cloth hang anew, and reset the camera to the named view."""
        self._starts += 1
        self.look_anew()

    def look_anew(self) -> None:
        """Reset the camera to the named view."""
        self._looks += 1
        self._document.notify("scene")

    def stop_at(self, time: float) -> None:
        """Take the moment of a pause [s] as the picture's `time`, if a picture can show it."""
        if self.request.paused and 0 < time <= LONGEST:
            # Round down: the picture must not make one more step.
            self.paused_at = math.floor(time * 1e6) / 1e6
            self._document.adjust(time=self.paused_at)

    def close(self) -> None:
        """Stop what is drawn, because the tab is closed."""
        self._kept = {}

    @property
    def shown(self) -> dict[str, Any]:
        """What the viewer in the page is told; addresses are relative to the page's.

        scenes, labels: the addresses of the scenes, and their names. pictures: the addresses of
        pictures in place of them, one after the other. note: a line until the last of them is
        drawn. line: a fault.
        design, wind, direction, on, view, daylight: what the browser applies to the scenes.
        starts, cut: another value begins the motion, or the view, anew. motion: another value
        makes another motion.
        """
        request, settings = self.request, self._document.settings
        seen: dict[str, Any] = {
            "scenes": [],
            "labels": [],
            "pictures": [],
            "note": "",
            "line": "",
            "design": None,
            "wind": settings.wind_speed,
            "direction": settings.direction,
            "on": request.on,
            "view": settings.view if isinstance(settings.view, str) else None,
            "daylight": settings.daylight,
            "paused": request.paused,
            "starts": self._starts,
            "motion": repr([getattr(settings, name) for name in OF_MOTION]),
        }
        framed = settings.view, settings.kind, settings.placement, settings.pose, settings.pins
        seen["cut"] = repr((request.shown, *framed, self._looks))
        try:
            seen |= self._addresses()
        except DraperyError as error:
            seen["line"] = self._pack_store.with_names(str(error))
        return seen

    def scene(self, key: str) -> SceneFile:
        """The file of a scene that is shown.

        It blocks, so call it in a thread. Raises DraperyError for what a page cannot play.
        """
        with self._playing:
            return scene_file(key, self._find(key, PlayedScene))

    def shared_scene(self, key: str) -> PlayedScene | None:
        """What the file of a scene is made of that is shown, and is the same for all tabs."""
        found = self._kept.get(key)
        return found if isinstance(found, PlayedScene) and found.is_shared else None

    def picture(self, key: str) -> bytes:
        """The file of a picture that is shown. It blocks, so call it in a thread.

        Raises DraperyError for what cannot be drawn.
        """

        def go_on(_number: int, _last: int) -> None:
            self._find(key, ExportRequest)

        with self._drawing:
            request = self._find(key, ExportRequest)
            path = self._document.folder / f"shown-{key}.{request.kind}"
            make(request, path, go_on, go_on)  # until something else is shown
            data = path.read_bytes()
            path.unlink()
        return data

    def shows(self, key: str) -> bool:
        """Whether what has this key in its address is shown."""
        return key in self._kept

    def _find(self, key: str, kind: type[Any]) -> Any:
        found = self._kept.get(key)
        if not isinstance(found, kind):
            raise OptionError("the page shows something else by now")
        return found

    def _addresses(self) -> dict[str, Any]:
        """The addresses of what is shown, and the design. Raises DraperyError."""
        request, document = self.request, self._document
        settings = document.settings
        design = None if settings.texture is not None else banner_of(document.sketch)
        shown: dict[str, PlayedScene | ExportRequest] = {}
        pictures, moving = self._pictures(design)
        found: dict[str, Any] = {
            "pictures": [self._keep(shown, each, each.kind, each) for each in pictures],
            "design": None if design is None else write_banner(design, "shorthand"),
            "note": moving and f"The {moving} is getting ready.",
        }
        if len(pictures) > 1:  # what does not move needs no player, and a scene is drawn
            subject = subject_of(pictures[0])
            stacks: list[tuple[Packs, object]] = [(document.packs(), settings.packs)]
            beside = self._open_beside(request.beside)
            if beside is not None:
                stacks.append((beside, request.beside))
                found["labels"] = self._captions()
            found["scenes"] = []
            for packs, paths in stacks:
                played = self._played(subject, packs, paths)
                source = played.subject, played.settings, played.patterns, paths, settings.format
                found["scenes"].append(self._keep(shown, played, "bin", source))
        self._kept = shown
        return found

    def _pictures(self, design: Banner | None) -> tuple[list[ExportRequest], str]:
        """What is drawn of what cannot be played, and what of it the user waits for.

        A still, until the animation is there; of a scene only that.
        """
        request, settings = self.request, self._document.settings
        if not request.on:
            settings = settings.changed(wind=0.0)
        small = settings.changed(size=(SIZE, SIZE))
        if request.scene is not None:
            scene = scene_choice(request.scene, design, settings)
            reduced = tuple(word for name, word in REDUCED if name == scene.name)
            scene = replace(scene, words=(*scene.words, *reduced))
            timing = find_scene(scene.name).clip.timing
            film = ExportRequest(design, small, "webp", timing, scene=scene)
            return [film], f"scene {request.scene}"
        still = ExportRequest(design, settings, garment=request.garment, skin=request.skin)
        film = replace(still, settings=small, kind="webp")
        if request.garment or request.skin:
            kind = "garment" if request.garment else "player"
            return [still, film], f"{kind} {Path(request.garment or request.skin or '').stem}"
        kind = design.kind if design else "banner"
        hangs = "wind" in applicable(settings.subject(kind), "loop")
        return [still, film] if hangs else [still], ""

    def _played(self, subject: Banner | Garment | None, packs: Packs, paths: object) -> PlayedScene:
        settings, kind = self._document.settings, Subject("garment")
        if not isinstance(subject, Garment):
            kind = settings.subject(subject.kind if subject else "banner")
        given = {
            name: getattr(settings, name) if name in BY_VIEW else settings.as_given(name)
            for name in applicable(kind, "page")
            if name not in (*IN_BROWSER, *OF_PICTURES)
        }
        if isinstance(subject, Garment):
            return PlayedScene(subject, packs, paths, subject.settings(**given), ())
        own = [layer.pattern for layer in subject.layers] if subject else []
        names = pattern_names(packs)
        side = packs.base_sheet().shape[1]
        # Such a file has the textures of all patterns, so another design needs no other file.
        if subject and not combined_style(settings.style).has("material"):
            if len(names) * side * side <= MAX_SIDE * MAX_SIDE // 2:
                subject, own = Banner(kind=subject.kind), []
            else:
                names = ()
        patterns = tuple(dict.fromkeys((*names, *own)))
        made = Settings(**given, size=(SIZE, SIZE))
        return PlayedScene(subject, packs, paths, made, patterns)

    def _keep(
        self,
        shown: dict[str, PlayedScene | ExportRequest],
        made: PlayedScene | ExportRequest,
        ending: str,
        source: object,
    ) -> str:
        """The address of what can be made. source: all that its content depends on."""
        text = repr((__version__, built_module(), source))
        key = hashlib.sha256(text.encode()).hexdigest()[:24]
        shown[key] = made
        is_shared = isinstance(made, PlayedScene) and made.is_shared
        return (
            f"live/{key}.{ending}" if is_shared else f"live/{self._document.token}/{key}.{ending}"
        )

    def _open_beside(self, paths: tuple[str | Path, ...] | None) -> Packs | None:
        """The packs of the second view; opened again only when they change."""
        if paths is None:
            self._beside = None
            return None
        key = paths, self._document.settings.format
        if self._beside is None or self._beside[0] != key:
            self._beside = key, open_packs(paths, format=key[1])
        return self._beside[1]

    def _captions(self) -> list[str]:
        """The names of the two sides."""
        names = self._pack_store.names
        others = [names.get(str(path), str(path)) for path in self.request.beside or ()]
        return ["your packs", ", ".join(Path(name).name for name in others) or "our own art"]
