# SPDX-License-Identifier: MIT
"""Line commands for programs in Edit (firmware/edit/PROTOCOL.md), and the full screen around them."""
from edit_robot import page, robot
from m512.crc16 import crc16

PAGES = {1: page("one", [(40, {1: 480}), (255, {1: 700, 2: 300}), (255, {1: 300, 2: 700})], repeat=5), 2: page("two", [(30, {})])}


def ask(r, line, ms=120):
    r.board.take()
    r.board.send(line.encode() + b"\r")
    r.board.run(ms=ms)
    answers = [text for text in r.board.take().translate(None, b"\x11\x13").decode().split("\r\n") if text.startswith("@")]
    assert len(answers) == 1, answers
    return answers[0]


def test_a_page_goes_in_and_comes_out():
    data = page("made", [(77, {5: 600})]).data
    with robot(pages=PAGES) as r:
        assert ask(r, "@open 9") == "@open OK"
        for offset in range(0, 512, 32):
            assert ask(r, f"@data {offset} {data[offset:offset + 32].hex()}") == "@data OK"
        assert ask(r, "@crc") == f"@crc {crc16(bytes(data)):04X} OK"
        assert ask(r, "@save 9 0x1").startswith("@save ERR 9 ")
        assert ask(r, f"@save 9 0x{crc16(bytes(data)):04X}", ms=250) == "@save OK"
        assert r.flash_page(9) == bytes(data)
        answer = ask(r, "@page 9", ms=400).split()
        assert answer[:2] == ["@page", "9"] and answer[2].lower() == bytes(data).hex() and answer[-1] == "OK"
        r.board.take()
        r.keys("\x1b[B", ms=800)
        assert r.text(1, 64, 4) == "made" and r.text(2, 76, 4) == "0009"


def test_data_stays_within_the_page():
    with robot(pages=PAGES) as r:
        assert ask(r, "@open 9") == "@open OK"
        assert ask(r, "@data 508 00112233") == "@data OK"
        for words in ("508 0011223344", "512 00", "511 0011", f"0 {33 * '00'}", "0 123", "0 1g"):
            assert ask(r, f"@data {words}").startswith("@data ERR 3 "), words


def test_open_does_not_drop_edits():
    with robot(pages=PAGES) as r:
        r.line("goto 1 1")
        r.line("set 77")
        assert ask(r, "@open 2").startswith("@open ERR 12 ")
        assert ask(r, "@frobnicate").startswith("@frobnicate ERR 1 ")
        assert ask(r, "@open").startswith("@open ERR 2 ")
        assert ask(r, "@page 128").startswith("@page ERR 3 ")


def test_play_misses_no_tick_and_space_breaks_it():
    with robot(pages=PAGES) as r:
        assert ask(r, "@play 1") == "@play OK"
        missed = [text for text in ask(r, "@where").split() if text.startswith("missed=")]
        r.board.run(ms=2000)
        assert [text for text in ask(r, "@where").split() if text.startswith("missed=")] == missed
        assert "state=play" in ask(r, "@where")
        r.board.send(b" ")
        r.board.run(ms=800)
        assert "state=idle" in ask(r, "@where")


def test_stack_headroom_after_everything_deep():
    """Bytes between the highest variable and the lowest stack ever, after the deepest things Edit does."""
    with robot(pages=PAGES) as r:
        for line in ("on", "go 0", "write", "insert 0", "int 0 1", "scale 120", "mirror 0", "save", "save 9", "page 2"):
            r.line(line)
            if "[y/N]" in r.command:
                r.keys("y", ms=200)
        for line, key in (("check 2", "q"), ("list 1 9", "q"), ("play 1", " ")):
            r.line(line, ms=2500)
            r.keys(key, ms=700)
        for line in ("@where", "@list", "@page 1", "@move 60 1 200200"):
            ask(r, line, ms=500)
        print(f"stack headroom: {r.board.stack_headroom} bytes (budget 384)")
        assert r.board.stack_headroom >= 384
