"""Errors for users: one line with the input, the place in it and the remedy."""


class DraperyError(Exception):
    """A fault that the user can correct. Its message is one line; commands then exit with 2."""


class DesignError(DraperyError):
    """A text or file that cannot be read as a banner."""


class PackError(DraperyError):
    """A resource pack, or a file in it, that cannot be used."""


class OptionError(DraperyError):
    """An option or argument with a value that is not allowed."""


class BackendError(DraperyError):
    """A renderer, or the compiler of kernels, that cannot run on this machine."""


class OutputError(DraperyError):
    """A target that cannot be written."""
