"""The registry of forms: reads banners from any text, and writes a banner in any form."""

import warnings
from collections.abc import Callable, Sequence
from contextlib import suppress
from itertools import islice
from types import ModuleType
from typing import TypeVar

from drapery.banner.design import Banner
from drapery.banner.formats import (
    bannerfont,
    bannermaker,
    bannotation,
    bedrock,
    bentobox,
    blazon,
    block_entity,
    bukkit,
    commandpanels,
    commands,
    crafttweaker,
    crazycrates,
    deluxemenus,
    denizen,
    essentialsx,
    functions,
    gamergeeks,
    give,
    give_legacy,
    give_old,
    item,
    item_replace,
    java,
    javascript,
    kubejs,
    loom_assistant,
    loot,
    minecraft_tools,
    mythicmobs,
    needcoolshoes,
    optifine,
    own_json,
    planet_minecraft,
    setblock,
    several,
    shorthand,
    skript,
    studio_link,
    summon,
    trees,
    wynncraft,
    yaml_plugin,
)
from drapery.banner.formats.form import BinaryForm, Form, single
from drapery.banner.formats.found import FoundBanner
from drapery.banner.formats.resemblance import advice
from drapery.banner.formats.snbt import MAX_TEXT
from drapery.banner.formats.tree import is_banner_id
from drapery.banner.formats.wrapping import unwrap, without_suffix
from drapery.banner.names import shown
from drapery.errors import DesignError

MAX_LINES = 120_000
"""Most lines of a text, which is the most words too."""

_MOST_WARNINGS = 5

FormName = TypeVar("FormName", str, str | None)


def _form(module: ModuleType, read: Callable[[str], list[FoundBanner]]) -> Form:
    return Form(
        *(module.NAME, module.TITLE, module.EXAMPLE, module.recognises),
        *(read, module.write, module.SOURCE),
    )


def _site(module: ModuleType) -> Form:
    def write(banner: Banner) -> str:
        if banner.kind not in module.KINDS:
            raise DesignError(f"{module.SITE} edits banners, not shields: write the form 'give'")
        address: str = module.write(banner)
        return address

    name = module.NAME.replace("_", "-")
    title = f"{module.TITLE}, or its code alone"
    return Form(
        *(name, title, module.EXAMPLE, module.recognises, single(module.parse), write),
        module.SOURCE,
    )


_TABLE = (
    _form(studio_link, single(studio_link.parse)),
    _site(planet_minecraft),
    _site(needcoolshoes),
    _site(minecraft_tools),
    _site(gamergeeks),
    _site(optifine),
    _form(bannerfont, bannerfont.read),
    _form(bannotation, single(bannotation.parse)),
    _form(bannermaker, single(bannermaker.parse)),
    _form(java, java.read),
    _form(kubejs, kubejs.read),
    _form(crafttweaker, crafttweaker.read),
    _form(javascript, javascript.read),
    _form(denizen, denizen.read),
    _form(bukkit, bukkit.read),
    _form(deluxemenus, deluxemenus.read),
    _form(mythicmobs, mythicmobs.read),
    _form(crazycrates, crazycrates.read),
    _form(commandpanels, commandpanels.read),
    _form(skript, skript.read),
    _form(bentobox, bentobox.read),
    _form(yaml_plugin, yaml_plugin.read),
    _form(essentialsx, essentialsx.read),
    _form(functions, functions.read),
    _form(give_old, commands.read_command),
    _form(setblock, commands.read_command),
    _form(summon, commands.read_command),
    _form(item_replace, commands.read_command),
    _form(block_entity, block_entity.read),
    _form(loot, trees.read),
    _form(wynncraft, trees.read_wynncraft),
    _form(loom_assistant, trees.read),
    _form(own_json, trees.read),
    _form(bedrock, trees.read),
    _form(item, trees.read),
    _form(give_legacy, commands.read_command),
    _form(give, commands.read_command),
    _form(blazon, single(blazon.parse)),
    _form(shorthand, single(shorthand.parse)),
)

FORMS: dict[str, Form] = {form.name: form for form in _TABLE}
"""Every form of text by name. A text is read by the first form that recognises it."""


def recognise(text: str) -> Form:
    """The first form that recognises a text.

    Raises DesignError if none does.
    """
    for form in _TABLE:
        if form.recognises(text):
            return form
    if text.lstrip().startswith(("http://", "https://")):
        raise DesignError(
            f"{shown(text.strip(), 60)}: not the address of a known banner editor;"
            " copy the banner's /give command instead"
        )
    raise DesignError(
        f"{shown(text.strip(), 60)}: not a known form of a banner; write it as"
        f" {shorthand.EXAMPLE!r}, or paste a /give command"
    )


def parse_banners(text: str, *, form: str | None = None) -> list[FoundBanner]:
    """All banners of a text, at least one, each with its place in the text.

    text: one design in any form, or several commands, one on each line, as in a function file; a
        broken line is skipped with a warning.
    form: one of FORMS, or None to recognise it.

    Raises DesignError with the place and the remedy.
    """
    errors: list[DesignError] = []
    found = parse_all(text, form, errors)
    warn_of(errors)
    return found


def parse_all(text: str, form: str | None, errors: list[DesignError]) -> list[FoundBanner]:
    """As `parse_banners`, but the errors of broken lines are added to `errors`."""
    if not isinstance(text, str):
        raise DesignError(f"design {shown(text)} is not a text; write it in quotes")
    if len(text) > MAX_TEXT:
        raise DesignError(f"the text has {len(text)} characters, over {MAX_TEXT}: shorten it")
    if (breaks := text.count("\n")) > MAX_LINES:
        raise DesignError(f"the text has {breaks + 1} lines, over {MAX_LINES}: split it")
    text = text.removeprefix("\ufeff")
    if not text.strip():
        raise DesignError(f"the text is empty: give a banner, such as {shorthand.EXAMPLE!r}")
    if form == functions.NAME or (form is None and _is_function(text)):
        own: list[DesignError] = []
        found = some_of(functions.find(text, own.append), own, functions.NOTHING)
        if form is None and not functions.has_only_commands(text):
            faults: list[DesignError] = []
            lines = _in_lines_if_more(text, found, faults)
            found, own = (lines, faults) if lines is not found else (found, own)
        errors += own
        return found
    return _any_form(unwrap(text), errors) if form is None else _read_as(_named(form), text)


def _read_as(form: Form, text: str) -> list[FoundBanner]:
    nothing = f"no banner in the text in the form {form.name!r}; it is written as {form.example}"
    return some_of(form.read(text), [], " ".join(nothing.split()))


def _is_function(text: str) -> bool:
    return functions.recognises(text) and recognise(text).name == functions.NAME


def _any_form(text: str, errors: list[DesignError]) -> list[FoundBanner]:
    """The banners of a text in the form that recognises it, or line by line."""
    is_typed = True  # where no form recognises it, or the one of texts that are typed by hand
    try:
        inner = unwrap(text)
        form = recognise(inner)
        is_typed = form.name == shorthand.NAME
        found = form.read(inner)
        return found if is_typed else _in_lines_if_more(text, found, errors)
    except DesignError as error:
        if found := several.find_in_lines(text, _recognised, errors):
            return found
        if found := _without_suffix(text):
            return found
        told = advice(text) if is_typed else None
        raise (DesignError(f"the text is {told}") if told else error) from None


def _in_lines_if_more(
    text: str, found: list[FoundBanner], errors: list[DesignError]
) -> list[FoundBanner]:
    """The banners line by line if these are more than those of the whole text.

    A form that looks for its own items passes over the lines that are designs in other forms.
    """
    faults: list[DesignError] = []
    in_lines = several.find_in_lines(text, _recognised, faults)
    if len(in_lines) <= len(found):
        return found
    errors += faults
    return in_lines


def _without_suffix(text: str) -> list[FoundBanner]:
    """The banners of a text without the amount or size at its end; empty if it has none.

    A plain banner counts only by an item's name, since `red:5` is not a banner.
    """
    shorter = without_suffix(text)
    with suppress(DesignError):
        found = _recognised(shorter) if shorter else []
        if is_banner_id(shorter) or any(one.banner.layers for one in found):
            return found
    return []


def _recognised(text: str) -> list[FoundBanner]:
    text = unwrap(text)
    return recognise(text).read(text)


def parse_banner(text: str, *, form: str | None = None, number: int | None = None) -> Banner:
    """The banner of a text in any form.

    text: one design, or several of which `number` chooses.
    form: one of FORMS, or None to recognise it.
    number: which banner, from 1, if the text holds several.

    Raises DesignError with the place and the remedy.
    """
    return choose_banner(parse_banners(text, form=form), number)


def write_banner(banner: Banner, form: str = "json") -> str:
    """The text of a banner in a form.

    banner: the design.
    form: one of FORMS.

    Raises DesignError if that form cannot hold it.
    """
    write = _named(form).write
    if write is None:
        raise DesignError(f"the form {form!r} can be read but not written")
    return write(banner)


def choose_banner(found: list[FoundBanner], number: int | None = None) -> Banner:
    """One of the banners that were found; several equal ones count as one.

    found: what was found in a text.
    number: which, from 1; None if all are equal.

    Raises DesignError for a number out of range, and for None if the banners differ.
    """
    if number is None and len({f.banner for f in found}) == 1:
        return found[0].banner
    if number is None:
        first, last = found[0].where, found[-1].where
        raise DesignError(
            f"{len(found)} banners, from {shown(first)} to {shown(last)}: choose one by its number"
            f" (--number 1 to {len(found)}); 'drapery show --list' lists them"
        )
    if not 1 <= number <= len(found):
        raise DesignError(f"there is no banner number {number}; use 1 to {len(found)}")
    return found[number - 1].banner


_FORMER_NAMES = {"text": shorthand.NAME}


def named_now(form: FormName) -> FormName:
    """The name of a form, in place of a former one."""
    return _FORMER_NAMES.get(form, form) if form is not None else form


def _named(form: str) -> Form:
    form = named_now(form)
    if form in FORMS:
        return FORMS[form]
    if form in binary_forms():
        raise DesignError(f"the form {form!r} is for files, but this is a text; give a file")
    raise unknown_form(form)


def unknown_form(form: str) -> DesignError:
    """The error for the name of a form that there is not."""
    import difflib

    known = (*FORMS, *binary_forms())
    close = difflib.get_close_matches(form[:40].lower(), known, 1)
    hint = f"; did you mean '{close[0]}'?" if close else f"; known are {', '.join(known)}"
    return DesignError(f"unknown form {shown(form)}{hint}")


def binary_forms() -> dict[str, BinaryForm]:
    """Every form of files by name. Importing them loads numpy, which texts do not need."""
    from drapery.banner.formats.binary import BINARY_FORMS

    return BINARY_FORMS


def write_blocks(banners: Sequence[Banner], suffix: str) -> bytes | None:
    """A file of blocks with the banners standing in a row to the east, to read from the south.

    banners: the designs, from west to east.
    suffix: .schem, .litematic, .nbt or .mcstructure; None comes back for another one.

    Raises DesignError for shields, which are not blocks, and for too many banners.
    """
    from drapery.banner.formats.binary import BLOCK_WRITERS

    write = BLOCK_WRITERS.get(suffix.lower())
    return None if write is None else write(banners)


def some_of(found: list[FoundBanner], errors: list[DesignError], nothing: str) -> list[FoundBanner]:
    """The banners that were found. Raises the first error, or one that says `nothing`, if none."""
    if not found:
        raise errors[0] if errors else DesignError(nothing)
    return found


def warn_of(errors: list[DesignError]) -> None:
    """Warn the caller's caller of what was skipped, and of no more than a few."""
    for error in islice(errors, _MOST_WARNINGS):
        warnings.warn(str(error), stacklevel=3)
    if len(errors) > _MOST_WARNINGS:
        warnings.warn(f"and {len(errors) - _MOST_WARNINGS} more like these", stacklevel=3)
