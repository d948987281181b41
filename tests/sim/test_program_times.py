# SPDX-License-Identifier: MIT
"""Duration of the requests of firmware/common/PROTOCOL.md on a robot of 18 servos, in the shipped Play and Edit: simulated time at the PC
from the first byte of a request to the last of its answer. Lines in between do not count: @now, and Play's reports of pages and steps, up
to 36 ms of them. `pytest -s` prints the figures."""

import pytest

from m512.crc16 import crc16
from m512.files.image import Image
from tests.sim import edit_robot, play_robot
from tests.sim.made_page import page

LOOP, PAGES = 1, 128
CRCS, POSE, WHERE = f"@crcs 0 {PAGES - 1}", "@pose", "@where"
OWN_MS = {CRCS: 290, POSE: 32, WHERE: 30}
BYTE_MS = 10 / 57.6  # 57,600 bit/s, 10 bits a byte
LEAST_LINES_A_SECOND, WATCH_SECONDS = 20, 2
TICK_HZ = 128


def motions():
    """A page that moves four joints forever, and 127 new ones."""
    image = Image.empty()
    image[LOOP] = page("loop", [(40, {1: 600, 11: 560}), (40, {1: 424, 11: 464})], next=LOOP)
    return image.to_bytes()


def edit():
    return edit_robot.robot(motions=motions()).board


def play():
    return play_robot.robot(pages=motions())


@pytest.fixture(params=[edit, play], ids=["edit", "play"])
def board(request):
    return request.param()


def timed(board, request, most_ms=3000):
    """(ms, words of the answer). @now lines, Play's reports of steps, and its prompt may come in between: their time on the line does not
    count."""
    board.take()
    start, heard = board.now_ms, b""
    board.send(request.encode() + b"\r")
    while board.now_ms - start < most_ms:
        board.run(ms=1)
        heard += board.take().translate(None, b"\x11\x13")
        for line in heard.split(b"\r\n")[:-1]:
            if line.startswith(request.split()[0].encode() + b" ") and line.endswith(b" OK"):
                return board.now_ms - start - heard.index(line) * BYTE_MS, line.decode().split()
    raise AssertionError(f"{request}: no answer within {most_ms} ms: {heard!r}")


def start_loop(board):
    """Starts a play. The returned function lists the ticks since then that have a frame of goals."""
    assert timed(board, f"@play {LOOP}")[1] == ["@play", "OK"]
    board.run(ms=3000)  # torque on, and the approach
    tick = play_robot.tick_of(board)
    board.clear_trace()
    return lambda: [tick(frame.cycle) for frame in board.trace if len(frame.goals) > 1]


def watched(board):
    """Number of complete @now lines in WATCH_SECONDS."""
    board.take()
    board.run(ms=1000 * WATCH_SECONDS)
    lines = board.take().translate(None, b"\x11\x13").split(b"\r\n")[1:-1]
    return sum(line.startswith(b"@now ") for line in lines)


def check_times(board, when, image):
    for request, own_ms in OWN_MS.items():
        ms, words = timed(board, request)
        print(f"{image}, {when}: {request} {ms:.1f} ms")
        assert 0 < ms <= own_ms, request
        assert request != POSE or len(words) == 18 + 2
        if request == CRCS:
            data = motions()
            assert words[1] == "".join(f"{crc16(data[512 * n : 512 * n + 512]):04X}" for n in range(PAGES))


def test_answers_come_in_time_and_cost_no_tick(board, request):
    name = request.node.callspec.id
    check_times(board, "idle", name)
    ticks = start_loop(board)
    check_times(board, "while a page plays", name)
    found = ticks()
    assert len(found) > TICK_HZ / 4 and found == list(range(found[0], found[0] + len(found)))


def test_watch_gives_twenty_lines_a_second_and_costs_no_tick(board, request):
    name = request.node.callspec.id
    assert timed(board, "@watch 50")[1] == ["@watch", "OK"]
    idle = watched(board)
    ticks = start_loop(board)
    playing = watched(board)
    print(f"{name}: @watch 50 gives {idle / WATCH_SECONDS:.1f} lines a second, {playing / WATCH_SECONDS:.1f} while a page plays")
    assert min(idle, playing) >= LEAST_LINES_A_SECOND * WATCH_SECONDS
    check_times(board, "while it is watched and a page plays", name)
    found = ticks()
    assert len(found) > TICK_HZ * WATCH_SECONDS - 2 and found == list(range(found[0], found[0] + len(found)))
