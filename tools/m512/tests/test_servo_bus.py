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


class Wire:
    """Servos at a rate: {rate: IDs}. Two servos have ID 2."""

    is_fast, device = True, "/dev/x"

    def __init__(self, servos_at):
        self.servos_at, self.rate, self.noise, self.written = servos_at, 0, b"", []

    def __enter__(self):
        return self

    def __exit__(self, *_exc):
        pass

    def set_rate(self, rate):
        self.rate = rate

    def find_echo(self):
        return False

    def is_somebody_there(self):
        return self.rate in self.servos_at

    def scan(self, ids, _progress):
        return [id_ for id_ in self.servos_at.get(self.rate, ()) if id_ in ids]

    def read(self, id_, _at, count):
        self.noise = b"?" if id_ == 2 else b""
        return None if id_ == 2 else bytes([1] * count)

    def ask(self, id_, _instruction):
        self.noise, here = b"", id_ in self.servos_at.get(self.rate, ())
        return servos.Answer(id_, 0, b"") if here else None

    def write(self, id_, at, value):
        self.written.append((id_, at, value))


def look(monkeypatch, wire, rate, mend=False):
    wire.rate = rate
    monkeypatch.setattr(servos, "Bus", lambda word: wire)
    return bus_doctor.examine("bus:/dev/x", lambda finding: None, mend)


def test_two_servos_with_one_id_are_not_moved_onto_the_bus_of_the_others(monkeypatch):
    wire = Wire({1000000: [1], 57142: [2, 3]})
    found = look(monkeypatch, wire, 1000000, mend=True)
    assert any("two servos have ID 2" in one.text for one in found)
    assert {id_ for id_, at, _ in wire.written if at == bus_doctor.AT_BAUD} == {3}


def test_the_command_that_moves_servos_names_the_rate_of_the_others_by_any_of_its_names(monkeypatch):
    found = look(monkeypatch, Wire({1000000: [1], 57142: [3]}), 57600)
    of_servos = [one for one in found if one.what == "servos"]
    assert [one.text for one in of_servos[:2]] == ["1 at 57142 baud: IDs 3", "1 at 1000000 baud: IDs 1"]
    assert "One command moves them: m512 doctor -p bus:/dev/x@57142 --mend;" in of_servos[1].advice
