# SPDX-License-Identifier: MIT
"""Motion files of every kind, recognised by suffix and contents.

load() puts its assumptions into Image.notes. save() returns the losses: what the new format cannot express.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from m512.errors import FileError, RefusedError, UnknownKindError
from m512.files import image as raw
from m512.files import scale12, storage
from m512.files.image import Image
from m512.files.wording import counted

TEXT, BINARY, HEX, MTN = "text", "image", "Intel HEX", "RoboPlus .mtn"
BY_SUFFIX = {".m512": TEXT, ".bin": BINARY, ".img": BINARY, ".hex": HEX, ".ihex": HEX, ".mtn": MTN}


def recognise(data: bytes, path: Path) -> str:
    """The kind of a file, from its contents. The suffix decides only if the contents do not. FileError: empty, or a kind that is
    not read. UnknownKindError: no known kind."""
    if not data:
        raise FileError(f"{path}: empty, so it holds no motions")
    start = data[:400].lstrip(b"\xef\xbb\xbf \t\r\n")
    if len(data) in raw.SIZES and b"\0" in start:  # a page has zeros behind its name
        return BINARY
    if start.startswith(b":"):
        return HEX
    if start.startswith(b"type="):
        return MTN
    lines = [line.strip() for line in start.split(b"\n")]
    if any(line.startswith(b"motion512") for line in lines):
        return TEXT
    if len(data) in raw.SIZES:
        return BINARY
    if path.suffix.lower() == ".mtnx":
        raise FileError(f"{path}: a file of R+ Motion 2, which this program cannot read. It reads .mtn files of RoboPlus Motion")
    kind = BY_SUFFIX.get(path.suffix.lower())
    if kind in (None, BINARY):
        raise UnknownKindError(
            f"{path}: {counted(len(data), 'byte')} that {'makes' if len(data) == 1 else 'make'} no motion file this program knows "
            "(image, Intel HEX, .mtn or text)"
        )
    return kind


def _text_of(data: bytes, path: Path) -> str:
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise FileError(f"{path}: not UTF-8 text (byte 0x{data[error.start]:02X} at {error.start}): in an editor, save it as UTF-8") from None


def load(path: Path, bits: int | None = None) -> Image:
    """Reads any motion file. `bits`: 10 or 12; None guesses from the positions, with a note (a text states it)."""
    return decode(storage.read(path), path, bits)


def decode(data: bytes, path: Path, bits: int | None = None) -> Image:
    """The image in a file's bytes. Every FileError names the file."""
    storage.must_fit(len(data), path)
    with naming(path):
        kind = recognise(data, path)
        image = _image(kind, data, path, bits)
    image.form = kind
    return image


@contextmanager
def naming(path: Path) -> Iterator[None]:
    """Every error about what is in a file names the file."""
    try:
        yield
    except (FileError, RefusedError) as error:
        if path.name in str(error):
            raise
        raise type(error)(f"{path}: {error}") from None


def _image(kind: str, data: bytes, path: Path, bits: int | None) -> Image:
    if kind == BINARY:
        return scale12.judged(raw.from_bytes(data, bits or 10), bits)
    if kind == HEX:
        return scale12.judged(raw.from_hex(_text_of(data, path), bits or 10), bits)
    if kind == TEXT:
        from m512.files.text import read_text

        text = _text_of(data, path)
        image = read_text(text, str(path), storage.folder(path))
        image.text = text
        return scale12.as_said(image, bits)
    from m512.files import mtn

    return mtn.read(data, str(path), bits)


def save(path: Path, image: Image, kind: str | None = None, replace: bool = False) -> list[str]:
    """Writes an image in the format of the path's suffix, or as `kind`. Returns the losses, also those of a file that was replaced.
    RefusedError: as storage.write()."""
    data, losses = encode(path, image, kind)
    return losses + storage.write(path, data, replace)


def kind_of(path: Path) -> str:
    """The format for a path. FileError: its suffix names no format."""
    kind = BY_SUFFIX.get(path.suffix.lower(), TEXT if storage.is_stream(path) else None)
    if kind is None:
        raise FileError(f"{path}: the suffix decides the format: {' '.join(BY_SUFFIX)}")
    return kind


def must_be_writable(path: Path, force: bool) -> None:
    """The cheap checks, before the motions are read. RefusedError: the file exists, or belongs to a backup. FileError: the suffix names no
    format, or the path is a folder."""
    storage.must_be_free(path, force)
    kind_of(path)


def keep_text(image: Image, source: Path, target: Path) -> None:
    """RefusedError if a text, or one that it includes, would be overwritten by its own motions and would lose content, such as comments.
    `image` was read from `source`. Where a pipe does not tell from which file it comes, no such text is overwritten."""
    if not (image.text and storage.exists(target) and target.exists()):
        return
    if any(storage.exists(path) and target.samefile(path) for path in image.included):
        raise RefusedError(f"{target} is a text that {source} includes, and would be lost. Name another file for the result")
    untraceable = storage.is_untraceable(source)
    if (untraceable or storage.is_source(source, target)) and _is_by_hand(target):
        raise RefusedError(
            f"{target} is somebody's text: its comments, poses, names and includes would become numbers. "
            + (f"It may be where the text in {source} comes from: remove it first, or name " if untraceable else "Change the text itself, or name ")
            + "another file for the result (of `m512 pages`: -o new.m512)"
        )


def keep_mtn(path: Path, bits: int | None, losses: list[str]) -> None:
    """RefusedError if a .mtn, written back, would change where nobody has changed it, or with one of these losses."""
    from m512.files import mtn

    data = storage.read(path)
    changed = mtn.first_change(data, mtn.write(decode(data, path, bits))[0])
    lost = [changed, *losses] if changed else losses
    if lost:
        raise RefusedError(
            f"{path} would not keep all that it says, and stays as it is: {'; '.join(lost)}. Name another file for the result: -o new.mtn"
        )


def _is_by_hand(path: Path) -> bool:
    """Whether a file is a text with more in it than the motions that it describes."""
    data = storage.read(path)
    try:
        if recognise(data, path) != TEXT:
            return False
    except FileError:  # nothing that this program knows
        return False
    from m512.files.text import read_text, write_text

    try:
        text = _text_of(data, path)
        return write_text(read_text(text, str(path), path.parent)) != text
    except FileError:  # a text with a mistake
        return True


def encode(path: Path, image: Image, kind: str | None = None) -> tuple[bytes, list[str]]:
    kind = kind or kind_of(path)
    if kind == BINARY:
        return image.to_bytes(), []
    if kind == HEX:
        return raw.to_hex(image).encode(), []
    if kind == TEXT:
        from m512.files.text import write_text

        return write_text(image).encode(), []
    from m512.files import mtn

    return mtn.write(image)
