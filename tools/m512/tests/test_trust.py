# SPDX-License-Identifier: MIT
"""Nothing of a user's is lost silently: existing files, hand-written texts, boards, motions in HEX files, terminals."""

import ctypes
import fcntl
import json
import os
import re
import signal
import subprocess
import sys
import termios
import time
from pathlib import Path

import pytest
from block_peer import PROMPTED, SESSION, BlockPeer, BlockPtyPeer
from conftest import REPO
from factory_peer import FactoryPeer
from hex_files import hex_file
from intelhex import IntelHex
from test_flash import make_app
from virtual_peer import VirtualLink

from m512 import __version__, ui
from m512.board import block, bus, child, loaders, ports
from m512.board.client import Client
from m512.board.download import Report
from m512.board.link import Link
from m512.board.memory import plan
from m512.errors import BoardError, FileError, M512Error, PortError, RefusedError, TextError
from m512.files import formats, storage
from m512.files.image import Image, to_hex
from m512.files.page import EMPTY, Page
from m512.files.text import read_text, write_text

TEXT = """motion512 1
page 1 stand
  step 1s | 1..18:512
page 3 walk
  next self
  step 50 | 1..18:400
"""
BY_HAND = TEXT.replace("page 3", "# my walk\npage 3")


@pytest.fixture
def files(tmp_path):
    image = read_text(TEXT)
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    (tmp_path / "hand.m512").write_text(BY_HAND)
    (tmp_path / "own.m512").write_text(write_text(image))
    return tmp_path


def run(*args, **options):
    return subprocess.run([sys.executable, "-m", "m512", *map(str, args)], capture_output=True, timeout=300, **options)


# Motions in Intel HEX: the same rules as for every motion file


def test_hex_of_motions_leaves_the_trim_alone(tmp_path):
    (tmp_path / "x.hex").write_text(to_hex(read_text(TEXT)))
    found = plan(tmp_path / "x.hex")
    assert min(found.pages) == 0xE200 // 256 and "keeps its own" in found.remarks[0]
    assert min(plan(tmp_path / "x.hex", with_trim=True).pages) == 0xE000 // 256


def trim_page(*columns, joint=3):
    """Page 0 with these words of one joint in its first steps."""
    page = Page()
    for step, word in enumerate(columns):
        page.set_word(step, joint, word & 0xFFFF)
    return page.seal()


TRIMS = [(512, 500, -12), (512, 500 - 288, -300), (0x4000, 0x4000, 7), (0x4000, 0x2000, 300)]
NO_TRIMS = [(512, 500, 512), (512, 500, 12), (512, 500, 0x4000), (0x4000, 0x4000, 301), (512, 200, -312), (400, 600, 0)]


@pytest.mark.parametrize("columns", TRIMS + NO_TRIMS)
def test_a_motion_on_page_0_is_not_written_as_the_trim(m512, tmp_path, columns):
    image = read_text(TEXT)
    image[0] = trim_page(*columns)
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    found, first = plan(tmp_path / "x.bin"), 0xE000 // 256 if columns in TRIMS else 0xE200 // 256
    assert min(found.pages) == first and min(plan(tmp_path / "x.bin", with_trim=True).pages) == 0xE000 // 256
    assert [("ID 3" in remark, "--with-trim" in remark) for remark in found.remarks] == ([] if columns in TRIMS else [(True, True)])
    checked = m512("pages", tmp_path / "x.bin", "check")
    assert checked.exit_code == (0 if columns in TRIMS else 3) and ("page 0: " in checked.stdout) == (columns in NO_TRIMS)


def roboplus_empty():
    """An empty page as RoboPlus writes it (FILES.md)."""
    page = Page(bytes(512))
    page.repeat, page.schedule, page.speed, page.accel, page.byte63 = 1, 0x0A, 32, 32, 0x55
    for joint in range(26):
        page.set_compliance(joint, 0x55)
        for step in range(7):
            page.set_word(step, joint, 0x4200)
    return page.seal()


def bow():
    return read_text("motion512 1\npage 1 bow\n  step 1s | 1..18:512\n  step 1s | 1..18:512\n")[1]


NO_OFFSET = [roboplus_empty(), trim_page(0x4000, 0x4000, 0), trim_page(512, 0x4000, 0x4000), trim_page(512, 512, 0x4000), bow()]


@pytest.mark.parametrize("page", NO_OFFSET, ids=["roboplus", "zero", "master", "both", "motion"])
@pytest.mark.parametrize("kind", ["bin", "hex"])
def test_a_page_0_without_a_trim_leaves_the_robot_its_own(m512, tmp_path, page, kind):
    """The third step of page 0 is the trim (motion/PAGE_FORMAT.md). Without it a robot stands crooked."""
    image = read_text(TEXT)
    image[0] = page
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    (tmp_path / "x.hex").write_text(to_hex(image))
    own = bytes(trim_page(512, 500, -12))
    with BlockPeer(full_flash()) as board:
        board.flash[0xE000:0xE200] = own
        result = m512("flash", tmp_path / f"x.{kind}", "-p", board.path, "--yes")
        assert result.exit_code == 0 and "the robot keeps its own" in result.stderr and "--with-trim" in result.stderr, result.stderr
        assert bytes(board.flash[0xE000:0xE200]) == own
        assert m512("flash", tmp_path / f"x.{kind}", "-p", board.path, "--yes", "--with-trim").exit_code == 0
        assert bytes(board.flash[0xE000:0xE200]) == bytes(page)


def test_a_damaged_trim_leaves_the_robot_its_own(tmp_path):
    """A robot takes no trim from a damaged page 0."""
    image = read_text("motion512 1\npage 0\n  offset 3:-5\npage 1 stand\n  step 1s | 1..18:512\n")
    image[0].checksum ^= 1
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    left = plan(tmp_path / "x.bin", damaged="keep")
    assert min(left.pages) == 0xE200 // 256 and any("page 0: damaged, so the robot adds nothing" in remark for remark in left.remarks)
    assert min(plan(tmp_path / "x.bin", damaged="keep", with_trim=True).pages) == 0xE000 // 256


def test_a_link_beyond_the_last_page_is_flashed_as_it_is(tmp_path):
    """An image without page 0 has no more pages than the board, so that none is left out."""
    image = read_text(TEXT)
    image[3].next = 200
    image[3].seal()
    (tmp_path / "x.bin").write_bytes(image.to_bytes()[512:])
    assert plan(tmp_path / "x.bin").pages[0xE600 // 256] == bytes(image[3])[:256]


def test_a_file_of_page_0_alone_is_told_why_it_is_left_out(tmp_path):
    with pytest.raises(FileError, match="holds nothing to flash: page 0 of the file holds no trim.*--with-trim"):
        plan(hex_file(tmp_path / "x.hex", (0xE000, bytes(trim_page(0x4000, 0x4000, 0)))))


def test_hex_of_motions_with_a_damaged_page_is_refused(tmp_path):
    image = read_text(TEXT)
    image[3].data[100] ^= 1
    (tmp_path / "x.hex").write_text(to_hex(image))
    with pytest.raises(M512Error, match="page 3: checksum"):
        plan(tmp_path / "x.hex")
    assert plan(tmp_path / "x.hex", damaged="keep").pages


def test_whatever_is_wrong_with_a_file_to_flash_its_name_is_said(m512, tmp_path):
    """Somebody who flashes a folder of files in a loop saw which sentence, and not which file."""
    damaged, large, twelve = Image.empty(), Image.empty(256), Image.empty()
    damaged[3].data[100] ^= 1
    large[200].steps = 1
    large[200].seal()
    twelve[3].steps = 1
    for joint in range(31):
        twelve[3].set_word(0, joint, 2048)
    twelve[3].seal()
    text = to_hex(damaged)
    contents = {"cut.hex": text[:5000], "two.hex": 2 * text, "bad.hex": text.replace(":10E01", "?10E01", 1), "damaged.hex": text}
    contents.update({"damaged.bin": damaged.to_bytes(), "large.bin": large.to_bytes(), "twelve.bin": twelve.to_bytes()})
    for name, content in contents.items():
        (tmp_path / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        with pytest.raises((FileError, RefusedError)) as refused:
            plan(tmp_path / name)
        assert str(refused.value).count(name) == 1, refused.value
    asked = m512("convert", tmp_path / "damaged.bin", tmp_path / "y.bin", "--damaged", "ask")
    assert asked.exit_code == 5 and "damaged.bin: damaged pages" in asked.stderr


def test_hex_without_its_end_is_refused(tmp_path):
    text = to_hex(read_text(TEXT))
    (tmp_path / "x.hex").write_text("\n".join(text.splitlines()[:-1]) + "\n")
    with pytest.raises(FileError, match="end record is missing"):
        plan(tmp_path / "x.hex")
    with pytest.raises(FileError, match="end record is missing"):
        formats.load(tmp_path / "x.hex")


def test_two_hex_files_in_one_are_refused(tmp_path):
    """The definition of Intel HEX lets nothing follow the end record. Everything behind it was once lost without a word."""
    first = hex_file(tmp_path / "a.hex", (0xE000 + 512, bytes(read_text(TEXT)[3]))).read_text()
    second = hex_file(tmp_path / "b.hex", (0xE000 + 1024, bytes(read_text(TEXT)[3]))).read_text()
    (tmp_path / "x.hex").write_text(first + second)
    for reads in (plan, formats.load):
        with pytest.raises(FileError, match=f"not one Intel HEX file.*line {first.count(chr(10))}.*two files"):
            reads(tmp_path / "x.hex")
    (tmp_path / "x.hex").write_text(first + "\n\x1a")  # the end of a file of MS-DOS
    assert formats.load(tmp_path / "x.hex").given == {1}


def test_hex_with_some_motion_pages_changes_only_those(tmp_path):
    page = bytes(read_text(TEXT)[3])
    found = plan(hex_file(tmp_path / "x.hex", (0xE000 + 3 * 512, page), (0xE000 + 9 * 512, page)))
    assert sorted(found.pages) == [0xE6, 0xE7, 0xF2, 0xF3]
    assert found.remarks == []  # nothing of page 0, which the file does not have
    with pytest.raises(FileError, match="whole 512-byte motion pages"):
        plan(hex_file(tmp_path / "half.hex", (0xE000 + 3 * 512, page[:256])))


@pytest.mark.parametrize(
    "words, pages",
    [
        (["pages", "part.hex", "rename", "3", "new", "--in-place"], {3, 9}),
        (["pages", "part.hex", "delete", "3", "-o", "new.hex"], {3, 9}),
        (["pages", "part.hex", "copy", "3", "20", "-o", "new.hex"], {3, 9, 20}),
        (["pages", "part.hex", "renumber", "3", "127", "-o", "new.hex"], {3, 9, 127}),
        (["pages", "part.hex", "extract", "3", "-o", "new.hex"], {3}),
        (["pages", "part.hex", "merge", "x.bin", "1", "-o", "new.hex"], {1, 3, 9}),
        (["convert", "part.hex", "new.hex"], {3, 9}),
        (["convert", "part.hex", "new.hex", "--only", "walk"], {3}),
        (["convert", "part.hex", "new.hex", "--bits", "12", "--scale", "10", "--joints", "1..18"], {3, 9}),
    ],
)
def test_hex_with_some_motion_pages_stays_one_when_it_is_changed(m512, files, monkeypatch, words, pages):
    """README: an Intel HEX file replaces only the pages that it contains. Page 9 is empty, and it is in the file."""
    monkeypatch.chdir(files)
    hex_file("part.hex", (0xE000 + 3 * 512, bytes(read_text(TEXT)[3])), (0xE000 + 9 * 512, EMPTY))
    done = m512(*words)
    assert done.exit_code == 0, done.stderr
    made = IntelHex("part.hex" if "--in-place" in words else "new.hex")
    assert {(at - 0xE000) // 512 for at in made.addresses()} == pages
    assert len(made.addresses()) == 512 * len(pages)


def test_motions_at_an_address_are_judged_as_a_motion_file(tmp_path):
    image = read_text(TEXT)
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    found = plan(tmp_path / "x.bin", 0xE000)
    assert min(found.pages) == 0xE200 // 256 and "keeps its own" in found.remarks[0]
    image[3].data[70] ^= 1
    (tmp_path / "damaged.bin").write_bytes(bytes(image[3]))
    with pytest.raises(RefusedError, match="page 3: checksum"):
        plan(tmp_path / "damaged.bin", 0xE600)
    (tmp_path / "half.bin").write_bytes(bytes(image[1])[:300])
    with pytest.raises(FileError, match="whole 512-byte motion pages"):
        plan(tmp_path / "half.bin", 0xE200)


@pytest.mark.parametrize("name", ["x.m512", "x.mtn", "x.hex", "text.bin"])
def test_an_address_is_for_raw_binaries(m512, tmp_path, name):
    """Other files would be written to the robot as raw text, over its program."""
    source = tmp_path / name
    source.write_bytes(formats.encode(source.with_suffix(".m512" if name == "text.bin" else source.suffix), read_text(TEXT))[0])
    result = m512("flash", source, "--address", "0", "--dry-run", "-p", "none")
    assert result.exit_code == 5 and "--address is for raw binaries" in result.stderr and name in result.stderr
    assert m512("flash", source, "--address", "0xE000", "--dry-run", "-p", "none").exit_code == 5


def test_a_file_of_motion_2_is_named(m512, tmp_path):
    (tmp_path / "x.mtnx").write_text("<?xml version='1.0'?>")
    result = m512("convert", tmp_path / "x.mtnx", tmp_path / "y.m512")
    assert result.exit_code == 4 and "x.mtnx: a file of R+ Motion 2" in result.stderr, result.stderr
    result = m512("flash", tmp_path / "x.mtnx", "--dry-run", "-p", "none")
    assert result.exit_code == 4 and result.stderr.rstrip().endswith("It reads .mtn files of RoboPlus Motion"), result.stderr


@pytest.mark.parametrize("words", [[], ["--address", "0"]])
def test_an_elf_file_is_not_flashed_as_code(m512, tmp_path, words):
    """Its header would become the program's first instructions."""
    (tmp_path / "x.elf").write_bytes(b"\x7fELF" + bytes(300))
    result = m512("flash", tmp_path / "x.elf", *words, "--dry-run", "-p", "none")
    assert result.exit_code == 4 and "is an ELF file. Flash the Intel HEX" in result.stderr, result.stderr


def test_code_without_an_address_is_told_about_it(m512, tmp_path):
    (tmp_path / "x.bin").write_bytes(bytes(300))
    result = m512("flash", tmp_path / "x.bin", "-p", "none")
    assert result.exit_code == 4 and "A raw binary of code needs --address, such as 0x0" in result.stderr, result.stderr


def test_an_address_below_the_flash_is_refused(tmp_path):
    (tmp_path / "x.bin").write_bytes(bytes(300))
    with pytest.raises(RefusedError, match="no address -5"):
        plan(tmp_path / "x.bin", -5)


# Existing files


@pytest.mark.parametrize("name", ["x.bin holding hex", "x.mtn holding image", "x.txt holding mtn"])
def test_in_place_keeps_the_kind_of_file_whatever_its_name_says(m512, files, name):
    """Raw areas of the CM-2 were also called .mtn."""
    name, _, suffix = name.split()
    kind = {"hex": formats.HEX, "image": formats.BINARY, "mtn": formats.MTN}[suffix]
    (files / name).unlink(missing_ok=True)
    (files / name).write_bytes(formats.encode(files / f"y.{suffix.replace('image', 'bin')}", read_text(TEXT))[0])
    result = m512("pages", files / name, "rename", "3", "new", "--in-place")
    assert result.exit_code == 0, result.stderr
    assert formats.recognise((files / name).read_bytes(), files / name) == kind
    assert formats.load(files / name)[3].name == b"new"


def test_a_hand_written_text_that_gave_some_of_the_motions_stays(m512, files, monkeypatch):
    monkeypatch.chdir(files)
    words = ["pages", "x.bin", "merge", "hand.m512", "all", "--replace", "-o", "hand.m512", "--force"]
    result = m512(*words)
    assert result.exit_code == 5 and "hand.m512 is somebody's text" in result.stderr
    assert (files / "hand.m512").read_text() == BY_HAND
    assert m512(*[word.replace("hand", "own") for word in words]).exit_code == 0


@pytest.mark.parametrize(
    "words",
    [
        ["convert", "main.m512", "poses.m512", "--force"],
        ["pages", "main.m512", "rename", "3", "new", "-o", "./poses.m512", "--force"],
        ["pages", "x.bin", "merge", "main.m512", "3", "--replace", "-o", "poses.m512", "--force"],
    ],
)
def test_a_text_that_is_included_is_not_overwritten_by_the_whole(m512, files, monkeypatch, words):
    """README: a text is never replaced by its own motions. The included one gave some of them."""
    monkeypatch.chdir(files)
    poses = "motion512 1\npose up | 1:300  # as high as it goes\n"
    (files / "poses.m512").write_text(poses)
    (files / "main.m512").write_text('motion512 1\ninclude "middle.m512"\npage 3 bow\nstep 9 | @up\n')
    (files / "middle.m512").write_text('motion512 1\ninclude "poses.m512"\n')
    result = m512(*words)
    assert result.exit_code == 5 and "poses.m512 is a text that main.m512 includes" in result.stderr
    assert (files / "poses.m512").read_text() == poses
    assert m512(*[word.replace("poses", "own") for word in words]).exit_code == 0


FROM_PIPES = [  # the first three with all files below: the file itself, another one, and a pipe that hides its source
    "{m512} convert - {target} --force < {source}",
    "cat {source} | {m512} convert - {target} --force",
    "{m512} pages x.bin merge - 3 --replace -o {target} --force < {source}",
    "{m512} convert - {target} --force < ../files/{source}",
    "{m512} convert /dev/stdin {target} --force < {source}",
    "{m512} convert /proc/self/fd/0 {target} --force < {source}",
    "{m512} convert /dev/fd/7 {target} --force 7< {source}",
    "{m512} convert <(cat {source}) {target} --force",
    '{m512} convert - {target} --force <<< "$(cat {source})"',
    "mkfifo fifo; cat {source} > fifo & {m512} convert fifo {target} --force",
    "{m512} pages - rename 3 foo -o {target} --force < {source}",
    "{m512} pages <(cat {source}) rename 3 foo -o {target} --force",
]
FILES = [("hand", "hand", True), ("main", "poses", True), ("own", "own", False), ("hand", "own", False)]


@pytest.mark.parametrize("line, source, target, kept", [(line, *files) for n, line in enumerate(FROM_PIPES) for files in FILES[: 4 if n < 3 else 1]])
def test_a_text_is_not_overwritten_by_its_own_motions_through_a_pipe(tmp_path, line, source, target, kept):
    """README: `-`, /dev/stdin and <(...) work as files."""
    files = tmp_path / "files"
    files.mkdir()
    image = read_text(TEXT)
    (files / "x.bin").write_bytes(image.to_bytes())
    (files / "x.mtn").write_bytes(formats.encode(files / "x.mtn", image)[0])
    (files / "hand.m512").write_text(BY_HAND)
    (files / "own.m512").write_text(write_text(image))
    (files / "poses.m512").write_text("motion512 1\npose up | 1:300  # as high as it goes\n")
    (files / "main.m512").write_text('motion512 1\ninclude "poses.m512"\npage 3 bow\nstep 9 | @up\n')
    before = (files / f"{target}.m512").read_bytes()
    command = line.format(m512=f"{sys.executable} -m m512", source=f"{source}.m512", target=f"{target}.m512")
    done = subprocess.run(["bash", "-c", command], cwd=files, capture_output=True, text=True, timeout=300)
    if kept:
        assert done.returncode == 5 and ("somebody's text" in done.stderr or "includes, and would be lost" in done.stderr), done.stderr
        assert (files / f"{target}.m512").read_bytes() == before
    else:
        assert done.returncode == 0, done.stderr


def test_a_text_of_somebody_else_is_overwritten_where_the_source_is_known(files):
    """Behind `<` is a file, and it is another one. From a pipe nobody can tell."""
    (files / "other.m512").write_text(BY_HAND)
    for command, code in (("convert - hand.m512 --force < other.m512", 0), ("convert <(cat x.bin) other.m512 --force", 0)):
        done = subprocess.run(["bash", "-c", f"{sys.executable} -m m512 {command}"], cwd=files, capture_output=True, text=True, timeout=300)
        assert done.returncode == code, done.stderr


@pytest.mark.parametrize("damage", [b"\nnonsense\n", b"\n# \xe4\n", b"\n# caf\xc3\xa9\n"])
def test_a_text_with_a_mistake_is_somebodys_too(files, damage):
    hand = files / "hand.m512"
    hand.write_bytes(hand.read_bytes() + damage)
    command = f"cat own.m512 | {sys.executable} -m m512 convert - hand.m512 --force"
    done = subprocess.run(["bash", "-c", command], cwd=files, capture_output=True, text=True, timeout=300)
    assert done.returncode == 5 and "remove it first" in done.stderr, done.stderr
    assert hand.read_bytes().endswith(damage)


@pytest.mark.parametrize("size", [65_024, 65_536, 131_072])
@pytest.mark.parametrize("suffix", ["m512", "hex", "mtn"])
def test_a_text_of_the_size_of_an_image_is_a_text(m512, files, size, suffix):
    """An image is known by its size, and a text can have any size."""
    path = files / f"size.{suffix}"
    data = formats.encode(path, read_text(TEXT))[0][: size - 10]
    path.write_bytes(data[:-2] + b" " * (size - len(data)) + data[-2:])
    wanted = {"m512": formats.TEXT, "hex": formats.HEX, "mtn": formats.MTN}[suffix]
    assert formats.recognise(path.read_bytes(), path) == wanted


@pytest.mark.parametrize("name", [b":hand", b"type=motion", b"motion512 1", b" \n:"])
def test_an_image_is_an_image_whatever_its_first_page_is_called(files, name):
    image = read_text(TEXT)
    image[1].name = name
    image[1].seal()
    for data in (image.to_bytes()[512:], bytes(image[1]) * 128, bytes(image[1]) * 256):
        assert formats.recognise(data, files / "x.m512") == formats.BINARY


@pytest.mark.parametrize("words", [["pages", "x.bin", "rename", "3", "new", "--in-place"], ["convert", "own.m512", "x.bin", "--force"]])
def test_a_write_protected_file_stays(m512, files, monkeypatch, words):
    """A file is replaced by a new one of the same name, for which the folder's permission would be enough, and root needs none."""
    monkeypatch.chdir(files)
    before = (files / "x.bin").read_bytes()
    (files / "x.bin").chmod(0o444)
    found = m512(*words)
    assert found.exit_code == 4 and "cannot write x.bin: Permission denied" in found.stderr
    assert (files / "x.bin").read_bytes() == before


@pytest.mark.parametrize("words", ["convert x.bin", "convert x.bin - --only 3", "pages x.bin extract 3 -o -"])
def test_motions_whose_reader_has_gone_are_no_bad_file(files, words):
    """As with `| true`."""
    read, write = os.pipe()
    os.close(read)
    found = subprocess.run([sys.executable, "-m", "m512", *words.split()], cwd=files, stdout=write, stderr=subprocess.PIPE, timeout=300, check=False)
    os.close(write)
    assert found.returncode == 141 and b"m512:" not in found.stderr, found.stderr


def test_files_are_replaced_whole_or_not_at_all(files, monkeypatch):
    target = files / "x.bin"
    before, mode = target.read_bytes(), target.stat().st_mode

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(FileError, match="No space left"):
        storage.write(target, b"half", replace=True)
    assert target.read_bytes() == before and sorted(path.name for path in files.iterdir()) == ["hand.m512", "own.m512", "x.bin"]
    monkeypatch.undo()
    storage.write(target, b"whole", replace=True)
    assert target.read_bytes() == b"whole" and target.stat().st_mode == mode


@pytest.mark.parametrize("name", ["x" * 255, "\u00e9" * 127])
def test_the_longest_name_that_a_folder_takes_is_written(files, name):
    for data in (b"new", b"replaced"):
        storage.write(files / name, data, replace=True)
        assert (files / name).read_bytes() == data


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP, signal.SIGINT])
def test_a_signal_while_the_file_gets_its_name_ends_m512_as_a_signal(files, monkeypatch, m512, number):
    """The file is written then. m512 said that it cannot be, because its temporary name was gone, and went on to an exit code of 4."""
    replace = os.replace

    def interrupted(*names):
        replace(*names)
        raise KeyboardInterrupt if number == signal.SIGINT else SystemExit(128 + number)

    monkeypatch.setattr(os, "replace", interrupted)
    done = m512("pages", files / "x.bin", "rename", "3", "new", "--in-place")
    assert done.exit_code == 128 + number and "cannot write" not in done.stderr, done.stderr
    assert formats.load(files / "x.bin")[3].name == b"new" and sorted(path.name for path in files.iterdir()) == ["hand.m512", "own.m512", "x.bin"]


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can give files away")
@pytest.mark.parametrize("name", ["x.bin", "own.m512", "link.bin"])
def test_a_file_keeps_its_owner_group_and_mode(m512, files, name):
    (files / "link.bin").symlink_to("x.bin")
    os.chown(files / name, 1234, 2345)
    os.chmod(files / name, 0o664)
    done = m512("pages", files / name, "rename", "3", "new", "--in-place")
    assert (done.exit_code, done.stderr) == (0, "")
    now = (files / name).stat()
    assert (now.st_uid, now.st_gid, now.st_mode & 0o7777) == (1234, 2345, 0o664)


@pytest.mark.parametrize(
    "uid, gid, says",
    [(1234, None, "owner"), (None, 2345, "group"), (1234, 2345, "owner and group"), (None, None, "")],
    ids=["uid", "gid", "both", "none"],
)
def test_an_owner_that_cannot_be_kept_is_said(files, monkeypatch, uid, gid, says):
    """A user who is not root, and a file of another user in a shared folder."""
    mine = files / "x.bin"
    monkeypatch.setattr(os, "chown", lambda *_: (_ for _ in ()).throw(PermissionError(1, "Operation not permitted")))
    status = list(mine.stat())
    status[4], status[5] = status[4] if uid is None else uid, status[5] if gid is None else gid
    lost = storage._keep_owner(str(mine), os.stat_result(status), mine)
    assert [says and f" {says} could not be kept" in line for line in lost] == ([True] if says else [])


def test_other_names_of_a_file_keep_the_old_contents_and_that_is_said(m512, files, monkeypatch):
    monkeypatch.chdir(files)
    os.link(files / "x.bin", files / "y.bin")
    before = (files / "x.bin").read_bytes()
    in_place = ("pages", "x.bin", "rename", "3", "new", "--in-place")
    done = m512(*in_place)
    assert done.exit_code == 0 and done.stderr == "loss: x.bin had other names (hard links): they keep the old contents\n"
    assert (files / "y.bin").read_bytes() == before and (files / "x.bin").read_bytes() != before
    assert m512(*in_place).stderr == ""


def test_a_folder_that_takes_no_file_is_named(m512, files, monkeypatch):
    result = m512("convert", files / "x.bin", files / "none" / "y.bin")
    assert result.exit_code == 4 and f"in the folder {files / 'none'}: No such file or directory" in result.stderr
    monkeypatch.setattr(storage.tempfile, "mkstemp", lambda **_: (_ for _ in ()).throw(PermissionError(13, "Permission denied")))
    result = m512("pages", files / "x.bin", "rename", "3", "new", "--in-place")
    assert result.exit_code == 4 and f"{files / 'x.bin'}: no new file can be made in the folder {files}: Permission denied" in result.stderr


# Boards


def full_flash():
    flash = bytearray(b"\xff" * 0x20000)
    flash[0xE000:0x1E000] = read_text(TEXT).to_bytes()
    return flash


@pytest.fixture
def board():
    with BlockPeer(full_flash()) as peer:
        yield peer


@pytest.fixture
def real_board():
    """A board at a real port."""
    with BlockPtyPeer(full_flash()) as peer:
        yield peer


def test_changing_a_board_shows_the_change_and_asks(m512, board):
    before = bytes(board.flash)
    result = m512("pages", board.path, "delete", "3")
    assert result.exit_code == 5 and "walk" in result.stderr and "--yes" in result.stderr and bytes(board.flash) == before
    assert m512("pages", board.path, "delete", "3", "--yes").exit_code == 0
    assert board.flash[0xE000 + 3 * 512 :][:512] == EMPTY


def with_page(number, name):
    """A page that somebody makes while m512 waits for an answer."""
    return read_text(f"motion512 1\npage {number} {name}\n  step 1s | 1..18:300\n")[number]


def meanwhile(monkeypatch, happens):
    """The user says yes to m512's question, and before that something happens."""
    monkeypatch.setattr(ui, "confirm", lambda question, yes: happens())


def test_what_a_person_saves_in_edit_during_the_question_stays(m512, monkeypatch, started):
    """Pages 7 and 9 are saved while m512 waits. Page 0 was never written, and saving wears the flash."""
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=TEXT + "page 7 bow\n  step 1s | 1:600\n", applied=True)
    edit.board.flash[0xE000:0xE200] = b"\xff" * 512
    edit.board.reset()
    edit.pass_time(1)
    new = {7: with_page(7, "deep_bow"), 9: with_page(9, "kick")}

    def saves():
        with VirtualLink(edit.path) as link:
            client = Client(link)
            for number, page in new.items():
                client.save_page(number, page)

    meanwhile(monkeypatch, saves)
    result = m512("pages", edit.path, "rename", "3", "march")
    assert result.exit_code == 0, result.stderr
    flash = bytes(edit.board.flash)
    assert [flash[0xE000 + 512 * n :][:512] for n in new] == [bytes(page) for page in new.values()]
    assert flash[0xE000 + 512 * 3 :][:5] == b"march" and flash[0xE000:0xE200] == b"\xff" * 512


def test_a_page_that_a_person_saves_in_edit_during_the_question_is_not_replaced(m512, monkeypatch, started):
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=TEXT, applied=True)

    def saves():
        with VirtualLink(edit.path) as link:
            Client(link).save_page(3, with_page(3, "run"))

    meanwhile(monkeypatch, saves)
    result = m512("pages", edit.path, "renumber", "3", "20")
    assert result.exit_code == 5 and 'page 3 "run": changed on the board' in result.stderr and "Nothing was written" in result.stderr, result.stderr
    assert bytes(edit.board.flash[0xE000 + 512 * 3 :][:512]) == bytes(with_page(3, "run"))
    assert bytes(edit.board.flash[0xE000 + 512 * 20 :][:512]) in (EMPTY, b"\xff" * 512)


def test_a_change_that_ends_half_way_says_what_was_written(m512, monkeypatch, tmp_path, started):
    """A page is moved: the first save works, the second is refused, as when a person begins to edit."""
    edit, saves = started("boot-cm5.hex", "edit-cm5.hex", text=TEXT, applied=True), []
    save = Client.save_page

    def second_fails(client, number, page):
        saves.append(number)
        if len(saves) == 2:
            raise BoardError("Edits would be lost", 12)
        save(client, number, page)

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(Client, "save_page", second_fails)
    result = m512("pages", edit.path, "renumber", "3", "20", "--yes")
    assert result.exit_code == 8 and "Only page 20 had been written" in result.stderr and saves == [20, 3], result.stderr
    flash = bytes(edit.board.flash)
    assert all(flash[0xE000 + 512 * number :][:4] == b"walk" for number in (3, 20))


def test_edit_that_has_edits_is_not_changed_and_no_file_says_so(m512, monkeypatch, tmp_path, started):
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=TEXT, applied=True)
    with VirtualLink(edit.path) as link:
        Client(link).ask("data 64 0102")
    monkeypatch.chdir(tmp_path)
    result = m512("pages", edit.path, "renumber", "3", "20", "--yes")
    assert result.exit_code == 8 and "puts back" not in result.stderr and not list(tmp_path.iterdir()), result.stderr


def test_a_page_that_a_person_saves_in_edit_during_the_writing_is_not_put_back(m512, monkeypatch, tmp_path, started):
    """Page 20 is written; then page 3 is another."""
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=TEXT, applied=True)
    save = Client.save_page

    def somebody_saves_too(client, number, page):
        save(client, number, page)
        save(client, 3, with_page(3, "run"))

    monkeypatch.setattr(Client, "save_page", somebody_saves_too)
    monkeypatch.chdir(tmp_path)
    result = m512("pages", edit.path, "renumber", "3", "20", "--yes")
    told = 'page 3 "run": changed on the board after m512 had read it, and stays as it is there. Only page 20 had been written by then. '
    assert result.exit_code == 5 and told in result.stderr and "epeat" not in result.stderr, result.stderr
    command = re.search("`m512 (flash .*)` puts back what page 20 held$", result.stderr.strip())
    assert m512(*command[1].split()).exit_code == 0
    assert bytes(edit.board.flash[0xE000 + 512 * 3 :][:512]) == bytes(with_page(3, "run"))
    assert bytes(edit.board.flash[0xE000 + 512 * 20 :][:512]) == EMPTY


@pytest.mark.parametrize("number, code", [(7, 0), (3, 5)])
def test_what_another_program_writes_during_the_question_stays(m512, monkeypatch, board, number, code):
    """A board at its loader's prompt. Page 50 is erased and stays so."""
    board.flash[0xE000 + 512 * 50 : 0xE000 + 512 * 51] = b"\xff" * 512
    new = bytes(with_page(number, "new"))

    def writes():
        board.flash[0xE000 + 512 * number : 0xE000 + 512 * (number + 1)] = new

    meanwhile(monkeypatch, writes)
    result = m512("pages", board.path, "rename", "3", "march")
    assert result.exit_code == code and ('page 3 "new": changed on the board' in result.stderr) == (code == 5), result.stderr
    assert board.flash[0xE000 + 512 * number :][:512] == new
    assert board.flash[0xE000 + 512 * 50 :][:512] == b"\xff" * 512
    assert board.flash[0xE000 + 512 * 3 :][:5] == (b"march" if code == 0 else b"new\0\0")
    assert code == 0 or board.left[-1] == 0


def test_play_keeps_its_erased_pages_erased(m512, started):
    """A write of a page takes 10 ms of the board's time and some of its flash's life, and changes nothing that a robot does."""
    play = started("boot-cm5.hex", "play-cm5.hex", text=TEXT, applied=True)
    play.board.flash[0xE000 + 512 * 50 : 0xE000 + 512 * 51] = b"\xff" * 512
    play.board.reset()
    play.pass_time(1)
    result = m512("pages", play.path, "rename", "3", "march", "--yes")
    assert result.exit_code == 0, result.stderr
    assert bytes(play.board.flash[0xE000 + 512 * 50 :][:512]) == b"\xff" * 512 and bytes(play.board.flash[0xE000 + 512 * 3 :][:5]) == b"march"


@pytest.mark.parametrize("there", [BlockPeer, FactoryPeer])
def test_a_board_that_waits_in_its_loader_does_so_after_a_change(m512, there):
    """It may hold no program, half of one after an interrupted flash, or be left there on purpose."""
    with there(full_flash()) as board:
        board.eeprom[0xFFF] = 0xFF
        result = m512("pages", "--board", "cm5", board.path, "rename", "3", "march", "--yes")
        assert result.exit_code == 0 and "waits in its boot loader; `m512 run` starts the application" in result.stderr, result.stderr
        assert board.flash[0xE000 + 512 * 3 :][:5] == b"march"
        assert board.state != 0 and board.eeprom[0xFFF] == 0xFF


@pytest.mark.parametrize("mode, says", [(0x11, "The controller restarts"), (0xFF, "waits in its boot loader")])
def test_a_board_whose_play_was_restarted_keeps_its_boot_mode(m512, started, mode, says):
    """EEPROM 0xFFF: 0xFF stays in the loader at every start (firmware/boot/ORIGINAL.md)."""
    play = started("boot-cm5.hex", "play-cm5.hex", text=TEXT, applied=True)
    play.board.eeprom[0xFFF] = mode
    result = m512("pages", play.path, "rename", "3", "march", "--yes")
    assert result.exit_code == 0 and says in result.stderr and play.board.eeprom[0xFFF] == mode, result.stderr
    play.pass_time(1)
    with VirtualLink(play.path) as link:
        if mode == 0xFF:
            assert loaders.at_prompt(link)
        else:
            assert Client(link).version["image"].lower() == "play"


def test_a_link_beyond_the_last_page_is_no_change(m512, board):
    image = read_text(TEXT)
    image[3].next = 200
    board.flash[0xE000 + 512 * 3 : 0xE000 + 512 * 4] = bytes(image[3].seal())
    result = m512("pages", board.path, "rename", "1", "stood", "--yes")
    assert result.exit_code == 0 and "page 3" not in result.stderr and board.flash[0xE000 + 512 * 3 + 25] == 200, result.stderr


@pytest.mark.parametrize("at_prompt, left", [(True, 0), (False, 2)])
def test_restore_answered_no_leaves_the_board_as_it_was_found(m512, board, tmp_path, at_prompt, left):
    assert m512("backup", tmp_path / "b", "-p", board.path, "--what", "motions").exit_code == 0
    board.flash[0xE000 + 600] ^= 1
    board.state = PROMPTED if at_prompt else 0
    board.left.clear()
    before = bytes(board.flash)
    result = m512("restore", tmp_path / "b", "-p", board.path, "--wait", "5")
    assert result.exit_code == 5 and bytes(board.flash) == before
    assert board.left[-1] == left


@pytest.mark.parametrize("what", ["", ",", " "])
def test_a_backup_of_nothing_is_none(m512, board, tmp_path, what):
    assert m512("backup", tmp_path / "b", "-p", board.path, "--what", "motions").exit_code == 0
    for words in (("backup", tmp_path / "c"), ("restore", tmp_path / "b")):
        result = m512(*words, "-p", board.path, "--what", what)
        assert result.exit_code == 2 and "the areas are motions, app, eeprom" in result.stderr, result.stderr
    assert not (tmp_path / "c").exists()
    manifest = json.loads((tmp_path / "b" / "manifest.json").read_text())
    (tmp_path / "b" / "manifest.json").write_text(json.dumps({**manifest, "files": {}}))
    result = m512("restore", tmp_path / "b", "-p", board.path)
    assert result.exit_code == 4 and f"{tmp_path / 'b'} holds nothing to restore" in result.stderr


def test_restore_that_is_refused_leaves_the_board_as_it_was_found(m512, tmp_path):
    """An application of a CM-2 for a CM-5 on which Play was running."""
    flash = bytearray(make_app(board=2)).ljust(0x20000, b"\xff")
    with BlockPeer(flash, board=2) as other:
        assert m512("backup", tmp_path / "b", "-p", other.path, "--what", "app").exit_code == 0
    with BlockPeer(full_flash(), board=1, state=0) as board:
        before = bytes(board.flash)
        result = m512("restore", tmp_path / "b", "-p", board.path, "--yes", "--wait", "5")
        assert result.exit_code == 5 and "application is for a cm2" in result.stderr, result.stderr
        assert bytes(board.flash) == before and board.left[-1] == 2


@pytest.mark.parametrize("word", ["PORT", "/dev/no_port", "no_port"])
def test_doctor_does_not_ask_for_the_port_that_was_named(m512, real_board, word):
    with Link(real_board.path):
        told = m512("doctor", "-p", real_board.path if word == "PORT" else word)
    assert told.exit_code == 3 and "BAD  port" in told.stdout and "name the port with -p" not in told.stdout, told.stdout
    assert ("in use by another program" in told.stdout) == (word == "PORT")


def test_port_is_opened_by_one_program_alone(real_board):
    with (
        Link(real_board.path),
        pytest.raises(PortError, match="in use by another program.*waits for a play, Ctrl-C there stops.*repeat this command"),
    ):
        Link(real_board.path)
    Link(real_board.path).close()


def test_what_a_board_or_a_file_says_does_not_steer_the_terminal(m512, files):
    image = Image.empty()
    image[5] = read_text(TEXT)[3]
    image[5].data[:6] = b"\x1b[2Jm\x07"
    (files / "evil.bin").write_bytes(image.to_bytes())
    for action in (["list"], ["check"], ["show", "5"], ["time", "5"]):
        result = m512("pages", files / "evil.bin", *action)
        assert not re.search(r"[\x00-\x08\x0b-\x1f\x7f-\x9f]", result.stdout + result.stderr)
    result = m512("convert", files / "\x1b[31mnothing", files / "y.bin")
    assert result.exit_code == 4 and "\x1b" not in result.stderr and "\\x1B" in result.stderr


# Text


def test_backslash_at_the_end_of_the_file_or_of_a_comment_swallows_nothing():
    with pytest.raises(TextError, match="backslash"):
        read_text(TEXT + "  step 1s | 1..18:9 \\")
    text = TEXT + "# C:\\motions\\\n  step 60 | 1..18:9\n"
    assert read_text(text)[3].steps == 2
    assert read_text(TEXT + "  step 60 | \\\n 1..18:9 # so\n")[3].steps == 2


def test_plus_before_an_angle_is_not_taken_for_an_absolute_one():
    with pytest.raises(TextError, match="30deg for the angle, or \\+102"):
        read_text(TEXT + "  step 60 | same 1:+30deg\n")
    assert read_text(TEXT + "  step 60 | same 1:-30deg\n")[3].word(1, 1) == 410


def test_check_says_what_a_page_speed_does_to_the_times(m512, tmp_path):
    (tmp_path / "x.m512").write_text("motion512 1\npage 1 slow\n  speed 64\n  step 0.5s | 1:512\n")
    result = m512("pages", tmp_path / "x.m512", "check")
    assert result.exit_code == 0 and "0.5 s becomes 1 s" in result.stderr


def test_include_of_an_endless_file_is_an_error(tmp_path):
    (tmp_path / "x.m512").write_text('motion512 1\ninclude "/dev/zero"\n')
    with pytest.raises(M512Error, match="/dev/zero"):
        formats.load(tmp_path / "x.m512")


@pytest.mark.parametrize("name", ["fifo", "-", "/dev/stdin", "/dev/fd/0"])
def test_include_of_a_pipe_does_not_wait(m512, tmp_path, monkeypatch, name):
    """Nobody writes to it, so m512 waited for ever."""
    monkeypatch.chdir(tmp_path)
    os.mkfifo("fifo")
    (tmp_path / "x.m512").write_text(f'motion512 1\ninclude "{name}"\n')
    done = subprocess.run(
        [sys.executable, "-m", "m512", "pages", "x.m512", "list"], stdin=subprocess.PIPE, capture_output=True, text=True, timeout=20
    )
    assert done.returncode == 4 and "x.m512:2: cannot read" in done.stderr, done.stderr


# Pipes


def test_convert_is_a_textconv_of_git(files):
    result = run("convert", files / "x.bin")
    assert result.returncode == 0 and read_text(result.stdout.decode()).to_bytes() == (files / "x.bin").read_bytes()
    git = [
        "git",
        "-c",
        "user.name=a",
        "-c",
        "user.email=a@b",
        "-c",
        "core.attributesFile=" + str(files / "attributes"),
        "-c",
        f"diff.motions.textconv={sys.executable} -m m512 convert",
    ]
    (files / "attributes").write_text("*.bin diff=motions\n")
    subprocess.run(["git", "init", "-q"], cwd=files, check=True)
    subprocess.run([*git, "add", "x.bin"], cwd=files, check=True)
    subprocess.run([*git, "commit", "-qm", "x"], cwd=files, check=True)
    changed = read_text(TEXT.replace("400", "401"))
    (files / "x.bin").write_bytes(changed.to_bytes())
    shown = subprocess.run([*git, "diff"], cwd=files, capture_output=True, text=True).stdout
    assert "401" in shown and "Binary" not in shown


@pytest.mark.parametrize("source", ["-", "/dev/stdin"])
def test_standard_input_and_output(files, source):
    data = (files / "x.bin").read_bytes()
    assert b"walk" in run("pages", source, "list", input=data).stdout
    assert run("convert", source, "/dev/stdout", input=data).stdout.startswith(b"motion512 1")


@pytest.mark.parametrize("words", ["diff - -", "diff - /dev/stdin", "pages - merge - 3 -o y.bin"])
def test_standard_input_for_two_files_is_a_sentence(m512, files, monkeypatch, words):
    monkeypatch.chdir(files)
    result = m512(*words.split(), input=(files / "x.bin").read_bytes())
    assert result.exit_code == 4 and "standard input gives one file, and here it is asked for two" in result.stderr


@pytest.mark.parametrize("words", [("list",), ("show", "walk"), ("check", "--json")])
def test_a_result_that_nobody_can_get_is_no_success(files, words):
    command = [sys.executable, "-m", "m512", "pages", str(files / "x.bin"), *words]
    result = subprocess.run(["sh", "-c", 'exec "$@" >&-', "sh", *command], stderr=subprocess.PIPE, text=True)
    assert result.returncode == 4 and result.stderr == "m512: standard output is closed: the result is lost\n"


@pytest.mark.parametrize("target", ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"])
def test_standard_output_may_be_a_file_that_is_there(files, target):
    """`>> log`: its existing content stays."""
    log = files / "log"
    log.write_text("before\n")
    with open(log, "ab") as out:
        command = [sys.executable, "-m", "m512", "convert", str(files / "x.bin"), target]
        assert subprocess.run(command, stdout=out).returncode == 0
    assert log.read_text().startswith("before\nmotion512 1")


@pytest.mark.parametrize("target", ["-", "/dev/stdout"])
def test_pages_of_a_board_go_to_standard_output(m512, started, target):
    play = started("play-cm5.hex", text=TEXT)
    play.pass_time(1)
    result = m512("get", "all", "-o", target, "-p", play.path)
    assert result.exit_code == 0 and read_text(result.stdout)[3] == read_text(TEXT)[3], result.stderr


def test_process_substitution(files):
    command = f"{sys.executable} -m m512 diff <(cat {files}/x.bin) {files}/own.m512"
    assert subprocess.run(["bash", "-c", command]).returncode == 0


# No tracebacks


@pytest.mark.parametrize("source, code", [("x.bin", 0), ("missing.bin", 4)])
def test_remarks_that_find_no_room_change_no_outcome(files, source, code):
    """`2> log` on a full disk once ended a transfer in the middle, with exit code 1."""
    image = Image.empty(256)
    image[200] = read_text("motion512 1\nbits 12\npage 1 a\n  step 1s | 1:2048\n")[1]
    (files / "x.bin").write_bytes(image.to_bytes())
    command = [sys.executable, "-m", "m512", "convert", str(files / source), str(files / "new.m512")]
    with open("/dev/full", "w") as full:
        assert subprocess.run(command, stderr=full).returncode == code


def test_terminal_takes_lines_from_a_pipe(real_board):
    result = run("term", "-p", real_board.path, input=b"id\n")
    assert result.returncode == 0 and b"ID Motion512 boot" in result.stdout and b"Traceback" not in result.stderr


def test_ctrl_c_has_an_exit_code_of_its_own(m512, files, monkeypatch):
    def stop(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(formats, "load", stop)
    result = m512("pages", files / "x.bin", "list")
    assert result.exit_code == 130 and "stopped" in result.stderr


def test_ctrl_c_during_the_imports_is_no_traceback(tmp_path):
    (tmp_path / "click.py").write_text("raise KeyboardInterrupt\n")
    done = run("--help", env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert (done.returncode, done.stderr) == (130, b"m512: stopped\n")


def test_ctrl_c_during_the_imports_is_not_lost(tmp_path):
    """Python drops an exception in a callback of the import system or in a destructor, and shows where it was."""
    (tmp_path / "click.py").write_text("""if True:
        import os, signal
        class Callback:
            def __del__(self):
                os.kill(os.getpid(), signal.SIGINT)
                for _ in range(1000):  # Python raises KeyboardInterrupt between two steps
                    pass
        Callback()""")
    done = run("--help", env={**os.environ, "PYTHONPATH": str(tmp_path)})
    assert (done.returncode, done.stderr) == (-signal.SIGINT, b"")


@pytest.mark.parametrize(
    "number, file, ignored",
    [(signal.SIGINT, "x.bin", False), (signal.SIGTERM, "x.bin", False), (signal.SIGHUP, "none.bin", False), (signal.SIGHUP, "x.bin", True)],
)
def test_a_signal_after_the_last_word_is_no_traceback(files, number, file, ignored):
    """Python calls what is registered here when the command is done. `ignored`: as under nohup."""
    code = f"""if True:
        import atexit, os, runpy, signal, sys
        sys.argv = ["m512", "pages", "{file}", "list"]
        {f"signal.signal({number}, signal.SIG_IGN)" if ignored else ""}
        atexit.register(lambda: os.kill(os.getpid(), {number}))
        runpy.run_module("m512", run_name="__main__")"""
    done = subprocess.run([sys.executable, "-c", code], cwd=files, capture_output=True, text=True, timeout=300)
    assert done.returncode == (0 if ignored else -number) and "Exception" not in done.stderr and "Traceback" not in done.stderr, done.stderr


RENAME = ["pages", "x.bin", "rename", "3", "new", "-o", "new.bin"]


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize("place, command", [("cb", RENAME), ("rename", RENAME), ("__set_name__", ["flash", "x.bin", "--yes", "-p", "none"])])
def test_a_signal_out_of_which_python_lets_no_exception_is_not_lost(files, number, place, command):
    """Python drops an exception out of what it calls behind each import and out of __del__, and the command would be carried out. Before
    3.12 one out of __set_name__, within an import, was a traceback."""
    code = f"""if True:
        import os, signal, sys
        class Dropped:
            def __del__(self):
                os.kill(os.getpid(), {number})
                for _ in range(1000):  # Python raises between two steps
                    pass
        def kill(frame, event, _):
            place, owner = frame.f_code.co_name, frame.f_locals.get("owner")
            if place == "__set_name__" and getattr(owner, "__name__", "") != "Image":
                return
            if event == "call" and place == "{place}" and signal.getsignal({number}) != signal.SIG_DFL:
                sys.setprofile(None)
                Dropped() if place == "rename" else os.kill(os.getpid(), {number})
        sys.argv = ["m512"] + {command}
        from m512.__main__ import main
        for number in (signal.SIGTERM, signal.SIGHUP):
            signal.signal(number, signal.SIG_DFL)
        sys.setprofile(kill)
        main()"""
    done = subprocess.run([sys.executable, "-c", code], cwd=files, capture_output=True, text=True, timeout=300)
    assert done.returncode == 128 + number and "Exception" not in done.stderr and "Traceback" not in done.stderr, done.stderr
    assert not (files / "new.bin").exists()


def test_an_error_of_a_board_that_python_drops_is_no_signal(tmp_path):
    """It has a number as well: an answer of 15 is not SIGTERM, and one of 11 not a crash."""
    code = """if True:
        import time
        from m512 import signals
        from m512.errors import BoardError
        class Dropped:
            def __del__(self):
                raise BoardError("no", 15)
        signals.end_with_exceptions()
        Dropped()
        time.sleep(0.2)"""
    done = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0 and "BoardError" in done.stderr, done.stderr


# The package


def test_version_is_that_of_the_project():
    text = (REPO / "CMakeLists.txt").read_text()
    assert __version__ == re.search(r"project\(motion512 VERSION ([0-9.]+)", text).group(1)


def test_package_says_that_it_is_typed_and_its_licence():
    text = (REPO / "tools" / "m512" / "pyproject.toml").read_text()
    assert 'license = "MIT"' in text and "py.typed" in text
    assert (REPO / "tools" / "m512" / "src" / "m512" / "py.typed").exists()


# First steps of a new user


def test_dry_run_looks_at_the_board_and_changes_nothing(m512, files, board):
    before = bytes(board.flash)
    result = m512("flash", files / "x.bin", "-p", board.path, "--dry-run")
    assert result.exit_code == 0 and "the board holds this already" in result.stderr
    board.flash[0xE000 + 600] ^= 1
    before = bytes(board.flash)
    result = m512("flash", files / "x.bin", "-p", board.path, "--dry-run")
    assert "1 of 254 flash pages would be written" in result.stderr and bytes(board.flash) == before


def test_a_dry_run_has_its_plan_as_json(m512, files, board):
    board.flash[0xE000 + 600] ^= 1
    result = m512("flash", files / "x.bin", "-p", board.path, "--dry-run", "--json")
    assert result.exit_code == 0
    plan = json.loads(result.stdout)
    assert plan["file"] == str(files / "x.bin") and plan["holds"] == "motions" and plan["pages"] == 254
    assert (plan["first"], plan["last"]) == (0xE200, 0x1DFFF) and "keeps its own" in plan["notes"][0]
    assert "1 of 254 flash pages would be written" in plan["found"][0]


def test_doctor_finds_the_loader_in_a_session_that_ctrl_c_has_left_open(m512, files):
    """Doctor's own bytes keep such a session alive."""
    with BlockPeer(full_flash(), state=SESSION) as board:
        result = m512("doctor", "-p", board.path)
        assert "Motion512 boot loader" in result.stdout and "silence" not in result.stdout, result.stdout
        assert board.state == PROMPTED and not board.writes


def test_a_start_without_a_file_is_told_as_json(m512, board):
    result = m512("run", "-p", board.path, "--json")
    assert result.exit_code == 0
    assert json.loads(result.stdout) == {"loader": "Motion512 boot loader", "board": "cm5", "started": True}


@pytest.mark.parametrize("words", [("play", "1"), ("doctor",), ("flash", "x.bin"), ("term",), ("backup",)])
def test_an_empty_name_is_no_port(m512, words):
    result = m512(*words, "-p", "")
    assert result.exit_code == 2 and "an empty name is no port" in result.stderr, result.stderr


def test_a_simulator_that_is_not_there_is_not_replaced_by_another(m512, monkeypatch, tmp_path):
    monkeypatch.setenv("M512_CM5SIM", str(tmp_path / "nope"))
    result = m512("pose", "--sim")
    assert result.exit_code == 9 and f"{tmp_path / 'nope'}, which M512_CM5SIM names" in result.stderr, result.stderr


def test_port_without_its_path_gets_a_hint(m512):
    result = m512("play", "1", "-p", "robot")
    assert result.exit_code == 6 and "-p ./robot" in result.stderr


def test_what_is_no_port_is_told_without_a_useless_hint(m512, files):
    (files / "here.bin").write_bytes(b"x")
    for word, says in ((str(files / "here.bin"), "is no serial port"), (str(files / "gone"), "no serial port is called")):
        result = m512("play", "1", "-p", word)
        assert result.exit_code == 6 and says in result.stderr and "-p ./" not in result.stderr, result.stderr


def test_images_beside_the_simulator_are_found(tmp_path, monkeypatch):
    from m512.board import sim
    from m512.errors import MissingError

    (tmp_path / "bin").mkdir()
    (tmp_path / "bin" / "cm5sim").write_text("")
    (tmp_path / "bin" / "play-cm5.hex").write_text("")
    monkeypatch.setenv("M512_CM5SIM", str(tmp_path / "bin" / "cm5sim"))
    monkeypatch.setenv("M512_BUILD", str(tmp_path / "nothing"))
    assert sim.find_image("play-cm5.hex") == tmp_path / "bin" / "play-cm5.hex"
    monkeypatch.delenv("M512_CM5SIM")
    monkeypatch.setattr(sim, "wheel_folder", lambda: None)
    monkeypatch.setattr(sim.child.sys, "executable", str(tmp_path / "python"))
    monkeypatch.setenv("PATH", "")
    with pytest.raises(MissingError, match="wheel .*M512_CM5SIM"):
        sim.find_cm5sim()


def test_doctor_does_not_repeat_itself(m512, monkeypatch, tmp_path):
    monkeypatch.setenv("M512_BUILD", str(tmp_path))
    monkeypatch.setenv("PATH", "")
    said = m512("doctor", "-p", "robot").stdout
    assert "there are:" not in said
    lines = [line.strip(" ->") for line in said.splitlines()]
    for line in lines:
        assert said.count(line) == 1 or len(line) < 12, line
    assert said.count("not installed") <= 2


# Errors of the operating system, and unintended input


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="a device that is always full is Linux's")
@pytest.mark.parametrize("words", [["pages", "x.bin", "list"], ["pages", "x.bin", "list", "--json"], ["--help"], ["convert", "x.bin"]])
def test_a_full_disk_behind_the_output_is_a_sentence(files, words):
    with open("/dev/full", "wb") as full:
        found = subprocess.run([sys.executable, "-m", "m512", *words], stdout=full, stderr=subprocess.PIPE, text=True, cwd=files, timeout=300)
    assert found.returncode == 4 and "No space left" in found.stderr and "Traceback" not in found.stderr and len(found.stderr.splitlines()) == 1


def test_a_name_that_no_file_can_have_is_a_sentence(m512, files):
    found = m512("convert", files / "x.bin", files / ("a" * 300 + ".bin"))
    assert found.exit_code == 4 and "too long" in found.stderr


def test_a_closed_output_is_a_sentence(files):
    found = subprocess.run(f"{sys.executable} -m m512 convert x.bin >&-", shell=True, stderr=subprocess.PIPE, cwd=files, timeout=300)
    assert found.returncode == 4 and b"standard output is closed" in found.stderr


@pytest.mark.parametrize(
    "words, code, says",
    [
        ("pose --sim >&-", 4, "standard output is closed"),
        ("get all -o g.bin --sim --motions x.bin 2>&-", 0, ""),
        ("get all -o g.bin --sim --motions x.bin <&-", 0, ""),
        ("drive 3 --sim --motions x.bin <&-", 5, "driving by keys needs a terminal"),
    ],
)
def test_a_closed_stream_is_no_file_that_is_opened_next(files, words, code, says):
    found = subprocess.run(f"{sys.executable} -m m512 {words}", shell=True, stderr=subprocess.PIPE, text=True, cwd=files, timeout=300)
    assert found.returncode == code and says in found.stderr and "Traceback" not in found.stderr, found.stderr


def test_a_reader_that_goes_away_ends_results_and_no_work(files):
    """Results without a reader end the command as a failure. Remarks without a reader end nothing."""
    for words, streams, code in (("pages x.bin list", "", 141), ("pages x.bin rename 3 stand -o y.bin", "2>&1", 0), ("pages no.bin list", "2>&1", 4)):
        subprocess.run(f"({sys.executable} -m m512 {words}; echo $? > rc) {streams} | true", shell=True, cwd=files, timeout=300, check=True)
        assert int((files / "rc").read_text()) == code, words
    assert (files / "y.bin").exists()


def test_an_empty_file_and_a_folder_that_is_no_backup_are_called_so(m512, files):
    (files / "empty.m512").write_text("")
    assert "empty.m512: empty, so it holds no motions" in m512("pages", files / "empty.m512", "list").stderr
    for words in (("diff", files, files / "x.bin"), ("restore", files), ("restore", files / "x.bin")):
        result = m512(*words)
        assert result.exit_code == 4 and "is no backup's folder: there is no manifest.json in it" in result.stderr


# The command line is checked before anything is asked or started


@pytest.fixture
def says(tmp_path, monkeypatch):
    """says(text) installs a Play for an adapter that prints this text when it ends."""
    monkeypatch.setenv("M512_PROGRAMS", str(tmp_path))

    def put(text):
        program = tmp_path / "motion512-play"
        program.write_text(f"#!/bin/sh\nend() {{ echo 'motion512-play: {text}' >&2; exit 4; }}\neval \"$START\"\nend\n")
        program.chmod(0o755)

    return put


@pytest.mark.parametrize(
    "text, ours",
    [
        ("x: the folder cannot be made. --robot names another", "x: the folder cannot be made. M512_ROBOT names another"),
        ("no home folder: name one with --robot", "no home folder: name one in M512_ROBOT"),
    ],
)
def test_what_a_program_refuses_is_told_in_words_of_m512(m512, says, text, ours):
    says(text)
    assert m512("pose", "-p", "bus:/dev/ttyX").stderr == f"m512: {ours}\n"


def test_the_reason_of_a_program_that_ends_while_its_console_is_opened_is_the_error(m512, says, monkeypatch):
    """pyserial lets termios.error through when the console ends in the middle of its opening."""

    def ends(*_, **__):
        raise termios.error(5, "Input/output error")

    says("pages.bin: not a file of 131072 bytes")
    monkeypatch.setenv("START", "echo serial port: /dev/pts/0 >&2")
    monkeypatch.setattr("serial.serial_for_url", ends)
    done = m512("pose", "-p", "bus:/dev/ttyX")
    assert done.stderr == "m512: pages.bin: not a file of 131072 bytes\n" and done.exit_code == 4


def test_what_a_program_says_at_its_end_is_told_in_words_of_m512(says, monkeypatch, capsys):
    says("ended. To make them limp: --off, or m512 torque off")
    monkeypatch.setenv("START", "trap end INT; echo serial port: /dev/pts/0 >&2; while :; do sleep 0.1; done")
    program = bus.Program("bus:/dev/ttyX", "play")
    program.tell()
    program.close()
    assert capsys.readouterr().err == "note: ended. To make them limp: m512 torque off -p bus:/dev/ttyX\n"


@pytest.mark.parametrize("when", ["console", "greeting"])
@pytest.mark.parametrize("error", [KeyboardInterrupt, SystemExit])
def test_a_program_for_an_adapter_ends_with_a_start_that_is_ended(says, monkeypatch, tmp_path, when, error):
    """Left behind, it would keep the adapter and the robot's folder from the next command."""
    master, slave = os.openpty()
    port = f"echo serial port: {os.ttyname(slave)} >&2; " if when == "greeting" else ""
    says("ended")
    monkeypatch.setenv("START", f"trap 'rm {tmp_path}/runs; exit' INT; touch {tmp_path}/runs; {port}while :; do sleep 0.1; done")

    def ended(*_):
        while not (tmp_path / "runs").exists():
            time.sleep(0.01)
        raise error

    if when == "console":
        monkeypatch.setattr(child.select, "select", ended)
    else:
        monkeypatch.setattr(Link, "_receive", ended)
    with pytest.raises(error):
        Link("bus:/dev/ttyX")
    assert not (tmp_path / "runs").exists()
    os.close(master)
    os.close(slave)


def test_a_device_that_is_no_serial_port_is_called_so(m512):
    result = m512("doctor", "-p", "bus:/dev/null")
    assert "/dev/null: not a serial port" in result.stdout and "Errno" not in result.stdout and "ioctl" not in result.stdout


@pytest.mark.parametrize("rate", [0, 99999999999])
def test_a_rate_that_no_adapter_has_is_called_so(m512, rate):
    assert f"bus:/dev/null@{rate}: the rate is 9600..3000000" in m512("doctor", "-p", f"bus:/dev/null@{rate}").stdout


@pytest.mark.skipif(not os.path.exists("/proc/locks"), reason="Linux tells who has locked a file")
def test_a_program_whose_name_is_cut_inside_a_letter_is_named(tmp_path):
    """Linux keeps 15 bytes of a name."""
    set_name, mine = 15, Path("/proc/self/comm").read_bytes().strip()
    with (tmp_path / "locked").open("w") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        ctypes.CDLL(None).prctl(set_name, "sicherungskopi\u00fc".encode())
        try:
            assert f"sicherungskopi\ufffd, process {os.getpid()}" in bus._holder(file.name)
        finally:
            ctypes.CDLL(None).prctl(set_name, mine)


@pytest.mark.parametrize("words", [("extract", "1"), ("rename", "1", "x"), ("delete", "1"), ("merge", "x.bin", "1")])
def test_an_output_is_looked_at_before_a_board(m512, files, words):
    result = m512("pages", "/dev/no_port", *words, "-o", files / "x.foo")
    assert result.exit_code == 4 and "the suffix decides the format" in result.stderr
    result = m512("pages", "/dev/no_port", *words, "-o", files / "x.bin")
    assert result.exit_code == 5 and "--force overwrites it" in result.stderr
    result = m512("pages", "/dev/no_port", *words, "-o", files / "y.bin", "--in-place")
    assert result.exit_code == 2 and "one of the two" in result.stderr


def test_a_dry_run_that_hears_nobody_names_the_port(m512, files):
    with BlockPeer() as silent:
        silent.on_byte = lambda byte: None
        result = m512("flash", files / "x.bin", "-p", silent.path, "--dry-run")
    assert result.exit_code == 7 and f"{silent.path}: no boot loader answers, and neither" in result.stderr


def test_a_loader_that_was_read_answers_at_once(m512, files, board):
    assert m512("pages", board.path, "list").exit_code == 0
    result = m512("flash", files / "x.bin", "-p", board.path, "--dry-run")
    assert result.exit_code == 0 and "the board holds this already" in result.stderr, result.stderr


@pytest.mark.parametrize(
    "name, data, one",
    [
        ("one.bin", b"\xff", "1 byte that makes no motion file "),
        ("row.m512", b"motion512 1\nrow 1..6\npage 1 x\n  step 1s | 512\n", "1 position;"),
        ("row.m512", b"motion512 1\nrow 1\npage 1 x\n  step 1s | 512 512\n", "the row has 1 joint"),
    ],
)
def test_one_is_no_plural(m512, tmp_path, name, data, one):
    (tmp_path / name).write_bytes(data)
    told = m512("pages", tmp_path / name, "list").stderr
    assert re.search(re.escape(one) + r"(?!s)", told), told


def test_one_flash_page_is_no_plural():
    assert str(Report(128, 1, 0.1, 1)).startswith("1 of 128 flash pages written") and "1 repetition on" in str(Report(128, 1, 0.1, 1))
    assert str(Report(1, 0, 0.1, 0)) == "the flash page was there already"


def test_one_cell_that_differs_is_no_plural(m512, board, tmp_path):
    assert m512("backup", tmp_path / "b", "-p", board.path, "--what", "eeprom").exit_code == 0
    board.eeprom[5] ^= 1
    told = m512("restore", tmp_path / "b", "-p", board.path).stderr
    assert "EEPROM: 1 cell differs\n" in told, told


def test_a_dry_run_without_a_board_is_no_success(m512, files, monkeypatch):
    monkeypatch.setattr(ports, "available", list)
    result = m512("flash", files / "x.bin", "--dry-run")
    assert result.exit_code == 6 and "254 flash pages" in result.stderr, result.stderr


@pytest.mark.parametrize("at_prompt, left", [(True, 0), (False, 2)])
def test_sigterm_leaves_the_board_as_it_was_found(m512, files, board, monkeypatch, at_prompt, left):
    board.state = PROMPTED if at_prompt else 0
    monkeypatch.setattr(block.BlockLoader, "different", lambda *_: signal.raise_signal(signal.SIGTERM))
    result = m512("flash", files / "x.bin", "-p", board.path, "--wait", "5")
    assert result.exit_code == 128 + signal.SIGTERM and result.stderr.endswith("m512: stopped by SIGTERM\n"), result.stderr
    assert board.left == [left]


def test_ctrl_c_leaves_a_loader_that_is_read_at_its_prompt(m512, board, monkeypatch):
    def stop(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(block.BlockLoader, "read", stop)
    for words in (("pages", board.path, "list"), ("diff", board.path, board.path)):
        board.left.clear()
        assert m512(*words).exit_code == 130 and board.left == [0]
