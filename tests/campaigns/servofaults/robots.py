# SPDX-License-Identifier: MIT
"""The robots that have the faults: Play and Edit at rest, while taught and while playing; and what their screens show.

There are twenty servos. 1..15 and 17 have positions in the pages; 17 was switched off by hand. 16 has the torque-off mark in the pages. No
page uses 18..20.
"""

import re

from cm5sim import Board
from m512.files.image import Image
from tests.campaigns import bus_watch
from tests.sim import edit_robot, play_robot
from tests.sim.made_page import page

from .model import ANGLE, HEAT, OVERLOAD, SILENT, TORQUE, VOLTAGE

THERE = range(1, 21)
SWINGING = range(1, 16)  # joints with positions in the pages
MARKED_OFF, RELEASED = 16, 17  # by the page, by hand
UNUSED = (18, 19, 20)
TORQUE_OFF_MARK, UNUSED_MARK = 0x2000, 0x4000
WALK, EXIT, POSE, LAYER = 4, 5, 6, 7
LAID_OVER = (1, 2, 3)  # joints of the layer
BY_CODE = ("swing 5 512 40 1500", "aim 15 540")  # motion by code in the layer situation
LOW, HIGH, MIDDLE = 412, 612, 512
RULES = ("hold", "exit", "limp")  # settings fault 0, 1, 2
SLICE_MS = 10
BACK = "back"
PLAY_SAYS = (
    (r"Servo (\d+) does not answer", SILENT),
    (r"Servo (\d+) answers again", BACK),
    (r"Servo (\d+) reports [a-z, ]*voltage", VOLTAGE),
    (r"Servo (\d+) reports [a-z, ]*angle limit", ANGLE),
    (r"Servo (\d+) reports [a-z, ]*overheating", HEAT),
    (r"Servo (\d+) reports [a-z, ]*overload", OVERLOAD),
    (r"Servo (\d+) has lost its torque", TORQUE),
)
EDIT_SAYS = {"No answer": SILENT, "Low voltage": VOLTAGE, "Angle limit": ANGLE, "Hot": HEAT, "Overload": OVERLOAD, "Lost torque": TORQUE}


def motions():
    """Returns a page that swings all joints until it is stopped, its exit page, a pose, and a page to layer over the first."""
    placed = (*SWINGING, RELEASED)

    def swing(number):
        return {joint: (LOW, HIGH)[(joint + number) % 2] for joint in placed}

    image = Image.empty()
    image[WALK] = page("walk", [(64, swing(0)), (64, swing(1))], joints=placed, next=WALK, exit=EXIT)
    image[EXIT] = page("exit", [(40, {})], joints=placed)
    image[POSE] = page("pose", [(40, {joint: 540 for joint in placed})], joints=placed)
    image[LAYER] = page("layer", [(48, {joint: 560 for joint in LAID_OVER}), (48, {})], joints=LAID_OVER, next=LAYER)
    for number in (WALK, EXIT, POSE):
        for step in range(7):
            for joint in range(31):
                if joint not in placed:
                    image[number].set_word(step, joint, 700 | (TORQUE_OFF_MARK if joint == MARKED_OFF else UNUSED_MARK))
        image[number].seal()
    return image.to_bytes()


class Watched:
    """What both images share: the clock, the reports with their times, and getting into a situation."""

    rule, playing = "hold", False
    shown, shown_row, heard = frozenset(), "", 0  # Edit's last message row; console bytes up to then

    def watch(self):
        """Forgets all reports. From now on `told` is {(joint, kind): ms since this call}."""
        self.told, self.ended = {}, None
        self.started_ms = self.board.now_ms
        self.held = self.holding
        self.board.clear_trace()
        self.listen()

    @property
    def since_ms(self):
        return self.board.now_ms - self.started_ms

    def note(self, joint, kind):
        self.told.setdefault((joint, kind), self.since_ms)

    def run(self, ms):
        for _ in range(int(ms / SLICE_MS)):
            self.board.run(ms=SLICE_MS)
            self.listen()

    def run_until(self, done, ms):
        """Runs until done() is true. Returns whether that happened in time."""
        for _ in range(int(ms / SLICE_MS)):
            if done():
                return True
            self.run(SLICE_MS)
        return done()

    @property
    def driven(self):
        return frozenset(SWINGING) if self.playing else frozenset()

    @property
    def cut(self):
        """Joints that the rule switches off."""
        return frozenset(THERE) - {RELEASED} if self.state in ("walk", "layer", "pause") and self.rule == "limp" else frozenset()

    @property
    def holding(self):
        return frozenset(servo.id for servo in self.board.servos if servo.torque)

    def where(self):
        """Returns the answer to @where as a dictionary."""
        answer = self.request("@where")
        return dict(word.split("=") for word in answer.split() if "=" in word)


class PlayRobot(Watched):
    """Play with a line terminal."""

    def __init__(self, state, rule="hold", seed=1):
        self.name = f"play.{state}" + (f".{rule}" if state not in ("rest", "off") else "")
        self.board = play_robot.robot(servos=THERE, pages=motions(), seed=seed)
        self.rule, self.state, self.playing = rule, state, state in ("walk", "layer")
        self.text = ""
        for line in (f"settings fault {RULES.index(rule)}", f"settings centre {POSE}", "on", f"off {RELEASED}"):
            self.line(line)
        if state == "off":
            self.line("off")
        elif state in ("walk", "layer", "pause"):
            self.line(f"play {WALK}")
            self.board.expect("Page 4 step 2", ms=4000)
        if state == "layer":
            for line in ("rate 120", "amplitude 90", f"layer {LAYER}", *BY_CODE):
                assert self.does(line), line
        if state == "pause":
            self.line("pause")
            self.board.run(ms=500)
        self.board.run(ms=700)  # the settings are in EEPROM, and the step is in its middle
        self.resets = self.board.resets
        self.phase = bus_watch.phase_of(self.board)
        self.watch()

    def listen(self):
        self.text = (self.text + self.board.take().decode("latin-1"))[-400:]
        whole, _, self.text = self.text.rpartition("\n")
        for line in whole.split("\n"):
            for pattern, kind in PLAY_SAYS:
                for joint in re.findall(pattern, line):
                    self.note(int(joint), kind)
            if "Ended" in line or "Broken off" in line:
                self.ended = self.since_ms
                self.end_text = line.strip()
            if "Motion512" in line:
                self.note(0, "reset")

    def line(self, text):
        return play_robot.ask(self.board, text)

    def request(self, text):
        self.board.send(text + "\r")
        return self.board.expect("OK\r\n")

    def does(self, text):
        """Types a line. Returns whether the answer is OK; reports about servos may come before it."""
        self.board.send(text + "\r")
        try:
            self.board.expect(" OK\r\n", ms=3000)
            return True
        except AssertionError:
            return False

    def on(self, joints):
        return self.does("on " + " ".join(map(str, sorted(joints))))

    def play(self, number):
        return self.does(f"play {number}")

    def stand(self):
        self.line("break")
        self.run(600)

    def remember_screen(self):
        """A line terminal has no screen to damage."""

    def screen_faults(self):
        return []


class EditRobot(Watched):
    """Edit with a terminal emulator."""

    def __init__(self, state, rule="hold", seed=1):
        self.name = f"edit.{state}" + (f".{rule}" if state not in ("rest", "teach") else "")
        self.rule, self.state, self.playing = rule, state, state == "walk"
        eeprom = _settings(rule)
        self.robot = edit_robot.Robot(servos=THERE, motions=motions(), seed=seed, eeprom=eeprom)
        self.board = self.robot.board
        self.line(f"page {WALK}")
        self.line("on")
        self.line(f"off {RELEASED}")
        if state == "teach":
            self.line("off")
            self.board.servos[3].push_to(300)
        elif state == "walk":
            self.board.send(f"play {WALK}\r")  # the screen is never quiet during a play
            self.board.run(ms=2200)
            self.robot.pump()
        self.resets = self.board.resets
        self.phase = bus_watch.phase_of(self.board)
        self.watch()

    def line(self, text):
        return self.robot.line(text)

    def row(self):
        buffer = self.robot.terminal.screen.buffer[self.robot.rows - 1]
        return "".join(buffer[x].data for x in range(80))

    def listen(self):
        self.robot.pump()
        row, now = self.row(), set()
        heard, self.heard = self.heard, len(self.board.console)
        stands = row == self.shown_row and heard == self.heard  # a row that is still being written may look the same twice
        for says, ids in re.findall(r"([A-Z][a-z ]+): ID ((?:\d+(?:-\d+)? )+)", row + " "):
            now |= {(joint, EDIT_SAYS[says]) for joint in _ids(ids) if says in EDIT_SAYS}
        if stands and (now or "well" in row or "Battery" in row):  # the row is complete
            for told in now:
                self.note(*told)
            for joint, kind in self.shown - now:
                if kind == SILENT:
                    self.note(joint, BACK)
            self.shown = now
        if stands and self.playing and self.ended is None and ("Ended" in row or "OK" in row):
            self.ended, self.end_text = self.since_ms, row.strip()
        self.shown_row = row
        for joint in self.held:
            if self.cell(joint) == "????":
                self.note(joint, TORQUE)

    def cell(self, joint):
        """Returns the joint's cell in the work pose's column."""
        buffer = self.robot.terminal.screen.buffer[joint]
        return "".join(buffer[x].data for x in range(19, 23))

    def request(self, text):
        self.robot.settle()
        self.board.send(text + "\r")
        answer = self.board.expect("OK\r\n")
        self.line("re")
        return answer

    def on(self, joints):
        return "No answer" not in self.line("on " + " ".join(map(str, sorted(joints))))

    def play(self, number):
        self.board.send(f"play {number}\r")
        self.board.run(ms=100)
        self.robot.pump()
        return True

    def stand(self):
        if self.playing and self.ended is None:
            self.robot.keys(" ", ms=500)

    def remember_screen(self):
        self.screen = [row[25:] for row in self.robot.terminal.screen.display[: self.robot.rows - 1]]
        self.at = self.robot.cursor

    def screen_faults(self):
        """Returns what is wrong on the screen, compared to before the fault and to a redrawn screen."""
        self.robot.settle()
        rows = self.robot.rows - 1
        now = self.robot.terminal.screen.display[:rows]
        found = [f"row {number + 1} was {was!r}, is {row[25:]!r}" for number, (was, row) in enumerate(zip(self.screen, now)) if was != row[25:]]
        self.line("re")
        anew = self.robot.terminal.screen.display[:rows]
        found += [f"row {number + 1} drawn anew is {after!r}, was {row!r}" for number, (row, after) in enumerate(zip(now, anew)) if row != after]
        return found


def _ids(text):
    for part in text.split():
        first, _, last = part.partition("-")
        yield from range(int(first), int(last or first) + 1)


def _settings(rule):
    """Returns an EEPROM with this rule, written by Play: Edit has no command for it."""
    with Board(images=[play_robot.IMAGE], seed=1) as board:
        board.expect("] ", ms=2000)
        play_robot.ask(board, f"settings fault {RULES.index(rule)}")
        board.run(ms=1000)
        return bytes(board.eeprom[0:4096])
