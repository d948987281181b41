# SPDX-License-Identifier: MIT
"""Faults of servos, and what the robot must report: the table of servofaults/README.md as code.

The table is about what a controller can know. It hears a servo only through the answers to the health poll, one servo per tick. So a fault
shows as *silence* (three polls in a row without a clean answer), as *error bits* in a clean answer, or as *torque* that is off although it
was switched on. `expected` works this out from which servos talk when a joint is polled. It knows nothing of the firmware.
"""

import dataclasses
import typing

SILENT, VOLTAGE, ANGLE, HEAT, OVERLOAD, TORQUE = "silent", "voltage", "angle limit", "overheating", "overload", "torque"
GRAVE = {SILENT, ANGLE, HEAT, OVERLOAD, TORQUE}  # the rule hold / exit / limp acts on these; voltage is only reported
ALARMS = {"overload": OVERLOAD, "overheating": HEAT, "low-voltage": VOLTAGE, "angle-limit": ANGLE}
SLOW_BAUD = 34  # value of a servo's register 4 for 57,142 bps
JAMMED_POS = 150
CABLE = 3  # number of servos on the cable that breaks


@dataclasses.dataclass(frozen=True)
class Fault:
    """A fault: its description, and how it begins and ends."""

    what: str
    begin: typing.Callable
    end: typing.Callable


def _model(name):
    """Returns begin and end of a fault of the virtual servo itself (tools/sim/servo/servo_fault.h)."""
    return lambda board, servo: servo.fault(name), lambda board, servo: servo.clear(name)


def _times(name, count):
    return lambda board, servo: servo.fault(name, times=count), lambda board, servo: servo.clear(name)


def _register(address, value, well):
    """Returns begin and end of a wrong register value."""
    return lambda board, servo: servo.write(address, [value]), lambda board, servo: servo.write(address, [well(servo)])


def _jam(board, servo):
    """Holds the servo at a position outside of all pages, so that it has to push."""
    servo.push_to(JAMMED_POS)
    servo.fault("blocked")


def _blink(board, servo):
    """Cuts the power for 50 ms."""
    servo.fault("dead")
    board.run(ms=50)
    servo.clear("dead")


def _fault(what, deeds):
    return Fault(what, *deeds)


FAULTS = {
    "silent": _fault("hears and obeys, never answers", _model("silent")),
    "dead": _fault("unplugged: deaf, dumb and limp; plugged in again its torque is off", _model("dead")),
    "duplicate": _fault("a second servo has the same ID", _model("duplicate")),
    "checksum": _fault("every answer has a wrong checksum", _model("checksum")),
    "short": _fault("every answer ends in the middle", _model("short")),
    "late": _fault("every answer comes 20 ms late, when others are asked", _model("late")),
    "two-talkers": _fault("answers whatever the others are asked", _model("two-talkers")),
    "rate": _fault("has fallen back to 57,142 bps: deaf and dumb, still holds", _register(4, SLOW_BAUD, lambda servo: 1)),
    "overload": _fault("overload alarm, with shutdown", _model("overload")),
    "overheating": _fault("85 degrees, with shutdown", _model("overheating")),
    "low-voltage": _fault("5.5 V", _model("low-voltage")),
    "angle-limit": _fault("reports its angle limits", _model("angle-limit")),
    "blocked": _fault("the horn is jammed: overload, once it has pushed for a second", (_jam, _model("blocked")[1])),
    "blink": _fault("no power for 50 ms: comes back with torque off", (_blink, lambda board, servo: None)),
    "noise": _fault("a random byte goes before every answer", _model("noise")),
    "checksum-2": _fault("two answers have a wrong checksum", _times("checksum", 2)),
    "silent-2": _fault("two answers are missing", _times("silent", 2)),
    "short-2": _fault("two answers end in the middle", _times("short", 2)),
    "late-2": _fault("two answers come late", _times("late", 2)),
}
TRANSIENT = {name for name in FAULTS if name.endswith("-2")}
LASTING = [name for name in FAULTS if name not in TRANSIENT]
# A loss of power clears these faults. Combined with a blink on the same servo they are not a second fault.
ENDED_BY_BLINK = {"dead", "blocked", "overload"}


@dataclasses.dataclass
class Expected:
    """Reports as {(joint, kind)}: all in `must`, at least one of each set in `either`, and only those in `may`."""

    must: set
    either: list
    may: set


def _is_heard(faults):
    """Returns whether the answer of a servo with these faults is understood if no other servo talks over it."""
    return not faults & {"silent", "dead", "rate", "checksum", "short"}


def _answers(faults):
    """Returns whether a servo with these faults sends something when it is polled."""
    return not faults & {"silent", "dead", "rate", "late"}


def _kinds(faults, driven, held):
    """Returns the (must, may) kinds of a joint that is heard. faults: of the servo that answers. held: its torque was on."""
    must, may = {kind for name, kind in ALARMS.items() if name in faults}, set()
    cut = must & {OVERLOAD, HEAT}  # the alarms that switch a servo off
    if held and cut:
        must.add(TORQUE)
    if held and "blocked" in faults:  # it pushes until something switches it off
        (may if cut or "blink" in faults or must & GRAVE else must).update({OVERLOAD, TORQUE})
        may.add(ANGLE)
    if "late-2" in faults:
        may.add(SILENT)
    if "blink" in faults:
        may.update({SILENT} | must & {OVERLOAD})  # without power it forgets the overload
        must.discard(OVERLOAD)
        if held:  # a robot that plays does not notice: the next goal switches the torque on again
            (may if driven else must).add(TORQUE)
    return must, may


def expected(faults, joints, driven, held, cut=frozenset()):
    """Returns what a robot with servos `joints` must report.

    faults: {joint: set of fault names}
    driven: joints that get a goal every tick
    held:   joints whose torque is on
    cut:    joints switched off at their first grave fault, so that the loss of torque is no news
    """
    told = Expected(set(), [], set())
    for joint in joints:
        own = faults.get(joint, frozenset())
        others = [other for other, names in faults.items() if other != joint and "two-talkers" in names and _answers(names)]
        must, may, either = set(), set(), set()
        if others or (_answers(own) and "duplicate" in own):
            must = {SILENT}
        elif "duplicate" in own:  # the twin answers for a servo that says nothing; its torque is off after power-up
            (may if joint in driven else must).update({TORQUE} if joint in held else set())
            may.add(SILENT)
        elif not _is_heard(own):
            must = {SILENT}
        else:
            must, may = _kinds(own, joint in driven, joint in held)
            if "late" in own:  # it may be heard while no other servo is polled; its report is then true
                either, may, must = must | {SILENT} if must else set(), may | must | {SILENT}, set()
        if SILENT in must and "blink" in own:
            may.add(TORQUE)
        if joint in cut and (must | may) & GRAVE:
            either = either or (may & GRAVE | {TORQUE} if must & GRAVE == {TORQUE} else set())
            must, may = must - {TORQUE}, may | {TORQUE}
        told.must |= {(joint, kind) for kind in must}
        told.may |= {(joint, kind) for kind in may | must}
        if either:
            told.either.append({(joint, kind) for kind in either})
    return told
