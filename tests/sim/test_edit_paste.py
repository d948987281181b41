# SPDX-License-Identifier: MIT
"""A script pasted at full line rate, with saves in it: every line is executed, although the UART loses a third unread byte."""

from tests.sim.edit_robot import MOTION_START, new_page, page, robot, seal

XON, XOFF = 0x11, 0x13


def paste(r, text):
    """Types at line rate as a terminal with software flow control does: up to 16 bytes still leave after an XOFF."""
    data, sent, may_send = text.encode("latin-1"), 0, True
    output = bytearray()
    while sent < len(data) or r.board.waiting:
        if may_send and r.board.waiting < 16 and sent < len(data):
            r.board.send(data[sent : sent + 16])
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
    """200 lines, and the pages that the flash must hold after them."""
    lines, pages = [], {}
    for number in range(10, 20):
        data = new_page()
        lines += [f"page {number}", "name", f"paste {number}", "dec"]
        data[0:14] = f"paste {number}".encode().ljust(14, b"\0")
        for k in range(6):
            joint, value = 1 + k, 100 * k + number
            lines += [f"goto {k + 1} {joint}", f"set {value}"]
            data[64 + 64 * k + 2 * joint : 66 + 64 * k + 2 * joint] = value.to_bytes(2, "little")
        lines += ["step 6", "time", "save", "# a remark"]
        data[16], data[20] = 10, 6
        pages[number] = seal(data)
    return lines, pages


def test_200_lines_with_saves_at_line_rate_lose_nothing():
    lines, pages = script()
    assert len(lines) >= 200
    with robot(pages={1: page("one", [(40, {})])}) as r:
        for number in pages:
            r.board.flash[MOTION_START + 512 * number : MOTION_START + 512 * (number + 1)] = b"\xff" * 512
        start = r.board.now_ms
        text = "\r".join(lines) + "\r"  # without questions, because typed-ahead input does not answer them
        paste(r, text)
        print(f"paste: {len(lines)} lines, {len(text)} bytes in {r.board.now_ms - start:.0f} ms, 10 saves")
        for number, data in pages.items():
            assert r.flash_page(number) == data, number


def test_a_pc_that_was_told_to_wait_may_go_on_after_a_restart():
    with robot() as r:
        r.board.take()
        r.board.send(b"re\r" * 100)
        r.board.expect(chr(XOFF), ms=3000)
        r.board.reset()
        r.board.run(ms=2500)
        assert [byte for byte in r.board.take() if byte in (XON, XOFF)][-1:] == [XON]
