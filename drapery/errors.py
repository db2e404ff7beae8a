"""What a user sees when input is bad: one line naming the input, the place in it and the remedy."""


class DraperyError(Exception):
    """Any fault that the user can mend. The message is one complete line; the exit code is 2."""


class DesignError(DraperyError):
    """A text or file that was meant as a banner and cannot be read as one."""


class PackError(DraperyError):
    """A resource pack, or a file in it, that cannot be used."""


class OptionError(DraperyError):
    """An option or argument outside what it may be."""


class BackendError(DraperyError):
    """A renderer that cannot run on this machine."""


class OutputError(DraperyError):
    """A target that cannot be written."""
