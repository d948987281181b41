# SPDX-License-Identifier: MIT
"""Errors that a user reads: one sentence each, shown without a traceback, each with an exit code for scripts."""

from __future__ import annotations

# Exit codes. 0 is success; 1 is Python's own for a crash and 2 is click's for a wrong command line.
EXIT_DIFFERENT = 3  # a comparison, check or verification found something
EXIT_BAD_FILE = 4  # a file is missing, damaged or of the wrong kind
EXIT_REFUSED = 5  # asked for something that would do harm, or the user said no
EXIT_PORT = 6  # no port, no access, or the cable came off
EXIT_NO_ANSWER = 7  # the port is there but nobody answers as expected
EXIT_BOARD = 8  # the board answered with an error
EXIT_MISSING = 9  # an optional library or the simulator is not installed
EXIT_CANCELLED = 130  # Ctrl-C, as shells have it

WORDS_MOST = 300  # characters of a sentence that quotes what somebody wrote


class M512Error(Exception):
    """Base of all errors that are the user's business rather than ours."""

    exit_code = EXIT_BAD_FILE


class FileError(M512Error):
    """A file cannot be read as what it should be."""


class TextError(FileError):
    """A line of the text format is wrong."""

    def __init__(self, message: str, where: str = "", line: int = 0):
        super().__init__(f"{where}:{line}: {message}" if line else message)
        self.line = line


class WordError(ValueError):
    """A word does not say what its place needs; the message is for the user. Who knows the place makes an M512Error of it."""

    def __init__(self, message: str):
        part = WORDS_MOST // 2
        super().__init__(message if len(message) <= WORDS_MOST else f"{message[:part]} ... {message[-part:]}")


class RefusedError(M512Error):
    exit_code = EXIT_REFUSED


class PortError(M512Error):
    exit_code = EXIT_PORT


class NoAnswerError(M512Error):
    exit_code = EXIT_NO_ANSWER


class BoardError(M512Error):
    """The board's own error answer: number (or None) and text."""

    exit_code = EXIT_BOARD

    def __init__(self, message: str, number: int | None = None) -> None:
        super().__init__(message)
        self.number = number


class CancelledError(M512Error):
    """The user pressed Ctrl-C; the text says how things stand."""

    exit_code = EXIT_CANCELLED


class MissingError(M512Error):
    exit_code = EXIT_MISSING


def how_to_install(package: str) -> str:
    """What to type for a library that m512 can do without, wherever m512 itself was installed from."""
    return f"pip install {package} (m512 by pipx: pipx inject m512 {package})"
