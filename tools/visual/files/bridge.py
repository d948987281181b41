# SPDX-License-Identifier: MIT
"""What the page asks of m512, in Pyodide: files to an image and back, checks, differences.

An image is 65,536 bytes: pages 0..127 as they lie in flash. Every answer is a dict of plain values; an error of m512's is
{"error": its sentence}. Other exceptions are mistakes of ours and pass.
"""

from pathlib import Path

from m512.errors import M512Error
from m512.files import conversion, formats, scale12
from m512.files import image as raw
from m512.files.wording import named_pages_text
from m512.pages import difference, operations

BOARD_PAGES = 128
BITS = 10
#: A sentence that quotes a whole line of a damaged file is cut in its middle.
SENTENCE = 400
IMAGE = Path("image.bin")


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
    """A motion file as an image: {"image", "notes", "losses"}, what `m512 convert NAME x.bin` makes; 12 bit is scaled to 10.
    {"no_room": pages} when pages of the user's would be lost (a board of 256 pages); `leave_out` loses them."""
    path = Path(name)
    image = formats.decode(bytes(data), path)
    notes, losses = list(image.notes), []
    if image.bits != BITS:
        notes = [note.replace(f"; {scale12.HINT}", "; it is scaled to 10 bit") for note in notes]
        image, losses = scale12.scaled(image, BITS)
    conversion.treat_damaged(image, path, "keep", notes)
    lost = image.beyond(BOARD_PAGES)
    if lost and not leave_out:
        return {"no_room": named_pages_text(lost)}
    image, cut = conversion.fitted(image, BOARD_PAGES, IMAGE)
    return {"image": image.to_bytes(), "notes": notes, "losses": losses + cut}


@_told
def saved(name, data):
    """An image as a file of the kind that the suffix of `name` says: {"file", "losses"}."""
    file, losses = formats.encode(Path(name), raw.from_bytes(bytes(data)))
    return {"file": file, "losses": losses}


@_told
def checked(data):
    """What `m512 pages check` says: {"found": [{"page", "text", "is_fault"}]}; is_fault is false for what may only surprise."""
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
    """What `m512 diff` says: {"changes": [{"page", "text"}]}."""
    return {
        "changes": [
            {"page": change.page, "text": str(change)} for change in difference.images(raw.from_bytes(bytes(first)), raw.from_bytes(bytes(second)))
        ]
    }
