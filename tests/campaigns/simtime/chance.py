# SPDX-License-Identifier: MIT
"""Random sessions for sessions.py. made(seed) returns the actions of a session: [(tick, words)].

The verbs are those of world.c; a tick is 1/128 s. A session is a person with a robot for some minutes: typing, use of the remote, servos
and lines that fail and recover, power cuts, a late computer.
"""

import random

from m512.crc16 import crc16
from tests.campaigns.fuzz_board import KEYS, PlayConsole
from tests.campaigns.fuzz_board import pages as play_pages

SECOND = 128
START = 3 * SECOND  # the search for servos is over
LOOKED_AT = 220  # ticks until everything is painted and the rules have checked it
CAPITALS, DEAF, SPOILT = 0.06, 0.1, 0.4  # shares: of lines; of sessions in which some servos ignore SYNC WRITE; of sent pages
TRIMMED, TRIM_MOST = 0.3, 200  # share of sessions; with it every position that a page or a line here names is in reach
LAW_PAGES = range(20, 30)
SOFT_PAGES = (1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 14, 21, 22, *LAW_PAGES)
SOFTNESS = (0x55, 0x55, 0x33, 0x66, 0x42)
CODE_PAGES = (  # number, code, steps, times played, undamaged: of the pages with one code only some can be called
    (70, 2, 0, 1, True),
    (71, 2, 1, 1, False),
    (72, 2, 1, 0, True),
    (73, 2, 1, 1, True),
    (74, 8, 0, 1, True),
    (75, 8, 1, 2, True),
    (76, 8, 1, 1, True),
    (77, 64, 0, 1, True),
)
FAST_PAGE = 78  # its first step is faster than an approach
PLAYED = (1, 2, 3, 4, 8, 9, 12, 13, 14, 15, 21, 22)
SETTINGS = (
    ("law", (0, 1)),
    ("remote", (0, 1, 2)),
    ("approach", (30, 60, 120, 240)),
    ("fault", (0, 0, 1, 1, 2)),
    ("low", (0, 90, 110)),
    ("hot", (0, 70, 75)),
    ("talk", (0, 1, 1, 1)),
    ("drive", (5, 10)),
    ("centre", (0, 1)),
)
FAULTS = (
    "silent",
    "silent",
    "dead",
    "dead",
    "checksum",
    "noise",
    "late",
    "short",
    "overload",
    "overheating",
    "low-voltage",
    "angle-limit",
    "mishears",
    "blocked",
)
BUTTONS = (1, 1, 2, 4, 8, 16, 16, 32, 64, 256, 512, 512)


def motions():
    """Returns the pages that all sessions begin with. They are the pages of Play's tests, random pages for the law, and pages that a
    code must not choose, placed below pages that it must choose. The pages for the law have both schedules, pauses, odd speeds, unused
    joints and joints that go through a step; no joint is faster than a servo. The softness of joints varies in many pages."""
    image, rng = bytearray(play_pages()), random.Random("pages of the law")
    for number in LAW_PAGES:
        page = image[512 * number : 512 * (number + 1)]
        steps = rng.randrange(2, 8)
        speed = rng.choice((32, 32, 27, 50, 80))
        time_base = rng.random() < 0.6
        links = [rng.choice((0, 0, *LAW_PAGES)) for _ in range(2)]
        page[:64] = bytes(64)
        page[:6] = f"law {number}".encode()
        page[15], page[16], page[20], page[22] = rng.choice((1, 1, 2, 3)), 10 if time_base else 0, steps, speed
        page[24], page[25], page[26] = rng.choice((0, 1, 8, 32, 32, 90)), *links
        for at in (27, 29):
            page[at : at + 2] = rng.choice(((0, 0), (rng.choice(LAW_PAGES), rng.choice((1, 2, 4, 8, 16)))))
        page[32:64] = b"\x55" * 32
        at = [rng.randrange(400, 624) for _ in range(31)]
        for step in range(steps):
            ticks = rng.randrange(12 if step else 50, 120)
            most = min(224, int(ticks * speed / 32 * 6)) if time_base else 224
            for joint in range(31):
                at[joint] = min(624, max(400, at[joint] + rng.choice((0, rng.randrange(-most, most + 1)))))
                word = at[joint] if rng.random() < 0.85 or not step else 0x4000
                page[64 + 64 * step + 2 * joint : 66 + 64 * step + 2 * joint] = word.to_bytes(2, "little")
            page[64 + 64 * step + 62] = rng.choice((0, 0, 0, rng.randrange(8, 60)))
            page[64 + 64 * step + 63] = ticks if time_base else rng.randrange(20, 40)
        image[512 * number : 512 * (number + 1)] = page
    page = bytearray(image[512 * LAW_PAGES[0] : 512 * LAW_PAGES[1]])
    page[:14], page[15], page[16], page[20], page[22], page[24:31] = b"fast".ljust(14, b"\0"), 200, 10, 2, 32, bytes((8, 0, 0, 0, 0, 0, 0))
    for step, (word, ticks) in enumerate(((712, 40), (512, 60))):
        page[64 + 64 * step : 128 + 64 * step] = word.to_bytes(2, "little") * 31 + bytes((0, ticks))
    image[512 * FAST_PAGE : 512 * (FAST_PAGE + 1)] = page
    for number, code, steps, count, _ in CODE_PAGES:
        page = bytearray(image[512 : 2 * 512])
        page[:14] = f"code {number}".encode().ljust(14, b"\0")
        page[15], page[20], page[21] = count, steps, code
        image[512 * number : 512 * (number + 1)] = page
    for number in (*SOFT_PAGES, FAST_PAGE, *(page[0] for page in CODE_PAGES)):
        at = 512 * number
        if number in SOFT_PAGES:
            image[at + 32 : at + 63] = rng.choices(SOFTNESS, k=31) if rng.random() < 0.7 else bytes([rng.choice(SOFTNESS)]) * 31
        image[at + 31] = 0
        image[at + 31] = 255 - sum(image[at : at + 512]) % 256
    for number, *_, is_whole in CODE_PAGES:
        image[512 * number + 100] ^= 0 if is_whole else 0xFF
    return bytes(image)


def typed(text):
    """Returns the action that types this."""
    data = text if isinstance(text, bytes) else text.encode("latin-1")
    return "type " + data.hex()


def in_capitals(rng, text):
    """Returns the line with another case. The argument of `name` keeps its case."""
    word, blank, rest = text.partition(" ")
    change = rng.choice((str.upper, str.capitalize, lambda words: "".join(rng.choice((c.upper(), c)) for c in words)))
    if word == "name":
        return change(word) + blank + rest
    return blank.join([change(word), " ".join(change(part) if part.isalpha() else part for part in rest.split(" "))])


class Person:
    """Adds actions to a list one after another. `at` is the tick of the next action."""

    def __init__(self, rng, servos, trims):
        self.rng, self.servos, self.trims, self.at, self.actions = rng, servos, trims, START, []

    def act(self, words, wait=0):
        self.actions.append((self.at, words))
        self.at += wait

    def line(self, text, wait=None):
        if self.rng.random() < CAPITALS:
            text = in_capitals(self.rng, text)
        self.act(typed(text + "\r"), self.rng.randrange(12, 3 * SECOND) if wait is None else wait)

    def servo(self):
        return self.rng.choice(self.servos) if self.servos else 1

    def joints(self, most=3):
        return " ".join(str(self.servo()) for _ in range(self.rng.randrange(1, most + 1)))

    # events around the program

    def servo_fails(self):
        rng, servo = self.rng, self.servo()
        if not self.servos:
            return
        self.act(f"fault {servo} {rng.choice(FAULTS)} {rng.choice((0, 0, 0, 1, 2, 5))}", rng.randrange(1, 8 * SECOND))
        if rng.random() < 0.8:
            self.act(f"clear {servo}", rng.randrange(0, 2 * SECOND))

    def two_servos_fail(self):
        """While one is silent, the other must be named."""
        rng = self.rng
        if len(self.servos) < 2:
            return
        first, second = rng.sample(self.servos, 2)
        self.act(f"fault {first} dead 0", rng.randrange(2, 5) * SECOND)
        self.act(f"fault {second} {rng.choice(('dead', 'silent'))} 0", rng.randrange(7, 9) * SECOND)
        self.act(f"clear {first}", rng.randrange(SECOND))
        self.act(f"clear {second}", rng.randrange(2 * SECOND))

    def line_fails(self):
        rng = self.rng
        kind = rng.random()
        if kind < 0.3:
            self.act(f"lose {rng.choice((1, 5, 30))}", rng.randrange(SECOND))
        elif kind < 0.6:
            self.act(f"damage {rng.choice((1, 1, 3, 20))}", rng.randrange(SECOND))
        elif kind < 0.8:
            self.act("plug 0", rng.randrange(2, 3 * SECOND))
            self.act("plug 1", rng.randrange(SECOND))
        else:
            latency = rng.choice((0, 2000, 8000, 32000))
            self.act(f"latency {latency} {rng.choice((250, 500, 2000))}", rng.randrange(SECOND))

    def computer_is_late(self):
        self.act(f"late {self.rng.choice((9, 30, 90, 110, 300))}", self.rng.randrange(SECOND))

    def power_fails(self):
        if self.rng.random() < 0.5:
            self.act("cut", 4 * SECOND)
        else:
            self.act(f"cutwrite {self.rng.randrange(1, 40)}", self.rng.randrange(2, SECOND))

    def hand_leaves_the_range(self):
        """Pushes a trimmed joint to an end of its servo, where no position of a page takes it, and then moves it."""
        rng = self.rng
        if not self.trims:
            return
        servo = rng.choice(list(self.trims))
        self.line("break" if isinstance(self, Player) else "re", 4 * SECOND)
        self.line(f"off {servo}", SECOND)
        self.act(f"push {servo} {rng.randrange(10, 40) if self.trims[servo] > 0 else rng.randrange(983, 1013)}", 3 * SECOND)
        if rng.random() < 0.7:
            self.line(f"on {servo}", SECOND)
        self.line(rng.choice(self.moves_of(servo)), rng.randrange(SECOND, 6 * SECOND))

    def hand_pushes(self):
        if self.servos:
            self.act(f"push {self.servo()} {self.rng.randrange(200, 824)}", self.rng.randrange(SECOND))

    def battery(self):
        self.act(f"supply {self.rng.choice((96, 96, 96, 85, 105, 112))}", self.rng.randrange(2 * SECOND))

    def panel(self):
        self.act(f"press {self.rng.choice((1, 2, 4, 8, 16, 16))}", self.rng.randrange(4, 40))
        self.act("press 0", self.rng.randrange(2 * SECOND))

    def remote(self):
        rng = self.rng
        buttons = rng.choice(BUTTONS)
        for _ in range(rng.choice((1, 1, 3, 10))):
            self.act(f"remote {buttons}", rng.choice((6, 7)))
        if rng.random() < 0.15:
            self.another_remote(buttons)
        if rng.random() < 0.85:
            self.act("remote 0", rng.randrange(2 * SECOND))

    def another_remote(self, buttons):
        """Its packets come between those of the first one, which goes on after its release."""
        rng = self.rng
        other = rng.choice((512, 512, *BUTTONS))
        for _ in range(rng.choice((1, 2, 6))):
            self.act(f"remote {other}", 3)
            self.act(f"remote {buttons}", rng.choice((3, 4)))
        self.act("remote 0", 3)
        for _ in range(rng.choice((1, 10, 60))):
            self.act(f"remote {buttons}", rng.choice((6, 7)))


class Player(Person):
    """A person at Play."""

    def moves_of(self, servo):
        rng = self.rng
        return f"play {rng.choice(PLAYED)}", f"@move {rng.choice((20, 60))} {servo} 200", f"aim {servo} 512", f"swing {servo} 512 40 2000"

    def plays(self):
        self.line(f"play {self.rng.choice(PLAYED)}" if self.rng.random() < 0.9 else "play walk start")

    def plays_by_the_law(self):
        """Plays by the law alone: only the pages decide where joints go."""
        for word in ("break", "free", "shape reset"):
            self.line(word, SECOND)
        self.line(f"play {self.rng.choice(LAW_PAGES)}", self.rng.randrange(4, 10) * SECOND)
        for word in self.rng.sample(("@where", "@crcs 1 9", "@pose", "aim 1 600", "swing 1 512 40 2000", "pause", "@watch 100", *"1248"), 2):
            if word in "1248":
                self.act(f"remote {word}", 8)
                self.act("remote 0", self.rng.randrange(1, 5) * SECOND)
            else:
                self.line(word, self.rng.randrange(1, 5) * SECOND)

    def ends(self):
        word = self.rng.choice(("stop", "stop", "stop", "break", "off", "@stop", "@break"))
        self.line(word)
        if word == "stop" and self.rng.random() < 0.3:
            self.line(word, self.rng.randrange(8, SECOND))

    def stops_twice(self):
        """Stops at rest, and then a play that begins at once: its pose is that of the play before."""
        rng = self.rng
        page = rng.choice((71, 73, 75, 75))
        self.line("break", 3 * SECOND)
        self.line(f"play {page}", 4 * SECOND)
        self.line("stop", rng.randrange(4, 60))
        self.line(f"play {page}", rng.randrange(8, 30))
        self.line("stop", 3 * SECOND)

    def pauses(self):
        self.line("pause")
        if self.rng.random() < 0.8:
            self.line(self.rng.choice(("resume", "resume", "resume", "stop", "break")))

    def shapes(self):
        rng = self.rng
        self.line(
            rng.choice(
                (
                    f"rate {rng.choice((50, 100, 150, 400))}",
                    f"amplitude {rng.choice((0, 50, 100, 150))}",
                    f"amplitude {rng.randrange(151)} {self.joints()}",
                    f"blend {rng.randrange(-100, 101)}",
                    "shape",
                    "shape reset",
                    "@shape",
                )
            )
        )

    def drives(self):
        for _ in range(self.rng.randrange(1, 30)):
            self.line(f"@drive {self.rng.randrange(-100, 101)} {self.rng.randrange(50, 200)} {self.rng.randrange(50, 150)}", 6)

    def layers(self):
        rng = self.rng
        self.line(f"layer {rng.choice(PLAYED)}" + (f" {self.joints()}" if rng.random() < 0.6 else ""))
        if rng.random() < 0.3:
            self.line("layer off")

    def layers_again(self):
        """Lays the same page over the same joint twice."""
        rng, servo = self.rng, self.servo()
        page = rng.choice((FAST_PAGE, FAST_PAGE, 13, 21, *LAW_PAGES))
        for word in ("break", "free", "shape reset"):
            self.line(word, 2 * SECOND)
        self.line(f"play {rng.choice((8, 9))}", 6 * SECOND)
        for _ in range(rng.randrange(2, 4)):
            self.line(f"layer {page} {servo}", rng.randrange(3, 7) * SECOND)
            self.line("layer off", 4 * SECOND)

    def stop_in_a_layer(self):
        """A fault of a servo must not disturb the stop."""
        rng, servo = self.rng, self.servo()
        self.line("play walk start", 4 * SECOND)
        self.line(f"layer 8 {servo}", rng.randrange(20, 2 * SECOND))
        if rng.random() < 0.7 and self.servos:
            self.act(f"fault {servo} {rng.choice(('silent', 'dead'))} 0", rng.randrange(SECOND))
        self.line("stop", rng.randrange(2 * SECOND))
        self.act(f"clear {servo}" if self.servos else "remote 0", SECOND)

    def aims(self):
        rng = self.rng
        lines = (
            f"aim {self.servo()} {rng.randrange(200, 824)}",
            f"aim {self.servo()} {rng.randrange(200, 824)} {rng.choice((30, 90, 200))}",
            f"swing {self.servo()} 512 {rng.randrange(1, 80)} {rng.choice((1000, 2000, 4000))}",
            f"free {self.servo()}",
            "free",
        )
        self.line(rng.choice(lines))

    def aims_at_many(self):
        for servo in self.servos[:6]:
            self.line(f"aim {servo} {self.rng.randrange(400, 624)}", 20)
        self.line("free", SECOND)

    def loses_the_adapter_in_a_layer(self):
        self.line("play walk start", 4 * SECOND)
        self.line(f"layer 8 {self.servo()}", SECOND)
        self.act("plug 0", self.rng.randrange(2, SECOND))
        self.act("plug 1", SECOND)

    def moves(self):
        rng = self.rng
        self.line(
            rng.choice(
                (
                    f"@move {rng.choice((20, 60, 120))} 1 200200",
                    f"@move 60 {self.servo()} {rng.randrange(256, 768):03x}",
                    "on",
                    f"on {self.joints()}",
                    "@torque on",
                    f"off {self.joints()}",
                    "off",
                )
            )
        )

    def fingers(self):
        """Presses several buttons, one after another or together, in a play, a stop, a pause or at rest."""
        rng, down = self.rng, 0
        if rng.random() < 0.25:
            self.fingers_at_the_panel()
            return
        if rng.random() < 0.6:
            self.line(f"play {rng.choice((1, 8, 9, 13, 21, 75))}", rng.randrange(5 * SECOND))
        for _ in range(rng.randrange(2, 7)):
            for button in rng.sample((1, 2, 4, 8, 16, 32, 256, 512, 512), rng.choice((1, 1, 2, 3))):
                down ^= button
            for _ in range(rng.choice((1, 1, 4, 12, 30))):
                self.act(f"remote {down}", rng.choice((6, 7)))
            if rng.random() < 0.1:
                self.at += rng.randrange(40, 2 * SECOND)
        if rng.random() < 0.8:
            self.act("remote 0", rng.randrange(3 * SECOND))

    def fingers_at_the_panel(self):
        rng, down = self.rng, 0
        self.line(rng.choice(("break", f"play {rng.choice((1, 8, 13))}")), rng.randrange(SECOND, 5 * SECOND))
        for _ in range(rng.randrange(2, 7)):
            for button in rng.sample((1, 2, 4, 8, 16, 16), rng.choice((1, 1, 2))):
                down ^= button
            self.act(f"press {down}", rng.randrange(8, 60))
        self.act("press 0", rng.randrange(8, 3 * SECOND))

    def calls(self):
        """Sends codes at rest, of pages that can be called and of others."""
        self.line("break", 6 * SECOND)
        for _ in range(self.rng.randrange(1, 4)):
            button = self.rng.choice((1, 2, 2, 8, 8, 16, 32, 64, 4))
            if self.rng.random() < 0.3:
                self.line(f"code {button}", 3 * SECOND)
            else:
                self.act(f"remote {button}", 8)
                self.act("remote 0", self.rng.randrange(SECOND, 4 * SECOND))

    def pauses_often(self):
        """Pauses in steps that joints run through, at any moment of them."""
        self.line("break", 3 * SECOND)
        self.line("shape reset", SECOND)
        self.line(f"play {self.rng.choice(LAW_PAGES)}", 4 * SECOND)
        for _ in range(self.rng.randrange(4, 10)):
            self.line("pause", 2 * SECOND)
            self.line("resume", self.rng.randrange(20, 150))

    def lets_go_of_a_stop(self):
        """Presses a stop together with buttons that call, and lets the stop go first."""
        rng = self.rng
        code = rng.choice((1, 2, 8, 16, 3))
        self.line("break" if rng.random() < 0.5 else f"play {rng.choice((1, 8, 13, 21))}", rng.randrange(2, 6) * SECOND)
        for buttons in (rng.choice((512 | code, 512 | code, 255)), code, rng.choice((0, code))):
            for _ in range(rng.randrange(1, 10)):
                self.act(f"remote {buttons}", rng.choice((6, 7)))
        self.act("remote 0", rng.randrange(2 * SECOND))

    def rests(self):
        """Sends many requests in a pause. Nothing may move."""
        rng = self.rng
        self.line(f"play {rng.choice((3, 4, 8, 9, 14, 21))}", rng.randrange(2, 5) * SECOND)
        self.shapes_rest(rng.randrange(3))
        self.line("pause", rng.randrange(8, 2 * SECOND))
        self.shapes_rest(rng.randrange(4))
        self.at += rng.randrange(2, 5) * SECOND
        self.line(rng.choice(("resume", "resume", "stop", "break")))

    def shapes_rest(self, count):
        rng = self.rng
        for _ in range(count):
            words = (
                f"aim {self.servo()} {rng.randrange(300, 724)}",
                f"swing {self.servo()} 512 {rng.randrange(20, 80)} {rng.choice((1000, 2000))}",
                f"layer {rng.choice((8, 9, 13, 14, 21, 22))} {self.joints()}",
                f"layer {rng.choice((8, 9, 13, 21, 22))}",
                f"free {self.servo()}",
                "layer off",
                "@drive 20 120 80",
                "rate 150",
                "play 1",
            )
            self.line(rng.choice(words), rng.randrange(20, 2 * SECOND))

    def loses_power(self):
        """Unplugs a servo and plugs it in again. It forgets what was written to it."""
        rng, servo = self.rng, self.servo()
        page = rng.choice((3, 8, 13, 14, 21))
        if not self.servos:
            return
        self.line(f"play {page}", rng.randrange(1, 5) * SECOND)
        self.act(f"fault {servo} dead 0", rng.choice((20, SECOND, 2 * SECOND, 3 * SECOND)))
        self.act(f"clear {servo}", rng.randrange(1, 3) * SECOND)
        for word in rng.choice((("break", "on"), ("break", "on"), ("break", "servos find", "on"), ())):
            self.line(word, 2 * SECOND)
        self.line(f"play {rng.choice((page, page, 9))}", rng.randrange(3, 6) * SECOND)

    def requests(self):
        """Sends right and wrong requests: words, number of words, ranges."""
        rng = self.rng
        first, last = sorted(rng.randrange(256) for _ in range(2))
        pages, rate = rng.choice((f"{first} {min(last, first + 20)}", f"{last} {first}", "5 300")), rng.choice((10, 50, 9, 400, 401))
        word = rng.choice("ver list page dense crcs pose where rate blend shape watch aim pag wher stop".split())
        wrong = f"@{word}" + "".join(rng.choice((" 1", " -1", " 256", " x", " 0x1F", " 99999")) for _ in range(rng.randrange(4)))
        lines = ("@where", "@pose", "@ver", f"@page {first}", f"@dense {first}", f"@crcs {pages}", wrong, wrong)
        if isinstance(self, Player):
            lines += ("@shape", f"@rate {rate}", f"@blend {rng.randrange(-102, 103)}", f"@amplitude {rng.randrange(153)}")
        for _ in range(rng.randrange(1, 4)):
            self.line(rng.choice(lines))

    def asks(self):
        lines = "@where @pose settings @list list servos status servos faults list settings version help law remote @ver @crcs @list @watch,50 @watch,0 servos,find nonsense".split()
        self.line(self.rng.choice(lines).replace(",", " "))

    def sets(self):
        for _ in range(self.rng.choice((1, 1, 2, 3))):
            name, values = self.rng.choice(SETTINGS)
            self.line(f"settings {name} {self.rng.choice(values)}", self.rng.choice((1, 8, 40, 200)))

    def halts_in_a_line(self):
        """Types text that stays unfinished while status lines come."""
        rng = self.rng
        text = "".join(rng.choice("abcdefg hij 0123") for _ in range(rng.randrange(1, 30)))
        self.act(typed(text), rng.randrange(6 * SECOND))
        self.act(typed("\b" * rng.randrange(3) + rng.choice(("\r", "\x15", "\x15"))), rng.randrange(SECOND))

    def types_noise(self):
        noise = PlayConsole(self.rng.randrange(1 << 30)).noise(self.rng.randrange(1, 300))
        self.act(typed(noise), len(noise) // 40 + SECOND)
        self.act(typed("\r"), SECOND)

    def types_too_much(self):
        self.act(typed("x" * self.rng.randrange(100, 300) + "\r"), SECOND)

    WEIGHTS = (
        ("plays", 16),
        ("plays_by_the_law", 6),
        ("ends", 8),
        ("pauses", 3),
        ("shapes", 4),
        ("drives", 2),
        ("layers", 5),
        ("layers_again", 2),
        ("stop_in_a_layer", 2),
        ("aims", 5),
        ("aims_at_many", 0.3),
        ("loses_the_adapter_in_a_layer", 0.5),
        ("moves", 4),
        ("asks", 3),
        ("requests", 3),
        ("sets", 3),
        ("halts_in_a_line", 3),
        ("types_noise", 0.3),
        ("types_too_much", 0.3),
        ("remote", 8),
        ("fingers", 4),
        ("calls", 2),
        ("lets_go_of_a_stop", 1),
        ("rests", 4),
        ("pauses_often", 1),
        ("loses_power", 2),
        ("panel", 2),
        ("stops_twice", 1),
        ("servo_fails", 5),
        ("two_servos_fail", 0.5),
        ("line_fails", 1.5),
        ("computer_is_late", 0.7),
        ("power_fails", 1.5),
        ("hand_pushes", 1),
        ("hand_leaves_the_range", 2),
        ("battery", 0.7),
    )


class Editor(Person):
    """A person at Edit."""

    def line(self, text, wait=None):
        super().line(text, self.rng.randrange(30, 2 * SECOND) if wait is None else wait)

    def moves_of(self, servo):
        return f"play {self.rng.choice(PLAYED)}", f"@move 60 {servo} 200"

    def opens(self):
        self.line(f"page {self.rng.choice((1, 2, 3, 5, 13, 30, 31, 100, 200))}", SECOND)

    def edits(self):
        rng = self.rng
        for _ in range(rng.randrange(1, 8)):
            self.line(
                rng.choice(
                    (
                        f"step {rng.randrange(1, 8)}",
                        f"goto {rng.randrange(10)} {rng.randrange(33)}",
                        f"set {rng.randrange(1024)}",
                        f"set {rng.randrange(256)}",
                        f"name n{rng.randrange(1000)}",
                        "write",
                        f"insert {rng.randrange(7)}",
                        f"delete {rng.randrange(7)}",
                        f"move {rng.randrange(7)} {rng.randrange(8)}",
                        f"swap {rng.randrange(7)} {rng.randrange(7)}",
                        "undo",
                        "redo",
                        "new",
                        f"copy {rng.randrange(30)}",
                    )
                ),
                rng.randrange(10, 60),
            )

    def tries(self):
        """Tries commands one at a time, with time to check each effect on the table and each answer."""
        rng = self.rng
        arrows = [b"\x1b[" + end for end in (b"A", b"B", b"C", b"D", b"H", b"F", b"5~", b"6~")]
        for _ in range(rng.randrange(1, 8)):
            step, other = rng.randrange(7), rng.randrange(8)
            kind = rng.random()
            if kind < 0.2:
                x = rng.choice((0, 1, 2, 3, 8, 9, 9))
                self.line(f"goto {x} {rng.randrange(3, 20) if x == 9 else rng.choice((1, 2, 3, 12, 31, 32)) if x < 8 else rng.randrange(31)}", 20)
                change = rng.choice((b"]", b"[", b"}", b"{", b"  ", f"set {rng.choice((0, 1, 7, 100, 255, 600, 1023, 1024))}\r"))
                self.act(typed(change), LOOKED_AT)
                if rng.random() < 0.5:
                    self.line("undo", LOOKED_AT)
            elif kind < 0.35:
                for _ in range(rng.randrange(1, 12)):
                    self.act(typed(rng.choice(arrows)), 4)
                self.act(typed(rng.choice(arrows)), LOOKED_AT)
            elif kind < 0.6:
                words = (
                    f"step {other}", f"go {step}", "write", f"write {step}", f"insert {step}", "delete", f"delete {step}", f"move {step} {other}",
                    f"swap {step} {rng.randrange(7)}", f"take 0 {step % 3}", "paste", f"paste {step}", f"mirror {step}", "time", "speed",
                    f"name t{step}", "on", "off", f"on {self.servo()}", f"off {self.servo()}", "re", f"copy {rng.choice((1, 3, 13, 20, 21))}",
                )  # fmt: skip
                self.line(rng.choice(words), LOOKED_AT)
                for word in rng.choice(((), (), ("undo",), ("undo", "redo"), ("undo", "redo", "undo"), ("re",))):
                    self.line(word, LOOKED_AT)
            elif kind < 0.7:
                words = ("next", "before", f"page {rng.choice((1, 13, 20, 21, 22, 31, 200))}", "new", f"copy {rng.randrange(20, 30)}", "go 6")
                self.line(rng.choice(words), LOOKED_AT)
                self.act(typed(rng.choice("yyn")), LOOKED_AT)
                self.act(typed("\x15\r"), SECOND // 2)  # if there was no question
            elif kind < 0.8:
                words = (
                    "page",
                    "page 300",
                    "page x",
                    "step 8",
                    "go 9",
                    "set",
                    "set 5 6",
                    "insert",
                    "delete 7",
                    "goto 1",
                    "nonsense",
                    "write 9",
                    "undo 1",
                )
                self.line(rng.choice(words), LOOKED_AT)
            elif kind < 0.87:
                self.line(rng.choice(("save", f"save {rng.randrange(40, 60)}")), LOOKED_AT)
                self.act(typed("\x15\r"), SECOND // 2)
            elif kind < 0.93:
                word = rng.choice(("list", "help", "list 3", "list 1 9", "@where", "@pose", "help go", "hex", "dec"))
                self.line(word, LOOKED_AT)
                self.act(typed("\r" if word[0] == "@" else " "), 2 * SECOND)
                self.act(typed("\r"), SECOND)
                self.line("re", LOOKED_AT)
            else:
                self.line("on", 2 * SECOND)
                self.line(f"play {rng.choice((1, 13, 20, 21, 22, 23))}", 12 * SECOND)

    def goes_back(self):
        """Fills the history of UNDO with large and small edits, and undoes them in a row."""
        rng = self.rng
        for _ in range(rng.randrange(2, 12)):
            step = rng.randrange(7)
            words = (f"write {step}", f"insert {step}", f"delete {step}", f"copy {rng.choice((1, 3, 13, 20, 21, 22))}", f"mirror {step}",
                     f"name u{step}", f"swap {step} {rng.randrange(7)}", f"move {step} {rng.randrange(8)}")  # fmt: skip
            self.line(rng.choice(words), LOOKED_AT)
        for _ in range(rng.randrange(2, 8)):
            self.line("undo", LOOKED_AT)

    def keys(self):
        for _ in range(self.rng.randrange(1, 20)):
            self.act(typed(self.rng.choice(KEYS + (b"[", b"]", b"{", b"}"))), self.rng.randrange(1, 20))
        self.act(typed("\r"), SECOND)

    def saves(self):
        rng = self.rng
        self.line(rng.choice(("save", "save", f"save {rng.randrange(40, 60)}")), rng.randrange(2, 60))
        self.act(typed(rng.choice("yyyn")), SECOND)
        self.act(typed(rng.choice("yyyn")), SECOND)

    def poses(self):
        rng = self.rng
        self.line(
            rng.choice(("on", "off", f"on {self.joints()}", f"off {self.joints()}", f"go {rng.randrange(7)}", f"mirror {rng.randrange(7)}")),
            2 * SECOND,
        )

    def plays(self):
        rng = self.rng
        self.line(rng.choice(("play", f"play {rng.choice(PLAYED)}", f"play 13 {rng.choice((50, 100, 200))}")), rng.randrange(5 * SECOND))
        key = rng.choice((" ", "\r", "\r", "\x1b", "\x03", "\x1b[A", "\x1b[B", "\x1b[C", "\x1b[D"))
        self.act(typed(key), rng.choice((SECOND, 3 * SECOND)))
        if len(key) == 3 and rng.random() < 0.5:
            self.act(typed(" "), SECOND)  # with a long page the play would not end by itself

    def exits_a_play(self):
        """Exits a play of many repetitions, and waits for its end."""
        self.line("on", 2 * SECOND)
        self.line(f"play {FAST_PAGE}", self.rng.randrange(3, 6) * SECOND)
        self.act(typed(self.rng.choice(("\x1b", "\x1b[A", "\x1b[D"))), 42 * SECOND)
        self.act(typed(" "), SECOND)

    def views(self):
        self.line(self.rng.choice(("list", "list 3", "list 1 9", "re", "hex", "dec", "help", "mon", "rows 40", "rows 24", "pairs")), SECOND)
        self.act(typed("\r"), SECOND)

    def asks(self):
        too_much = (f"@data 0 {'5a' * self.rng.randrange(33, 36)}", f"@data {self.rng.randrange(481, 600)} {'5a' * 32}")
        self.line(self.rng.choice(("@where", "@pose", "@crc", "@ver", "@list 1 9", "@page 1", "@watch 50", "@watch 0", *too_much)))

    def uploads(self):
        """A program saves a page, sometimes one that cannot be played. A cut must leave the old or the complete new one."""
        rng = self.rng
        data = bytearray(play_pages()[13 * 512 : 14 * 512])
        for _ in range(rng.randrange(1, 9)):
            data[64 + 64 * rng.randrange(2) + 62 + rng.randrange(2)] = rng.randrange(1, 200)
        if rng.random() < SPOILT:
            at, value = rng.choice(((16, 5), (20, 9), (22, 0)))  # schedule, steps, speed
            data[at] = value
        data[31] = 0
        data[31] = 255 - sum(data) % 256
        number = rng.choice((*PLAYED, *range(40, 60)))
        self.act(typed(b"\0@"), SECOND // 2)
        self.act(typed(b"\x15\r"), SECOND // 4)
        self.line(f"@open {number}", 20)
        for offset in range(0, 512, 32):
            self.line(f"@data {offset} {data[offset : offset + 32].hex()}", 4)
        self.line("@crc", 20)
        if rng.random() < 0.5:
            self.act(f"cutwrite {rng.randrange(1, 9)}")
        self.line(f"@save {number} 0x{crc16(data):04x}", SECOND)
        self.line(f"@list {number} {number}", SECOND // 2)

    WEIGHTS = (
        ("opens", 4),
        ("edits", 8),
        ("tries", 12),
        ("goes_back", 3),
        ("keys", 3),
        ("saves", 5),
        ("poses", 4),
        ("plays", 5),
        ("exits_a_play", 0.7),
        ("views", 3),
        ("asks", 2),
        ("uploads", 2),
        ("servo_fails", 3),
        ("line_fails", 1),
        ("computer_is_late", 0.5),
        ("power_fails", 2),
        ("hand_pushes", 3),
        ("hand_leaves_the_range", 2),
    )


def made(seed, motions):
    """Returns the actions of a session."""
    rng = random.Random(f"session {seed}")
    servos = list(range(1, 1 + rng.choice((0, 1, 4, 6, 6, 12, 18, 18))))
    actions = [(0, f"seed {seed}"), (0, f"motions {motions}")] + [(0, f"servo {servo}") for servo in servos]
    if servos and rng.random() < DEAF:
        actions += [(0, f"deaf {servo}") for servo in rng.sample(servos, min(len(servos), rng.choice((1, 2, 6))))]
    trims = {}
    if rng.random() < TRIMMED:
        trims = {servo: rng.choice((-1, 1)) * rng.randrange(40, TRIM_MOST + 1) for servo in servos if rng.random() < 0.4}
        actions += [(0, f"trim {servo} {offset}") for servo, offset in trims.items()]
    kinds = rng.choice(((Player,), (Player,), (Player,), (Editor,), (Editor, Player), (Player, Editor)))
    at = START
    for kind in kinds:
        person = kind(rng, servos, trims)
        actions.append((0 if at == START else at, "image " + ("edit" if kind is Editor else "play")))
        person.at = at + (START if at > START else 0)
        ends = person.at + rng.choice((20, 60, 120)) * SECOND
        names, weights = zip(*kind.WEIGHTS)
        while person.at < ends:
            getattr(person, rng.choices(names, weights)[0])()
        actions += person.actions
        at = person.at
    actions.append((at + SECOND, "end"))
    return actions


def text(actions):
    """Returns the list in the form that simtime_session reads."""
    return "".join(f"{tick} {words}\n" for tick, words in actions)
