"""A text that is copied by one click."""

from collections.abc import Callable

from nicegui import ui

from drapery.studio.notices import tell

_COPY = """
async (event) => {
  const field = event.target.closest(".copy").querySelector("textarea, input");
  try {
    await navigator.clipboard.writeText(field.value);
  } catch {
    // Without https, from another machine, browsers keep their clipboard to the old way.
    field.select();
    document.execCommand("copy");
  }
  emit();
}
"""


def copy_field(label: str, *, rows: int = 1) -> Callable[[str], None]:
    """A field to read, with a button that copies it; the callable puts a text into it."""
    with ui.element("div").classes("copy"):
        area = ui.textarea(label).classes("copy-text").props("readonly outlined dense")
        area.props(f'input-class="copy-input" rows={rows} spellcheck=false')
        area.props["aria-label"] = label
        button = ui.button(icon="content_copy").props("flat dense")
        button.props["aria-label"] = f"Copy: {label}"
        button.tooltip("Copy")
        button.on("click", lambda: tell("Copied"), js_handler=_COPY)
    return area.set_value
