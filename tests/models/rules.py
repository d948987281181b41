# SPDX-License-Identifier: MIT
"""What each sentence of the page decides: the model with one sentence broken, against the whole model.

A broken model is classic_law.py with one piece of text replaced. A set of cases exercises a sentence if at least one case comes out
different with the sentence broken; the number of such cases is the measure. READINGS are the other readings of sentences that the page leaves open:
a case that one of them decides does not convict a player.
"""

import pathlib
import sys
import types

from tests.models import random_pages

# (sentence of the page, text of the model, text in its place)
RULES = (
    (
        "the next section's first tick is made in the call that sets it up",
        "if self.ended:\n                return self.end_sample()",
        "return self.end_sample() if self.ended else None",
    ),
    (
        "an empty section uses up a call",
        "        if self.num == 0:  #",
        "        for _ in range(3):\n"
        "            if self.num == 0 and not self.ended:\n                self.section_change()\n        if self.ended:\n            return None\n        if self.num == 0:  #",
    ),
    ("section change: start = last output", "joint.start, joint.w = joint.output, joint.g", "joint.w = joint.g"),
    ("section change: w = speed reached", "joint.start, joint.w = joint.output, joint.g", "joint.start = joint.output"),
    ("CRUISE of a through joint", "int16(div((joint.M - joint.acc) * (N - 2 * A), N - A))", "int16(joint.M - 2 * joint.acc)"),
    ("CRUISE of a stop joint", "joint.v * A * 12, 5", "joint.v * A * 12, 6"),
    ("CRUISE of a stop joint: >> floors", "div(joint.v * A * 12, 5) >> 8", "div(div(joint.v * A * 12, 5), 256)"),
    ("CRUISE -> FALL: main", "int16(joint.M - joint.main - joint.acc)", "int16(joint.M - joint.main)"),
    ("a pause is a section of its own", "self.section == FALL and self.P > 0", "False"),
    ("HOLD -> next step with w = g = 0", "joint.w = joint.g = 0\n        self.step", "pass\n        self.step"),
    ("behind FALL output = target", "joint.start = joint.output = joint.target", "pass"),
    ("behind HOLD a joint goes on from its output", "if self.section == FALL:  # the", "if self.section in (FALL, HOLD):  # the"),
    ("repetitions are counted down", "(self.repetitions - 1) % 256", "0"),
    ("a stop request ends the repetitions", "            self.repetitions = 0", "            pass"),
    (
        "link 0: the step is final, all joints stop",
        "return self.step == self.page.steps and self.next == 0",
        "return self.step == self.page.steps and self.next == 0 and False",
    ),
    ("PLAY_COUNT 0 is passed over", "if page.play_count != 0:", "if True:"),
    (
        "look-ahead takes the page that the link names",
        "return Page(self.image, self.next).word(1, joint.id)",
        "return Page(self.image, self.next).word(1, joint.id) if Page(self.image, self.next).play_count else 0x4000",
    ),
    (
        "look-ahead takes the first step of a refused page as stored",
        "return Page(self.image, self.next).word(1, joint.id)",
        "return 0x4000 if Page(self.image, self.next).refused() else Page(self.image, self.next).word(1, joint.id)",
    ),
    ("P = (pause << 5) / PAGE_SPEED", "div(page.pause(step) << 5, page.speed)", "page.pause(step)"),
    ("u = (time * PAGE_SPEED) >> 5", "uint16(page.time(step) * page.speed) >> 5", "page.time(step)"),
    ("u is at least 1", "max(1, uint16(page.time(step) * page.speed) >> 5)", "(page.time(step) * page.speed >> 5) or 2"),
    ("prev = start, not the last target", "prev, cur = joint.start, word", "prev, cur = joint.target, word"),
    ("through: on the way in one direction", "prev < cur < nx or prev > cur > nx", "prev < cur <= nx or prev > cur >= nx"),
    ("through needs P = 0", " and self.P == 0", ""),
    ("P, not the pause byte, decides", " and self.P == 0", " and self.page.pause(self.step) == 0"),
    ("flagged: not driven", "if word & FLAGGED:  #", "if False:  #"),
    ("flagged: 0x2000 as well", "FLAGGED = 0x4000 | 0x2000", "FLAGGED = 0x4000"),
    ("flagged: v = w = g = 0", "joint.M = joint.w = joint.g = 0\n            joint.through", "joint.M = 0\n            joint.through"),
    ("flagged: the end's sample has v = 0", "            joint.v = 0\n            return\n", "            return\n"),
    ("flagged in the following step: nx = cur", "        if nx & FLAGGED:\n            nx = cur\n", ""),
    ("time base: N = u", "u if page.schedule == TIME_BASE else", "u + 1 if page.schedule == TIME_BASE else"),
    ("speed base: N = 40 max|M| / (3 u)", "uint16(40 * longest), 3 * u", "uint16(40 * longest) + 3 * u - 1, 3 * u"),
    ("max|M| of the joints that are there", "for joint in self.joints), default=0)", "for joint in self.joints[:1]), default=0)"),
    ("N <= 2A, not <", "if self.N <= 2 * self.A:", "if self.N < 2 * self.A:"),
    ("A = (N - 1) >> 1", "(self.N - 1) >> 1", "self.N >> 1"),
    ("no ramp left: the step is skipped", "self.N = 0  # the", "pass  # the"),
    ("K = M * 2560 / 12", "div(joint.M * 2560, 12)", "joint.M * 213"),
    ("v: divisor of a through joint", "4 * N - 2 * A if", "4 * N - 4 * A if"),
    ("v: divisor of a stop joint", "else 4 * (N - A)", "else 4 * N"),
    ("v: divisor 0 counts as 1", "divisor or 1", "divisor or 10 ** 9"),
    ("v: the carried speed", "K - joint.w * 2 * A", "K"),
    ("v is truncated", "int16(div(K - joint.w * 2 * A, divisor or 1))", "int16((K - joint.w * 2 * A) // (divisor or 1))"),
    (
        "v wraps before it is limited",
        "limited(int16(div(K - joint.w * 2 * A, divisor or 1)), -1023, 1023)",
        "limited(div(K - joint.w * 2 * A, divisor or 1), -1023, 1023)",
    ),
    ("v is limited to +-1023", "divisor or 1)), -1023, 1023)", "divisor or 1)), -32768, 32767)"),
    ("the play's end makes one sample", "return self.output_of(Joint.rise, 1, self.num)", "return None"),
    (
        "the end's sample: num of the section used up",
        "return self.output_of(Joint.rise, 1, self.num)",
        "return self.output_of(Joint.rise, 1, max(1, self.A))",
    ),
    (
        "the end's sample: no sample if num is 0",
        "if self.num == 0:\n            return None\n        return",
        "self.num = self.num or 1\n        return",
    ),
    ("RISE is truncated", "d = int16(div((self.v - self.w) * c, num))", "d = int16((self.v - self.w) * c // num)"),
    (
        "RISE: d >> 1 floors",
        "int16(div((self.w + (d >> 1)) * c * 144, 15) >> 9)\n        self.output = limited(self.start + self.acc",
        "int16(div((self.w + div(d, 2)) * c * 144, 15) >> 9)\n        self.output = limited(self.start + self.acc",
    ),
    (
        "RISE: * 144 / 15 >> 9, from left to right",
        "self.acc = int16(div((self.w + (d >> 1)) * c * 144, 15) >> 9)",
        "self.acc = int16(div((self.w + (d >> 1)) * c * 144 >> 9, 15))",
    ),
    ("the output is limited to 0..1023", "return max(lowest, min(highest, value))", "return max(lowest, min(highest, value)) if lowest else value"),
    (
        "acc is not limited",
        "self.output = limited(self.start + self.acc, 0, 1023)",
        "self.output = limited(self.start + self.acc, 0, 1023); self.acc = self.output - self.start",
    ),
    ("CRUISE: main * c / num is truncated", "div(self.main * c, num)), 0, 1023)", "self.main * c // num), 0, 1023)"),
    ("a CRUISE that is not empty sets g = v", "        self.g = self.v\n", ""),
    ("FALL of a stop joint", "d = int16(div(-self.w * c, num))", "d = int16(-(self.w * c // num))"),
    ("FALL of a through joint goes on at v", "if self.through:", "if False:"),
    ("a link above 127 counts as 0", "return 0 if link > LAST_PAGE else link", "return link % 128"),
    ("a page already passed over ends the play", "if number in passed_over:", "if passed_over:"),
    ("a page without steps is found before PLAY_COUNT", "or not 1 <= self.steps <= 7", "or self.play_count and not 1 <= self.steps <= 7"),
    ("ours refuses a bad checksum", "sum(self.raw) % 256 != 0xFF\n            or", ""),
    ("ours refuses PAGE_SPEED 0", "or self.speed == 0", "or (self.speed == 0 and setattr(self, 'speed', 32))"),
    ("ours refuses another SCHEDULE", "self.schedule not in (SPEED_BASE, TIME_BASE)", "False"),
    ("ours refuses positions above 1023", "1023 < self.word(step, joint) and", "5000 < self.word(step, joint) < 5001 and"),
    ("a refused page ends the play at the join", "if page.refused():", "if page.refused() and self.page is None:"),
    ("repetitions are PLAY_COUNT when a page is entered", "self.repetitions = page, page.play_count", "self.repetitions = page, 1"),
    ("stop follows EXIT_PAGE", "link = page.exit_page", "link = page.next_page"),
    ("exit pages in a circle end", "if link in self.exit_pages:", "if False:"),
    ("a linked page by its code", "            for code, linked in page.linked:", "            for code, linked in ():"),
    ("the followed code is the new call", "link, self.call = linked, code", "link = linked"),
    (
        "the last non-zero code stays in force",
        "            if code:\n                self.code = code",
        "            if True:\n                self.code = code",
    ),
    (
        "the link is decided when the last step begins",
        "        if self.step == self.page.steps:\n            self.decide_link()",
        "        if self.step == 1:\n            self.decide_link()",
    ),
)

READINGS = (
    (
        "1: a word above 0x7FFF is negative in the look-ahead",
        "return self.raw[at] | self.raw[at + 1] << 8",
        "return int16(self.raw[at] | self.raw[at + 1] << 8)",
    ),
    ("2: positions of unused steps are looked at as well", "range(1, self.steps + 1) for joint", "range(1, 8) for joint"),
    ("3: a stop stays in force over later codes", "            if code:\n", "            if code and self.code != STOP:\n"),
    (
        "4: the page that closes a circle of exit pages is found at the join",
        "            if link in self.exit_pages:\n"
        "                self.reason = EXIT_CIRCLE\n                return 0\n            self.exit_pages.add(link)\n",
        "            self.exit_link = link\n",
    ),
    ("5: a linked page of the call's code goes before NEXT_PAGE", "elif self.code and self.code != self.call:", "elif self.code:"),
    ("6: pages are passed over along NEXT_PAGE", "number = self.follow(page)", "number = page.next_page"),
    (
        "7: a flagged joint is set on its target",
        "joint.M = joint.w = joint.g = 0\n            joint.through",
        "joint.start = joint.target\n            joint.M = joint.w = joint.g = 0\n            joint.through",
    ),
)


def broken(old, new):
    """The model with one piece of text replaced, as a module."""
    text = pathlib.Path(__file__).with_name("classic_law.py").read_text(encoding="utf-8")
    if text.count(old) != 1:
        raise ValueError(f"classic_law.py has {text.count(old)} times: {old}")
    module = types.ModuleType("broken_law")
    sys.modules["broken_law"] = module  # dataclasses look their module up
    exec(compile(text.replace(old, new), "broken_law", "exec"), module.__dict__)
    return module


def outcome(case, model):
    """What the model makes of the case; a broken one may fail in any way."""
    try:
        return random_pages.result(case, model)
    except (ArithmeticError, LookupError, TypeError, AttributeError) as error:
        return repr(error)


def print_measure(cases):
    from tests.models import classic_law

    whole = [outcome(case, classic_law) for case in cases]
    ends = {}
    for _, _, reason in whole:
        ends[reason] = ends.get(reason, 0) + 1
    print(f"{len(cases)} cases; ends: " + ", ".join(f"{reason} {count}" for reason, count in sorted(ends.items())))
    for title, table in (("cases that the sentence decides", RULES), ("cases that another reading would change", READINGS)):
        print(f"{title}:")
        for sentence, old, new in table:
            model = broken(old, new)
            print(f"{sum(outcome(case, model) != good for case, good in zip(cases, whole)):6}  {sentence}", flush=True)
