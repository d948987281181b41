# SPDX-License-Identifier: MIT
"""Motion areas by chance, over the whole input space of the classic law, to compare players with classic_law.py. `case(seed)` gives the
same case for the same seed, always. A call is one tick. A code with tick t arrives before call t."""

import random
from dataclasses import dataclass, field

from tests.models import classic_law as law

IMAGE_BYTES = 65536
CORNERS = (0, 1, 2, 511, 512, 513, 1021, 1022, 1023)
CODES = (1, 2, 3)
DAMAGES = ("checksum", "speed", "schedule", "steps", "position")


@dataclass
class Case:
    seed: int
    image: bytes
    page: int
    joints: int
    positions: dict
    call: int | None = None
    schedule: dict = field(default_factory=dict)
    limit: int = 1500

    def play(self):
        """Plays this case with the model."""
        return law.ClassicPlay(self.image, self.page, self.joints, self.positions, self.schedule, self.call)


def one_of(chance, *choices):
    """Returns one of the choices, values or functions without arguments. Only the chosen function is called."""
    choice = chance.choice(choices)
    return choice() if callable(choice) else choice


def checksummed(page, error=0):
    page[31] = 0
    page[31] = (0xFF - sum(page) + error) % 256
    return page


def positions_by_chance(chance, steps):
    """Yields the positions of one joint in all steps of a page: a style of motion, not only noise."""
    style = chance.choice(("any", "any", "corners", "run", "small", "still"))
    at, way = chance.randrange(1024), chance.choice((-1, 1))
    for _ in range(steps):
        if style == "any":
            at = chance.randrange(1024)
        elif style == "corners":
            at = chance.choice(CORNERS)
        elif style == "run":  # keeps one direction: passes through
            at = law.limited(at + way * chance.randrange(200), 0, 1023)
        elif style == "small":
            at = law.limited(at + chance.randint(-12, 12), 0, 1023)
        yield at


def flag(chance):
    """Returns the word of a joint that is not driven: either flag, any lower bits."""
    return chance.choice((0x4000, 0x4000, 0x4200, 0x2000, 0x6000)) | chance.choice((0, 0, chance.randrange(0x2000)))


def page_by_chance(chance, links):
    """Returns a page that can be played. links: page numbers that its links may name."""
    page = bytearray(512)
    steps = chance.choice((1, 1, 2, 2, 3, 4, 5, 6, 7))
    page[15] = chance.choice((1, 1, 1, 1, 1, 1, 1, 2, 3, 0, 0, chance.randrange(256)))
    page[16] = chance.choice((law.TIME_BASE, law.TIME_BASE, law.SPEED_BASE))
    page[20] = steps
    page[22] = one_of(chance, 32, 32, 14, 20, 64, lambda: chance.randint(1, 60), lambda: chance.randint(1, 255))
    page[24] = one_of(chance, 0, 0, 1, 2, 3, 8, 32, lambda: chance.randrange(256))
    page[25], page[26], page[27], page[29] = (chance.choice(links) for _ in range(4))
    page[28], page[30] = (chance.choice((0, *CODES)) for _ in range(2))
    flags = chance.choice((0, 0, 0.1, 0.4))
    for joint in range(law.JOINTS):
        for step, at in enumerate(positions_by_chance(chance, 7), 1):
            word = flag(chance) if chance.random() < flags or step > steps else at
            page[64 * step + 2 * joint : 64 * step + 2 * joint + 2] = word.to_bytes(2, "little")
    short = chance.random() < 0.3
    for step in range(1, 8):
        page[64 * step + 62] = one_of(chance, 0, 0, 0, 0, 1, 2, lambda: chance.randrange(32))
        page[64 * step + 63] = one_of(
            chance, *((0, 1, 2, 3) if short else ()), lambda: chance.randrange(10 if short else 60), lambda: chance.randrange(10 if short else 256)
        )
    return checksummed(page)


def damaged(chance, page, joint):
    """Returns the page with one fault for which our player refuses it. joint: a present joint."""
    kind = chance.choice(DAMAGES)
    if kind == "checksum":
        return checksummed(page, chance.randint(1, 255))
    if kind == "speed":
        page[22] = 0
    elif kind == "schedule":
        page[16] = chance.choice((1, 5, 9, 11, 255))
    elif kind == "steps":
        page[20] = chance.choice((0, 0, 8, 255))
    else:
        at = 64 * chance.randint(1, page[20]) + 2 * joint
        page[at : at + 2] = chance.choice((1024, 4095, 0x1FFF)).to_bytes(2, "little")
    return checksummed(page)


def case(seed, limit=1500):
    """Returns the case of a seed. About one page in eight is damaged."""
    chance = random.Random(seed)
    pages = chance.sample(range(1, 128), chance.randint(1, 6))
    links = pages * 2 + [0] * chance.choice((1, len(pages) * 2, len(pages) * 6)) + [chance.randint(128, 255), chance.randint(1, 127)]
    count = chance.choice((1, 2, 3, 4, 4, 6, 8, 12, 18, 31))
    there = sorted(chance.sample(range(law.JOINTS), count))
    image = bytearray(IMAGE_BYTES)
    for number in pages:
        page = page_by_chance(chance, links)
        image[512 * number : 512 * number + 512] = (
            damaged(chance, page, there[0]) if chance.random() < (0.15 if number != pages[0] else 0.05) else page
        )
    positions = {i: one_of(chance, 512, lambda: chance.randrange(1024), lambda: chance.choice(CORNERS)) for i in there}
    made = Case(seed, bytes(image), pages[0], sum(1 << i for i in there), positions, limit=limit)
    if chance.random() < 0.4:
        made.call = chance.choice((None, *CODES))
        codes = sorted(chance.sample(range(400), chance.randint(1, 4)))
        made.schedule = {tick: chance.choice((0, *CODES)) for tick in codes}
    if chance.random() < 0.3:
        made.schedule[chance.randrange(500)] = law.STOP
    return made


def result(case):
    """Returns the model's result of a case: [(call, goals)] with output, and the number of the last call."""
    play = case.play()
    last, sent = -1, []
    for last, goals in enumerate(play.ticks(case.limit)):
        if goals is not None:
            sent.append((last, goals))
    return sent, last
