# SPDX-License-Identifier: MIT
"""A robot with Play on the simulated board, for test_play*.py: its motion pages, its prompt, recorded sessions.

A session (tests/models/golden/sessions/*.txt) is the text of a terminal, with directives for other events:

    ] play 1                typed: everything after the prompt
     OK                     expected output
    # wait 500              waits in ms         # rc 16            a packet of the remote
    # fault 3 silent        a servo fails       # clear 3          ... and recovers
    # press START, # release START              # note ...         a remark
"""

import pathlib
import re

from cm5sim import Board
from m512.files.image import Image
from m512.files.page import SCHEDULE_SPEED
from tests.sim.made_page import JOINTS, page  # noqa: F401 (the tests take them from here)

TOP = pathlib.Path(__file__).resolve().parents[2]
SESSIONS = TOP / "tests" / "models" / "golden" / "sessions"
GOLDEN = TOP / "tests" / "models" / "golden"
IMAGE = "play-cm5.hex"
UP, DOWN, LEFT, RIGHT, PAUSE, STOP = 1, 2, 4, 8, 256, 512
XON, XOFF = 0x11, 0x13


def walk_steps(turn=0):
    """Two steps of half a second that swing the legs to both sides."""
    left = {11: 560 + turn, 12: 464 + turn, 13: 540, 14: 484}
    right = {11: 464 - turn, 12: 560 - turn, 13: 484, 14: 540}
    return [(64, left), (64, right)]


def motions():
    """The pages of the robot of these tests."""
    image = Image.empty()
    image[1] = page("ready", [(40, {1: 480, 2: 544})])
    image[2] = page("bow", [(60, {11: 600, 12: 424}), (60, {11: 600, 12: 424}, 64), (60, {})], code=16)
    image[3] = page("walk start", [(40, {11: 540, 12: 484})], code=UP, next=4, exit=5)
    walk = dict(exit=5, link1_code=LEFT, link2_code=RIGHT)
    image[4] = page("walk", walk_steps(), next=4, link1_page=6, link2_page=7, **walk)
    image[5] = page("walk stop", [(40, {})])
    image[6] = page("turn left", walk_steps(20), next=6, link1_page=6, link2_page=7, **walk)
    image[7] = page("turn right", walk_steps(-20), next=7, link1_page=6, link2_page=7, **walk)
    image[8] = page("loop a", [(30, {1: 560})], next=8, exit=9)
    image[9] = page("loop b", [(30, {1: 464})], next=9, exit=8)
    image[10] = page("no steps")
    image[11] = page("torn", [(30, {})])
    image[11].data[100] ^= 0xFF
    image[12] = page("into torn", [(30, {1: 540})], next=11)
    image[13] = page("thrice", [(30, {1: 540}), (30, {1: 484})], repeat=3)
    image[14] = page("slow", [(255, {1: 812, 2: 212})], speed=128)
    image[15] = page("long name 13c", [(30, {})], repeat=0, next=1)
    image[16] = page("bad sched", [(30, {})], schedule=5)
    image[17] = page("speed 0", [(30, {})], speed=0)
    image[18] = page("bad link", [(30, {})], next=200)
    image[19] = page("bad pos", [(30, {3: 1500})])
    image[20] = page("nine steps", [(30, {})])
    image[20].steps = 9
    image[20].seal()
    image[21] = page("speed base", [(64, {1: 700}), (64, {1: 512})], schedule=SCHEDULE_SPEED)
    image[22] = page("some", [(30, {1: 560, 3: 0x4000 | 700, 5: 0x2000 | 700})], code=32)
    data = bytearray(image.to_bytes())
    data[100 * 512 :] = b"\xff" * (28 * 512)
    return bytes(data)


def robot(servos=JOINTS, pages=None, image=IMAGE, kind="cm5", **options):
    """A board at its first prompt. It has polled each servo, and no remote packet has come for so long that no button counts as held."""
    board = Board(kind=kind, images=[image], motions=motions() if pages is None else pages, servos=servos, **options)
    board.expect("] ", ms=2000)
    board.run(ms=510)
    return board


def press_start(board):
    """Presses Start on the panel for 50 ms."""
    board.press("START")
    board.run(ms=50)
    board.release("START")


def ask(board, line, ms=3000):
    """Types a line and returns its answer, without the echo and the next prompt."""
    board.run(ms=5)
    board.take()
    board.send(line + "\r")
    text = board.expect("\r\n] ", ms=ms)
    return text.replace("\r\n", "\n").split("\n", 1)[1][:-2].strip("\n")


def paste(board, text, behind_xoff=16):
    """Types at line rate as a terminal with software flow control does: `behind_xoff` bytes still leave after an XOFF. Returns the board's
    output without XON and XOFF."""
    data, sent, may_send, heard = text.encode("latin-1"), 0, True, bytearray()
    while sent < len(data) or board.waiting:
        if may_send and board.waiting < behind_xoff and sent < len(data):
            board.send(data[sent : sent + behind_xoff])
            sent += behind_xoff
        board.run(ms=1)
        new = board.take()
        for byte in new:
            if byte in (XON, XOFF):
                may_send = byte == XON
        heard += new
    return bytes(heard).translate(None, bytes((XON, XOFF)))


def tick_of(board):
    """Returns a function from cycles to ticks, counted from now. A frame goes out within its own tick."""
    board.run_to("__vector_12")
    phase = board.now_cycles
    return lambda cycle: (cycle - phase) // 125_000


def shown(raw):
    """The text on a terminal: CR goes to column 0, BS goes back by one, later text overwrites."""
    lines = []
    for line in raw.decode("latin-1").split("\n"):
        cells, column = [], 0
        for character in line:
            if character == "\r":
                column = 0
            elif character == "\b":
                column = max(0, column - 1)
            elif character >= " ":
                cells[column : column + 1] = [character]
                column += 1
        lines.append("".join(cells).rstrip(" ") if cells[:2] != ["]", " "] else "".join(cells))
    return "\n".join(lines)


def _until(board, text, start, most_ms=8000):
    for _ in range(most_ms // 5):
        if text.encode() in board.console[start:]:
            _until_quiet(board)
            return
        board.run(ms=5)
    raise AssertionError(f"{text!r} did not come within {most_ms} ms: {board.console[start:]!r}")


def _direct(board, words, start):
    """Executes one directive of a session. start: console position when the line before was typed."""
    name, arguments = words[0], words[1:]
    if name == "wait":
        board.run(ms=int(arguments[0]))
    elif name == "until":
        _until(board, " ".join(arguments), start)
    elif name == "rc":
        board.rc(int(arguments[0]))
        board.run(ms=5)
    elif name == "fault":
        board.servos[int(arguments[0])].fault(arguments[1])
    elif name == "clear":
        board.servos[int(arguments[0])].clear()
    elif name in ("press", "release"):
        getattr(board, name)(arguments[0])
        board.run(ms=50)
    elif name != "note":
        raise ValueError(f"unknown directive {name}")


def run_session(board, text):
    """Executes a session and returns it as it really happened, with "n" for the numbers of bus counts."""
    done, told, pending = [], len(board.console), b"] "

    def settle():
        """Appends complete lines to the session; text after the last line end waits."""
        nonlocal pending, told
        raw = board.console[told:]
        told += len(raw)
        cut = (pending + raw).rfind(b"\n") + 1
        done.extend(re.sub(r"\d+", "n", line) if line.startswith("Bus:") else line for line in shown((pending + raw)[:cut]).splitlines())
        pending = (pending + raw)[cut:]

    since = told
    for line in text.splitlines():
        if line.startswith("# "):
            settle()
            done.append(line)
            _direct(board, line[2:].split(), since)
            since = told
        elif line.startswith("] ") and len(line) > 2:
            since = len(board.console)
            board.send(line[2:] + "\r", wait=True)
            _until_quiet(board)
    settle()
    done += shown(pending).splitlines()
    return "\n".join(piece.rstrip() for piece in done if piece.strip() != "]") + "\n"


def _until_quiet(board, quiet_ms=15, most_ms=6000):
    """Runs until the prompt is back and no more output comes."""
    for _ in range(most_ms // quiet_ms):
        before = len(board.console)
        board.run(ms=quiet_ms)
        if len(board.console) == before and board.console.endswith(b"] "):
            return
