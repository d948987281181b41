# SPDX-License-Identifier: MIT
"""`m512 doctor -p bus:...`: examines everything from the adapter to each servo and gives advice. Torque stays as it is and nothing
moves. Only with `mend` it writes two registers: a rate or a return delay that the programs cannot use."""

from __future__ import annotations

from typing import Callable

from m512 import ui
from m512.board import bus, servos
from m512.board.doctor import BAD, LOW_BATTERY_DV, OK, WARN, Add, Finding
from m512.errors import M512Error
from m512.files.text.writer import ranges

# Rates in baud that servos are sold with or were set to -> divisor n. The rate is 2,000,000 / (n + 1).
RATES = {1000000: 1, 57142: 34, 115200: 16, 500000: 3, 400000: 4, 250000: 7, 200000: 9, 19200: 103, 9600: 207}
PLAYED = range(31)  # IDs that Play and Edit can drive
OTHERS = range(31, 254)
MODELS = {
    12: "AX-12",
    18: "AX-18",
    300: "AX-12W",
    10: "RX-10",
    24: "RX-24F",
    28: "RX-28",
    64: "RX-64",
    107: "EX-106",
    113: "DX-113",
    116: "DX-116",
    117: "DX-117",
    29: "MX-28",
    310: "MX-64",
    320: "MX-106",
    360: "MX-12W",
}
AT_BAUD, AT_DELAY = 4, 5
DELAY_MIN, DELAY_SOLD = 5, 250  # in 2 us
NOBODY = (
    "is their power on (USB does not feed servos), the cable plugged in at both ends, and a switch on the adapter at the right kind of "
    "bus (TTL for AX)? Plug in one servo alone to find a bad cable"
)


def examine(word: str, tell: Callable[[Finding], None], mend: bool = False) -> list[Finding]:
    out: list[Finding] = []

    def add(*parts: str) -> None:
        out.append(Finding(*parts))
        tell(out[-1])

    _programs(add)
    _folder(add)
    try:
        with servos.Bus(word) as line:
            _adapter(line, add)
            _servos(line, add, next((rate for rate in RATES if abs(rate - line.rate) < line.rate / 50), line.rate), mend)
    except M512Error as error:
        add("adapter", BAD, str(error), "m512 term --list names the ports")
    return out


def _programs(add: Add) -> None:
    try:
        add("programs", OK, " ".join(str(bus.find_program(image)) for image in ("play", "edit")))
    except M512Error as error:
        add("programs", BAD, "Play and Edit for this computer are missing", str(error).partition(": ")[2])


def _folder(add: Add) -> None:
    wrong = bus.wrong_file()
    if wrong:
        add("folder", BAD, f"{wrong}: not a file of {bus.FILE_BYTES[wrong.name]} bytes", "Move it away, and a new one is made")


def _adapter(line: servos.Bus, add: Add) -> None:
    add("adapter", OK, f"{line.device} opens")
    add(
        "latency",
        OK if line.is_fast else WARN,
        "the driver passes bytes on at once" if line.is_fast else "the driver may hold bytes back",
        "" if line.is_fast else "motions are as smooth; servos are asked less often. FTDI: 1 in /sys/class/tty/*/device/latency_timer",
    )
    if line.find_echo():
        add("echo", OK, "the adapter repeats what it is sent: dropped")


def _servos(line: servos.Bus, add: Add, wanted: int, mend: bool) -> None:
    found: list[int] = []
    for rate in [wanted] + [rate for rate in RATES if rate != wanted]:
        try:
            line.set_rate(rate)
        except M512Error as error:
            add("rate", WARN, str(error))
            continue
        ids = _scan(line, PLAYED) if rate in (wanted, 1000000, 57142) or line.is_somebody_there() else []
        if (ids and rate == wanted) or (not ids and line.is_somebody_there()):
            ids += _scan(line, OTHERS)
        if ids:
            found += ids
            _at_rate(line, add, rate, ids, wanted, mend)
    _missing(sorted(found), add)


def _scan(line: servos.Bus, ids: range) -> list[int]:
    """The IDs of these that answer or produce noise. Each that does not takes a while."""
    with ui.phase(f"Asking IDs {ids[0]}..{ids[-1]} at {line.rate} baud") as progress:
        return line.scan(ids, progress)


def _at_rate(line: servos.Bus, add: Add, rate: int, ids: list[int], wanted: int, mend: bool) -> None:
    is_right = rate == wanted
    word = f"bus:{line.device}" + ("" if wanted == bus.PLAY_RATE else f"@{wanted}")
    add(
        "servos",
        OK if is_right else WARN,
        f"{len(ids)} at {rate} baud: IDs {ranges(ids) or 'none'}",
        ""
        if is_right
        else f"they are not played at {wanted}. One command moves them: m512 doctor -p {word} --mend; "
        f"or play them as they are: -p bus:{line.device}@{rate}",
    )
    for id_ in ids:
        if _servo(line, add, id_, mend) and mend and not is_right:
            _mend_rate(line, add, id_, rate, wanted)


def _missing(ids: list[int], add: Add) -> None:
    """Reports missing and unplayable IDs. Robots number their servos from 1 on without a gap."""
    if not ids:
        add("servos", BAD, "no servo answers, at no rate", NOBODY)
    gaps = [id_ for id_ in range(1, max(ids, default=0)) if id_ not in ids and id_ in PLAYED]
    if gaps and len(gaps) <= len(ids):
        add("servos", WARN, f"nobody has ID {ranges(gaps)}", "if one should: its cable, or two servos share another ID")
    beyond = [id_ for id_ in ids if id_ not in PLAYED]
    if beyond:
        add(
            "servos",
            WARN,
            f"IDs {ranges(beyond)} are never driven: joints are 0..30",
            "give them another ID with the monitor image or a maker's tool",
        )


def _servo(line: servos.Bus, add: Add, id_: int, mend: bool) -> bool:
    """Returns whether it may be moved to another rate: False if two servos may have this ID. Where they are they disturb nobody."""
    what = f"servo {id_}"
    table: dict[int, int] = {}
    for at, count in ((0, 19), (24, 23)):
        data = line.read(id_, at, count)
        if data is None:
            add(what, BAD, *_no_answer(line, id_))
            return not line.noise
        table.update(enumerate(data, at))
    answer = line.ask(id_, servos.PING)
    if line.noise or answer is None:
        add(what, BAD, *_two(id_))
        return False
    problems = [f"{name}: {what_to_do}" for bit, name, what_to_do in servos.ERRORS if answer.error & bit]
    volts, sold = table[42], _word(table, 0)
    if volts < LOW_BATTERY_DV and not problems:
        problems = [f"{volts / 10:.1f} V: charge the battery soon"]
    add(
        what,
        WARN if problems else OK,
        f"{MODELS.get(sold, f'model {sold}')} firmware {table[2]}, at {_word(table, 36)}, goes {_word(table, 6)}..{_word(table, 8)}, "
        f"torque {'on' if table[24] else 'off'} up to {_word(table, 34) * 100 // 1023} %, {volts / 10:.1f} V, {table[43]} C "
        f"(limits {table[12] / 10:.1f}..{table[13] / 10:.1f} V, {table[11]} C)",
        "; ".join(problems),
    )
    if _word(table, 6) == 0 and _word(table, 8) == 0:
        add(what, WARN, "turns without end (both angle limits are 0), so it takes no goals", "set its angle limits: 0 and 1023")
    if table[AT_DELAY] < DELAY_MIN:
        _mend_delay(line, add, id_, table[AT_DELAY], mend)
    return True


def _two(id_: int, told: str = "") -> tuple[str, str]:
    return f"{told}two servos have ID {id_}, or its cable is bad", "unplug one of them, and give the other another ID"


def _word(table: dict[int, int], at: int) -> int:
    return table[at] | table[at + 1] << 8


def _no_answer(line: servos.Bus, id_: int) -> tuple[str, str]:
    if line.noise:
        return _two(id_, "what it answers is damaged: ")
    return "answers PING only", "its status return level (address 16) is 0: set it to 2"


def _mend_rate(line: servos.Bus, add: Add, id_: int, rate: int, wanted: int) -> None:
    divisor: int | None = RATES.get(wanted)
    if divisor is None:
        add(f"servo {id_}", WARN, f"no servo has the rate {wanted}", "name one of " + " ".join(map(str, RATES)))
        return
    line.set_rate(wanted)
    is_taken = line.ask(id_, servos.PING) is not None or bool(line.noise)
    line.set_rate(rate)
    if is_taken:  # both would move together, and no command could tell them apart
        add(f"servo {id_}", BAD, f"stays at {rate} baud: another servo has ID {id_} at {wanted}", "unplug one of them, and give the other another ID")
        return
    line.write(id_, AT_BAUD, divisor)  # the answer comes at the old rate or at the new one
    line.set_rate(wanted)
    done = line.ask(id_, servos.PING) is not None
    noise = line.noise
    line.set_rate(rate)
    if noise:
        add(f"servo {id_}", BAD, *_two(id_, f"moved from {rate} to {wanted} baud: "))
        return
    add(
        f"servo {id_}",
        OK if done else BAD,
        f"moved from {rate} to {wanted} baud" if done else f"does not answer at {wanted} baud",
        "" if done else "switch its power off and on, and look again",
    )


def _mend_delay(line: servos.Bus, add: Add, id_: int, delay: int, mend: bool) -> None:
    what = f"servo {id_}"
    if not mend:
        add(what, WARN, f"answers after {2 * delay} us, before some adapters listen", "--mend sets it to 500 us, as sold")
        return
    line.write(id_, AT_DELAY, DELAY_SOLD)
    done = line.read(id_, AT_DELAY, 1) == bytes([DELAY_SOLD])
    if done:
        add(what, OK, "its return delay is 500 us now")
    else:
        add(what, BAD, "its return delay could not be changed", "its settings may be locked: switch its power off and on, and look again")
