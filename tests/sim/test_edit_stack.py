# SPDX-License-Identifier: MIT
"""Stack headroom: bytes between the highest variable and the lowest stack so far, after Edit's deepest calls: SAVE, PLAY with all events
during it, UNDO, lists, program requests. Minimum 384."""

from tests.sim.boot_board import factory_section
from tests.sim.edit_robot import page, robot

BUDGET = 384

PAGES = {
    1: page("one", [(40, {1: 480}), (60, {1: 700, 2: 300}), (60, {1: 300, 2: 700})], repeat=3, exit=2),
    2: page("two", [(10 + k, {k: 300 + k}) for k in range(7)], joints=range(31)),
}
# The way to save that needs the most stack: the factory loader's routine reads its data from a fixed place in RAM, whose 256 bytes are kept
# on the stack meanwhile.
LOADER = {"images": ("edit-cm5.hex",), "loader": factory_section(), "bootrst": True}


def act(r, line, ms=0):
    r.line(line, ms=ms)
    if "[y/N]" in r.command:
        r.keys("y", ms=ms)


def ask(r, line):
    r.board.send(line.encode() + b"\r")
    r.board.run(ms=400)


def test_headroom_after_everything_deep():
    with robot(pages=PAGES, **LOADER) as r:
        seen = {}

        def note(what):
            seen[what] = r.board.stack_headroom

        for line in (
            "on",
            "go 0",
            "write",
            "insert 0",
            "swap 0 1",
            "take 0 6",
            "paste 0",
            "mirror 0",
            "undo",
            "redo",
            "undo",
            "copy 2",
            "undo",
            "new",
            "undo",
            "off 5",
            "pairs 1 2",
        ):
            act(r, line)
        note("edits")
        for line, key in (("list 1 9", "q"), ("list", "q"), ("help", "q")):
            r.line(line, ms=900)
            r.keys(key, ms=300)
        note("lists")
        r.board.servos[7].fault("silent")
        for line, key in (("play 1", " "), ("play 1", "\r"), ("play 2", "\x03")):
            r.line(line, ms=2500)
            r.keys(key, ms=1500)
        r.board.servos[7].clear()
        note("play")
        for line in (
            "@where",
            "@list",
            "@page 1",
            "@pose",
            "@torque on",
            "@move 60 1 200200200",
            "@play 1",
            "@where",
            "@break",
            "@open 2",
            "@crc",
            "@data 64 " + "00" * 32,
        ):
            ask(r, line)
        r.board.run(ms=1500)
        note("programs")
        r.keys("\x1b[B", ms=900)
        act(r, "page 1")
        act(r, "name z")
        act(r, "save")
        act(r, "save 9")
        note("save")
        assert r.flash_page(1)[:2] == b"z\0" and r.flash_page(9)[:2] == b"z\0"
        print("stack headroom: " + ", ".join(f"{what} {left}" for what, left in seen.items()) + f" (budget {BUDGET})")
        assert min(seen.values()) >= BUDGET
