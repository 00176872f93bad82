"""What is raised. Ctrl-C raises KeyboardInterrupt, after the call has stopped cleanly."""

from __future__ import annotations


class Error(Exception):
    """Base of InputError and RunFailure. Attributes other than `what` are None except in an InputError."""

    what: str
    file: str | None = None
    line: int | None = None
    key: str | None = None
    value: str | None = None
    allowed: str | None = None
    nearest: str | None = None

    def __init__(self, message: str) -> None:
        super().__init__(message)
        self.what = message


class InputError(Error, ValueError):
    """An error in what the user gave; nothing is written.

    The attributes are those of the messages on the command line: `what` is wrong, in one sentence; the `file` ("--set"
    for settings) and the `line` in it; the `key`, its `value` as given, what is `allowed`, and the `nearest` known
    name. What a message does not have is None.
    """

    def __init__(self, message: str, what: str = "", file: str = "", line: int = 0, key: str = "", value: str = "",
                 allowed: str = "", nearest: str = "") -> None:
        super().__init__(message)
        self.what = what or message
        self.file = file or None
        self.line = line or None
        self.key = key or None
        self.value = value or None
        self.allowed = allowed or None
        self.nearest = nearest or None

    def __reduce__(self) -> tuple[type[InputError], tuple[object, ...]]:
        return (type(self), (str(self), self.what, self.file, self.line, self.key, self.value, self.allowed,
                             self.nearest))


class RunFailure(Error, RuntimeError):
    """The calculation cannot continue: no convergence, or an energy balance that does not close."""
