"""Profiles of players as the game writes them, whose skin, cape and elytra are textures of packs.

Since 1.21.9 the `profile` of a head or a mannequin may name them: `texture`, `cape`, `elytra`, and
`model`, the arms. All else in a profile says whose account it is.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from drapery.banner.names import shown
from drapery.banner.packs.texture_ids import full_id
from drapery.errors import DesignError, OptionError, PackError
from drapery.user_files import read_user_file

if TYPE_CHECKING:
    from drapery.style.skins import Arms

ENDINGS = (".json", ".snbt")
"""Endings of files of profiles."""

MAX_PROFILE = 1 << 16
"""The longest text of a profile [bytes]; signed textures of an account have about 1,500."""

_MODELS: "Mapping[str, Arms]" = {"wide": "classic", "slim": "slim"}
_KEYS = frozenset(("texture", "cape", "elytra", "model", "name", "id", "properties"))
_NAMES = ("profile", "minecraft:profile")


@dataclass(frozen=True)
class Profile:
    """A profile. texture, cape, elytra: ids of textures of packs, or None. arms: by its model."""

    texture: str
    cape: str | None = None
    elytra: str | None = None
    arms: "Arms | None" = None


def is_profile_text(skin: str) -> bool:
    """Whether a skin is the text of a profile."""
    return "{" in skin and not skin.lower().endswith(".png")


def is_profile_file(skin: str) -> bool:
    """Whether a skin is the file of a profile."""
    return skin.lower().endswith(ENDINGS) and not is_profile_text(skin)


def profile_of(skin: str, folder: Path = Path()) -> Profile | None:
    """The profile that a skin names, by its text or file; None for other skins.

    folder: where a relative path starts. Raises OptionError.
    """
    if is_profile_text(skin):
        return read_profile(skin)
    if not is_profile_file(skin):
        return None
    path = folder / skin
    name = f"profile {shown(str(path), 200)}"
    data = read_user_file(path, MAX_PROFILE, name=name)
    try:
        return read_profile(data.decode("utf-8-sig"), name)
    except UnicodeDecodeError:
        raise OptionError(f"{name} is not UTF-8; save it as UTF-8") from None


def read_profile(text: str, name: str = "profile") -> Profile:
    """The profile of a text: JSON or SNBT, alone or in an item, an entity or a command.

    name: what messages call it. Raises OptionError.
    """
    from drapery.banner.formats.snbt import parse_command

    if len(text) > MAX_PROFILE:
        raise OptionError(f"{name} has over {MAX_PROFILE} characters; leave some out")
    try:
        parts = parse_command(text)
    except DesignError as error:
        raise OptionError(f"{name} is not JSON or SNBT: {error}") from None
    found = next(_profiles(parts), None)
    if not isinstance(found, dict):
        raise OptionError(
            f"{name} {shown(text)} has no profile with textures; write"
            ' {texture:"minecraft:entity/player/slim/alex",model:"slim"}'
        )
    return _checked(found, name)


def _profiles(parts: list[Any]) -> Iterator[Any]:
    """What is a profile in the parts of a command: of components, of an entity, or alone."""
    compounds = [part for part in parts if isinstance(part, dict)]
    compounds += [
        inner
        for part in compounds
        for inner in (part.get("components"), part.get("tag"))
        if isinstance(inner, dict)
    ]
    for part in compounds:
        yield from (part[key] for key in _NAMES if key in part)
    yield from (part for part in compounds if _KEYS.intersection(part))


def _checked(found: Mapping[str, Any], name: str) -> Profile:
    texture, cape, elytra = (_texture(found, key, name) for key in ("texture", "cape", "elytra"))
    model = found.get("model")
    if model is not None and not (isinstance(model, str) and model in _MODELS):
        raise OptionError(f"{name}: model {shown(model)} is not known; use one of: wide, slim")
    if texture is None:
        whose = found.get("name")
        who = f" of {shown(whose)}" if isinstance(whose, str) else ""
        raise OptionError(
            f"{name}{who} names no texture: the skin of an account is on a server of the game, not"
            " here; add texture, the id of a texture of a pack, or give a PNG file"
        )
    return Profile(texture, cape, elytra, None if model is None else _MODELS[model])


def _texture(found: Mapping[str, Any], key: str, name: str) -> str | None:
    value = found.get(key)
    if value is None:
        return None
    if not isinstance(value, str):
        raise OptionError(f"{name}: {key} {shown(value)} is not the id of a texture")
    try:
        return full_id(value, f"{name}: {key}")
    except PackError as error:
        raise OptionError(str(error)) from None
