# SPDX-License-Identifier: MIT
"""Noise for whole shipped images on the strict board. Used by fuzz.py.

An input is a class. One session is one board and one seed. pieces() is the list of events (verb, data). It depends on the seed alone. A fault is an AssertionError or a Violation.

Every session of an application checks, in addition to what its input checks:
  * no violation of the board, no reset, and the stack keeps its headroom
  * `@where` is answered; the longest time is measured
  * goals go to existing servos and are within 0..1023
  * flash is unchanged; EEPROM is unchanged outside of the settings
"""

import random

from cm5sim import Board
from cm5sim.board import CYCLES_PER_TICK, rc_packet, sync_goals
from m512.files.image import from_bytes
from tests.sim.boot_noise import MAKERS
from tests.sim.boot_noise import fuzz as boot_fuzz
from tests.sim.edit_noise import fuzz as edit_fuzz
from tests.sim.play_robot import motions

XON, XOFF = 0x11, 0x13
SETTINGS_END = 0x100
HEADROOM_MIN = 64
ANSWER_TRIES = 40  # of 3 s each
WALK, TURN_LEFT, TURN_RIGHT = 4, 6, 7  # of play_robot.motions()
SYNC_WRITE, REG_WRITE, WRITE, READ = 0x83, 4, 3, 2
EEPROM_REGISTERS = 24


def pages():
    """Returns the pages of Play's tests, with the turns as the walk's blend partners."""
    image = from_bytes(motions())
    image[WALK].data[17], image[WALK].data[18] = TURN_RIGHT, TURN_LEFT
    image[WALK].seal()
    return image.to_bytes()


class Session:
    """One robot that receives noise; the base class of the inputs below."""

    name = promise = how = ""
    image = "play-cm5.hex"
    size = 160_000  # bytes of one session; its start and end take 3 s
    obeys_flow = 0.5  # share of sessions whose sender obeys XOFF

    def __init__(self, seed, size=None):
        self.seed, self.size = seed, size or self.size
        self.rng = random.Random(f"{self.name} {seed}")
        self.flow = self.rng.random() < self.obeys_flow
        self.servos = list(range(1, 1 + self.rng.choice((0, 1, 6, 6, 18))))
        self.sent = 0
        self.slowest_ms = 0.0
        self.board = None
        self.who = {}  # the servos by their original ID

    # contents of an input

    def pieces(self):
        """Returns [(verb, data)] of about self.size bytes in total; a verb is the name of a method."""
        made, count = [], 0
        while count < self.size:
            made.append(("type", self.noise(self.rng.randrange(200, 1500))))
            count += len(made[-1][1])
        return made

    def noise(self, count):
        raise NotImplementedError

    def look(self):
        """Makes the input's own checks at the end."""

    # verbs

    def type(self, data):
        """Sends at line rate. A sender that obeys XOFF sends 16 more bytes after it, as a USB adapter does."""
        board, at, may_send = self.board, 0, True
        if not self.flow:
            board.send(data)
            at = len(data)
        while at < len(data) or board.waiting:
            if may_send and board.waiting < 16 and at < len(data):
                board.send(data[at : at + 16])
                at += 16
            board.run(ms=2 if self.flow else 50)
            if self.flow:
                for byte in board.take():
                    if byte in (XON, XOFF):
                        may_send = byte == XON

    def wait(self, ms):
        self.board.run(ms=ms)

    def fault(self, data):
        servo, name, times = data
        if name == "clear":
            self.who[servo].clear()
        else:
            self.who[servo].fault(name, times)

    # playing

    def start(self):
        self.board = Board(images=[self.image], motions=pages(), servos=self.servos, seed=self.seed % 65536 + 1)
        self.board.forbid("unexpected-reset")
        self.board.expect("] ", ms=2500)
        self.board.run(ms=300)
        self.board.clear_trace()

    def answer(self):
        """Sends `@where` until it is answered; earlier lines may still be in the queue. Returns the answer."""
        self.board.run(ms=50)
        self.board.take()
        began = self.board.now_ms
        for _ in range(ANSWER_TRIES):
            self.board.send(b"\x15\r\x15@where\r")
            try:
                text = self.board.expect(" OK\r\n", ms=3000)
                if "@where state=" in text:
                    self.slowest_ms = max(self.slowest_ms, self.board.now_ms - began)
                    return text
            except AssertionError:
                pass
        raise AssertionError(f"no answer to @where; the console says {self.board.console[-200:]!r}")

    def look_at_packets(self):
        ids = set(self.servos) | set(self.board.servos.ids)  # noise may have changed a servo's ID
        for _, packet in self.board.packets:
            instruction, address = packet[4], packet[5] if len(packet) > 6 else 255
            if instruction == SYNC_WRITE:
                for servo, goal in sync_goals(packet).items():
                    assert servo in ids and goal <= 1023, f"goal {goal} for servo {servo}"
            elif instruction in (WRITE, REG_WRITE):
                assert packet[2] in ids, f"a write to servo {packet[2]}, which is not there: {packet.hex()}"
                assert address >= EEPROM_REGISTERS, f"a write into a servo's EEPROM: {packet.hex()}"
                if address == 30:
                    assert packet[6] | packet[7] << 8 <= 1023, f"a goal out of range: {packet.hex()}"
        self.board.clear_trace()

    def play(self, pieces):
        """Plays the pieces on a new board and checks everything."""
        self.start()
        self.who = {servo.id: servo for servo in self.board.servos}
        flash, eeprom = bytes(self.board.flash), bytes(self.board.eeprom)
        for verb, data in pieces:
            getattr(self, verb)(data)
            self.sent += len(data) if isinstance(data, bytes) else 0
            self.look_at_packets()
        self.answer()
        self.look()
        self.look_at_packets()
        assert bytes(self.board.flash) == flash, "flash has changed"
        assert bytes(self.board.eeprom)[SETTINGS_END:] == eeprom[SETTINGS_END:], "EEPROM has changed beside the settings"
        assert self.board.stack_headroom >= HEADROOM_MIN, f"{self.board.stack_headroom} bytes of stack left"

    def run(self):
        """Plays the whole session. Returns (bytes, simulated seconds, slowest answer in ms, stack headroom)."""
        self.play(self.pieces())
        figures = self.sent, self.board.now_ms / 1000, self.slowest_ms, self.board.stack_headroom
        self.board.close()
        return figures


# ---- the shell ----

WORDS = (
    "play stop break pause resume code on off list status servos faults law remote settings version help p s b ? "
    "rate amplitude blend drive layer aim swing free shape @rate @amplitude @blend @drive @layer @aim @swing @free @shape @watch "
    "@ver @list @page @dense @pose @move @torque @play @stop @break @pause @resume @where @open @data @crc @save @ @nothing"
).split()
ARGUMENTS = (
    "0 1 2 3 4 8 9 11 13 14 15 16 17 18 19 20 21 22 30 31 32 64 126 127 128 200 240 255 256 1023 1024 65535 65536 99999999999 "
    "0x0 0x1F 0x200 0xFFFF 0x10000 0xfg -1 1.5 x ready bow walk thrice 4 5 6 slow loop find defaults exact classic latch hold on off "
    "-100 -40 50 100 150 151 400 401 512 700 reset drive centre approach fault low hot neutral flow fast talk law remote 200 200200 --- 1ff---200 3ff400 0g0 \xff"
).split()
KEYS = (b"\x08", b"\x7f" * 5, b"\x01", b"\x15", b"\x1b[A", b"\x1b[B", b"\x1b[", b"\x1b", b"\x1b[12;3R", b"\0", b"\x11", b"\x13", b"\t", b";")


class PlayConsole(Session):
    name = "play-console"
    promise = "Play stands whatever is typed"
    how = (
        "words of its shell and of programs with good and bad numbers, keys, broken pieces of them and bytes without sense; half of the "
        "senders do not stop at XOFF"
    )

    def line(self):
        rng = self.rng
        count = rng.choice((0, 0, 1, 1, 1, 2, 2, 3, 9))
        text = rng.choice(WORDS)
        for _ in range(count):
            text += rng.choice((" ", " ", " ", ",", ".", ":", "  ")) + rng.choice(ARGUMENTS)
        made = bytearray(text.encode("latin-1"))
        if rng.random() < 0.15:
            at = rng.randrange(len(made))
            made[at : at + 1] = rng.choice((b"", made[at : at + 1] * 2, rng.randbytes(1), rng.choice(KEYS)))
        return bytes(made) + rng.choice((b"\r", b"\r", b"\r", b"\n", b"\r\n", b"\r\r"))

    def noise(self, count):
        rng, made = self.rng, bytearray()
        while len(made) < count:
            kind = rng.random()
            if kind < 0.75:
                made += self.line()
            elif kind < 0.85:
                made += rng.choice(KEYS)
            elif kind < 0.97:
                made += rng.randbytes(rng.randrange(1, 60))
            else:
                made += bytes([rng.randrange(32, 127)]) * rng.randrange(60, 400) + b"\r"
        return bytes(made)


# ---- the remote ----


class Remote(Session):
    name = "remote"
    promise = "Play stands whatever comes from the remote, mixed with typed text; a good packet behind it counts"
    how = "good packets, packets with bytes lost, doubled or changed, packets into each other, text and bytes without sense between them"
    obeys_flow = 0.0

    def buttons(self):
        rng = self.rng
        return rng.choice((0, 0, 1, 2, 4, 8, 5, 9, 16, 32, 64, 128, 256, 512, 255, 513, 768, rng.randrange(1024), rng.randrange(65536)))

    def noise(self, count):
        rng, made = self.rng, bytearray()
        while len(made) < count:
            packet = bytearray(rc_packet(self.buttons()))
            kind = rng.random()
            if kind < 0.45:
                made += packet * rng.choice((1, 1, 1, 2, 5))
            elif kind < 0.8:
                at = rng.randrange(6)
                packet[at : at + 1] = rng.choice((b"", packet[at : at + 1] * 2, rng.randbytes(1), rc_packet(self.buttons())))
                made += packet
            elif kind < 0.9:
                made += rng.choice((b"version\r", b"status\r", b"U", b"\xff", b"\x55", b"\xff\x55", b"@where\r", b"stop\r", b"help\r"))
            else:
                made += rng.randbytes(rng.randrange(1, 20))
        return bytes(made)

    def look(self):
        """Two stops within a second are a break, so the robot must be idle now."""
        for _ in range(2):
            self.board.rc(512)
            self.board.run(ms=200)
            self.board.rc(0)
            self.board.run(ms=200)
        for _ in range(8):
            if "state=idle" in self.answer():
                return
            self.board.run(ms=500)
        raise AssertionError("two stops of the remote do not stop the robot")


# ---- the servo bus ----

FAULTS = (
    "silent",
    "silent",
    "silent",
    "checksum",
    "noise",
    "late",
    "short",
    "two-talkers",
    "overload",
    "overheating",
    "low-voltage",
    "angle-limit",
    "duplicate",
    "blocked",
)


class PlayBus(Session):
    """Bytes on the bus while the board listens for answers, from 50 us to 2 ms after its tick. Meanwhile the servos fail and recover."""

    name = "play-bus"
    promise = "Play stands whatever is on the servo bus; afterwards every servo is found again"
    how = (
        "good, changed and foreign status packets and noise where the answers belong, with thirteen kinds of servo faults, at rest and while playing"
    )
    size = 150_000
    waking = (  # lines typed repeatedly, so that the robot rests and plays
        b"play ready\r",
        b"play walk start\r",
        b"play 13\r",
        b"on\r",
        b"off\r",
        b"stop\r",
        b"servos\r",
        b"faults\r",
        b"break\r",
        b"pause\r",
        b"resume\r",
        b"servos find\r",
        b"@move 60 1 200200\r",
        b"@pose\r",
        b"play 8\r",
        b"law classic\r",
        b"law exact\r",
    )

    def __init__(self, seed, size=None):
        super().__init__(seed, size)
        self.servos = list(range(1, 1 + self.rng.choice((2, 4, 6, 6, 12))))
        self.phase = self.next_look_ms = 0

    def status(self):
        """Returns a status packet that could be an answer, or almost."""
        rng = self.rng
        params = rng.choice((0, 0, 2, 2, 4, 8, 20, 20, 20, 24, rng.randrange(60)))
        body = [rng.choice(self.servos + [0, 30, 31, 253, 254]), params + 2, rng.choice((0, 0, 0, 1, 4, 32, 36, 127, 255))]
        body += [rng.choice((0, 1, 2, 3, 255, rng.randrange(256))) for _ in range(params)]
        packet = bytearray(b"\xff\xff" + bytes(body) + bytes([~sum(body) & 0xFF]))
        if rng.random() < 0.5:
            at = rng.randrange(len(packet))
            packet[at : at + 1] = rng.choice((b"", packet[at : at + 1] * 2, rng.randbytes(1), b"\xff"))
        return bytes(packet)

    def burst(self):
        rng = self.rng
        made = b"" if rng.random() < 0.7 else rng.randbytes(rng.randrange(1, 60))
        while len(made) < 20 or rng.random() < 0.6:
            made += self.status() if rng.random() < 0.85 else rng.randbytes(rng.randrange(1, 20))
        return made[:143]

    def pieces(self):
        rng, made, count = self.rng, [], 0
        while count < self.size:
            kind = rng.random()
            if kind < 0.02:
                made.append(("say", rng.choice(self.waking)))
            elif kind < 0.06:
                made.append(("fault", (rng.choice(self.servos), rng.choice(FAULTS + ("clear",) * 8), rng.choice((None, 1, 5)))))
            else:
                made.append(("wire", (rng.randrange(800, 32_000), self.burst())))
                count += len(made[-1][1][1])
        return made

    def wire(self, data):
        offset, burst = data
        board = self.board
        board.run(cycles=(self.phase + offset - board.now_cycles) % CYCLES_PER_TICK)
        board.servos.noise(burst)
        self.sent += len(burst)

    def say(self, data):
        """Sends one line; the console is quiet otherwise."""
        self.board.send(data)

    def start(self):
        super().start()
        self.board.run_to("__vector_12")
        self.phase = self.board.now_cycles % CYCLES_PER_TICK

    def look_at_packets(self):
        """Checks only twice a second: reading a trace costs more time than the noise."""
        if self.board.now_ms >= self.next_look_ms:
            self.next_look_ms = self.board.now_ms + 500
            super().look_at_packets()

    def look(self):
        """Ends all noise. Every healthy servo must be found again. Noise may have changed a servo's ID, rate, delay and answers: they
        are restored."""
        for servo_id, servo in self.who.items():
            servo.write(3, [servo_id, 1, 250])
            servo.write(16, [2])
            servo.clear()
        for twin in list(self.board.servos)[len(self.who) :]:  # of duplicate IDs; their IDs may have changed
            twin.fault("dead")
        self.board.run(ms=3000)
        self.next_look_ms = 0
        self.board.send(b"\x15break\r")
        self.board.run(ms=3000)
        self.board.send(b"servos find\r")
        self.board.run(ms=4000)
        self.board.take()
        self.board.send(b"@pose\r")
        text = self.board.expect(" OK\r\n", ms=3000)
        for servo in self.servos:
            assert f" {servo}:" in text and f" {servo}:?" not in text, f"servo {servo} is well and not found: {text!r}"


# ---- inputs with their own noise ----


class EditConsole:
    """tests/sim/edit_noise.py. Three of four sessions ignore XOFF. In the fourth, Edit receives every byte; that takes as long with
    fewer bytes."""

    name = "edit-console"
    promise = "Edit stands whatever is typed, and flash is what SAVE wrote"
    how = (
        "its grammar, answers, keys, lines of programs, saves, restarts, broken pieces of them and bytes "
        "without sense; three senders in four do not stop at XOFF, and most of theirs is lost, as it would be"
    )
    size = 100_000
    slow_size = 4_000

    def __init__(self, seed, size=None):
        self.seed, self.size = seed, size or self.size

    def run(self):
        loud = self.seed % 4 != 3
        figures = edit_fuzz(self.seed // 4 if not loud else self.seed, self.size if loud else min(self.size, self.slow_size), loud=loud)
        return figures.sent, figures.seconds, 0.0, figures.headroom


class Loader:
    """tests/sim/boot_noise.py"""

    name = "loader"
    promise = "The boot loader stands whatever comes, and writes nothing without a valid command"
    how = "noise at the prompt, its words, STK500 sessions and block frames, broken in every way"
    size = 1_250_000  # 17 s of silence follow

    def __init__(self, seed, size=None):
        self.seed, self.size = seed, size or self.size

    def run(self):
        figures = boot_fuzz(MAKERS[self.seed % len(MAKERS)], self.seed, self.size)
        return figures.sent, figures.seconds, 0.0, figures.headroom


INPUTS = {kind.name: kind for kind in (PlayConsole, Remote, PlayBus, EditConsole, Loader)}


def mean_size(name):
    """Returns the mean size of a session of this input, in bytes."""
    kind = INPUTS[name]
    return kind.size if kind is not EditConsole else (3 * kind.size + kind.slow_size) // 4
