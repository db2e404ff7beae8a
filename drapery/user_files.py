"""Files that a user names: only regular files, read up to a limit.

A named pipe or a device may never end, or never begin. So each place that opens such a file does it
here; `tests/test_user_files.py` looks for places that do not.
"""

import errno
import os
import stat
from pathlib import Path
from typing import BinaryIO

from drapery.errors import DraperyError, OptionError

_DESCRIPTORS = ("/dev/stdin", "/dev/fd/")
"""Names of what the process was started with: `/dev/stdin`, and `<(command)` of a shell."""


def open_user_file(path: str | Path, *, descriptors: bool = False) -> BinaryIO:
    """A file, open to read its bytes.

    descriptors: whether a pipe that the process was started with is read too, by its name in
    `/dev`. Raises OSError, whose `strerror` names the fault, also for what is no regular file.
    """
    name = os.fspath(path)
    if "\0" in name:
        raise OSError(errno.EINVAL, "its name holds a character of number 0")
    # Without waiting, since a named pipe opens only when somebody writes to it.
    flags = os.O_RDONLY | getattr(os, "O_BINARY", 0) | getattr(os, "O_NONBLOCK", 0)
    try:
        number = os.open(name, flags | getattr(os, "O_NOCTTY", 0))
    except ValueError as error:  # a lone surrogate, which no file system's encoding has
        raise OSError(errno.EINVAL, "its name cannot be written in this system") from error
    try:
        kind = os.fstat(number).st_mode
        if stat.S_ISDIR(kind):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        if not (stat.S_ISREG(kind) or (descriptors and name.startswith(_DESCRIPTORS))):
            raise OSError(errno.EINVAL, "it is a pipe or a device, not a file")
        if not stat.S_ISREG(kind):
            os.set_blocking(number, True)
        return os.fdopen(number, "rb")
    except BaseException:
        os.close(number)
        raise


def read_user_file(
    path: str | Path,
    max_bytes: int,
    *,
    name: str = "",
    remedy: str = "check the path",
    shorter: str = "shorten it",
    error: type[DraperyError] = OptionError,
) -> bytes:
    """The bytes of a file.

    name: of the file in messages; its path by default. remedy, shorter: what to do about a file
    that cannot be read, and about one that is longer than max_bytes. error: what is raised then.
    """
    name = name or shown_path(path)
    try:
        with open_user_file(path) as file:
            data = file.read(max_bytes + 1)
    except OSError as fault:
        raise error(f"{name} cannot be read: {reason(fault)}; {remedy}") from None
    if len(data) > max_bytes:
        raise error(f"{name} has over {max_bytes} bytes; {shorter}")
    return data


def shown_path(path: str | Path) -> str:
    """A path as an error quotes it: printable, and at most some 200 characters long."""
    text = str(path)
    text = text if text.isprintable() else ascii(text)[1:-1]
    return text if len(text) <= 200 else f"{text[:100]} ... {text[-90:]}"


def reason(fault: BaseException) -> str:
    """The system's message for an error of its own; what the others mean for the name of a file."""
    if isinstance(fault, OSError):
        return fault.strerror or "the system refuses it"
    if isinstance(fault, RuntimeError):
        return "its links lead round in a circle"
    return "its name cannot be written in this system"
