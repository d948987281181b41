# SPDX-License-Identifier: MIT
"""`m512 flash`, `run`, `backup`, `restore` against peers that speak the protocols of both loaders, in virtual time.

The cable is pulled at many points. Afterwards nothing outside the transfer has changed, and a repetition completes it.
"""

import json
import os
import random
import re
from types import SimpleNamespace

import pytest
from block_peer import PROMPTED as PROMPTED_OURS
from block_peer import SLOW, BlockPeer, BlockPtyPeer
from conftest import REPO
from factory_peer import APP as RUNS
from factory_peer import OFF_S, PROMPTED, FactoryPeer, FactoryPtyPeer
from hex_files import hex_file
from virtual_peer import VirtualLink

from m512 import ui
from m512.board import backup, factory_flash, kept, memory
from m512.board.block import LEAVE, WRITE, frame
from m512.board.client import Client
from m512.board.factory import FactoryLoader
from m512.board.factory_flash import LAST_START
from m512.board.loaders import BANNER_IN_FLASH
from m512.board.memory import APP, BOOT, RECORD_AT, Record
from m512.crc16 import crc16
from m512.errors import BoardError, RefusedError
from m512.files import formats
from m512.files.image import Image
from m512.files.page import EMPTY
from m512.files.text import read_text

MOTIONS = """motion512 1
page 1 stand
  step 1s | 1..18:512
page 3 walk
  next self
  step 50 | 1..18:400
page 100 end
  step 50 | 1..18:600
"""


def make_app(board=1, kind=1, size=5000, good=True):
    """An application image with a record, like our images."""
    app = bytearray(random.Random(7).randbytes(size))
    app[0:4] = b"\x0c\x94\x46\x00"
    app[0x8C:0x9C] = b"M512" + len(app).to_bytes(4, "little") + b"\xff\xff" + bytes([board, kind, 1, 2, 3, 1])
    app[0x94:0x96] = (crc16(bytes(app)) ^ (0 if good else 1)).to_bytes(2, "little")
    return bytes(app)


@pytest.fixture
def app_hex(tmp_path):
    return hex_file(tmp_path / "play.hex", (0, make_app()))


@pytest.fixture
def motions(tmp_path):
    path = tmp_path / "lib.m512"
    path.write_text(MOTIONS)
    return path


def motion_area():
    return read_text(MOTIONS).to_bytes()


def old_flash():
    """A flash full of other content."""
    return random.Random(1).randbytes(0x20000)


def changed_outside(peer, before, start, end):
    return [a for a in range(0x20000) if not start <= a < end and peer.flash[a] != before[a]]


@pytest.fixture(params=["ours", "factory"])
def peer(request):
    flash = bytearray(old_flash())
    # Most of the motion area is already correct, so that the factory loader's slow dumps do not dominate the test's time.
    flash[0xE000:0x1E000] = b"".join(EMPTY for _ in range(128))
    with (BlockPeer if request.param == "ours" else FactoryPeer)(flash) as it:
        it.before = bytes(it.flash)
        yield it


# Both loaders


def test_flash_motions_and_leave_everything_else(m512, peer, motions):
    result = m512("flash", motions, "-p", peer.path, "--json")
    assert result.exit_code == 0, result.stderr
    assert peer.flash[0xE200:0x1E000] == motion_area()[512:]
    assert not changed_outside(peer, peer.before, 0xE200, 0x1E000)
    assert "the robot keeps its own" in result.stderr
    # Three pages of 512 bytes differ. The second half of a page that uses no joint above 18 may stay as it was.
    assert json.loads(result.stdout)["written"] <= 6
    again = json.loads(m512("flash", motions, "-p", peer.path, "--json").stdout)
    assert again["written"] == 0


def test_flash_asks_before_motions_that_the_file_does_not_hold_are_lost(m512, peer, motions, tmp_path):
    mine = read_text("motion512 1\npage 7 bow\n  step 1s | 1..18:300\npage 9 kick\n  step 1s | 1..18:300\npage 3 old\n  step 1s | 1:300\n")
    peer.flash[0xE200:0x1E000] = mine.to_bytes()[512:]
    before = bytes(peer.flash)
    result = m512("flash", motions, "-p", peer.path)
    assert result.exit_code == 5 and 'pages 7 "bow" and 9 "kick" would be lost' in result.stderr and "--yes" in result.stderr, result.stderr
    assert bytes(peer.flash) == before
    result = m512("flash", motions, "-p", peer.path, "--yes")
    assert result.exit_code == 0, result.stderr
    assert peer.flash[0xE200:0x1E000] == motion_area()[512:]


def test_a_late_yes_does_not_lose_a_fast_session(m512, motions, monkeypatch):
    """Our loader ends a session, and its rate, after 4 s without a byte (boot/BLOCK_PROTOCOL.md)."""
    with BlockPeer() as peer:
        peer.flash[0xE200:0x1E000] = read_text("motion512 1\npage 7 bow\n  step 1s | 1..18:300\n").to_bytes()[512:]
        rates, asked = [], []
        peer.set_rate = lambda rate: (rates.append(rate), setattr(peer, "pc_rate", rate))
        monkeypatch.setattr(ui, "confirm", lambda question, yes: (asked.append(question), peer.pass_time(20)))
        result = m512("flash", motions, "-p", peer.path, "--fast")
        assert asked and result.exit_code == 0 and rates == [117647, 57600], result.stderr
        assert peer.flash[0xE200:0x1E000] == motion_area()[512:]


def test_flash_application_and_start(m512, peer, app_hex):
    result = m512("run", app_hex, "-p", peer.path)
    assert result.exit_code == 0, result.stderr
    assert "Motion512 play 1.2.3 for cm5" in result.stderr and "started" in result.stderr
    assert peer.flash[:5000] == make_app() and peer.flash[5000:5120] == b"\xff" * 120
    assert not changed_outside(peer, peer.before, 0, 5120)
    peer.pass_time(0.02)  # the factory loader jumps a moment after it has said so
    assert peer.state == 0 and peer.eeprom[0xFFF] == 0x11
    assert not getattr(peer, "hurt", [])


FOREIGN = b"\x0c\x94\x46\x00" + bytes(4996)  # an application without a record


def test_an_application_without_a_record_is_marked_until_it_is_complete(m512, tmp_path):
    foreign = hex_file(tmp_path / "foreign.hex", (0, FOREIGN))
    with BlockPeer(bytearray(old_flash())) as peer:
        peer.broken_pages = {10}
        assert m512("flash", foreign, "-p", peer.path).exit_code != 0
        assert peer.eeprom[0xFF0] == 0x50
        peer.broken_pages = set()
        assert m512("flash", foreign, "-p", peer.path).exit_code == 0
        assert peer.eeprom[0xFF0] == 0xFF and peer.flash[:5000] == FOREIGN
        peer.eeprom[0xFF0] = 0x50  # as a download that ended before this was cleared
        assert m512("flash", foreign, "-p", peer.path).exit_code == 0
        assert peer.eeprom[0xFF0] == 0xFF
        peer.eeprom[0xFF0] = 0x34  # another program's
        assert m512("flash", foreign, "-p", peer.path).exit_code == 0
        assert peer.eeprom[0xFF0] == 0x34


@pytest.mark.parametrize("kind", [BlockPtyPeer, FactoryPtyPeer])
def test_flash_through_a_real_port(m512, tmp_path, kind):
    """One page: in real time, the factory loader shows all motions in a minute."""
    walk = bytes(read_text(MOTIONS)[3])
    with kind(bytearray(old_flash())) as peer:
        result = m512("flash", hex_file(tmp_path / "walk.hex", (0xE600, walk)), "-p", peer.path)
        assert result.exit_code == 0, result.stderr
        assert bytes(peer.flash) == old_flash()[:0xE600] + walk + old_flash()[0xE800:]


def test_flash_calls_a_running_board_and_asks_for_the_button(m512, motions, peer):
    peer.state = 0
    result = m512("flash", motions, "-p", peer.path, "--wait", "5")
    assert result.exit_code == 0 and "Press the MODE button" in result.stderr


@pytest.mark.parametrize("tenths", range(0, 60, 2))
def test_the_button_counts_at_any_moment_of_the_wait(m512, peer, tenths):
    """m512 pauses its '#' now and then, to ask for Play or Edit."""
    peer.state, peer.presses_mode, waits_since, on_silence = 0, False, [], peer.on_silence

    def person(seconds):
        if peer.app_heard.endswith(b"##") and not waits_since:
            waits_since.append(peer.now())
        if waits_since and peer.state == 0 and peer.now() >= waits_since[0] + tenths / 10:
            peer.press_mode()
            waits_since[0] = float("inf")  # once
        on_silence(seconds)

    peer.on_silence = person
    result = m512("run", "-p", peer.path, "--wait", "10")
    assert result.exit_code == 0 and "Press the MODE button" in result.stderr, result.stderr


@pytest.mark.parametrize("gap", [n / 20 for n in range(1, 10)])
def test_a_button_pressed_twice_is_waited_for_again(m512, peer, gap):
    """The second press takes the loader away while it is called or identified. The third comes after a while."""
    peer.state, peer.presses_mode, presses, on_silence = 0, False, [], peer.on_silence

    def person(seconds):
        if peer.app_heard.endswith(b"##") and not presses:
            presses.extend(peer.now() + after for after in (1, 1 + gap, 8))
        if presses and peer.now() >= presses[0] and (len(presses) > 1 or peer.state == 0):
            presses[0:1] = [] if len(presses) > 1 else [float("inf")]
            peer.press_mode()
        on_silence(seconds)

    peer.on_silence = person
    result = m512("run", "-p", peer.path, "--wait", "20")
    assert result.exit_code == 0 and "Press the MODE button" in result.stderr, result.stderr


def test_flash_says_what_it_waits_for_and_gives_up(m512, motions, peer):
    peer.state, peer.presses_mode = 0, False
    result = m512("flash", motions, "-p", peer.path, "--wait", "0.5")
    assert result.exit_code == 7 and "no boot loader answered within" in result.stderr


def test_backup_restore_brings_back_every_byte(m512, peer, motions, tmp_path):
    assert m512("flash", motions, "-p", peer.path).exit_code == 0
    peer.eeprom[10:14] = b"abcd"
    before, eeprom = bytes(peer.flash), bytes(peer.eeprom)
    result = m512("backup", tmp_path / "b", "-p", peer.path, "--what", "motions,eeprom", "--json")
    assert result.exit_code == 0, result.stderr
    manifest = json.loads((tmp_path / "b" / "manifest.json").read_text())
    assert manifest["files"]["motions"]["crc16"] == f"{crc16(before[0xE000:0x1E000]):04X}" and manifest["date"]
    peer.flash[0xE000 + 512 * 3 + 70] ^= 1
    peer.flash[0xE000 + 512 * 50 : 0xE000 + 512 * 51] = bytes(512)
    peer.eeprom[11] = 0
    result = m512("restore", tmp_path / "b", "-p", peer.path, "--yes", "--wait", "5")
    assert result.exit_code == 0, result.stderr
    assert 'page 3 "walk", step 1, ID 3: 401 -> 400 (-1)' in result.stderr
    assert bytes(peer.flash) == before and peer.eeprom[:0xFF0] == eeprom[:0xFF0]


def test_a_board_whose_motions_are_read_runs_again_and_one_that_waited_waits(m512, peer, motions):
    peer.state = RUNS
    peer.eeprom[0xFFF] = 0x11  # the loader starts the application
    for words in (("pages", peer.path, "list"), ("diff", peer.path, motions)):
        result = m512(*words)
        peer.pass_time(1)
        assert "MODE" in result.stderr and "The controller restarts." in result.stderr and peer.state == RUNS, result.stderr
    result = m512("pages", peer.path, "delete", "100", "--yes")  # nothing to write, but it might have been
    assert "waits in its boot loader; `m512 run`" in result.stderr and peer.state == PROMPTED
    result = m512("pages", peer.path, "list")
    assert "restarts" not in result.stderr and "waits" not in result.stderr and peer.state == PROMPTED


def test_restore_asks_the_application_for_its_board_and_not_the_manifest_alone(m512, tmp_path):
    with BlockPeer() as cm5:
        assert m512("flash", hex_file(tmp_path / "cm5.hex", (0, make_app())), "-p", cm5.path).exit_code == 0
        assert m512("backup", tmp_path / "b", "-p", cm5.path, "--what", "app").exit_code == 0
    manifest = json.loads((tmp_path / "b" / "manifest.json").read_text())
    (tmp_path / "b" / "manifest.json").write_text(json.dumps(manifest | {"board": "cm2"}))
    with BlockPeer(board=2) as cm2:
        before = bytes(cm2.flash)
        result = m512("restore", tmp_path / "b", "-p", cm2.path, "--yes")
        assert result.exit_code == 5 and "this backup's application is for a cm5, this board is a cm2" in result.stderr
        assert bytes(cm2.flash) == before


def test_restore_asks_first(m512, peer, motions, tmp_path):
    m512("backup", tmp_path / "b", "-p", peer.path, "--what", "motions")
    peer.flash[0xE000 + 600] ^= 1
    before = bytes(peer.flash)
    result = m512("restore", tmp_path / "b", "-p", peer.path, "--wait", "5")
    assert result.exit_code == 5 and "--yes" in result.stderr and bytes(peer.flash) == before


def pull_cable(peer, when):
    """Pulls the cable after `when` thousandths: of a transfer with our loader; with the factory's, of the dumps or at a byte of a
    download."""
    if isinstance(peer, BlockPeer):
        peer.cut_after = 20 + when * 2
    elif when % 2:
        peer.cut_after = 100 + when * 300
    else:

        def pull(direction, _, byte):
            if direction == "->" and peer.state == "loading" and peer.loader.size >= when % 250:
                peer.pull()
                return None
            return byte

        peer.garble = pull


@pytest.mark.parametrize("when", [0, 3, 201, 512, 767])
def test_cable_pulled_during_flash(m512, peer, motions, when):
    pull_cable(peer, when)
    result = m512("flash", motions, "-p", peer.path)
    assert not peer.plugged, ("the cable was not pulled", result.exit_code, result.stderr)
    assert result.exit_code in (6, 7) and result.stderr.strip()
    assert not changed_outside(peer, peer.before, 0xE200, 0x1E000)
    peer.pass_time(0.5)  # the factory loader detects the silence
    peer.garble = None
    peer.plug()
    result = m512("flash", motions, "-p", peer.path, "--wait", "5")
    assert result.exit_code == 0, result.stderr
    assert peer.flash[0xE200:0x1E000] == motion_area()[512:]
    assert not changed_outside(peer, peer.before, 0xE200, 0x1E000)
    assert not getattr(peer, "hurt", [])


# A change of pages on a board that breaks off. A repetition is another command: `renumber --swap` would exchange them again.

TWO_MOTIONS = (
    "motion512 1\npage 8 mymotion\n"
    + "".join(f"  step 50 | 1..18:{400 + k}\n" for k in range(7))
    + "page 9 other\n  next 8\n"
    + "".join(f"  step 50 | 1..18:{600 + k}\n" for k in range(7))
)


def board_with_two_motions(started, kind):
    """(its end of the cable, its flash)"""
    if kind == "edit":
        edit = started("boot-cm5.hex", "edit-cm5.hex", text=TWO_MOTIONS, applied=True)
        return edit, edit.board.flash
    flash = old_flash()[:0xE000] + read_text(TWO_MOTIONS).to_bytes() + old_flash()[0x1E000:]
    peer = BlockPeer(flash) if kind == "ours" else FactoryPeer(flash, says=b"\r\n\n SYSTEM O.K.")  # without the board's name
    return peer, peer.flash


def break_off(board, how, at):
    """At this byte of the line."""
    if how == "cut":
        board.cut_after = at
        return
    pressed = []

    def press(_, index, byte):
        if index >= at and not pressed:
            pressed.append(index)
            raise KeyboardInterrupt
        return byte

    board.garble = press


BREAKS = [
    (kind, last, words, how)
    for kind, last in (("edit", 6000), ("ours", 2200), ("factory", 12000))
    for words in (["8", "120"], ["8", "9", "--swap"])
    for how in ("cut", "Ctrl-C")
    if kind != "edit" or (how == "cut") == ("--swap" in words)  # the whole board takes the most time
]


@pytest.mark.parametrize("kind, last, words, how", BREAKS)
def test_a_renumber_that_breaks_off_names_the_command_that_puts_the_pages_back(m512, started, monkeypatch, tmp_path, kind, last, words, how):
    monkeypatch.chdir(tmp_path)
    board, flash = board_with_two_motions(started, kind)
    before, begun, named = bytes(flash[0xE000:0x1E000]), board.moved, 0
    command = ["renumber", *words, "--yes"]
    assert m512("pages", "--board", "cm5", board.path, *command).exit_code == 0 and not os.listdir()
    after, total = bytes(flash[0xE000:0x1E000]), board.moved - begun
    chance = random.Random(f"{kind} {words} {how}")
    parts = 2 if kind == "edit" else 3
    for back in (chance.randrange(last * part // parts, last * (part + 1) // parts) for part in range(parts)):
        board, flash = board_with_two_motions(started, kind)
        break_off(board, how, board.moved + total - back)
        result = m512("pages", "--board", "cm5", board.path, *command)
        now, put_back = bytes(flash[0xE000:0x1E000]), re.search("`m512 (flash [^`]*)` puts ", result.stderr)
        if put_back is None:  # before the first page was written, or after the last one
            assert now in (before, after) and (now == before or "epeat the command" not in result.stderr) and not os.listdir(), result.stderr
            continue
        named += 1
        told = result.stderr
        assert result.exit_code in (6, 7, 130) and "epeat the command" not in told and told.count(put_back[0]) == len(os.listdir()) == 1, told
        board.garble, old = None, board.path
        board.pass_time(0.5)  # the factory loader detects the silence
        board.plug()
        again = m512(*put_back.group(1).replace(old, board.path).split())
        assert again.exit_code == 0 and bytes(flash[0xE000:0x1E000]) == before, (result.stderr, again.stderr)
        os.remove(os.listdir()[0])
    assert named


@pytest.mark.parametrize("kind", ["ours", "factory"])
def test_the_loaders_write_the_new_place_of_a_page_before_the_old_one_is_emptied(m512, monkeypatch, tmp_path, kind):
    monkeypatch.chdir(tmp_path)
    peer, _ = board_with_two_motions(None, kind)
    assert m512("pages", "--board", "cm5", peer.path, "renumber", "8", "100", "--yes").exit_code == 0
    written = [page * 256 for page in peer.writes] if kind == "ours" else [address for address, _ in peer.downloads]
    pages = list(dict.fromkeys((address - 0xE000) // 512 for address in written))
    assert pages == [9, 100, 8]


@pytest.mark.parametrize("kind", ["ours", "factory"])
def test_trim_erased_and_damaged_pages_are_put_back_as_they_were(m512, monkeypatch, tmp_path, kind):
    """SIGTERM behind the first pages. Page 0 is the trim, page 5 is damaged, and page 7 erased."""
    peer, flash = board_with_two_motions(None, kind)
    motions = read_text(TWO_MOTIONS + "page 0\n  offset 3:-5\n").to_bytes()
    flash[0xE000:0x1E000] = motions[: 512 * 5] + bytes(range(256)) * 2 + motions[512 * 6 : 512 * 7] + b"\xff" * 512 + motions[512 * 8 :]
    before = bytes(flash[0xE000:0x1E000])
    monkeypatch.chdir(tmp_path)
    (tmp_path / "new.m512").write_text(TWO_MOTIONS.replace("page 8", "page 7").replace("page 9", "page 5"))

    def press(direction, index, byte):
        if direction == "->" and flash[0xE000 + 512 * 5 :][:512] != before[512 * 5 :][:512]:
            raise SystemExit(143)  # cli/__init__.py
        return byte

    for words in (["delete", "0", "5", "8"], ["merge", "new.m512", "5", "7", "--replace"]):
        peer.garble = press
        result = m512("pages", "--board", "cm5", peer.path, *words, "--yes")
        named = re.search("m512: ended. `m512 (flash [^`]*)` puts back what pages ", result.stderr)
        assert result.exit_code == 143 and named and flash[0xE000:0x1E000] != before, result.stderr
        peer.garble = None
        peer.pass_time(0.5)
        again = m512(*named[1].split())
        assert again.exit_code == 0 and bytes(flash[0xE000:0x1E000]) == before, (named[1], again.stderr)


def test_on_an_adapter_the_pages_are_put_back_by_put_and_delete(m512, started, monkeypatch, tmp_path):
    """A board with Edit stands for the program of an adapter, which has no boot loader either."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(kept, "bus", SimpleNamespace(is_bus=lambda url: True))
    edit, flash = board_with_two_motions(started, "edit")
    save = Client.save_page

    def only_page_100(client, number, page):
        if number == 8:
            raise BoardError("no")
        save(client, number, page)

    monkeypatch.setattr(Client, "save_page", only_page_100)
    result = m512("pages", edit.path, "renumber", "8", "100", "--yes")
    found = re.search("`m512 (put [^`]*)` puts back what pages 8 and 9 held; page 100 held nothing: `m512 (pages [^`]*)`$", result.stderr.strip())
    assert result.exit_code == 8 and found, result.stderr
    monkeypatch.setattr(Client, "save_page", save)
    for command in found.groups():
        done = m512(*command.split())
        assert done.exit_code == 0, done.stderr
    assert bytes(flash[0xE200:0x1E000]) == read_text(TWO_MOTIONS).to_bytes()[512:]


@pytest.mark.parametrize("kind", ["edit", "ours", "factory"])
def test_without_a_file_that_keeps_them_no_pages_are_changed(m512, started, monkeypatch, tmp_path, kind):
    board, flash = board_with_two_motions(started, kind)
    before = bytes(flash[0xE000:0x1E000])
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    result = m512("pages", "--board", "cm5", board.path, "renumber", "8", "9", "--swap", "--yes")
    assert result.exit_code == 4 and "so nothing was written" in result.stderr, result.stderr
    assert bytes(flash[0xE000:0x1E000]) == before


# Our loader

KEYS = {0x08, 0x09, 0x0A, 0x0D, 0x1B, *range(0x20, 0x80)}  # an Edit that has been started takes them for a person's


@pytest.mark.parametrize("loses", ["_answer", "_request"])
@pytest.mark.parametrize("words, state, to", [("run", PROMPTED, 1), ("backup b1", RUNS, 2), ("restore b0 --yes", RUNS, 2)])
def test_a_loader_that_has_left_and_whose_answer_is_lost_is_no_failure(m512, tmp_path, monkeypatch, words, state, to, loses):
    """`the boot loader does not answer any more. Repeat the command` once came after all was done."""
    monkeypatch.chdir(tmp_path)
    with BlockPeer(old_flash()) as board:
        assert m512("backup", "b0", "-p", board.path).exit_code == 0
        board.flash[0xE000:0xE200], board.left, board.state = bytes(512), [], state
        works, lost = getattr(board, loses), []

        def lose(command, *rest):
            if command == LEAVE and not lost:
                lost.append(command)
            else:
                works(command, *rest)

        setattr(board, loses, lose)
        result = m512(*words.split(), "-p", board.path, "--wait", "5")
        assert result.exit_code == 0 and board.left == [to] and lost, result.stderr
        assert len(board.app_heard) == 6 * (loses == "_answer") and not KEYS & set(board.app_heard), board.app_heard.hex(" ")


def test_only_a_transfer_that_broke_off_goes_on_where_it_stopped(m512, motions):
    flash = bytearray(old_flash())
    flash[0xE000:0x1E000] = EMPTY * 128  # no motions would be lost, so none are read and named before the write
    with BlockPeer(flash) as peer:
        peer.cut_after = 1600
        broken = m512("flash", motions, "-p", peer.path, "--wait", "5")
        assert broken.exit_code == 6 and "repeat the command: it goes on where it stopped" in broken.stderr, broken.stderr
        peer.plug()
        peer.cut_after = peer.moved + 100
        broken = m512("pages", peer.path, "list")
        assert broken.exit_code == 6 and broken.stderr.strip().endswith("then repeat the command"), broken.stderr


def test_ctrl_c_in_a_transfer_says_that_it_can_be_repeated(m512, motions):
    def press(direction, index, byte):
        if len(peer.writes) > 20:
            raise KeyboardInterrupt
        return byte

    with BlockPeer(bytearray(old_flash())) as peer:
        peer.garble = press
        result = m512("flash", motions, "-p", peer.path, "--yes")
        assert result.exit_code == 130 and "m512: stopped while it wrote. Repeat the command: it goes on where it" in result.stderr, result.stderr
        peer.garble = None
        peer.pass_time(2)
        again = m512("flash", motions, "-p", peer.path, "--yes")
        assert again.exit_code == 0 and bytes(peer.flash[0xE200:0x1E000]) == formats.load(motions).to_bytes()[512:], again.stderr


def test_crc16_known_answer_and_frame_of_the_description():
    assert crc16(b"123456789") == 0x29B1
    assert frame(1, 1, b"") == bytes.fromhex("a5010100c89d") and frame(3, 2, b"\xff\x01") == bytes.fromhex("a5030201ff013658")


def with_noise(peer):
    noise = random.Random(3)
    peer.garble = lambda _, index, byte: byte if index < 60 or noise.random() > 0.0002 else noise.choice([None, byte ^ 0x10])


def that_spoils_the_fast_rate(peer):
    peer.garble = lambda _, index, byte: byte if peer.pc_rate == SLOW else byte ^ 0x40


class SpoilsPages:
    """Damages every `each`th byte at the fast rate: short frames come through, pages do not."""

    def __init__(self, peer, begins=0, each=150):
        self.peer, self.passed, self.begins, self.each = peer, 0, begins, each
        peer.garble = self

    def __call__(self, _, index, byte):
        if self.peer.pc_rate == SLOW:
            return byte
        self.passed += 1
        return byte if self.passed < self.begins or self.passed % self.each else byte ^ 0x40


@pytest.mark.parametrize("lost", [False, True])
@pytest.mark.parametrize("begins", [0, 3000, 14000])
def test_a_fast_rate_that_spoils_pages_is_given_up(m512, tmp_path, begins, lost):
    """The first exchange comes through. Pages that have come through before are not sent again."""
    text = "motion512 1\n" + "".join(f"page {page} p{page}\n  step 50 | 1..18:{300 + page}\n" for page in range(1, 41))
    (tmp_path / "lib.m512").write_text(text)
    with BlockPeer(old_flash()) as peer:
        spoils = SpoilsPages(peer, begins)
        if lost:
            peer.garble = lambda *args: byte if (byte := spoils(*args)) == args[-1] else None
        result = m512("flash", tmp_path / "lib.m512", "-p", peer.path, "--fast")
        assert result.exit_code == 0 and result.stderr.count("the fast rate does not work here; going on at 57,600") == 1, result.stderr
        assert peer.flash[0xE200:0x1E000] == read_text(text).to_bytes()[512:] and len(peer.writes) == len(set(peer.writes))
        assert spoils.passed > begins and peer.rate == peer.pc_rate == SLOW


@pytest.mark.parametrize("word", ["flash", "run"])
def test_a_fast_rate_that_falls_silent_is_given_up_at_any_request(m512, app_hex, word):
    with BlockPeer(old_flash()) as peer:
        at, total = 0, 1
        while at < total:
            peer.flash[:], passed = old_flash(), []

            def silent(_, index, byte, passed=passed, at=at):
                if peer.pc_rate == SLOW:
                    return byte
                passed.append(index)
                return byte if len(passed) <= at or at == 0 else None

            peer.garble, peer.state = silent, PROMPTED_OURS
            result = m512(word, app_hex, "-p", peer.path, "--fast")
            assert result.exit_code == 0, (at, result.stderr)
            assert peer.flash[:5000] == make_app() and peer.rate == peer.pc_rate == SLOW, at
            total = max(total, len(passed))
            at += 397


def test_a_remark_does_not_continue_the_line_of_a_progress_bar(monkeypatch, capsys):
    monkeypatch.setattr(ui, "is_terminal", lambda _: True)
    with ui.phase("Writing") as progress:
        progress(1, 2)
        ui.say("note: one")
    ui.say("note: two")
    assert "\n\nnote: one\n" in (said := capsys.readouterr().err) and "\n\nnote: two" not in said  # a bar that is not drawn ends its line


def that_repeats_the_answer_to_a_write(peer):
    answer, repeated = peer._answer, []

    def twice(command, *rest):
        answer(command, *rest)
        if command == WRITE and not repeated:
            repeated.append(answer(command, *rest))

    peer._answer = twice


@pytest.mark.parametrize(
    "fault, says",
    [
        (with_noise, "repetitions"),
        (that_spoils_the_fast_rate, "the fast rate does not work here; going on at 57,600"),
        (that_repeats_the_answer_to_a_write, "written and read back"),
    ],
)
def test_block_pages_arrive_over_a_bad_line(m512, motions, fault, says):
    with BlockPeer(old_flash()) as peer:
        fault(peer)
        result = m512("flash", motions, "-p", peer.path, *["--fast"] * (fault is that_spoils_the_fast_rate))
        assert result.exit_code == 0, result.stderr
        assert peer.flash[0xE200:0x1E000] == motion_area()[512:] and says in result.stderr


@pytest.mark.parametrize("letter, before", [(b"i", None), (b"d", None), (b"i", b"x")])
def test_block_loader_is_not_taken_for_the_factorys_when_a_letter_is_lost(m512, motions, letter, before):
    """The letter is of the command `id`: our loader then answers that it does not know the command, as the factory's does. before: a
    letter that noise has put into the loader's line, whose echo is lost; so the echo of `id` is right."""
    with BlockPeer(old_flash()) as peer:
        gone = []

        def lose(direction, _, byte):
            if direction == "->" and byte == letter[0] and not gone:
                gone.append(byte)
                peer.line += before or b""
                return byte if before else None
            return byte

        peer.garble = lose
        result = m512("flash", motions, "-p", peer.path)
        assert gone and result.exit_code == 0 and "Motion512 boot loader" in result.stderr
        assert peer.eeprom == b"\xff" * 4096


def test_block_flash_that_is_said_to_be_written_and_is_not(m512, motions):
    """The loader's own answer is OK. Only the sums of the flash, read back, show the fault."""
    with BlockPeer(old_flash()) as peer:
        peer.forgetful_pages.add(0xE600 // 256)
        result = m512("flash", motions, "-p", peer.path)
        assert result.exit_code == 8 and "read back wrong at 0x0E600" in result.stderr, result.stderr


def test_block_flash_that_does_not_take_the_data(m512, motions):
    with BlockPeer(old_flash()) as peer:
        peer.broken_pages.add(0xE600 // 256)
        result = m512("flash", motions, "-p", peer.path)
        assert result.exit_code == 8 and "0x0E600: the flash does not take the data" in result.stderr


def test_block_wrong_board_is_refused_before_anything_is_written(m512, tmp_path):
    image = hex_file(tmp_path / "x.hex", (0, make_app(board=2)))
    with BlockPeer(old_flash(), board=1) as peer:
        result = m512("flash", image, "-p", peer.path)
        assert result.exit_code == 5 and "for cm2, but this board is a cm5" in result.stderr and not peer.writes


# The factory loader


def test_factory_downloads_are_single_pages_below_the_reserve_and_the_rest_goes_through_the_mailbox(m512, tmp_path):
    text = MOTIONS + "page 116 low\n  step 50 | 1..18:1\npage 127 last\n  step 50 | 1..18:2\n"
    (tmp_path / "x.m512").write_text(text)
    flash = bytearray(b"\xff" * 0x20000)
    flash[0xE000:0x1E000] = EMPTY * 128
    with FactoryPeer(flash) as peer:
        result = m512("flash", tmp_path / "x.m512", "-p", peer.path)
        assert result.exit_code == 0, result.stderr
        assert peer.downloads and all(a % 256 == 0 and 0 < n <= 256 and a < 0x1C800 for a, n in peer.downloads)
        assert peer.mails == [116, 127] and not peer.hurt
        assert peer.flash[0xE200:0x1E000] == read_text(text).to_bytes()[512:]
        assert peer.eeprom[0xFF4] == 0xFF and peer.eeprom[0xFFF] == 0x11


def test_factory_lost_bytes_are_found_by_size_and_sent_again(m512, motions):
    flash = bytearray(b"\xff" * 0x20000)
    flash[0xE000:0x1E000] = EMPTY * 128
    with FactoryPeer(flash) as peer:
        state = {"lost": 0}

        def lose(direction, _, byte):
            if direction == "->" and peer.state == "loading" and state["lost"] < 1 and peer.loader.size == 100:
                state["lost"] += 1
                return None
            return byte

        peer.garble = lose
        result = m512("flash", motions, "-p", peer.path)
        assert result.exit_code == 0 and state["lost"] == 1 and "1 repetition " in result.stderr
        assert peer.flash[0xE200:0x1E000] == motion_area()[512:]


@pytest.mark.parametrize("way, at, becomes", [("", 0, None), ("<-", 20, None), ("<-", 700, None), ("->", 9, ord("3"))])
def test_factory_dumps_begin_anywhere_and_are_asked_for_again_when_damaged(way, at, becomes):
    """The last row: `flash 11200` arrives as `flash 11300`, and a good dump of other memory comes."""
    with FactoryPeer(bytearray(old_flash())) as peer:
        passed = []

        def harm(direction, _, byte):
            if direction == way:
                passed.append(byte)
            return becomes if direction == way and len(passed) == at else byte

        with VirtualLink(peer.path) as link:
            loader = FactoryLoader(link)
            peer.garble = harm
            assert loader.read(0x11234, 0x11333) == bytes(peer.flash[0x11234:0x11333])
            assert loader.retries == bool(way)


@pytest.mark.parametrize("page", [LAST_START // 256, LAST_START // 256 + 1, 0x1DE, 0x1E0, 0x1FE])
def test_factory_download_near_the_loader_is_refused_before_a_word_is_typed(page):
    """Regardless of the caller: such pages go through the mailbox, and the loader's own pages are never written."""
    with FactoryPeer(bytearray(old_flash())) as peer, VirtualLink(peer.path) as link:
        loader, pages = FactoryLoader(link), {page: bytes(256), page + 1: bytes(256)}
        with pytest.raises(RefusedError, match="would hurt"):
            factory_flash.write_page(loader, page, pages)
        if page >= BOOT[0] // 256:
            with pytest.raises(RefusedError):
                loader.write(pages)
        assert not [word for word in peer.words if word.startswith(b"load")] and not peer.hurt and bytes(peer.flash) == peer.before


class WornEeprom(bytearray):
    """The cell 0x810, in the mailbox, holds 5 whatever is written."""

    def __setitem__(self, at, value):
        super().__setitem__(at, value)
        super().__setitem__(0x810, 5)


class WeakEeprom(bytearray):
    """The mark that starts the copy changes the number of the page into that of a page of the loader."""

    def __setitem__(self, at, value):
        super().__setitem__(at, value)
        if (at, value) == (0xFF4, 0xAA):
            super().__setitem__(0xFF5, 0x88)


STAYS = "the controller stays in it at every start"


@pytest.mark.parametrize(
    "eeprom, says", [(WornEeprom, "the EEPROM does not take the page"), (WeakEeprom, "has changed by itself; nothing was written")]
)
def test_factory_mailbox_that_fails_says_that_the_controller_stays_in_its_loader(m512, tmp_path, eeprom, says):
    """m512 has typed `sys` by then: EEPROM FFF is FF (boot/ORIGINAL.md)."""
    path = tmp_path / "x.m512"
    path.write_text("motion512 1\npage 120 end\n  step 50 | 1..18:600\n")
    with FactoryPeer(bytes(0xE000) + EMPTY * 128 + b"\xff" * 0x2000) as peer:
        peer.eeprom = eeprom(peer.eeprom)
        result = m512("flash", path, "-p", peer.path, "--board", "cm5")
        assert result.exit_code == 8 and says in result.stderr and peer.eeprom[0xFFF] == 0xFF
        assert STAYS in result.stderr and "repeat the command" in result.stderr, result.stderr
        peer.press_mode()
        peer.pass_time(OFF_S)
        assert bytes(peer.flash) == peer.before


def test_factory_flash_that_is_worn_out_says_that_the_controller_stays_in_its_loader(m512, app_hex):
    with FactoryPeer() as peer:
        peer.loader.dead_pages.add(0x400 // 256)
        result = m512("flash", app_hex, "-p", peer.path, "--board", "cm5")
        assert result.exit_code == 8 and "read back wrong at 0x00400" in result.stderr and peer.eeprom[0xFFF] == 0xFF
        assert result.stderr.count(STAYS) == 1, result.stderr


@pytest.mark.parametrize("mode, says", [(0x11, "The controller restarts"), (0xFF, "waits in its boot loader; `m512 run` starts the application")])
def test_restore_says_whether_the_controller_stays_in_its_loader(m512, peer, tmp_path, mode, says):
    """After an interrupted transfer the boot mode is that of the transfer."""
    peer.eeprom[0xFFF] = mode
    assert m512("backup", tmp_path / "b", "-p", peer.path, "--what", "motions", "--board", "cm5").exit_code == 0
    peer.flash[0xE000 + 512 * 3 + 2] ^= 1
    result = m512("restore", tmp_path / "b", "-p", peer.path, "--what", "motions", "--yes", "--board", "cm5")
    assert result.exit_code == 0 and says in result.stderr and peer.eeprom[0xFFF] == mode, result.stderr


@pytest.mark.parametrize("direction, lost", [("<-", b"J"), ("->", b"\r")])  # of `Jump Address`; the end of `go`
def test_factory_application_that_is_started_and_does_not_say_so_is_no_failure(m512, direction, lost):
    with FactoryPeer(old_flash()) as peer:
        typed, done = bytearray(), []

        def lose(way, _, byte):
            if way == "->":
                typed.append(byte)
            if (way, bytes([byte])) == (direction, lost) and typed.endswith((b"go", b"go\r")) and not done:
                done.append(byte)
                return None
            return byte

        peer.garble = lose
        result = m512("run", "-p", peer.path, "--board", "cm5")
        peer.pass_time(0.1)
        assert done and result.exit_code == 0 and "started" in result.stderr and peer.state == RUNS, result.stderr


def test_factory_success_is_not_believed(m512, motions):
    flash = bytearray(b"\xff" * 0x20000)
    flash[0xE000:0x1E000] = EMPTY * 128
    with FactoryPeer(flash) as peer:
        peer.loader.dead_pages.add(0xE600 // 256)
        result = m512("flash", motions, "-p", peer.path)
        assert result.exit_code == 8 and "read back wrong at 0x0E600" in result.stderr and "worn out" in result.stderr


def test_factory_prompt_with_a_full_line_is_not_crashed(m512, motions):
    flash = bytearray(b"\xff" * 0x20000)
    flash[0xE000:0x1E000] = motion_area()
    with FactoryPeer(flash) as peer:
        peer.loader.line = bytearray(b"x" * 80)
        assert m512("flash", motions, "-p", peer.path).exit_code == 0 and not peer.hurt


def test_factory_full_line_does_not_hurt_when_work_begins():
    from m512.board.factory import FactoryLoader

    with FactoryPeer() as peer:
        peer.loader.line = bytearray(b"x" * 80)
        with VirtualLink(peer.path) as link:
            FactoryLoader(link)
        assert not peer.hurt


# Refusals, without a board


@pytest.mark.parametrize(
    "pieces, says",
    [
        ([(0x1E000, bytes(100))], "into the boot loader"),
        ([(0, bytes(APP[1] + 1))], "where saved pages are kept"),
        ([(0x1DF00, bytes(0x200))], "into the boot loader"),
        ([(0x20000, bytes(512))], "beyond this board's flash"),
        ([(0x100, bytes(100))], "no reset vector at 0"),
    ],
)
def test_flash_refuses_what_would_hurt(m512, tmp_path, pieces, says):
    result = m512("flash", hex_file(tmp_path / "x.hex", *pieces), "--dry-run")
    assert result.exit_code == 5 and says in result.stderr


def test_flash_refuses_damaged_images(m512, tmp_path):
    result = m512("flash", hex_file(tmp_path / "x.hex", (0, make_app(good=False))), "--dry-run")
    assert result.exit_code == 5 and "length or CRC" in result.stderr
    image = Image.empty()
    image[3].data[100] ^= 1
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    result = m512("flash", tmp_path / "x.bin", "--dry-run")
    assert result.exit_code == 5 and "page 3: checksum" in result.stderr
    with BlockPeer(old_flash()) as peer:
        assert m512("flash", tmp_path / "x.bin", "--dry-run", "--damaged", "keep", "-p", peer.path).exit_code == 0


def test_flash_refuses_wrong_kinds_of_motions(m512, tmp_path):
    image = Image.empty(256)
    image[200] = read_text(MOTIONS)[3]
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    result = m512("flash", tmp_path / "x.bin", "--dry-run")
    assert result.exit_code == 5 and 'page 200 "walk"' in result.stderr


def test_areas_are_those_of_the_linker():
    text = (REPO / "linker" / "memory_map.h").read_text()
    here = dict(re.findall(r"#define (MEM_\w+) (0x[0-9A-F]+)", text))
    for name, area in (("APP", APP), ("JOURNAL", memory.JOURNAL), ("MOTION", memory.MOTIONS), ("BOOT", memory.BOOT)):
        assert area == (int(here[f"MEM_{name}_START"], 16), int(here[f"MEM_{name}_END"], 16)), name
    assert int(here["MEM_APP_RECORD"], 16) == RECORD_AT


def test_record_of_an_application():
    record = Record.of(make_app(2, 2))
    assert str(record) == "Motion512 edit 1.2.3 for cm2" and record.fits(make_app(2, 2))
    assert Record.of(bytes(300)) is None


def test_restore_leaves_the_mailbox_alone():
    wanted, found = bytearray(4096), bytearray(4096)
    wanted[0xFF3:0xFF7] = b"\1\xaa\5\2"  # FF4: a page waits; FF5: its number (boot/ORIGINAL.md, section 7)
    assert backup.eeprom_changes(bytes(wanted), bytes(found)) == {0xFF3: 1, 0xFF6: 2}


@pytest.mark.parametrize("command", [["flash", "{old}"], ["restore", "{b}", "--what", "motions"], ["restore", "{b}"]])
def test_a_page_that_an_interrupted_command_left_in_the_mailbox_is_not_copied_later(m512, tmp_path, command):
    (tmp_path / "old.m512").write_text(MOTIONS + "page 124 bow\n  step 50 | 1..18:300\n")
    with FactoryPeer() as peer:
        peer.flash[0xE000:0x1E000] = read_text((tmp_path / "old.m512").read_text()).to_bytes()
        start, end = BANNER_IN_FLASH  # so that nothing restarts the loader to learn its name
        peer.flash[start:end] = peer.loader.banner.rjust(end - start)
        assert m512("backup", tmp_path / "b", "-p", peer.path, "--board", "cm5").exit_code == 0
        flash = bytes(peer.flash)
        peer.eeprom[0x800:0xA00], peer.eeprom[0xFF4], peer.eeprom[0xFF5] = EMPTY, 0xAA, 124
        words = [word.format(old=tmp_path / "old.m512", b=tmp_path / "b") for word in command]
        result = m512(*words, "-p", peer.path, "--yes", "--board", "cm5", "--wait", "5")
        assert result.exit_code == 0, result.stderr
        peer.press_mode()
        peer.pass_time(OFF_S)  # it copies when it starts
        assert bytes(peer.flash) == flash


@pytest.mark.parametrize(
    "at, mode, before",
    [
        *((0x100, mode, before) for mode, before in ((0x11, 0x11), (0x11, 0xFF), (0xFF, 0x11))),
        (0xE000 + 512 * 3, 0x11, 0x11),
        (0xE000 + 512 * 124, 0xFF, 0x11),
    ],
)
def test_restore_leaves_no_eeprom_cell_that_writing_flash_has_changed(m512, tmp_path, at, mode, before):
    """The factory loader notes each download at FF6..FFE; the last motion pages go through the mailbox at 0x800; code, with the boot mode
    changed until it is complete."""
    with FactoryPeer() as peer:
        peer.flash[: 4 * 256], peer.flash[0xE000:0x1E000] = make_app()[: 4 * 256], EMPTY * 128
        peer.eeprom[0x800:0xA00], peer.eeprom[0xFF6:0xFFF], peer.eeprom[0xFFF] = bytes(range(256)) * 2, b"downloads", mode
        assert m512("backup", tmp_path / "b", "-p", peer.path, "--board", "cm5").exit_code == 0
        wanted, flash = bytes(peer.eeprom), bytes(peer.flash)
        peer.flash[at] ^= 1
        peer.eeprom[0x20] ^= 1
        peer.eeprom[0xFFF] = before
        result = m512("restore", tmp_path / "b", "-p", peer.path, "--yes", "--board", "cm5", "--wait", "5")
        assert result.exit_code == 0 and bytes(peer.flash) == flash, result.stderr
        different = [hex(cell) for cell in range(4096) if peer.eeprom[cell] != wanted[cell] and cell not in backup.MAILBOX_CELLS]
        assert not different, f"{different}: {result.stderr}"
        assert f"EEPROM: {'1 cell differs' if mode == before else '2 cells differ'}\n" in result.stderr
        assert " changed while flash was written" in result.stderr
        again = m512("restore", tmp_path / "b", "-p", peer.path, "--board", "cm5", "--wait", "5")
        assert again.exit_code == 0 and "The board holds this already" in again.stderr, again.stderr


@pytest.fixture
def other_eeprom(m512, tmp_path):
    """other_eeprom(peer) -> a backup whose cells 0x20..0x3F differ from those of the peer."""

    def make(peer):
        assert m512("backup", tmp_path / "b", "-p", peer.path, "--what", "eeprom", "--board", "cm5").exit_code == 0
        peer.eeprom[0x20:0x40] = bytes(range(32))
        return tmp_path / "b"

    return make


@pytest.mark.parametrize("fault", ["a byte changes", "the last digit of the count is doubled"])
def test_eeprom_bytes_that_arrive_wrong_are_written_again(m512, other_eeprom, fault):
    with FactoryPeer() as peer:
        folder, typed, done, wanted = other_eeprom(peer), bytearray(), [], bytes(peer.eeprom)

        def garble(direction, _, byte):
            if direction == "->" and not done:
                typed.append(byte)
                if fault == "a byte changes" and peer.state == "eep_dn":
                    done.append(byte)
                    return byte ^ 1
                if fault != "a byte changes" and typed.endswith(b"eep_dn 20 20"):
                    done.append(byte)
                    peer.on_byte(byte)
            return byte

        peer.garble = garble
        result = m512("restore", folder, "-p", peer.path, "--yes", "--board", "cm5")
        assert done and result.exit_code == 0 and "32 EEPROM cells written and read back" in result.stderr, result.stderr
        assert peer.eeprom == wanted[:0x20] + b"\xff" * 32 + wanted[0x40:]


def test_eeprom_bytes_are_not_sent_to_an_address_that_changed_on_the_line(m512, other_eeprom):
    """The digit is changed on its way there, and again in its echo."""
    with FactoryPeer() as peer:
        folder, before, passed = other_eeprom(peer), bytes(peer.eeprom), {"->": bytearray(), "<-": bytearray()}

        def garble(direction, _, byte):
            passed[direction].append(byte)
            return byte ^ 4 if passed[direction].endswith((b"eep_dn 2", b"eep_dn 6")) else byte

        peer.garble = garble
        result = m512("restore", folder, "-p", peer.path, "--yes", "--board", "cm5")
        assert result.exit_code == 8 and "took another address than it was given" in result.stderr, result.stderr
        assert passed["->"].endswith(b"eep_dn 20 20\r") and bytes(peer.eeprom) == before


@pytest.mark.parametrize(
    "how, code, says",
    [
        (KeyboardInterrupt, 130, "stopped while it wrote the EEPROM. Repeat the command: it writes what still differs"),
        (SystemExit, 143, ""),
        (None, 6, "run no other command"),  # the cable is pulled
    ],
)
def test_an_end_between_eeprom_bytes_leaves_no_loader_that_takes_the_next_command_for_them(m512, other_eeprom, how, code, says):
    """`eep_dn` waits for its bytes without a time limit. `m512 doctor` once wrote its own bytes into the EEPROM then."""
    with FactoryPeer() as peer:
        folder = other_eeprom(peer)

        def end(direction, _, byte):
            if direction == "->" and peer.state == "eep_dn" and byte == 0xFF:
                peer.garble = None
                if how:
                    raise how(code)
                peer.pull()
            return byte

        peer.garble = end
        result = m512("restore", folder, "-p", peer.path, "--yes", "--board", "cm5")
        assert result.exit_code == code and says in result.stderr, result.stderr
        if how:
            assert peer.state == PROMPTED and peer.eeprom[0x20:0x40] == b"\xff" * 32
        else:
            peer.plug()
            assert m512("restore", folder, "-p", peer.path, "--yes", "--board", "cm5").exit_code == 0
            assert peer.eeprom[0x20:0x40] == b"\xff" * 32


def test_an_eeprom_cell_that_is_worn_out_is_named(m512, peer, other_eeprom):
    class Worn(bytearray):
        def __setitem__(self, at, value):
            super().__setitem__(at, value)
            super().__setitem__(0x2A, 5)

    folder = other_eeprom(peer)
    peer.eeprom = Worn(peer.eeprom)
    result = m512("restore", folder, "-p", peer.path, "--yes", "--board", "cm5")
    assert result.exit_code == 8 and "EEPROM reads back wrong at 0x02A, 3 times" in result.stderr, result.stderr
    assert "EEPROM cells written" not in result.stderr and "epeat the command" in result.stderr


class WrongDigit:
    """The line changes 0x0n at the start of this row of a dump into 0x1n, `times` times. Both are shown as a dot beside the row."""

    def __init__(self, peer, address, times=1):
        self.row, self.times, self.line = b" %08X : " % address, times, bytearray()
        peer.garble = self

    def __call__(self, direction, _, byte):
        if direction != "<-":
            return byte
        self.line.append(byte)
        if byte == 0x0A:
            self.line.clear()
        if self.times and self.line == self.row + b"0":
            self.times -= 1
            return 0x31
        return byte


def first_low_byte(data, start):
    """The first row from `start` on whose first byte is 0x00..0x0F."""
    return next(at for at in range(start, len(data), 16) if data[at] < 16)


@pytest.mark.parametrize("what", ["eeprom", "motions", "app", "app of others", "behind the app"])
def test_a_digit_that_the_line_changes_is_in_no_backup(m512, tmp_path, what):
    """The factory loader's dump has no checksum (boot/ORIGINAL.md)."""
    flash = bytearray(make_app()).ljust(0xE000, b"\xff") + motion_area() + b"\xff" * 0x2000
    if what == "app of others":
        flash[0x8C:0x90] = b"none"
    flash[0x2000:0x2010] = bytes(16)
    with FactoryPeer(flash) as peer:
        peer.eeprom[0x120:0x140] = bytes(32)
        area = what if what in ("eeprom", "motions") else "app"
        at = {"eeprom": 0x120, "motions": 0xE000 + 3 * 512 + 64, "behind the app": 0x2000}.get(what) or first_low_byte(flash, 0x200)
        line = WrongDigit(peer, at)
        result = m512("backup", tmp_path / "b", "-p", peer.path, "--what", area, "--board", "cm5")
        assert result.exit_code == 0 and line.times == 0, result.stderr
        wanted = {"eeprom": peer.eeprom, "motions": flash[0xE000:0x1E000], "app": flash[:0xC000]}[area]
        assert (tmp_path / "b" / f"{area}.bin").read_bytes() == bytes(wanted)


def test_a_backup_that_is_read_differently_each_time_is_none(m512, tmp_path):
    with FactoryPeer() as peer:
        line, dump, readings = WrongDigit(peer, 0x120, times=0), peer.loader.do_e, []

        def every_other_time(args):
            if (args or [peer.loader.dump_at]) == [0x100]:
                readings.append(args)
                line.times = len(readings) % 2
            return dump(args)

        peer.loader.do_e = every_other_time
        peer.eeprom[0x120:0x140] = bytes(32)
        result = m512("backup", tmp_path / "b", "-p", peer.path, "--what", "eeprom", "--board", "cm5")
        assert result.exit_code == 7 and "eeprom at 0x100 is read differently each time" in result.stderr, result.stderr
        assert not (tmp_path / "b").exists()


GOOD_ENTRY = {"file": "motions.bin", "address": 0xE000, "bytes": 65536, "crc16": f"{crc16(EMPTY * 128):04X}", "sha256": ""}


@pytest.mark.parametrize(
    "entry, says",
    [
        ({"crc16": "0000"}, "not what the manifest says"),
        ({"address": None}, "manifest.json is damaged"),
        ({"file": 5}, "manifest.json is damaged"),
        (None, "manifest.json is damaged"),
    ],
)
def test_a_backup_that_was_changed_is_not_restored(m512, tmp_path, entry, says):
    """address None: there is none. entry None: the manifest is cut."""
    (tmp_path / "motions.bin").write_bytes(EMPTY * 128)
    named = {key: value for key, value in {**GOOD_ENTRY, **(entry or {})}.items() if value is not None}
    manifest = json.dumps({"format": "m512-backup", "version": 1, "files": {"motions": named}})
    (tmp_path / "manifest.json").write_text(manifest if entry else "{")
    result = m512("restore", tmp_path)
    assert result.exit_code == 4 and says in result.stderr, result.stderr


@pytest.mark.parametrize(
    "area, address, expected, found",
    [("motions", 0x1E000, "0x0E000", "0x1E000"), ("app", 256, "0x00000", "0x00100"), ("eeprom", 1, "0x00000", "0x00001")],
)
def test_backup_of_another_address_is_not_restored(m512, tmp_path, area, address, expected, found):
    with BlockPeer(bytearray(b"\xff" * 0xE000 + motion_area() + b"\xff" * 0x2000)) as board:
        assert m512("backup", tmp_path / "b", "-p", board.path).exit_code == 0
        manifest = json.loads((tmp_path / "b" / "manifest.json").read_text())
        manifest["files"][area]["address"] = address
        (tmp_path / "b" / "manifest.json").write_text(json.dumps(manifest))
        board.flash[0xE000 + 512 + 66] ^= 1
        before = bytes(board.flash)
        result = m512("restore", tmp_path / "b", "-p", board.path, "--yes")
        assert result.exit_code == 4 and expected in result.stderr and found in result.stderr and area in result.stderr, result.stderr
        assert bytes(board.flash) == before
    assert m512("diff", tmp_path / "b", tmp_path / "b").exit_code == (4 if area == "motions" else 0)


@pytest.fixture
def backup_of_all(m512, tmp_path):
    """(board, folder): a backup of all areas, and its board, whose motions have changed since."""
    with BlockPeer(bytearray(b"\xff" * 0xE000 + motion_area() + b"\xff" * 0x2000)) as board:
        assert m512("backup", tmp_path / "b", "-p", board.path).exit_code == 0
        board.flash[0xE000 + 512 + 66] ^= 1
        yield board, tmp_path / "b"


def cut(path):
    path.write_bytes(path.read_bytes()[:100])


def with_another_address(path):
    manifest = path.with_name("manifest.json")
    parts = json.loads(manifest.read_text())
    parts["files"][path.stem]["address"] = 1
    manifest.write_text(json.dumps(parts))


@pytest.mark.parametrize("harm, says", [(cut, "is not what the manifest says"), (os.unlink, "No such file"), (with_another_address, "address")])
def test_a_damaged_file_of_a_backup_does_not_hold_up_the_others(m512, backup_of_all, harm, says):
    board, folder = backup_of_all
    harm(folder / "eeprom.bin")
    told = m512("restore", folder, "-p", board.path, "--yes")
    assert told.exit_code == 4 and "eeprom" in told.stderr and says in told.stderr, told.stderr
    assert f"m512 restore {folder} --what motions,app" in told.stderr
    assert m512("diff", folder, folder).exit_code == 0
    done = m512("restore", folder, "-p", board.path, "--yes", "--what", "motions,app")
    assert done.exit_code == 0 and bytes(board.flash[0xE000:0x1E000]) == (folder / "motions.bin").read_bytes(), done.stderr
    assert m512("restore", folder, "-p", board.path, "--yes", "--what", "eeprom").exit_code == 4


def test_without_a_good_file_a_backup_offers_no_way_out(m512, backup_of_all):
    board, folder = backup_of_all
    for name in ("motions", "eeprom", "app"):
        cut(folder / f"{name}.bin")
    told = m512("restore", folder, "-p", board.path, "--yes")
    assert told.exit_code == 4 and "--what" not in told.stderr and told.stderr.count("not what the manifest says") == 3
    assert "--what" not in m512("diff", folder, folder).stderr


@pytest.mark.parametrize(
    "words",
    [
        ["pages", "b/motions.bin", "rename", "1", "x", "--in-place"],
        ["pages", "link.bin", "rename", "1", "x", "--in-place"],
        ["pages", "other.bin", "rename", "1", "x", "-o", "b/motions.bin", "--force"],
        ["convert", "other.bin", "b/motions.bin", "--force"],
        ["get", "all", "-o", "b/motions.bin", "--force", "-p", "peer://nobody"],
    ],
)
def test_a_backup_stays_as_it_was_read(m512, backup_of_all, tmp_path, monkeypatch, words):
    monkeypatch.chdir(tmp_path)
    folder = backup_of_all[1]
    (tmp_path / "other.bin").write_bytes(bytes(backup_of_all[0].flash[0xE000:0x1E000]))
    (tmp_path / "link.bin").symlink_to(folder / "motions.bin")
    before = (folder / "motions.bin").read_bytes()
    told = m512(*words)
    assert told.exit_code == 5 and "belongs to the backup" in told.stderr and "-o new.bin" in told.stderr, told.stderr
    assert (folder / "motions.bin").read_bytes() == before
    assert m512("pages", "b/motions.bin", "rename", "1", "x", "-o", "b/new.bin").exit_code == 0


@pytest.mark.parametrize(
    "manifest", ['{"name": "my page", "files": 5}', "{", '{"format": "m512-backup", "files": {"app": {"file": "app.bin"}}}', "[]"]
)
def test_a_manifest_that_does_not_name_a_file_does_not_protect_it(m512, tmp_path, manifest):
    (tmp_path / "manifest.json").write_text(manifest)
    (tmp_path / "motions.bin").write_bytes(motion_area())
    assert m512("pages", tmp_path / "motions.bin", "rename", "1", "x", "--in-place").exit_code == 0
