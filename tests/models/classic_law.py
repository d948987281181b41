# SPDX-License-Identifier: MIT
"""A model of the classic law of motion, to compare motion/ with. Written from the description of the law alone, without reading motion/.

    for tick in ClassicPlay(image, page, joints, positions).ticks(1000): ...

Numbers are Python integers of unlimited width; they wrap only where the page says int16(). The order of the code and the names are the
page's: w, v, g, A, N, P, M, K, acc, main, nx. Page of the law: "The law of motion", section 1. Page bytes: "Motion512". Links: "Calling
pages". Two intended differences from the original are included: a flagged joint is not driven, and an invalid page is refused.

READING and a number mark a choice where the page can be read in two ways; tests/models/README.md lists them.
"""

from dataclasses import dataclass

PAGE_BYTES, STEP_BYTES, JOINTS, LAST_PAGE = 512, 64, 31, 127
FLAGGED = 0x4000 | 0x2000
TIME_BASE, SPEED_BASE = 0x0A, 0
STOP = 255  # the code that means stop
RISE, CRUISE, FALL, HOLD = "RISE", "CRUISE", "FALL", "HOLD"

# The end of a play.
DONE, REFUSED, PASSED_TWICE, EXIT_CIRCLE = "link 0", "page refused", "pages with PLAY_COUNT 0 in a circle", "exit pages in a circle"


def int16(value):
    """Wraps to 16 bits, signed."""
    return (value + 0x8000) % 0x10000 - 0x8000


def uint16(value):
    return value % 0x10000


def div(a, b):
    """Returns a / b, truncated toward zero."""
    return abs(a) // abs(b) * (1 if (a < 0) == (b < 0) else -1)


def limited(value, lowest, highest):
    return max(lowest, min(highest, value))


class Page:
    """One motion page of an image, read only. Steps count from 1, as in the specification."""

    def __init__(self, image, number):
        self.raw = image[PAGE_BYTES * number : PAGE_BYTES * (number + 1)]
        self.number = number
        self.play_count, self.schedule, self.steps = self.raw[15], self.raw[16], self.raw[20]
        self.speed, self.accel_time = self.raw[22], self.raw[24]
        self.next_page, self.exit_page = self.raw[25], self.raw[26]
        self.linked = ((self.raw[28], self.raw[27]), (self.raw[30], self.raw[29]))  # (code, page)

    def word(self, step, joint):
        """Returns the stored position word of a joint, including flags. READING 1: unsigned."""
        at = STEP_BYTES * step + 2 * joint
        return self.raw[at] | self.raw[at + 1] << 8

    def pause(self, step):
        return self.raw[STEP_BYTES * step + 62]

    def time(self, step):
        return self.raw[STEP_BYTES * step + 63]

    def refused(self):
        """Returns whether the page is refused. READING 2: positions are checked in the used steps, for all 31 joints."""
        return (
            sum(self.raw) % 256 != 0xFF
            or self.speed == 0
            or self.schedule not in (SPEED_BASE, TIME_BASE)
            or not 1 <= self.steps <= 7
            or any(
                1023 < self.word(step, joint) and not self.word(step, joint) & FLAGGED for step in range(1, self.steps + 1) for joint in range(JOINTS)
            )
        )


@dataclass
class Joint:
    """A joint that is present. start: output at the last section change. w: speed carried into the section, v: the step's speed, g: the
    speed reached. M: displacement of the step, acc: of RISE, main: of CRUISE, then of FALL."""

    id: int
    start: int
    target: int
    output: int
    w: int = 0
    v: int = 0
    g: int = 0
    M: int = 0
    acc: int = 0
    main: int = 0
    through: bool = False

    def rise(self, c, num):
        d = int16(div((self.v - self.w) * c, num))
        self.g = self.w + d
        self.acc = int16(div((self.w + (d >> 1)) * c * 144, 15) >> 9)
        self.output = limited(self.start + self.acc, 0, 1023)

    def cruise(self, c, num):
        self.output = limited(self.start + int16(div(self.main * c, num)), 0, 1023)
        self.g = self.v

    def fall(self, c, num):
        if self.through:
            self.cruise(c, num)
            return
        d = int16(div(-self.w * c, num))
        self.g = self.w + d
        self.output = limited(self.start + int16(div((self.w + (d >> 1)) * c * 144, 15) >> 9), 0, 1023)


class ClassicPlay:
    """One play. image: 65,536 bytes. page: the start page. joints: bit mask of the present IDs. positions: {id: 0..1023} at the start.
    schedule: {tick: code}, codes that arrive before that tick (0 = the first call); STOP requests a stop. call: the code that called the
    page, None if called by number."""

    def __init__(self, image, page, joints, positions, schedule=None, call=None):
        self.image, self.schedule = image, schedule or {}
        self.code = call
        self.joints = [Joint(i, positions[i], positions[i], positions[i]) for i in range(JOINTS) if joints >> i & 1]
        self.section, self.num, self.c = "", 0, 0  # no section is running
        self.A = self.N = self.P = 0
        self.page: Page = None  # type: ignore[assignment]  # until the first step begins
        self.step, self.repetitions, self.repeat = 0, 0, False
        self.next, self.exit_pages = page, set()
        self.decided_by = None  # the code in force when the last link was decided
        self.ended = None  # DONE, REFUSED, PASSED_TWICE or EXIT_CIRCLE; None if the limit of ticks came first
        self.reason = DONE  # why there is no next page

    def ticks(self, limit):
        """Yields for each call the sent goals in the order of the IDs, or None. The last call is the one that finds the end."""
        for number in range(limit):
            code = self.schedule.get(number, 0)
            if code:
                self.code = code  # the last non-zero code stays in force (latch). READING 3: even over a stop
            yield self.tick()
            if self.ended:
                return

    def tick(self):
        if self.c >= self.num:  # used up: the next section is set up, and its first tick is made in the same call
            self.section_change()
            if self.ended:
                return self.end_sample()
        if self.num == 0:  # an empty section uses up a call without output
            return None
        self.c += 1
        if self.section == HOLD:
            return None
        return self.output_of({RISE: Joint.rise, CRUISE: Joint.cruise, FALL: Joint.fall}[self.section], self.c, self.num)

    def output_of(self, formula, c, num):
        for joint in self.joints:
            formula(joint, c, num)
        return tuple(joint.output for joint in self.joints)

    def section_change(self):
        for joint in self.joints:
            joint.start, joint.w = joint.output, joint.g
        if self.section == RISE:
            self.begin_section(CRUISE, self.N - 2 * self.A)
        elif self.section == CRUISE:
            self.begin_section(FALL, self.A)
        elif self.section == FALL and self.P > 0:
            self.begin_section(HOLD, self.P)
        else:
            self.begin_step()

    def begin_section(self, section, num):
        self.section, self.num, self.c = section, num, 0
        N, A = self.N, self.A
        for joint in self.joints:
            if section == CRUISE and joint.through:
                joint.main = 0 if N == A else int16(div((joint.M - joint.acc) * (N - 2 * A), N - A))
            elif section == CRUISE:
                joint.main = int16(joint.M - joint.acc - int16(div(joint.v * A * 12, 5) >> 8))
            elif section == FALL:
                joint.main = int16(joint.M - joint.main - joint.acc)

    def begin_step(self):
        if self.section == HOLD:
            for joint in self.joints:
                joint.w = joint.g = 0
        self.step += 1  # rule 1
        if self.page is None or self.step > self.page.steps:
            if not self.repeat and not self.enter(self.next):
                self.ended = self.reason
                return
            self.step = 1
        if self.section == FALL:  # the rounding remainder is dropped
            for joint in self.joints:
                joint.start = joint.output = joint.target
        if self.step == self.page.steps:
            self.decide_link()
        self.prepare_step()
        self.begin_section(RISE, self.A)  # rule 8

    def end_sample(self):
        """Makes the call that finds the end: RISE with c = 1 and the num of the last section, from the last value sent."""
        if self.num == 0:
            return None
        return self.output_of(Joint.rise, 1, self.num)

    # Rule 2: pages

    def decide_link(self):
        """Decides the link at the beginning of the last step of a page."""
        self.repetitions = (self.repetitions - 1) % 256
        if self.code == STOP:
            self.repetitions = 0
        self.repeat = self.repetitions > 0
        self.decided_by = self.code
        self.next = self.page.number if self.repeat else self.follow(self.page, self.code)

    def follow(self, page, code):
        """Returns the link of a page by a code; 0 if nothing follows, with the cause in self.reason. READING 4: an exit link back to a
        page that was left by its exit link, or that one has led to, counts as link 0. READING 5: a linked page of the call's own code
        has priority over NEXT_PAGE."""
        link = page.next_page
        if code == STOP:
            link = page.exit_page
            self.exit_pages.add(page.number)
            if link in self.exit_pages:
                self.reason = EXIT_CIRCLE
                return 0
            self.exit_pages.add(link)
        elif code:
            link = next((linked for its_code, linked in page.linked if its_code == code), link)
        return 0 if link > LAST_PAGE else link

    def enter(self, number):
        """Makes the page of this number, or the one it passes over to, the current page. Returns false if the play ends; self.reason is
        the cause. READING 6: pages are passed over along the link of the code that decided the link."""
        passed_over, code = set(), self.code if self.page is None else self.decided_by
        while number != 0:
            if number > LAST_PAGE:
                return False
            page = Page(self.image, number)
            if page.refused():
                self.reason = REFUSED
                return False
            if page.play_count != 0:
                self.page, self.repetitions = page, page.play_count
                return True
            if number in passed_over:
                self.reason = PASSED_TWICE
                return False
            passed_over.add(number)
            number = self.follow(page, code)
        return False

    def is_final(self):
        return self.step == self.page.steps and self.next == 0

    def following_word(self, joint):
        """Returns the stored word of the following step; after the last step, of the first step of the next page."""
        if self.step < self.page.steps:
            return self.page.word(self.step + 1, joint.id)
        return Page(self.image, self.next).word(1, joint.id)

    # Rules 3 to 7

    def prepare_step(self):
        page, step = self.page, self.step
        self.P = div(page.pause(step) << 5, page.speed)
        u = max(1, uint16(page.time(step) * page.speed) >> 5)
        for joint in self.joints:
            self.prepare_way(joint)
        longest = max((abs(joint.M) for joint in self.joints), default=0)
        self.N = u if page.schedule == TIME_BASE else div(uint16(40 * longest), 3 * u)
        self.A = page.accel_time
        if self.N <= 2 * self.A:
            self.A = 0 if self.N == 0 else (self.N - 1) >> 1
            if self.A == 0:
                self.N = 0  # the step is skipped: a fault of the original, kept
        for joint in self.joints:
            self.prepare_speed(joint)

    def prepare_way(self, joint):
        word = self.page.word(self.step, joint.id)
        joint.acc = 0
        if word & FLAGGED:  # not driven: the target stays, the output repeats. READING 7: even a remainder after a pause
            joint.M = joint.w = joint.g = 0
            joint.through = False
            return
        prev, cur = joint.start, word
        nx = cur if self.is_final() else self.following_word(joint)
        if nx & FLAGGED:
            nx = cur
        joint.M, joint.target = cur - prev, cur
        joint.through = (prev < cur < nx or prev > cur > nx) and self.P == 0 and not self.is_final()

    def prepare_speed(self, joint):
        if self.page.word(self.step, joint.id) & FLAGGED:
            joint.v = 0
            return
        K = div(joint.M * 2560, 12)
        N, A = self.N, self.A
        divisor = 4 * N - 2 * A if joint.through else 4 * (N - A)
        joint.v = limited(int16(div(K - joint.w * 2 * A, divisor or 1)), -1023, 1023)
