# SPDX-License-Identifier: Apache-2.0
"""What may go wrong."""


class Error(Exception):
    """A foreseeable failure.

    Attributes:
        code: "usage", "input", "output", "cancelled", "memory" or "internal".
        message: what is wrong.
        where: file, line, argument or object; empty when nowhere in particular.
        mend: what can be done about it; may be empty.
    """

    code: str = "internal"

    def __init__(self, message: str, where: str = "", mend: str = "") -> None:
        super().__init__(message, where, mend)
        self.message = message
        self.where = where
        self.mend = mend

    @property
    def file(self) -> str:
        """The same as `where`."""
        return self.where

    def __str__(self) -> str:
        place = f"{self.where}: " if self.where else ""
        return place + self.message + (f" ({self.mend})" if self.mend else "")


class UsageError(Error, ValueError):
    """An argument makes no sense."""

    code = "usage"


class InputError(Error):
    """A file cannot be read, is damaged, or holds nothing usable."""

    code = "input"


class OutputError(Error):
    """A result cannot be written."""

    code = "output"


class Cancelled(Error):
    """The run was stopped."""

    code = "cancelled"


class OutOfMemory(Error, MemoryError):
    """The run needs more memory than there is."""

    code = "memory"


class InternalError(Error, RuntimeError):
    """A broken promise of the library itself."""

    code = "internal"


_BY_CODE: dict[str, type[Error]] = {
    kind.code: kind for kind in (UsageError, InputError, OutputError, Cancelled, OutOfMemory, InternalError)
}


def error_of(code: str, message: str, where: str = "", mend: str = "") -> Error:
    """Returns the error of a code; the extension calls it."""
    return _BY_CODE[code](message, where, mend)
