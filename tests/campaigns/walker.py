# SPDX-License-Identifier: MIT
"""A robot with Play that is kept busy by a remote, by a terminal that fills the serial line, and by faults of its servos.

One seed determines everything. Time runs in slices. The packets on the servo bus are checked as they come, so the trace of an hour (a
million packets) is never in memory.
"""

import random
import re

from cm5sim.board import CYCLES_PER_TICK, sync_goals
from m512.files.image import from_bytes
from tests.sim import play_robot

UP, DOWN, LEFT, RIGHT, STOP = 1, 2, 4, 8, 512
SLICE_MS = 10
PACKET_MS = 100  # interval between two packets while a button of the remote is held
LINE_BYTES_A_MS = 5.76
XON, XOFF = 0x11, 0x13
REST_TICKS = 5  # between two plays, READY alone takes longer; a shorter gap between frames is a missed tick
QUERIES = [
    "status",
    "servos",
    "@where",
    "faults",
    "list",
    "@pose",
    "law",
    "help",
    "@list",
    "nonsense",
    "play 200",
    "settings",
    "@page 4",
    "code 3000",
    "version",
    "@ver",
]
PASSING = ("silent", "checksum", "short", "noise", "late")
LASTING = ("silent", "dead", "checksum", "overload", "angle-limit", "overheating", "low-voltage")


class Bus:
    """Checks the frames of goals."""

    def __init__(self, phase):
        self.phase = phase
        self.frames = self.missed = self.doubled = 0
        self.offset_min, self.offset_max = CYCLES_PER_TICK, 0
        self.last = None  # tick of the last frame
        self.recording = None  # [(tick, goals)] while the reference page plays

    def take(self, packets):
        for cycle, packet in packets:
            if packet[4] != 0x83 or not (goals := sync_goals(packet)):
                continue
            tick, offset = divmod(cycle - self.phase, CYCLES_PER_TICK)
            self.frames += 1
            self.offset_min, self.offset_max = min(self.offset_min, offset), max(self.offset_max, offset)
            if self.last is not None:
                gap = tick - self.last
                self.doubled += gap == 0
                self.missed += gap - 1 if 1 < gap <= REST_TICKS else 0
            self.last = tick
            if self.recording is not None:
                self.recording.append((tick, goals))


def ticks_of(page):
    """Returns the ticks that a page of time-base schedule takes after its first two steps. At speed 32, a step's time counts ticks.

    The first step begins where the servos are, a unit or two from their goals. The second begins at the resulting speed.
    """
    return sum(round(page.time(step) * 32 / page.speed) + page.pause(step) for step in range(2, page.steps))


class Walker:
    """The robot and everything that happens to it."""

    def __init__(self, seed, joints, motions, reference, layer):
        self.chance = random.Random(seed)
        self.joints, self.reference, self.layer = list(joints), reference, layer
        self.pages = {number: page for number, page in from_bytes(motions).items() if number and page.is_playable}
        self.reference_ticks = ticks_of(self.pages[reference])
        self.board = play_robot.robot(servos=self.joints, pages=motions, seed=seed)
        play_robot.ask(self.board, "on")
        self.board.run_to("__vector_12")
        self.bus = Bus(self.board.now_cycles)
        self.board.clear_trace()
        self.resets = self.board.resets
        self.held = self.flooding = 0
        self.may_send, self.rest, self.lines = True, b"", 0
        self.text = ""
        self.done = dict.fromkeys(("plays", "codes", "breaks", "pauses", "stops", "faults", "commands", "packets", "driven"), 0)
        self.complaints = []

    # ---- time ----

    def slice(self):
        board = self.board
        if self.held and board.now_ms >= self.next_packet_ms:
            self.packet(self.held)
        if self.flooding:
            self.type()
        board.run(ms=SLICE_MS)
        heard = board.take()
        for byte in heard:
            if byte in (XON, XOFF):
                self.may_send = byte == XON
        self.text = (self.text + heard.decode("latin-1"))[-2000:]

    def run(self, ms):
        for _ in range(int(ms / SLICE_MS)):
            self.slice()
        self.bus.take(self.board.packets)
        self.board.clear_trace()

    def until(self, pattern, ms):
        for _ in range(int(ms / 100)):
            if re.search(pattern, self.text):
                return True
            self.run(100)
        return bool(re.search(pattern, self.text))

    # ---- remote and terminal ----

    def packet(self, value):
        self.board.rc(value)
        self.done["packets"] += 1
        self.next_packet_ms = self.board.now_ms + PACKET_MS

    def hold(self, value):
        if value != self.held:
            self.held = value
            self.packet(value)

    def say(self, line):
        self.text = ""
        self.board.send(line + "\r")
        self.done["commands"] += 1
        self.run(60)

    def type(self):
        """Types like a PC: without a pause, but obeying XOFF."""
        room = int(LINE_BYTES_A_MS * SLICE_MS) + 1
        while len(self.rest) < room:
            self.rest += QUERIES[self.lines % len(QUERIES)].encode() + b"\r"
            self.lines += 1
            self.done["commands"] += 1
        if self.may_send:
            count = max(0, room - self.board.waiting)
            self.board.send(self.rest[:count])
            self.rest = self.rest[count:]

    def stop_typing(self):
        self.flooding = 0
        for _ in range(200):
            if self.may_send and not self.board.waiting:
                break
            self.run(SLICE_MS)
        self.board.send(self.rest + b"\r")
        self.rest = b""
        self.run(2500)

    def stand(self):
        """Releases all buttons, breaks the play, and waits until nothing moves."""
        if self.flooding:
            self.stop_typing()
        self.hold(0)
        self.say("break")
        self.run(400)

    # ---- episodes ----

    def walk(self):
        """Holds and changes buttons for a while, then releases them. The walk goes on until it is stopped."""
        self.hold(self.chance.choice((UP, UP, UP, DOWN, LEFT, RIGHT)))
        for _ in range(self.chance.randrange(2, 9)):
            self.run(self.chance.randrange(600, 3000))
            self.hold(self.chance.choice((UP, UP, UP | LEFT, UP | RIGHT, LEFT, RIGHT, DOWN, 0)))
            self.done["codes"] += 1
        self.stop()

    def stop(self):
        """Stops the walk by remote, panel or typed word; sometimes twice within a second."""
        self.hold(0)
        for _ in range(self.chance.choice((1, 1, 1, 2))):
            way = self.chance.randrange(3)
            if way == 0:
                self.packet(STOP)
                self.run(120)
                self.packet(0)
            elif way == 1:
                self.board.press("START")
                self.run(100)
                self.board.release("START")
            else:
                self.say("stop")
            self.done["stops"] += 1
            self.run(200)
        self.until("Stopped|Broken|Ended", 6000)

    def call(self):
        """Plays a page by its number for a while."""
        self.say(f"play {self.chance.choice(list(self.pages))}")
        self.done["plays"] += 1
        self.run(self.chance.randrange(200, 9000))
        what = self.chance.randrange(4)
        if what == 0:
            self.say("break")
            self.done["breaks"] += 1
        elif what == 1:
            self.say("pause")
            self.until("Paused", 1500)
            self.run(self.chance.randrange(400, 1500))
            self.say("resume")
            self.done["pauses"] += 1
            self.run(self.chance.randrange(200, 3000))
        elif what == 2:
            self.stop()

    def flood(self):
        """Fills the serial line in both directions while the robot walks."""
        self.hold(UP)
        self.run(1500)
        self.flooding = 1
        for _ in range(self.chance.randrange(2, 6)):
            self.run(self.chance.randrange(800, 2500))
            self.hold(self.chance.choice((UP, UP | LEFT, RIGHT, 0, UP)))
        self.stop_typing()

    def driven(self):
        """Drives the walk twenty times a second while a layer comes and goes. Then the cable is pulled, and the play must end by itself."""
        self.hold(UP)
        self.run(1500)
        self.hold(0)
        wish, before = (0, 100, 100), self.text
        for line in range(self.chance.randrange(40, 160)):
            if line % 10 == 0:
                wish = self.chance.randint(-100, 100), self.chance.randint(50, 200), self.chance.randint(0, 120)
            self.board.send("@drive {} {} {}\r".format(*wish))
            if line % 30 == 15:
                self.board.send(self.chance.choice((f"layer {self.layer}\r", "layer off\r")))
            if line % 30 == 25:
                joint = self.chance.choice(self.joints)
                self.board.send(self.chance.choice((f"swing {joint} 512 60 1500\r", f"aim {joint} 540\r", "free\r")))
            self.run(50)
            self.done["driven"] += 1
        if not self.until("Stopped|Broken|Ended", 9000) and not self.is_idle():
            self.complaints.append(f"nobody drives, and the play goes on, at {self.board.now_ms:.0f} ms: {before[-40:]} ... {self.text[-80:]}")

    def is_idle(self):
        """Returns whether nothing plays. A play that ended early (such as a walk whose code the remote held) reported its end long ago."""
        self.say("@where")
        return self.until("state=idle", 1000)

    def passing_faults(self):
        """Spoils one or two answers in a row. The walk must go on."""
        self.hold(UP)
        for _ in range(self.chance.randrange(2, 8)):
            self.board.servos[self.chance.choice(self.joints)].fault(self.chance.choice(PASSING), times=self.chance.choice((1, 2)))
            self.done["faults"] += 1
            self.run(self.chance.randrange(300, 900))
        for servo in self.board.servos:
            servo.clear()

    def lasting_fault(self):
        """Makes a servo fail. The rule ends the play; then the servo recovers and is switched on."""
        self.say(f"play {self.chance.choice(list(self.pages))}")
        self.run(self.chance.randrange(500, 3000))
        servo = self.board.servos[self.chance.choice(self.joints)]
        servo.fault(self.chance.choice(LASTING))
        self.done["faults"] += 1
        self.run(1500)
        servo.clear()
        self.run(500)
        self.stand()
        self.say("on")
        self.run(300)
        if not servo.torque:
            self.complaints.append(f"servo {servo.id} stayed limp after its fault, at {self.board.now_ms:.0f} ms")

    def set_something(self):
        self.say(
            self.chance.choice(
                (
                    "settings hot 65",
                    "settings hot 70",
                    "settings approach 60",
                    "settings approach 90",
                    "remote latch",
                    "remote hold",
                    "law classic",
                    "law exact",
                )
            )
        )
        self.run(600)

    def episode(self):
        chosen = self.chance.choices(
            (self.walk, self.call, self.flood, self.passing_faults, self.lasting_fault, self.set_something, self.driven), (30, 30, 6, 8, 4, 2, 8)
        )[0]
        chosen()
        self.stand()

    # ---- the reference page ----

    def measure(self):
        """Plays the reference page. Returns its goals tick by tick, after its first two steps (ticks_of). Complains about joints that do
        not end at the page's last positions."""
        self.stand()
        for line in ("law exact", "remote latch", "settings approach 60", "on"):
            self.say(line)
        self.run(800)
        self.text, self.bus.recording = "", []
        self.say(f"play {self.reference}")
        self.until("Ended", 20_000)
        self.run(300)
        recorded, self.bus.recording = self.bus.recording, None
        final = self.pages[self.reference]
        wanted = {joint: final.word(final.steps - 1, joint) for joint in self.joints}
        for joint, pos in wanted.items():
            if pos <= 1023 and (self.board.servos[joint].goal != pos or abs(self.board.servos[joint].present - pos) > 3):
                self.complaints.append(f"joint {joint} stands at {self.board.servos[joint].goal} and not at {pos}")
        ends = recorded[-1][0] if recorded else 0
        return [(tick - ends, goals) for tick, goals in recorded if tick > ends - self.reference_ticks]

    def statistics(self):
        """Returns the counts that `faults` prints."""
        self.stand()
        self.say("faults")
        self.run(500)
        words = self.text.replace(":", " ").split()
        return {words[i]: int(words[i + 1]) for i in range(len(words) - 1) if words[i + 1].isdigit()}
