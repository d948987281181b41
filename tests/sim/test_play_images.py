# SPDX-License-Identifier: MIT
"""Motion sets: that of tests/samples, and real ones where they are (../shared/data, or M512_SHARED). Valid pages play to their end
under both laws on the shipped image, the others are refused with the reason. A sample of the pages; M512_ALL_PAGES=1
plays every one (tests/unit plays them all on the PC in any case)."""

import os

import pytest

from m512.files.image import Image, from_bytes, is_erased
from m512.files.page import Fault
from tests.sim.play_robot import SHARED, TOP, ask, robot

DATA = SHARED / "data"
ALL = bool(os.environ.get("M512_ALL_PAGES"))
EVERY = 1 if ALL else 5
REASONS = {
    Fault.CHECKSUM: "checksum is wrong",
    Fault.STEPS: "more than 7 steps",
    Fault.SCHEDULE: "unknown schedule",
    Fault.SPEED: "page speed is 0",
    Fault.POSITION: "position above 1023",
}
FILES = [TOP / "tests" / "samples" / "robot_128p.bin", *sorted(DATA.glob("*.bin"))]
PLAY_MS, END_MS = 3000, 60_000


def read(path):
    """The first 128 pages of a file, judged as this board judges them: 10 bits."""
    return Image(from_bytes(path.read_bytes()[: 128 * 512]).pages)


def play_to_the_end(board, number):
    """Returns what was printed. A page that goes on for ever is stopped after a while."""
    board.run(ms=20)
    board.take()
    board.send(f"play {number}\r", wait=True)
    board.run(ms=30)
    text = board.take().decode("latin-1")
    if " OK" not in text:
        return text
    for waited in range(0, END_MS, 100):
        text += board.take().decode("latin-1")
        if "Ended" in text or "Stopped" in text or "Broken" in text:
            return text
        if waited == PLAY_MS:
            board.send("stop\r", wait=True)
        board.run(ms=100)
    raise AssertionError(f"page {number} did not end: {text!r}")


@pytest.mark.parametrize("law", ["exact", "classic"])
@pytest.mark.parametrize("path", FILES, ids=lambda path: path.stem)
def test_pages_of_a_set(path, law):
    image = read(path)
    board = robot(servos=range(1, 21), pages=image.to_bytes())
    for line in ("settings talk 0", "settings approach 240", f"law {law}"):
        ask(board, line)
    board.run(ms=1000)
    played = refused = 0
    for number, page in list(image.items())[1::EVERY]:
        text = play_to_the_end(board, number)
        fault = next((fault for fault in page.faults() if fault is not Fault.LINK), Fault.OK)  # such a link counts as 0
        if is_erased(page) or (fault is Fault.OK and page.steps == 0):
            assert f"Page {number} is empty" in text
        elif fault is not Fault.OK:
            assert f"Page {number} is damaged: {REASONS[fault]}" in text
            refused += 1
        elif page.repeat != 0:
            assert "Ended" in text or "Stopped" in text, text
            assert "fault of a servo" not in text
            played += 1
        assert all(0 <= goal <= 1023 for frame in board.trace for goal in frame.goals.values())
        board.clear_trace()
    text = ask(board, "faults")
    assert "Ticks: missed 0 goals late 0" in text
    print(f"\n{path.stem}, {law}: {played} pages played, {refused} refused")
    assert played + refused > 0


def test_there_are_sets_of_others():
    if len(FILES) == 1:
        pytest.skip(f"no motion sets of others in {DATA} (M512_SHARED)")
