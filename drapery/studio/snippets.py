"""The command or the Python code that makes the same file as an export."""

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, astuple, dataclass, field, replace
from pathlib import Path
from typing import Any

from drapery import Banner, Settings
from drapery.banner import write_banner
from drapery.errors import quoted
from drapery.file_formats import formats_of
from drapery.garments import (
    Garment,
    PlayerSettings,
    find_garment,
    player_of,
)
from drapery.option import Option, Output, Subject
from drapery.player_settings import PLAYER_OPTIONS
from drapery.scenes import Clip, SceneEntry, find_scene
from drapery.settings import LOOP_OPTIONS, NAMED_OPTIONS, OPTIONS, LoopSettings
from drapery.studio.chosen_scene import SceneChoice

FORMATS = {
    each.ending[1:]: each for each in formats_of("still", "loop", "model", "page") if each.single
}
"""The formats of exports by their endings, without the dot."""
KINDS = (*FORMATS, "face", "json")
"""The kinds of files: endings, `face`, the flat face without cloth, and `json`, the design."""
STILLS = tuple(kind for kind, format in FORMATS.items() if format.kind() == "still")
LOOPS = tuple(kind for kind, format in FORMATS.items() if format.kind() == "loop")
MODELS = tuple(kind for kind, format in FORMATS.items() if format.kind() == "model")
MOVING = (*LOOPS, *(kind for kind in MODELS if FORMATS[kind].moving))
"""The kinds that have a length."""

FILE_OPTIONS: Mapping[str, Option] = {
    **NAMED_OPTIONS,
    **LOOP_OPTIONS,
    "scale": Option(
        "scale",
        "Pixels of a texel",
        int,
        8,
        bounds=(1, 256),
        unit="pixels",
        affects=("surface",),
        not_for=("still", "loop", "model", "page"),
    ),
}
"""The options of all files: of pictures, of animations, and `--scale` of `drapery flat`."""
OUTPUTS: dict[str, tuple[Output, ...]] = {
    **dict.fromkeys(STILLS, ("still",)),
    **dict.fromkeys(LOOPS, ("loop",)),
    **{kind: ("model", "loop" if kind in MOVING else "still") for kind in MODELS},
    "face": ("face",),
    "html": ("page",),
}
"""What each kind of file is for the table of options: a 3-D file holds a loop or one pose, and a
design has no options."""

CAPES = ("cape", "elytra")
"""Garments that show the design although their own texture is another."""


@dataclass(frozen=True)
class ExportRequest:
    """The description of a file to make.

    kind: one of KINDS. timing: of a loop. scale: pixels per texel, for a face.
    garment: the name or the file of a garment, which is drawn in place of the banner. scene: a
    ready-made scene, which pictures and animations show in place of the banner. skin: the name or
    the file of a skin, whose player wears the garment and has the design on its head or shield.
    """

    banner: Banner | None
    settings: Settings
    kind: str = "png"
    timing: LoopSettings = field(default_factory=LoopSettings)
    scale: int = FILE_OPTIONS["scale"].default
    garment: str | None = None
    scene: SceneChoice | None = None
    skin: str | None = None


def scene_of(request: ExportRequest) -> SceneChoice | None:
    """The scene that the file shows; a model, a face, a page and a design are of the banner."""
    return request.scene if request.kind in (*STILLS, *LOOPS) else None


def scene_clip(request: ExportRequest, scene: SceneEntry) -> Clip:
    """The size and length of a picture or an animation of a scene."""
    size = request.settings.size
    if request.kind in STILLS:
        return replace(scene.clip, size=size)
    return Clip.timed(size, request.timing)


def subject_of(request: ExportRequest) -> Banner | Garment | None:
    """What is drawn: the banner, or a garment, with the banner as its design if it shows one."""
    found = drawn_garment(request)
    if found is None:
        return request.banner
    design = _design_on(request)
    return found if design is None else found.with_design(design)


def drawn_garment(request: ExportRequest) -> Garment | None:
    """The garment or player that is drawn; a face, a page and a design are of the banner.

    Raises OptionError for a garment or a skin that cannot be read.
    """
    player = _player(request)
    if player is not None:
        return player_of(player)
    if request.garment is None or request.kind in ("face", "html", "json"):
        return None
    return find_garment(request.garment)


def _player(request: ExportRequest) -> PlayerSettings | None:
    """The player that is drawn; None without a skin, and for a garment that no player wears."""
    if request.skin is None or request.kind in ("face", "html", "json"):
        return None
    if request.garment is not None:
        wearer = find_garment(request.garment).wearer
        if wearer is None or wearer.kind != "player":
            return None
    player = PlayerSettings(skin=request.skin)
    if request.garment is not None:
        player = replace(player, wear=(request.garment,))
    if request.banner is None:
        return player
    text = write_banner(request.banner, "shorthand")
    if request.garment is not None and _shows_design(request.garment):
        player = replace(player, worn_design=text)
    if request.banner.kind == "shield":
        return replace(player, shield=text)
    return replace(player, head=text)


def _player_words(player: PlayerSettings, called: Mapping[str, str]) -> dict[str, Any]:
    """The options of a player that differ from their default, with the user's names of files."""
    names = ("skin", "wear", "head", "worn_design", "shield")
    words = {name: getattr(player, name) for name in names}
    words["skin"] = called.get(player.skin, player.skin)
    words["wear"] = [_garment_name(each, called) for each in player.wear]
    return {name: value for name, value in words.items() if value}


def _garment_name(garment: str, called: Mapping[str, str]) -> str:
    """The name of a garment of the package, or the name of a file of the user."""
    return called.get(garment, Path(garment).name)


def _design_on(request: ExportRequest) -> Banner | None:
    """The design on a garment, if it shows one; a player has its own options for that."""
    if request.garment is None or _player(request) is not None:
        return None
    return request.banner if _shows_design(request.garment) else None


def _shows_design(garment: str) -> bool:
    """Whether a garment shows the design of the page."""
    return garment in CAPES or find_garment(garment).shows_design


def file_name(request: ExportRequest, stem: str = "banner") -> str:
    """The name of the file, for example `banner.png`."""
    return f"{stem}.{'png' if request.kind == 'face' else request.kind}"


def options_for(request: ExportRequest) -> Settings:
    """The options of this kind of file; the others have their default."""
    given = _values(request)
    found = drawn_garment(request)
    return Settings(**given) if found is None else found.settings(**given)


def as_command(
    request: ExportRequest, called: Mapping[str, str] | None = None, stem: str = "banner"
) -> str:
    """The command that writes the file, quoted for a shell.

    called: the user's names of packs, by path.
    """
    if scene := scene_of(request):
        return _scene_command(request, scene, stem)
    found, player = drawn_garment(request), _player(request)
    banner = request.banner if found is None else _design_on(request)
    design = [] if banner is None else [quoted(write_banner(banner, "shorthand"))]
    out = quoted(file_name(request, stem))
    if request.kind == "json":
        return " ".join(["drapery show", *design, "--as json", ">", out])
    command = _COMMANDS[OUTPUTS[request.kind][0]]
    if player is not None:
        command, design = "player", [*_player_flags(player, called or {})]
    elif found is not None:
        command = f"garment {quoted(_garment_name(str(request.garment), called or {}))}"
        design = ["--design", *design] if design else []
    words = [f"drapery {command}", *design, "-o", out]
    words += [quoted(word) for word in _flags(request, called or {})]
    return " ".join(words)


def as_python(
    request: ExportRequest, called: Mapping[str, str] | None = None, stem: str = "banner"
) -> str:
    """Lines of Python that write the file."""
    if scene := scene_of(request):
        return _scene_python(request, scene, stem)
    found, out = drawn_garment(request), _text(file_name(request, stem))
    banner = [] if found is None and request.banner is None else ["banner"]
    settings = _keywords(_changed(request, called or {}))
    named = [*_keywords(file_values(request)), *settings]
    imported, line = _PYTHON[OUTPUTS[request.kind][0] if request.kind in OUTPUTS else request.kind]
    subject = banner or ["None"]
    words = {"drawn": banner + named, "model": [*subject, out, *named], "settings": settings}
    joined = {name: ", ".join(each) for name, each in words.items()}
    names, lines = imported.split(), [line.format(out=out, subject=subject[0], **joined)]
    if player := _player(request):
        given = ", ".join(_keywords(_player_words(player, called or {})))
        names += ["drapery.garments.PlayerSettings", "drapery.garments.player_of"]
        lines = [f"banner = player_of(PlayerSettings({given}))", *lines]
    elif found is not None:
        design = _design_on(request)
        text = "" if design is None else f".with_design({_text(write_banner(design, 'shorthand'))})"
        names += ["drapery.garments.find_garment"]
        name = _garment_name(str(request.garment), called or {})
        lines = [f"banner = find_garment({_text(name)}){text}", *lines]
    elif request.banner is not None:
        names += ["drapery.Banner"]
        text = _text(write_banner(request.banner, "shorthand"))
        lines = [f"banner = Banner.parse({text})", *lines]
    return "\n".join([*_imports(names), "", *lines, ""])


def _player_flags(player: PlayerSettings, called: Mapping[str, str]) -> Iterator[str]:
    for name, value in _player_words(player, called).items():
        for each in value if isinstance(value, list) else (value,):
            yield from (PLAYER_OPTIONS[name].command_flag, quoted(each))


def _scene_command(request: ExportRequest, scene: SceneChoice, stem: str) -> str:
    words = ["drapery scene", scene.name, "-o", quoted(file_name(request, stem))]
    if request.kind in LOOPS:
        for name, value in asdict(request.timing).items():
            words += [LOOP_OPTIONS[name].command_flag, plain(value)]
    words += ["--size", "x".join(map(str, request.settings.size))]
    for style in style_names_of(request):
        words += ["--style", quoted(style)]
    for name, value in scene.words:
        words += ["--set", quoted(f"{name}={value}")]
    return " ".join(words)


def _scene_python(request: ExportRequest, scene: SceneChoice, stem: str) -> str:
    clip, out = scene_clip(request, find_scene(scene.name)), _text(file_name(request, stem))
    style = f", style={list(style_names_of(request))!r}" if style_names_of(request) else ""
    still = request.kind in STILLS
    lines = [
        "from drapery.scenes import Clip, find_scene, scene_frames",
        "",
        f"scene = find_scene({_text(scene.name)})",
        f"parameters = scene.parameters({dict(scene.words)!r})",
        f"clip = Clip({', '.join(map(plain, astuple(clip)))})",
        f"frames = scene_frames(scene, parameters, clip{', last=True' if still else ''}{style})",
        f"next(frames).save({out})"
        if still
        else f"save_animation(frames, {plain(clip.fps)}, {out}, total={clip.count})",
        "",
    ]
    return "\n".join(lines if still else ["from drapery.render import save_animation", *lines])


def style_names_of(request: ExportRequest) -> tuple[str, ...]:
    """The styles of the settings, as names or paths."""
    style = request.settings.style
    return tuple(map(str, style if isinstance(style, tuple) else (style,)))


_COMMANDS = {
    "still": "render",
    "loop": "animate",
    "model": "model",
    "face": "flat",
    "page": "web",
}


def option_names(request: ExportRequest) -> tuple[str, ...]:
    """The names of the FILE_OPTIONS that apply to the file.

    Raises OptionError for a garment or a skin that cannot be read.
    """
    if request.kind not in OUTPUTS:
        return ()
    if drawn_garment(request) is not None:
        subject = Subject("player")  # its cape has the studio's texture
    else:
        subject = request.settings.subject(request.banner.kind if request.banner else "banner")
    return tuple(
        name
        for name, option in FILE_OPTIONS.items()
        if all(option.applies(subject, output) for output in OUTPUTS[request.kind])
    )


def _values(request: ExportRequest) -> dict[str, Any]:
    """The options of the picture that apply to the file, by name."""
    names = (name for name in option_names(request) if name in OPTIONS)
    return {name: request.settings.as_given(name) for name in names}


def _changed(request: ExportRequest, called: Mapping[str, str]) -> dict[str, Any]:
    """This kind's options that differ from their default, or from those of the garment's file;
    packs have the user's names."""
    values = _values(request)
    found = drawn_garment(request)
    default = Settings() if found is None else found.settings()
    changed = {
        name: value
        for name, value in values.items()
        if value != default.as_given(name) and (value is not None or found is None)
    }
    if "packs" in changed:
        changed["packs"] = [called.get(str(pack), str(pack)) for pack in changed["packs"]]
    if "texture" in changed:
        changed["texture"] = str(changed["texture"])
    return changed


def file_values(request: ExportRequest) -> dict[str, Any]:
    """The options that affect only the file, apply to it and differ from their default, by name."""
    if request.kind == "html":
        return {"size": request.settings.size}  # the command has another default
    numbers = {**asdict(request.timing), "scale": request.scale}
    chosen = {name: numbers[name] for name in option_names(request) if name in numbers}
    return {name: value for name, value in chosen.items() if value != FILE_OPTIONS[name].default}


def _flags(request: ExportRequest, called: Mapping[str, str]) -> Iterator[str]:
    for name, value in (file_values(request) | _changed(request, called)).items():
        option = FILE_OPTIONS[name]
        flag = option.command_flag
        if option.several:
            for each in value:
                yield from (flag, each)
        elif value is True:
            yield flag
        else:
            yield from (flag, option.to_text(value) if option.parts else plain(value))


def plain(value: object) -> str:
    """The value in short form: 4 for 4.0; without rounding."""
    return repr(value).removesuffix(".0") if isinstance(value, float) else str(value)


def _text(value: object) -> str:
    """The value as Python code; strings have double quotes."""
    if isinstance(value, list):
        return f"[{', '.join(map(_text, value))}]"
    return json.dumps(value, ensure_ascii=False) if isinstance(value, str) else repr(value)


def _keywords(values: Mapping[str, Any]) -> list[str]:
    """Keyword arguments as Python code, for example `view="iso"`."""
    return [f"{name}={_text(value)}" for name, value in values.items()]


def _imports(names: list[str]) -> list[str]:
    """Import lines for full names, one line for each module."""
    modules: dict[str, list[str]] = {}
    for name in sorted(names):
        module, _, short = name.rpartition(".")
        modules.setdefault(module, []).append(short)
    return [f"from {module} import {', '.join(modules[module])}" for module in modules]


_PYTHON = {
    "still": ("drapery.draw", "draw({drawn}).save({out})"),
    "loop": ("drapery.animate", "animate({drawn}).save({out})"),
    "face": ("drapery.draw_face", "draw_face({drawn}).save({out})"),
    "model": ("drapery.save_model", "save_model({model})"),
    "page": (
        "pathlib.Path drapery.Settings drapery.web.page.write_page",
        "write_page(Path({out}), {subject}, Settings({settings}))",
    ),
    "json": (
        "drapery.banner.write_banner pathlib.Path",
        'Path({out}).write_text(write_banner(banner) + "\\n")',
    ),
}
"""What each kind of file imports, and the line that writes it."""
