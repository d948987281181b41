# SPDX-License-Identifier: MIT
"""Errors for the user: one sentence each, shown without a traceback, with an exit code for scripts."""

from __future__ import annotations

# Exit codes. 0 is success, 1 is Python's for a crash, 2 is click's for a wrong command line.
EXIT_DIFFERENT = 3  # a comparison, check or verification found something
EXIT_BAD_FILE = 4  # a file is missing, damaged or of the wrong kind, or the page that is asked for is empty
EXIT_REFUSED = 5  # the request would do harm, or the user said no
EXIT_PORT = 6  # no port, no access, or the cable was unplugged
EXIT_NO_ANSWER = 7  # the port exists, but nobody answers as expected
EXIT_BOARD = 8  # the board answered with an error, or has broken off a motion
EXIT_MISSING = 9  # the simulator, or a program for an adapter, is not installed
EXIT_CANCELLED = 130  # Ctrl-C, as in shells

WORDS_MOST = 300  # longest message in characters, when it quotes user input


class M512Error(Exception):
    """Base of all errors that the user can act on."""

    exit_code = EXIT_BAD_FILE


class FileError(M512Error):
    """A file cannot be read as its expected kind."""


class UnknownKindError(FileError):
    """A file's bytes are of no kind that is known here: they may be anything, such as code."""


class TextError(FileError):
    """A line of the text format is wrong, or lines line..last that are one statement."""

    def __init__(self, message: str, where: str = "", line: int = 0, last: int = 0):
        super().__init__(f"{where}:{line}{f'-{last}' if last > line else ''}: {message}" if line else message)
        self.line = line


class WordError(ValueError):
    """A word is not valid in its place; the message is for the user. The caller that knows the place turns it into an M512Error."""

    def __init__(self, message: str):
        part = WORDS_MOST // 2
        super().__init__(message if len(message) <= WORDS_MOST else f"{message[:part]} ... {message[-part:]}")


class EmptyPageError(M512Error):
    """A page that is asked for holds nothing, or no action to play."""


class RefusedError(M512Error):
    exit_code = EXIT_REFUSED


class PortError(M512Error):
    exit_code = EXIT_PORT


class NoAnswerError(M512Error):
    exit_code = EXIT_NO_ANSWER


class BoardError(M512Error):
    """An error answer of the board: number (or None) and text."""

    exit_code = EXIT_BOARD

    def __init__(self, message: str, number: int | None = None) -> None:
        super().__init__(message)
        self.number = number


class CancelledError(M512Error):
    """The user pressed Ctrl-C; the text says what state things are in."""

    exit_code = EXIT_CANCELLED


class MissingError(M512Error):
    exit_code = EXIT_MISSING
