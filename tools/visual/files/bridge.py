# SPDX-License-Identifier: MIT
"""The page's interface to m512 in Pyodide: files to an image and back, checks, differences.

An image is 65,536 bytes: pages 0..127 as in flash. Every answer is a dict of plain values. An m512 error is returned as
{"error": its message}. Other exceptions are bugs and are not caught.
"""

import errno
import os
from pathlib import Path

from m512.errors import M512Error
from m512.files import conversion, formats, scale12
from m512.files import image as raw
from m512.files.wording import named_pages_text
from m512.pages import difference, operations

BOARD_PAGES = 128
BITS = 10
#: A longer message is cut in the middle: it may quote a whole line of a damaged file.
SENTENCE = 400
#: Why a file that a text includes cannot be read here, and what to do about it.
NO_FILE = os.strerror(errno.ENOENT)
HINT = "the page has only the file that is opened. On your computer `m512 convert {} {}` puts both into one, which can be opened here"


def _told(function):
    def told(*arguments):
        try:
            return function(*arguments)
        except M512Error as error:
            return {"error": short(str(error))}

    return told


def short(sentence):
    part = SENTENCE // 2
    return sentence if len(sentence) <= SENTENCE else f"{sentence[:part]} … {sentence[-part:]}"


@_told
def opened(name, data, leave_out=False):
    """Converts a motion file to an image as `m512 convert NAME x.bin` does, but to pages 0..127 even if the file begins with page 1:
    {"image", "notes", "losses"}. 12 bit is scaled to 10. {"no_room": pages} if pages would be lost (from a board of 256 pages);
    `leave_out` drops them."""
    path = Path(name)
    try:
        image = formats.decode(bytes(data), path)
    except M512Error as error:
        raise M512Error(str(error).replace(NO_FILE, HINT.format(path.name, path.with_suffix(".bin").name))) from None
    notes, losses = list(image.notes), []
    if image.bits != BITS:
        notes = [note.replace(f"; {scale12.HINT}", "; it is scaled to 10 bit") for note in notes]
        image, losses = scale12.scaled(image, BITS)
    conversion.treat_damaged(image, path, "keep", notes, BOARD_PAGES)
    lost = image.beyond(BOARD_PAGES)
    if lost and not leave_out:
        return {"no_room": named_pages_text(lost)}
    image, cut = image.resized(BOARD_PAGES)
    return {"image": image.to_bytes(), "notes": notes, "losses": losses + cut}


@_told
def saved(name, data):
    """Converts an image to a file of the format given by the suffix of `name`: {"file", "losses"}."""
    file, losses = formats.encode(Path(name), raw.from_bytes(bytes(data)))
    return {"file": file, "losses": losses}


@_told
def checked(data):
    """The findings of `m512 pages check`: {"found": [{"page", "text", "is_fault"}]}. is_fault is false for remarks."""
    image = raw.from_bytes(bytes(data))
    return {
        "found": [
            {"page": page, "text": text, "is_fault": is_fault}
            for found, is_fault in ((operations.check(image), True), (operations.remarks(image), False))
            for page, text in found
        ]
    }


@_told
def differences(first, second):
    """The output of `m512 diff`: {"changes": [{"page", "text"}]}."""
    return {
        "changes": [
            {"page": change.page, "text": str(change)} for change in difference.images(raw.from_bytes(bytes(first)), raw.from_bytes(bytes(second)))
        ]
    }
