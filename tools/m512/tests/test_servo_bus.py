# SPDX-License-Identifier: MIT
"""The doctor's bus of servos on an adapter (servos.py), on a port and a clock of the test. tests/host/test_doctor.py has the real ones."""

from contextlib import contextmanager
from types import SimpleNamespace

import pytest

from m512.board import bus_doctor, servos

ANSWER = bytes([0xFF, 0xFF, 2, 2, 0, 0xFB])  # of servo 2 to a PING


class Port:
    """Answers each packet to servo 2 with these bytes, at these times after it."""

    def __init__(self, *answers):
        self.answers, self.now, self.timeout, self.coming = answers, 0.0, 0.0, []

    def write(self, packet):
        self.coming = [(self.now + after, data) for after, data in self.answers if packet[2] == ANSWER[2]]

    def read(self, count):
        if not self.coming or self.coming[0][0] > self.now + self.timeout:
            self.now += self.timeout
            return b""
        at, data = self.coming.pop(0)
        self.now = max(self.now, at)
        if data[count:]:
            self.coming.insert(0, (at, data[count:]))
        return data[:count]

    @property
    def in_waiting(self):
        return len(self.coming[0][1]) if self.coming and self.coming[0][0] <= self.now else 0

    def flush(self):
        pass

    reset_input_buffer = flush


@pytest.fixture(name="line")
def a_line(monkeypatch):
    def make(*answers):
        port = Port(*answers)
        monkeypatch.setattr(servos, "time", SimpleNamespace(monotonic=lambda: port.now))
        monkeypatch.setattr("serial.Serial", lambda *_args, **_words: port)
        return servos.Bus("bus:/dev/of-the-test")

    return make


def test_what_a_second_servo_with_the_id_adds_makes_no_later_question_wait(line):
    bus = line((0.004, ANSWER), (0.015, b"\xff\x02"), (0.024, b"\x00"))
    assert bus.ask(2, servos.PING).id == 2 and bus.noise
    assert bus.longest == pytest.approx(0.004)


def test_a_search_says_how_far_it_is(line, monkeypatch):
    said = []

    @contextmanager
    def phase(title):
        yield lambda done, total: said.append((title, done, total))

    monkeypatch.setattr(bus_doctor.ui, "phase", phase)
    bus = line((0.004, ANSWER))
    assert bus_doctor._scan(bus, range(1, 4)) == [2]
    assert said == [("Asking IDs 1..3 at 1000000 baud", done, 3) for done in (1, 2, 3)]
