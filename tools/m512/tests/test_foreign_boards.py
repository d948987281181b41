# SPDX-License-Identifier: MIT
"""Unsupported boards, and loaders that do not name their board: nothing is written there, whichever command comes first. The form of the
banner and the loader's commands are in boot/ORIGINAL.md, 1 and 2."""

import random

import pytest
from block_peer import BlockPeer
from factory_peer import PROMPTED, FactoryPeer
from hex_files import hex_file
from peer import APP
from test_flash import MOTIONS, make_app, motion_area

from m512.board import banner
from m512.errors import RefusedError
from m512.files.page import EMPTY

HARMLESS = {b"id", b"@ver", b"flash 1f780", b"flash", b"reset"}


def banner_of(name):
    return b"\r\n\n SYSTEM O.K. (" + name + b" Boot loader V1.00)"


def full_flash():
    flash = bytearray(random.Random(1).randbytes(0x20000))
    flash[0xE000:0x1E000] = EMPTY * 128
    return flash


@pytest.fixture
def commands(m512, tmp_path):
    """{command: its words, without the port}."""
    (tmp_path / "lib.m512").write_text(MOTIONS)
    app = hex_file(tmp_path / "play.hex", (0, make_app()))
    with FactoryPeer(full_flash()) as ours:
        assert m512("backup", tmp_path / "saved", "-p", ours.path, "--what", "motions,eeprom").exit_code == 0
    lib = tmp_path / "lib.m512"
    return {
        "flash": ("flash", lib),
        "flash code": ("flash", app),
        "dry": ("flash", lib, "--dry-run"),
        "run": ("run",),
        "run code": ("run", app),
        "backup": ("backup", tmp_path / "new"),
        "restore": ("restore", tmp_path / "saved", "--yes"),
        "put": ("put", lib, "walk"),
        "get": ("get", "all", "-o", tmp_path / "got.bin"),
        "play": ("play", "1"),
        "pages": ("pages", None, "delete", "3", "--yes"),
        "diff": ("diff", None, lib),
        "doctor": ("doctor",),
    }


def call(m512, words, path, *more):
    port = [] if None in words else ["-p", path]
    result = m512(*(path if word is None else word for word in words), *port, *more)
    return result, result.stderr + (result.stdout if words[0] == "doctor" else "")


def is_as_it_was(peer, eeprom=None):
    return peer.flash == peer.before and not peer.downloads and not peer.hurt and (eeprom is None or peer.eeprom == eeprom)


@pytest.mark.parametrize("state", [PROMPTED, APP])
@pytest.mark.parametrize("name", [b"CM510", b"CM-530", b"CM700", b"OpenCM9.04"])
def test_a_board_that_is_none_of_ours_is_refused_by_its_name(m512, commands, name, state):
    for command, words in commands.items():
        if state == APP and words[0] in ("put", "get", "play", "doctor") or command == "dry" and state == APP:
            continue  # these do not ask for the button, so nobody answers them
        with FactoryPeer(full_flash(), state, says=banner_of(name)) as peer:
            eeprom = bytes(peer.eeprom)
            result, told = call(m512, words, peer.path)
            assert result.exit_code == (3 if command == "doctor" else 5), (command, told)
            assert f"this is a {name.decode()}" in told and "nothing was written" in told, (command, told)
            assert is_as_it_was(peer, eeprom) and set(peer.words) <= HARMLESS, (command, peer.words)
            assert peer.state == PROMPTED


def test_saying_that_it_is_ours_does_not_help_against_its_own_name(m512, commands):
    with FactoryPeer(full_flash(), says=banner_of(b"CM510")) as peer:
        result, told = call(m512, commands["flash"], peer.path, "--board", "cm5")
        assert result.exit_code == 5 and "this is a CM510" in told and is_as_it_was(peer)


@pytest.mark.parametrize("says", [banner_of(b"XY9"), b"\r\n\n SYSTEM O.K.", b"\r\n\n SYSTEM O.K. (CM5 B"])
def test_a_board_that_nobody_knows_is_asked_for(m512, commands, says):
    for command in ("flash", "flash code", "run", "backup", "restore", "pages", "diff", "put", "doctor"):
        with FactoryPeer(full_flash(), says=says) as peer:
            result, told = call(m512, commands[command], peer.path)
            assert result.exit_code == (3 if command == "doctor" else 5) and "--board cm5" in told and is_as_it_was(peer), (command, told)
            assert ("XY9" in told) == (b"XY9" in says)
    with FactoryPeer(full_flash(), says=says) as peer:
        assert call(m512, commands["flash"], peer.path, "--board", "cm5")[0].exit_code == 0
        assert peer.flash[0xE200:0x1E000] == motion_area()[512:]
    with FactoryPeer(full_flash(), says=says) as peer:
        result, told = call(m512, commands["run code"], peer.path, "--board", "cm2")
        assert result.exit_code == 5 and "for cm5" in told and is_as_it_was(peer)


@pytest.mark.parametrize("name, board", [(b"CM5", "cm5"), (b"CM-5", "cm5"), (b"CM2", "cm2"), (b"CM-2+", "cm2")])
def test_boards_of_ours_are_known_by_their_names(m512, commands, name, board):
    with FactoryPeer(full_flash(), says=banner_of(name)) as peer:
        result, told = call(m512, commands["run code"], peer.path)
        assert (result.exit_code == 0) == (board == "cm5"), told
        assert f"factory boot loader on a {board}" in told
        assert board == "cm5" or "this board is a cm2" in told and is_as_it_was(peer)
    other = "cm2" if board == "cm5" else "cm5"
    with FactoryPeer(full_flash(), says=banner_of(name)) as peer:
        result, told = call(m512, commands["flash"], peer.path, "--board", other)
        assert result.exit_code == 5 and f"--board says {other}" in told and is_as_it_was(peer)


def test_the_known_loader_at_its_prompt_is_not_restarted(m512, commands):
    """Its banner is read from its flash (boot/ORIGINAL.md, 7b)."""
    flash = full_flash()
    flash[0x1F7E9 : 0x1F7E9 + 40] = b" SYSTEM O.K. (CM5 Boot loader V1.31)".ljust(40, b"\0")
    with FactoryPeer(flash, says=b"") as peer:
        assert call(m512, commands["doctor"], peer.path)[0].exit_code in (0, 3)
        assert call(m512, commands["dry"], peer.path)[0].exit_code == 0
        assert b"reset" not in peer.words and is_as_it_was(peer)


def test_a_loader_that_does_not_come_back_from_its_restart_is_told(m512, commands):
    with FactoryPeer(full_flash()) as peer:
        peer.garble = lambda direction, _, byte: None if direction == "->" and byte == 0x23 else byte
        result, told = call(m512, commands["flash"], peer.path)
        assert result.exit_code == 7 and "MODE" in told and is_as_it_was(peer)


def test_our_own_loader_on_another_board(m512, commands):
    with BlockPeer(full_flash(), board=3) as peer:
        result, told = call(m512, commands["flash"], peer.path)
        assert result.exit_code == 5 and "this is a CM510" in told and not peer.writes
    with BlockPeer(full_flash(), board=2) as peer:
        result, told = call(m512, commands["flash"], peer.path, "--board", "cm5")
        assert result.exit_code == 5 and "--board says cm5" in told and not peer.writes


@pytest.mark.parametrize(
    "text, name",
    [
        (b"\xff\r\n\n SYSTEM O.K. (CM5 Boot loader V1.31)\r\n - ", "CM5"),
        (b"SYSTEM O.K. (Some Thing Bootloader)", "Some Thing"),
        (b"SYSTEM O.K. (CM5 Boot lo", ""),
        (b"SYSTEM O.K. ()", ""),
        (b"", ""),
        (b"\r\nOpenCM9.04 boot loader\r\n - ", "OpenCM9.04"),
        (b"SYSTEM O.K. CM-530 V2\r\n - ", "CM-530"),
        (b"SYSTEM O.K. (CM510)", "CM510"),
        (b"system o.k. (cm530 bootloader)", "cm530"),
        (b"SYSTEM O.K. (CM5)", ""),
        (b"SYSTEM O.K. (\x1b[2J Boot loader)", ""),
    ],
)
def test_the_name_in_a_banner(text, name):
    assert banner.name_in(text) == name


@pytest.mark.parametrize("name", ["", " ", "CM", "CM5A", "CM-50", "cm510", "X" * 40])
def test_no_other_name_is_taken_for_ours(name):
    with pytest.raises(RefusedError):
        banner.board_of(name)


@pytest.mark.parametrize("name", ["CM-904ES", "CM-510 Rev.2", "BIOLOID CM510", "OpenCR", "OpenCM 9.04", "cm530", "CM-50", "CM25"])
def test_another_board_of_the_family_is_refused_whatever_the_user_says(name):
    for told in ("", "cm5", "cm2"):
        with pytest.raises(RefusedError, match="m512 knows CM-2, CM-2[+] and CM-5 only"):
            banner.board_of(name, told)


@pytest.mark.parametrize("name", ["CM5+", "CM-5 Rev.2", "CM-2 Plus", "Arduino"])
def test_a_name_that_nobody_knows_is_left_to_the_user(name):
    with pytest.raises(RefusedError, match="--board cm5"):
        banner.board_of(name)
    assert banner.board_of(name, "cm2") == "cm2"


@pytest.mark.parametrize("pause", [0.05, 0.5])
@pytest.mark.parametrize("state", [PROMPTED, APP])
def test_a_banner_in_lumps(m512, commands, state, pause):
    """The first part may end anywhere. The board is recognised by its name or the user must name it; it is never taken for another."""
    for whole in (banner_of(b"CM5"), banner_of(b"CM510")):
        for at in range(12, len(whole), 8):
            with FactoryPeer(full_flash(), state, says=whole) as peer:
                send, sent = peer.send, bytearray()

                def lumps(data, peer=peer, send=send, sent=sent, first=whole[:at]):
                    sent += data
                    rest = len(sent) - sent.find(first) - len(first)
                    if first in sent and rest < len(data):
                        send(data[: len(data) - rest])
                        peer.sent_until = max(peer.clock, peer.sent_until) + pause
                        data = data[len(data) - rest :]
                    send(data)

                peer.send = lumps
                result, told = call(m512, commands["flash"], peer.path)
                if b"CM510" in whole:
                    assert result.exit_code in (5, 7) and is_as_it_was(peer), (at, told)
                assert result.exit_code == 0 or is_as_it_was(peer) and ("--board" in told or "CM510" in told or "MODE" in told), (at, told)
