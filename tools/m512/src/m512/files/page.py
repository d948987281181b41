# SPDX-License-Identifier: MIT
"""The 512-byte motion page: layout, checks, field access. The same as motion/page.h; both are tested with page_vectors.py.

A Page accepts any bytes, because damaged pages must be shown, kept and repaired. `fault()` and `faults()` report what is wrong, in
the order of page_status_t.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

PAGE_BYTES = 512
JOINTS = 31
STEPS = 7
STEP_BYTES = 64
NAME_BYTES = 14
TICKS_PER_SECOND = 128

SCHEDULE_SPEED = 0x00
SCHEDULE_TIME = 0x0A
POS_UNUSED = 0x4000  # joint not used in this step: it keeps its last target
POS_TORQUE_OFF = 0x2000  # Edit's work pose only
TRIM_STEP = 2  # of page 0
TRIM_MAX = 300  # the robot treats a larger trim as damaged and as 0


class Fault(IntEnum):
    """page_status_t of motion/page.h. LINK is never reported: a link beyond the last page counts as no link (links_beyond)."""

    OK = 0
    CHECKSUM = 1
    STEPS = 2
    SCHEDULE = 3
    SPEED = 4
    LINK = 5
    POSITION = 6


@dataclass(frozen=True)
class Kind:
    """Properties of a page that depend on its origin and are not in its bytes."""

    pages: int = 128
    pos_max: int = 1023


def _field(at: int, doc: str) -> property:
    def get(self: Page) -> int:
        return self.data[at]

    def put(self: Page, value: int) -> None:
        self.data[at] = value

    return property(get, put, doc=doc)


class Page:
    """512 bytes with named fields. Setting a field does not update the checksum: call seal()."""

    __slots__ = ("data",)

    def __init__(self, data: bytes | bytearray | None = None):
        if data is None:
            data = EMPTY
        if len(data) != PAGE_BYTES:
            raise ValueError(f"a page has 512 bytes, not {len(data)}")
        self.data = bytearray(data)

    repeat = _field(15, "PLAY_COUNT: plays before the link is followed; 0 = no action")
    schedule = _field(16, "SCHEDULE: 0 speed base, 0x0A time base")
    blend_right = _field(17, "partner page to the right while the motion is shaped; 0 = none")
    blend_left = _field(18, "partner page to the left")
    steps = _field(20, "PAGE_STEP: steps used, 0..7")
    code = _field(21, "PLAY_CODE: remote code that calls this page, 0 = none")
    speed = _field(22, "PAGE_SPEED: 32 = nominal")
    dxl_setup = _field(23, "DXL_SETUP: kept as found")
    accel = _field(24, "ACCEL_TIME in ticks")
    next = _field(25, "NEXT_PAGE")
    exit = _field(26, "EXIT_PAGE")
    link1_page = _field(27, "LINKED_PAGE1")
    link1_code = _field(28, "LINKED_PAGE1_PLAY_CODE")
    link2_page = _field(29, "LINKED_PAGE2")
    link2_code = _field(30, "LINKED_PAGE2_PLAY_CODE")
    checksum = _field(31, "PAGE_CHECKSUM: the 8-bit sum of all bytes is 0xFF")
    byte63 = _field(63, "reserved; 0x55 in factory pages")

    LINKS = ("next", "exit", "link1_page", "link2_page")
    PARTNERS = ("blend_right", "blend_left")

    def __bytes__(self) -> bytes:
        return bytes(self.data)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Page) and self.data == other.data

    def __repr__(self) -> str:
        return f"<Page {self.title!r} {self.steps} steps>"

    def copy(self) -> Page:
        return Page(self.data)

    # Name

    @property
    def name(self) -> bytes:
        """The bytes of the name up to the NUL (all 14 if there is none)."""
        return bytes(self.data[:NAME_BYTES]).split(b"\0")[0]

    @name.setter
    def name(self, value: bytes) -> None:
        if len(value) > NAME_BYTES - 1 or b"\0" in value:
            raise ValueError("a page name has at most 13 characters")
        self.data[:NAME_BYTES] = value.ljust(NAME_BYTES, b"\0")

    @property
    def title(self) -> str:
        """The name for display: ASCII, other bytes escaped."""
        return "".join(chr(b) if 0x20 <= b < 0x7F else f"\\x{b:02x}" for b in self.name)

    # Compliance and positions

    def compliance(self, joint: int) -> int:
        return self.data[32 + joint]

    def set_compliance(self, joint: int, value: int) -> None:
        self.data[32 + joint] = value

    def word(self, step: int, joint: int) -> int:
        """The raw position word of `joint` (0..30) in `step` (0..6)."""
        at = 64 + STEP_BYTES * step + 2 * joint
        return self.data[at] | self.data[at + 1] << 8

    def set_word(self, step: int, joint: int, word: int) -> None:
        at = 64 + STEP_BYTES * step + 2 * joint
        self.data[at : at + 2] = word.to_bytes(2, "little")

    def words(self, step: int) -> list[int]:
        return [self.word(step, joint) for joint in range(JOINTS)]

    def pause(self, step: int) -> int:
        return self.data[64 + STEP_BYTES * step + 62]

    def set_pause(self, step: int, ticks: int) -> None:
        self.data[64 + STEP_BYTES * step + 62] = ticks

    def time(self, step: int) -> int:
        """Byte 63 of the step: time in ticks, or the speed in speed base."""
        return self.data[64 + STEP_BYTES * step + 63]

    def set_time(self, step: int, value: int) -> None:
        self.data[64 + STEP_BYTES * step + 63] = value

    def step_bytes(self, step: int) -> bytes:
        return bytes(self.data[64 + STEP_BYTES * step : 64 + STEP_BYTES * (step + 1)])

    def set_step_bytes(self, step: int, block: bytes) -> None:
        assert len(block) == STEP_BYTES
        self.data[64 + STEP_BYTES * step : 64 + STEP_BYTES * (step + 1)] = block

    # Checks

    def seal(self) -> Page:
        """Sets the checksum."""
        self.data[31] = 0
        self.data[31] = (0xFF - sum(self.data)) & 0xFF
        return self

    def faults(self, kind: Kind = Kind()) -> Iterator[Fault]:
        """All faults, in the order of page_status_t."""
        if sum(self.data) & 0xFF != 0xFF:
            yield Fault.CHECKSUM
        if self.steps > STEPS:
            yield Fault.STEPS
        if self.schedule not in (SCHEDULE_SPEED, SCHEDULE_TIME):
            yield Fault.SCHEDULE
        if self.speed == 0:
            yield Fault.SPEED
        if any(is_used(word) and word > kind.pos_max for step in range(min(self.steps, STEPS)) for word in self.words(step)):
            yield Fault.POSITION

    def fault(self, kind: Kind = Kind()) -> Fault:
        """The first fault, as the firmware's page_check reports it."""
        return next(self.faults(kind), Fault.OK)

    def fault_text(self, kind: Kind = Kind()) -> str:
        """The faults in words; empty for a good page."""
        return "; ".join(self._describe(fault, kind) for fault in self.faults(kind))

    def _describe(self, fault: Fault, kind: Kind) -> str:
        if fault is Fault.CHECKSUM:
            right = self.copy().seal().checksum
            return f"checksum is 0x{self.checksum:02X} and should be 0x{right:02X}"
        if fault is Fault.STEPS:
            return f"{self.steps} steps, at most 7 are possible"
        if fault is Fault.SCHEDULE:
            return f"schedule is 0x{self.schedule:02X}, neither speed base (0x00) nor time base (0x0A)"
        if fault is Fault.SPEED:
            return "page speed is 0"
        bad = [
            f"step {step + 1} ID {joint} is 0x{self.word(step, joint):04X}"
            for step in range(min(self.steps, STEPS))
            for joint in range(JOINTS)
            if is_used(self.word(step, joint)) and self.word(step, joint) > kind.pos_max
        ]
        more = f" and {len(bad) - 3} more" if len(bad) > 3 else ""
        return f"position beyond {kind.pos_max}: " + ", ".join(bad[:3]) + more

    def poses(self, number: int) -> list[int]:
        """The steps that hold poses: those used. Of page 0 the first two, too, however many it says, and not the third, the trim's."""
        used = set(range(min(self.steps, STEPS)))
        return sorted(used if number else (used | {0, 1}) - {TRIM_STEP})

    def set_trim(self, joint: int, trim: int | None) -> None:
        """For page 0. None: the joint is not used."""
        self.set_word(TRIM_STEP, joint, POS_UNUSED if trim is None else trim & 0xFFFF)

    def trims(self) -> list[int]:
        """For page 0: what a robot adds to its joints' goals if the page is good, however many steps it says. The third step holds it,
        signed (motion/PAGE_FORMAT.md)."""
        if self.data == b"\xff" * PAGE_BYTES:
            return [0] * JOINTS
        return [0 if POS_UNUSED <= word < POS_UNUSED + 0x2000 else word - 0x10000 if word & 0x8000 else word for word in self.words(TRIM_STEP)]

    def trim_problem(self) -> str:
        """For page 0 of 10 bits: why a robot cannot take it for a trim, or an empty text. Where the first two steps both hold a pose, a joint's trim must be the
        second step's position minus the first's."""
        if any(self.trims()) and self.fault():
            return f"damaged, so the robot adds nothing ({self.fault_text()})"
        for joint, trim in enumerate(self.trims()):
            master, own = self.word(0, joint), self.word(1, joint)
            if master <= 1023 and own <= 1023 and trim != own - master:
                return (
                    f"the trim belongs here, and this looks like a motion: ID {joint} has {trim} in its third step, "
                    f"where the second less the first is {own - master}"
                )
            if abs(trim) > TRIM_MAX:
                return f"the trim of ID {joint} is {trim}; the robot takes more than {TRIM_MAX} for damaged, and adds nothing"
        return ""

    def links_beyond(self, kind: Kind = Kind()) -> list[str]:
        """Links beyond the last page, which a player ignores: "next 200"."""
        return [f"{link.replace('_', ' ')} {getattr(self, link)}" for link in self.LINKS if getattr(self, link) >= kind.pages]

    @property
    def is_playable(self) -> bool:
        return bool(self.steps != 0 and self.repeat != 0)

    @property
    def is_empty(self) -> bool:
        """No action and no name, and sound: lists leave such pages out. A torn page may have the first half of an empty one."""
        return self.steps == 0 and not self.name and not self.fault()


def is_used(word: int) -> bool:
    """Whether a position word drives its joint: neither flag is set."""
    return not word & (POS_UNUSED | POS_TORQUE_OFF)


def _make_empty() -> bytes:
    data = bytearray(PAGE_BYTES)
    data[15] = 1
    data[16] = SCHEDULE_TIME
    data[22] = 32
    data[24] = 32
    data[32:63] = bytes([0x55]) * JOINTS
    for step in range(STEPS):
        data[64 + STEP_BYTES * step : 64 + STEP_BYTES * step + 62] = POS_UNUSED.to_bytes(2, "little") * JOINTS
    data[31] = (0xFF - sum(data)) & 0xFF
    return bytes(data)


EMPTY = _make_empty()
"""The empty page of the specification, sealed."""
