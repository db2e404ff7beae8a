"""`drapery gallery`: every ready-made scene as an animation, and an index page."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from drapery.commands import options as o
from drapery.commands.notices import compile_notice, progress
from drapery.file_formats import formats_of

if TYPE_CHECKING:
    from drapery.scenes import SceneEntry

_PAGE = """<!doctype html>
<html lang="en">
<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<title>Drapery: the scenes</title>
<style>
  html { color-scheme: light dark; background: Canvas; color: CanvasText; }
  body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 84rem;
         padding: 0 1rem; }
  main { display: grid; gap: 2rem; margin-top: 1rem;
         grid-template-columns: repeat(auto-fill, minmax(min(20rem, 100%), 1fr)); }
  h2 { margin: .4rem 0 0; font-size: 1.05rem; }
  p { margin: .1rem 0; }
  img, video { width: 100%; display: block; image-rendering: pixelated; border-radius: 4px; }
  code { background: light-dark(#eeeeea, #2c2c30); padding: .1rem .3rem; border-radius: 3px; }
</style>
<h1>The scenes</h1>
<p>Each is one command; <code>drapery scene NAME</code> alone lists its parameters.</p>
<main>
{% for scene in scenes %}
<section>
{% if is_video %}
<video autoplay loop muted playsinline src="{{ scene.file }}"></video>
{% else %}
<img alt="{{ scene.summary }}" src="{{ scene.file }}" loading="lazy">
{% endif %}
<h2>{{ scene.name }}</h2>
<p>{{ scene.summary }}</p>
<p><code>drapery scene {{ scene.name }} -o {{ scene.file }}</code></p>
</section>
{% endfor %}
</main>
</html>
"""
KINDS = {
    each.ending[1:]: each for each in formats_of("loop") if each.single and each.kind() == "loop"
}


@o.pictured("loop", without=(*o.OF_PICTURES, "fps"))
def run(
    out: Annotated[Path, typer.Option("-o", "--out", metavar="DIR", help="A folder.")],
    names: Annotated[
        list[str] | None,
        typer.Argument(metavar="[NAME]...", help="Some scenes only.", show_default="all"),
    ] = None,
    seconds: Annotated[
        float | None, typer.Option(help="Length of each in seconds.", show_default="its own")
    ] = None,
    kind: Annotated[str, typer.Option("--as", help=f"One of {', '.join(KINDS)}.")] = "gif",
    size: o.SizeOption = "480x480",
    backend: o.BackendOption = "auto",
    **words: Any,
) -> None:
    """Make the gallery: all scenes, and an index page."""
    from drapery.option import one_of
    from drapery.output_files import replacing
    from drapery.scenes import find_scene, scene_names
    from drapery.settings import OPTIONS

    one_of("as", kind, tuple(KINDS))
    scenes = [find_scene(name) for name in names or scene_names()]
    pixels = OPTIONS["size"].parse(size)
    timed = o.loop_options_of({"seconds": seconds, **words})
    _make_folder(out)
    entries = []
    for scene in scenes:
        file = f"{scene.name}.{kind}"
        _play(scene, out / file, pixels, timed, backend)
        entries.append({"name": scene.name, "summary": scene.summary, "file": file})
    is_video = KINDS[kind].media_type.startswith("video/")
    with replacing(out / "index.html") as page:
        page.write_text(_rendered(entries, is_video), encoding="utf-8")


def _play(
    scene: "SceneEntry",
    target: Path,
    size: tuple[int, int],
    timed: Mapping[str, Any],
    backend: str,
) -> None:
    """Write a scene as an animation. timed: the options of a loop that are given, by name."""
    from dataclasses import replace

    from drapery.render import save_animation
    from drapery.render.encode import check_target
    from drapery.scenes import Clip, scene_frames

    check_target(target, "loop")
    clip = Clip.timed(size, replace(scene.clip.timing, **timed))
    with compile_notice(), progress(scene.name, clip.count) as tick:
        frames = scene_frames(scene, scene.parameters(), clip, backend)
        save_animation(frames, clip.fps, target, total=clip.count, progress=tick)


def _rendered(entries: list[dict[str, str]], is_video: bool) -> str:
    from jinja2 import Environment

    return Environment(autoescape=True).from_string(_PAGE).render(scenes=entries, is_video=is_video)


def _make_folder(out: Path) -> None:
    from drapery.errors import OutputError

    try:
        out.mkdir(parents=True, exist_ok=True)
    except OSError as fault:
        raise OutputError(f"{out}: {fault.strerror}; name a folder to write in") from fault
