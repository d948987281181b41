# SPDX-License-Identifier: MIT
"""Whether a file or folder may be replaced is judged when it gets its name, so also what another program has made since m512 began stays."""

import ast
import json
import os
from datetime import datetime
from types import SimpleNamespace

import pytest
from block_peer import BlockPeer
from test_imports import TOP

import m512.board.backup as backups
from m512.board.kept import kept
from m512.cli import board as commands
from m512.errors import FileError, RefusedError
from m512.files import formats, storage
from m512.files.image import Image
from m512.files.text import read_text

MOTION = "motion512 1\npage 1 stand\n  step 1s | 1..18:512\n"


@pytest.fixture
def here(tmp_path, monkeypatch):
    """The current folder, with a motion file and a small backup."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "x.bin").write_bytes(read_text(MOTION).to_bytes())
    (tmp_path / "saved").mkdir()
    (tmp_path / "saved" / "motions.bin").write_bytes(b"as read")
    (tmp_path / "saved" / "manifest.json").write_text(json.dumps({"format": "m512-backup", "files": {"motions": {"file": "motions.bin"}}}))
    return tmp_path


@pytest.fixture
def boards():
    """Two boards in their loaders, with different contents of the EEPROM."""
    flash = bytes(0xE000) + read_text(MOTION).to_bytes() + bytes(0x2000)
    with BlockPeer(flash) as first, BlockPeer(flash) as second:
        first.eeprom[0x10], second.eeprom[0x10] = 1, 2
        yield first, second


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.parametrize("words", ["convert x.bin y.bin", "pages x.bin extract 1 -o y.bin", "pages PORT delete 1 -o y.bin"])
def test_a_file_that_appears_meanwhile_stays(m512, here, boards, monkeypatch, words):
    encode = formats.encode

    def slowly(*args):
        (here / "y.bin").write_bytes(b"somebody's")
        return encode(*args)

    monkeypatch.setattr(formats, "encode", slowly)
    result = m512(*words.replace("PORT", boards[0].path).split())
    assert result.exit_code == 5 and "y.bin is there already (--force overwrites it)" in result.stderr, result.stderr
    assert (here / "y.bin").read_bytes() == b"somebody's"
    assert not list(here.glob(".*"))
    assert m512(*words.replace("PORT", boards[0].path).split(), "--force").exit_code == 0 and formats.load(here / "y.bin")


def test_pages_that_are_read_do_not_replace_a_file_that_appears_meanwhile(m512, here, started, monkeypatch):
    board = started("boot-cm5.hex", "play-cm5.hex", text=MOTION, applied=True)
    monkeypatch.setattr(Image, "empty", lambda count, empty=Image.empty: (here / "y.bin").write_bytes(b"somebody's") and empty(count))
    result = m512("get", "1", "-p", board.path, "-o", "y.bin")
    assert result.exit_code == 5 and "y.bin is there already" in result.stderr, result.stderr
    assert (here / "y.bin").read_bytes() == b"somebody's"


def test_a_hex_file_of_pages_that_were_read_holds_no_others(m512, here, started):
    """Flashing it would empty all other pages of a board."""
    board = started("boot-cm5.hex", "play-cm5.hex", text=MOTION + "page 3 walk\n  step 1s | 1..18:400\n", applied=True)
    for name, given in (("y.hex", {3}), ("y.bin", None)):
        assert m512("get", "3", "-p", board.path, "-o", name).exit_code == 0
        image = formats.load(here / name)
        assert image.given == given and image.used() == [3]


@pytest.mark.parametrize("error", [PermissionError(1, "Operation not permitted"), OSError(95, "Operation not supported")])
def test_a_file_system_without_hard_links_keeps_what_is_there_too(here, monkeypatch, error):
    def none(*_):
        raise error

    monkeypatch.setattr(os, "link", none)
    storage.write(here / "y.bin", b"mine")
    with pytest.raises(RefusedError, match="there already"):
        storage.write(here / "y.bin", b"other")
    assert (here / "y.bin").read_bytes() == b"mine" and (here / "y.bin").stat().st_mode & 0o777 == 0o666 & ~storage._umask()
    monkeypatch.setattr(os, "replace", none)
    with pytest.raises(FileError, match=error.strerror):
        storage.write(here / "z.bin", b"other")
    assert sorted(path.name for path in here.iterdir()) == ["saved", "x.bin", "y.bin"]


def test_a_link_that_leads_to_itself_is_something(m512, here):
    (here / "y.bin").symlink_to("y.bin")
    assert m512("convert", "x.bin", "y.bin").exit_code == 5
    with pytest.raises(RefusedError, match="there already"):
        storage.write(here / "y.bin", b"")
    assert (here / "y.bin").is_symlink()
    assert m512("convert", "x.bin", "y.bin", "--force").exit_code == 0


# Backups


def during(monkeypatch, board, *words):
    """The results of `m512 backup` of another board, which runs after a first one has looked at the folder and before it writes."""
    take, results = backups.take, []

    def meanwhile(*args):
        monkeypatch.setattr(backups, "take", take)
        results.append(board(*words))
        return take(*args)

    monkeypatch.setattr(backups, "take", meanwhile)
    return results


def test_robots_that_are_backed_up_in_the_same_second_get_a_folder_each(m512, here, boards, monkeypatch):
    monkeypatch.setattr(commands, "datetime", SimpleNamespace(now=lambda: datetime(2026, 1, 1, 12)))
    first, second = (("backup", "--what", "eeprom", "-p", board.path) for board in boards)
    others = during(monkeypatch, m512, *second)
    result = m512(*first)
    assert (others[0].exit_code, result.exit_code) == (0, 0)
    assert "backup-20260101-120000: eeprom" in others[0].stderr and "backup-20260101-120000-2: eeprom" in result.stderr
    for name, board in (("backup-20260101-120000-2", boards[0]), ("backup-20260101-120000", boards[1])):
        assert backups.load(here / name).data == {"eeprom": bytes(board.eeprom)}


@pytest.mark.parametrize("there", [False, True])
def test_two_backups_of_the_same_name_do_not_become_one(m512, here, boards, monkeypatch, there):
    if there:
        (here / "robot").mkdir()
    words = [("backup", "robot", "--what", what, "-p", board.path) for what, board in zip(("eeprom", "motions"), boards)]
    others = during(monkeypatch, m512, *words[1])
    result = m512(*words[0])
    assert others[0].exit_code == 0 and result.exit_code == 4 and "robot is there already and not empty" in result.stderr
    assert sorted(contents(here / "robot")) == ["manifest.json", "motions.bin"]
    assert backups.load(here / "robot").data == {"motions": bytes(boards[1].flash[0xE000:0x1E000])}


@pytest.mark.parametrize("there", [False, True])
def test_of_a_backup_that_cannot_be_written_nothing_remains(m512, here, boards, monkeypatch, there):
    if there:
        (here / "robots").mkdir()
    write = storage.write

    def full(path, *rest):
        if path.name == "manifest.json":
            raise FileError(f"cannot write {path}: No space left on device")
        return write(path, *rest)

    monkeypatch.setattr(storage, "write", full)
    before = contents(here)
    result = m512("backup", "robots/1/new", "--what", "eeprom", "-p", boards[0].path)
    assert result.exit_code == 4 and "No space left" in result.stderr
    assert contents(here) == before and (here / "robots").exists() == there and not (here / "robots" / "1").exists()


@pytest.mark.parametrize("name", ["motions.bin", "manifest.json"])
def test_a_log_replaces_no_file_of_a_backup(m512, here, name):
    before = contents(here)
    result = m512("term", "--log", f"saved/{name}", "--force", "-p", "no-port", input="")
    assert result.exit_code == 5 and "belongs to the backup saved" in result.stderr
    with pytest.raises(RefusedError, match="belongs to the backup"):
        storage.begin(here / "saved" / name, replace=True)
    assert contents(here) == before


def test_a_log_replaces_a_file_as_a_result_does(here):
    os.link(here / "x.bin", here / "y.bin")
    (here / "x.bin").chmod(0o640)
    log, losses = storage.begin(here / "x.bin", replace=True)
    with log:
        log.write(b"said")
    assert (here / "x.bin").read_bytes() == b"said" and (here / "x.bin").stat().st_mode & 0o777 == 0o640
    assert len((here / "y.bin").read_bytes()) == 65536 and "hard links" in losses[0]
    (here / "x.bin").chmod(0o444)
    with pytest.raises(FileError, match="Permission denied"):
        storage.begin(here / "x.bin", replace=True)
    with pytest.raises(RefusedError, match="there already"):
        storage.begin(here / "x.bin")
    assert (here / "x.bin").read_bytes() == b"said"


def test_pages_of_two_boards_that_change_in_the_same_second_are_kept_in_files_of_their_own(here, monkeypatch):
    monkeypatch.setattr("m512.board.kept.datetime", SimpleNamespace(now=lambda: datetime(2026, 1, 1, 12)))
    image, links = read_text(MOTION), [SimpleNamespace(url=f"/robots/{robot}/port", remedy="") for robot in (1, 2)]
    with kept(links[0], image, [1]):
        with kept(links[1], image, [2]) as keep:
            names = sorted(path.name for path in here.glob("pages-before-*"))
            assert names == ["pages-before-port-20260101-120000-2.hex", "pages-before-port-20260101-120000.hex"]
            keep([2])
            assert [formats.load(here / name).given for name in names[1:]] == [{1}]
        assert [path.name for path in here.glob("pages-before-*")] == names[1:]
    assert not list(here.glob("pages-before-*"))


# One place

METHODS = set("write_bytes write_text mkdir makedirs touch rename link symlink mkstemp mkdtemp NamedTemporaryFile".split())


def makes_a_file(call):
    """Whether a call makes or replaces a file."""
    name, owner = getattr(call.func, "attr", ""), getattr(getattr(call.func, "value", None), "id", "")
    if name in METHODS:
        return owner not in ("console", "operations")
    mode = next((word.value for word in call.args[1:2] if isinstance(word, ast.Constant)), "r")
    return f"{owner}.{name}" == "os.replace" or getattr(call.func, "id", name) == "open" and bool(set(str(mode)) & set("wax+"))


def test_files_are_written_in_one_place():
    found = {
        str(path.relative_to(TOP)): node.lineno
        for path in TOP.rglob("*.py")
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8")))
        if isinstance(node, ast.Call) and makes_a_file(node)
    }
    assert set(found) == {"files/storage.py"}, found
