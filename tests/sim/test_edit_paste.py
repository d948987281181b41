# SPDX-License-Identifier: MIT
"""A script pasted at full line rate, saves in it: every line is executed, on the UART that loses a third byte. And noise:
random and grammar-made bytes, no hang, no violation, flash changed only by SAVE. M512_FUZZ_BYTES sets how many (10^7 for
the whole)."""
import os
import random

import pytest

from edit_robot import MOTION_START, UNUSED, new_page, page, robot, seal

XON, XOFF = 0x11, 0x13
FUZZ_BYTES = int(os.environ.get("M512_FUZZ_BYTES", "60000"))


def paste(r, text):
    """Types at line rate as a terminal with software flow control does: up to 16 bytes still leave behind an XOFF."""
    data, sent, may_send = text.encode("latin-1"), 0, True
    output = bytearray()
    while sent < len(data) or r.board.waiting:
        if may_send and r.board.waiting < 16 and sent < len(data):
            r.board.send(data[sent:sent + 16])
            sent += 16
        r.board.run(ms=1)
        new = r.board.take()
        for byte in new:
            if byte in (XON, XOFF):
                may_send = byte == XON
        output += new
    r.terminal.feed(output)
    r.settle()
    return output


def script():
    """200 lines, and what the flash must hold after them."""
    lines, pages = [], {}
    for number in range(10, 20):
        data = new_page()
        lines += [f"page {number}", "new", "yname", f"paste {number}"]
        data[0:14] = f"paste {number}".encode().ljust(14, b"\0")
        for k in range(6):
            joint, value = 1 + k, 100 * k + number
            lines += [f"goto {k + 1} {joint}", f"set {value}"]
            data[64 + 64 * k + 2 * joint:66 + 64 * k + 2 * joint] = value.to_bytes(2, "little")
        lines += ["step 6", "time", "save", "# a remark"]
        data[16], data[20] = 10, 6
        pages[number] = seal(data)
    return lines, pages


def test_200_lines_with_saves_at_line_rate_lose_nothing():
    lines, pages = script()
    assert len(lines) >= 200
    with robot(pages={1: page("one", [(40, {})])}) as r:
        for number in pages:
            r.board.flash[MOTION_START + 512 * number:MOTION_START + 512 * (number + 1)] = b"\xff" * 512
        start = r.board.now_ms
        text = "\r".join(lines) + "\r"   # "new", then y as the answer and name as the next line
        paste(r, text)
        print(f"paste: {len(lines)} lines, {len(text)} bytes in {r.board.now_ms - start:.0f} ms, 10 saves")
        for number, data in pages.items():
            assert r.flash_page(number) == data, number


def grammar(rng):
    words = ("page next before copy new name step go write insert delete move mirror set goto on off time speed re hex dec "
             "undo redo list find check take paste int scale swap pairs help balance mon rows play p n b s g w i d m u ?")
    word = rng.choice(words.split())
    count = rng.choice((0, 0, 1, 1, 1, 2, 2, 3, 9))
    numbers = (rng.choice(("0", "1", "3", "6", "7", "31", "127", "128", "1023", "65535", "65536", "0x1f", "-1", "x", "yes"))
               for _ in range(count))
    return " ".join((word, *numbers)) + rng.choice(("\r", "\n", "\r\n", "\r\r")) + rng.choice(("", "", "y", "n", " ", "q", "\x1b"))


def noise(rng, count):
    made = bytearray()
    while len(made) < count:
        kind = rng.randrange(10)
        if kind < 6:
            made += grammar(rng).encode()
        elif kind < 8:
            made += bytes(rng.randrange(256) for _ in range(rng.randrange(1, 40)))
        else:
            made += rng.choice((b"\x1b[A", b"\x1b[B", b"\x1b[C", b"\x1b[D", b"\x1b[", b"\x1b[999;9R", b"]", b"[", b"}", b"{", b" ",
                                b"@where\r", b"@pose\r", b"@page 300\r", b"@data 9 00\r", b"x" * 200 + b"\r"))
    text = bytes(made[:count])
    for word in (b"sav", b"SAV", b"toss", b"exit"):   # they write, wait for good, restart
        text = text.replace(word, b"....")
    return text


@pytest.mark.parametrize("seed", [1, 2])
def test_noise_does_no_harm(seed):
    rng = random.Random(seed)
    with robot(pages={1: page("one", [(40, {1: 480})]), 2: page("two", [(30, {})], next=2)}) as r:
        before = bytes(r.board.flash[MOTION_START:])
        left = FUZZ_BYTES // 2
        while left > 0:
            part = noise(rng, min(left, 5000))
            paste(r, part.decode("latin-1"))
            left -= len(part)
        assert bytes(r.board.flash[MOTION_START:]) == before
        r.keys("\x03", ms=3000)
        r.keys("\x1b", ms=300)
        r.keys("q\x03", ms=300)
        r.terminal.screen.reset()
        r.keys("\r", ms=300)
        if "[CID:" in r.show():
            r.line("exit", ms=1500)
        r.keys("\x03")
        r.line("dec")
        r.line("re", ms=500)
        assert "PageNumber" in r.show(), r.show()
