"""A design in from any form of text or file, and out in any form."""

from nicegui import context, ui

from drapery.banner.design import Banner
from drapery.banner.formats import write_banner
from drapery.banner.formats.registry import FORMS
from drapery.banner.names import shown as quoted
from drapery.errors import DesignError
from drapery.studio.components import value_of
from drapery.studio.notices import tell
from drapery.studio.selection import desk_of
from drapery.studio.session import Session
from drapery.studio.sketch import banner_of, sketch_of
from drapery.studio.upload_queue import MAX_FOUND, UploadQueue, incoming_of
from drapery.studio.widgets import button, words
from drapery.studio.words import in_words

_PLACEHOLDER = (
    "Paste a /give command, an item, JSON, the address of a banner editor,"
    " or write: white creeper:lime"
)


def build(session: Session) -> None:
    """Fields to read from and to copy from."""
    _reader(session)
    _writer(session)


def _reader(session: Session) -> None:
    incoming = incoming_of(session)
    words("Read a design", "h2").classes("heading")
    text = ui.element("textarea").classes("field code").props('id="design-text" rows=4')
    text.props.update({"placeholder": _PLACEHOLDER, "aria-label": "A design in any form"})
    fault = words("", "p").classes("fault").props('role="alert"')
    with ui.element("div").classes("line"):
        press = button("Read this text", lambda: None, text="Read", key="Ctrl+Enter")
        press.classes("primary").props('id="read-text"')
        with ui.element("label").classes("button file"):
            ui.icon("upload_file").props("aria-hidden=true")
            words("Choose a file")
            chooser = ui.element("input").props('id="design-file" type="file"')
            chooser.props.update({"aria-label": "A file of designs"})
    words(
        "Or drop a file anywhere: schematics, structures, regions, saves, functions.", "p"
    ).classes("hint")
    listed = ui.element("div").classes("found-list")
    text.on(
        "read",
        lambda event: incoming.read_text(str(value_of(event)), beside=True),
        js_handler="(e) => emit(e.detail)",
    )
    client = context.client

    def arrive() -> None:
        with client:
            _arrive(session, incoming)
            fault.set_text(incoming.line)
            fault.set_visibility(bool(incoming.line))
            listed.clear()
            with listed:
                _choices(session, incoming)

    fault.set_visibility(False)
    incoming.listen(arrive)


def _arrive(session: Session, incoming: UploadQueue) -> None:
    for note in incoming.notes:
        tell(note, "warning")
    if incoming.line:
        # Beside the field the line stands already.
        if not incoming.beside:
            tell(incoming.line, "fault")
    elif len({found.banner for found in incoming.found}) == 1:
        _lay_out(session, incoming.found[0].banner)
    else:
        ui.run_javascript("studio.tab('text')")
        tell(f"{len(incoming.found)} banners in {incoming.name or 'the text'}: choose one")


def _lay_out(session: Session, banner: Banner) -> None:
    sketch = sketch_of(banner, session.sketch.title)
    desk_of(session).lay_out(sketch)
    count = len(sketch.strokes)
    tell(f"Read a {sketch.kind} of {count} layer{'' if count == 1 else 's'}")


def _choices(session: Session, incoming: UploadQueue) -> None:
    if len({found.banner for found in incoming.found}) < 2:
        return
    for number, found in enumerate(incoming.found[:MAX_FOUND]):
        label = f"{number + 1}: {in_words(sketch_of(found.banner))}"
        choice = ui.element("button").classes("found").props("type=button")
        choice.props.update({"aria-label": label, "title": label})
        choice.on("click", lambda banner=found.banner: _lay_out(session, banner))
        with choice:
            picture = ui.element("img").props('alt="" loading="lazy" width=30 height=60')
            picture.props["src"] = f"/found/{session.token}/{number}.png?v={id(incoming.found):x}"
            words(quoted(found.where, 60).strip("'") or f"Banner {number + 1}")
    if len(incoming.found) > MAX_FOUND:
        words(f"The first {MAX_FOUND} of {len(incoming.found)}.", "p").classes("hint")


def _writer(session: Session) -> None:
    words("Write the design", "h2").classes("heading")
    forms = {name: form.title for name, form in FORMS.items() if form.write is not None}
    with ui.element("div").classes("line"):
        choice = ui.element("select").classes("field grow").props('aria-label="Form of the text"')
        with choice:
            for name, title in forms.items():
                option = words(f"{name}: {title}", "option")
                option.props.update({"value": name, "selected": name == "give"})
        copy = button("Copy the text", lambda: None, icon="content_copy").classes("primary")
        with copy:
            words("Copy").classes("copy-words")
        copy.props('data-copy="written"')
    written = ui.element("textarea").classes("field code").props('id="written" rows=6 readonly')
    written.props.update({"aria-label": "The design as text", "spellcheck": "false"})
    form = "give"

    def show() -> None:
        try:
            text, fault = write_banner(banner_of(session.sketch), form), False
        except DesignError as error:
            text, fault = str(error), True
        written.props["value"] = text
        written.classes(add="is-fault" if fault else "", remove="" if fault else "is-fault")
        copy.props["disabled"] = fault
        for element in (written, copy):
            element.update()

    def choose(name: object) -> None:
        nonlocal form
        form = str(name)
        show()

    choice.on(
        "change", lambda event: choose(value_of(event)), js_handler="(e) => emit(e.target.value)"
    )
    show()
    session.listen("sketch", show)
