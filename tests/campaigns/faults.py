# SPDX-License-Identifier: MIT
"""Every fault that a servo can have, in every situation of the robot: alone, and in pairs on one servo and on two. Each fault must be
named on the screen with the joint's number within a simulated second. The rest of the robot must do what the setting says,
without a leap. When the fault is over, the servo must be usable again. There is no reset, no missed tick, and nothing that
would damage a chip.

servofaults/README.md lists what must be named, and what the retries hide and the statistics count (model.py is the same as code).
"""

import collections
import itertools
import random

from cm5sim import Violation
from tests.campaigns import bus_watch, proof
from tests.campaigns.servofaults import model
from tests.campaigns.servofaults.model import FAULTS, GRAVE, OVERLOAD, SILENT, TORQUE
from tests.campaigns.servofaults.robots import BACK, MARKED_OFF, POSE, RELEASED, SWINGING, THERE, UNUSED, EditRobot, PlayRobot
from tests.sim import snapshot

TITLE = "Servo faults"
PROMISE = "Every fault of a servo is named within a second, and the rest of the robot does not leap."

NAMED_MS = 1000  # the promised time
PUSHED_MS = 2600  # a jammed servo reports overload only after a second of pushing
RULE_MS = {"hold": 1000, "exit": 3500, "limp": 1500}  # time until the rule has acted; exit: the page plays to its end
STEP_MAX, CHANGE_MAX = 9, 4  # pos per tick: 200 pos in 64 ticks with ramps of 32, braked in at least 8
TALKS_INTO_FRAMES = {"late", "late-2"}  # such an answer may spoil a frame on the bus: that tick's goals are lost
LAST_STEP_MAX = 2  # before it stops
POSE_ERROR_MAX = 4
OUT_MS = 50  # from the message to the last goal that may still have been in transit
SAMPLE = 12  # number of states in a sample, besides those that have been broken
BROKE = ("edit.walk.limp/two-talkers@8+blocked@8",)  # the news came as the row's time was over, and Edit forgot it
PASSING = {"blink", "late", "late-2"}  # a servo with one of these may answer again by itself
SITUATIONS = {
    f"{image}.{state}": (robot, words)
    for image, robot, states in (
        ("play", PlayRobot, ("rest", "walk.hold", "walk.exit", "walk.limp", "off", "pause.hold", "pause.limp", "layer.hold", "layer.exit")),
        ("edit", EditRobot, ("rest", "teach", "walk.hold", "walk.exit", "walk.limp")),
    )
    for state in states
    for words in [state.split(".")]
}
IN_PAIRS = [name for name in SITUATIONS if name not in ("play.off", "play.pause.hold", "play.pause.limp", "play.layer.hold", "play.layer.exit")]
ALONE_ON = (1, 5, 15, MARKED_OFF, RELEASED, UNUSED[-1])


def add_arguments(group):
    group.add_argument("--only", metavar="STATE", help="one state by its name, such as play.walk.hold/silent@5+overload@8")


# ---- the states ----


def name_of(situation, faults):
    return f"{situation}/" + "+".join(f"{fault}@{joint}" for fault, joint in faults)


def parse(name):
    situation, _, faults = name.partition("/")
    return situation, [(fault, int(joint)) for fault, joint in (word.split("@") for word in faults.split("+"))]


def all_states(seed):
    """Yields the names of all states. The seed picks the joints of a pair of faults."""
    chance = random.Random(seed)
    for situation in SITUATIONS:
        for fault, joint in itertools.product(FAULTS, ALONE_ON):
            yield name_of(situation, [(fault, joint)])
        yield name_of(situation, [("dead", joint) for joint in range(3, 3 + model.CABLE)])
        yield name_of(situation, [("dead", joint) for joint in THERE])
    for situation in IN_PAIRS:
        for first, second in itertools.combinations(model.LASTING, 2):
            one, other = chance.sample(SWINGING, 2)
            yield name_of(situation, [(first, one), (second, other)])
            if second != "blink" or first not in model.ENDED_BY_BLINK:
                yield name_of(situation, [(first, one), (second, one)])


# ---- one state ----


class Trial:
    """Plays one state: the fault, the robot's reaction, the repair, and the next play."""

    def __init__(self, robot, faults):
        self.robot, self.board = robot, robot.board
        self.faults = faults
        self.found = []
        self.by_joint = collections.defaultdict(set)
        for fault, joint in faults:
            self.by_joint[joint].add(fault)
        self.expected = model.expected(self.by_joint, THERE, robot.driven, robot.holding, robot.cut)
        if isinstance(robot, EditRobot):  # an alarm explains why torque is off; Edit shows torque in its table when nothing moves
            alarmed = {joint for joint, kind in self.expected.must if kind in model.ALARMS.values()}
            self.expected.must -= {(joint, TORQUE) for joint in alarmed}
        self.other_goals = {joint: self.board.servos[joint].goal for joint in UNUSED + (MARKED_OFF, RELEASED)}
        self.servos = {joint: self.board.servos[joint] for joint in self.by_joint}
        self.named_ms = 0

    def complain(self, text):
        self.found.append(text)

    def befall(self):
        """Starts the faults. Runs until all of them are named or the time is over."""
        robot = self.robot
        robot.remember_screen()
        for fault, joint in self.faults:
            FAULTS[fault].begin(self.board, self.servos[joint])
        jammed = any("blocked" in faults for faults in self.by_joint.values())
        wanted = [{told} for told in sorted(self.expected.must)] + self.expected.either
        began = [robot.since_ms] * len(wanted)
        while any(not told & set(robot.told) for told in wanted) and robot.since_ms < (PUSHED_MS if jammed else NAMED_MS):
            robot.run(20)
            for index, told in enumerate(wanted):
                if any(self.is_pushing_still(*one) for one in told):
                    began[index] = robot.since_ms
        for told, since_ms in zip(wanted, began):
            ms = min((robot.told[one] for one in told if one in robot.told), default=1e9) - since_ms
            if ms > NAMED_MS:
                self.complain(f"not named within {NAMED_MS} ms: {_list(told)}")
            else:
                self.named_ms = max(self.named_ms, ms)

    def is_pushing_still(self, joint, kind):
        """Returns whether the servo is jammed and has not noticed yet."""
        return kind in (OVERLOAD, TORQUE) and "blocked" in self.by_joint[joint] and OVERLOAD not in self.servos[joint].alarms

    def rule_acts(self):
        return self.robot.playing and any(kind in GRAVE and joint != RELEASED for joint, kind in self.robot.told)

    def obey_rule(self):
        """Checks that the rest of the robot follows the rule for faults."""
        robot = self.robot
        robot.run(max(0, NAMED_MS - robot.since_ms))
        if not self.rule_acts() or robot.rule == "limp":
            robot.run(500)  # meanwhile a late servo may still become silent
        acts = self.rule_acts()
        over = acts and robot.rule != "limp"
        if over:
            robot.run_until(lambda: robot.ended is not None, RULE_MS[robot.rule])
        if over != (robot.ended is not None) and robot.playing:
            self.complain(f"the play {'went on' if over else 'ended'}, rule {robot.rule}")
        elif over and "ervo" not in robot.end_text:
            self.complain(f"the play ended with {robot.end_text!r}")
        self.watch_bus(acts, over)
        passing = {(joint, BACK) for joint, faults in self.by_joint.items() if faults & PASSING}
        wrong = set(robot.told) - self.expected.may - passing
        if wrong:
            self.complain(f"named without reason: {_list(wrong)}")

    def watch_bus(self, acts, over):
        robot = self.robot
        packets = self.board.packets
        frames = bus_watch.frames_of(packets)
        step, change = bus_watch.largest_steps(frames)
        if step > STEP_MAX or change > CHANGE_MAX:
            self.complain(f"a leap: {step} pos in a tick, {change} pos more than in the tick before")
        driven = set().union(*(goals for _, goals in frames)) if frames else set()
        if driven - set(robot.driven):
            self.complain(f"driven without reason: {sorted(driven - set(robot.driven))}")
        if bus_watch.written(packets, bus_watch.GOAL_AT) or bus_watch.written(packets, bus_watch.TORQUE_AT, 1):
            self.complain("a goal or torque on was written outside the play")
        if not robot.playing:
            return
        silent_ms = [ms for (joint, kind), ms in robot.told.items() if kind == SILENT]
        if over and frames and robot.ended is not None and frames[-1][0] / 16000 - robot.started_ms > robot.ended + 20:
            self.complain("frames behind the end")
        snap = bus_watch.last_step(frames, {joint for joint, _ in robot.told})
        if over and snap > LAST_STEP_MAX:
            self.complain(f"ended with a snap: {snap} pos in the last tick")
        gaps = bus_watch.missing_ticks(frames, robot.phase)
        if gaps and not any(faults & TALKS_INTO_FRAMES for faults in self.by_joint.values()):
            self.complain(f"{gaps} ticks without a frame")
        lost = {}  # {joint that the rule takes out: since when}
        for (joint, kind), ms in robot.told.items() if acts else ():
            if kind in GRAVE:
                lost[joint] = min(ms, lost.get(joint, ms))
        still = {joint for cycle, goals in frames for joint in goals if cycle / 16000 - robot.started_ms > lost.get(joint, 1e9) + OUT_MS}
        if still:
            self.complain(f"still driven: {sorted(still)}")
        last = {joint for cycle, goals in frames if cycle / 16000 > self.board.now_ms - 100 for joint in goals}
        if not over and last != set(robot.driven) - set(lost) and not silent_ms:
            self.complain(f"no longer driven: {sorted(set(robot.driven) - set(lost) - last)}")
        healthy = [joint for joint in SWINGING if joint not in self.by_joint and (joint, SILENT) not in robot.told]
        limp = [joint for joint in healthy if not self.board.servos[joint].torque]
        if limp:
            self.complain(f"healthy joints went limp: {limp}")

    def recover(self):
        """Ends the faults. The servos must answer, switch on, and play."""
        robot = self.robot
        silent = {joint for joint, kind in robot.told if kind == SILENT and (joint, BACK) not in robot.told}
        robot.told = {told: ms for told, ms in robot.told.items() if told[1] != BACK}
        for fault, joint in self.faults:
            FAULTS[fault].end(self.board, self.servos[joint])
        began = robot.since_ms
        want = {(joint, BACK) for joint in silent}
        robot.run_until(lambda: want <= set(robot.told), NAMED_MS)
        if want - set(robot.told):
            self.complain(f"not reported back within {NAMED_MS} ms: {_list(want - set(robot.told))}")
        robot.run(max(0, 300 - (robot.since_ms - began)))
        for complaint in robot.screen_faults() if not robot.playing or robot.ended else []:
            self.complain(complaint)
        limp = {joint for joint, kind in robot.told if kind == TORQUE}
        with_twin = {joint for joint, faults in self.by_joint.items() if "duplicate" in faults}  # the twin is limp
        if holding := sorted(joint for joint in limp - with_twin if self.board.servos[joint].torque):
            self.complain(f"named as limp, but they hold: {holding}")
        robot.stand()
        joints = set(SWINGING) | (set(self.by_joint) | limp) - {RELEASED}
        if not robot.on(joints):
            self.complain("`on` was refused")
        off = [joint for joint in joints if not self.board.servos[joint].torque]
        if off:
            self.complain(f"`on` left them limp: {off}")
        released = RELEASED in self.by_joint  # a servo that was switched off by hand stays faulty until it holds again
        if isinstance(robot, PlayRobot) and not released and robot.where().get("faulty") != "00000000":
            self.complain("still called faulty, though all is well")
        if not robot.play(POSE):
            self.complain("`play` was refused")
        self.board.clear_trace()
        robot.run(2500)
        frames = bus_watch.frames_of(self.board.packets)
        step, change = bus_watch.largest_steps(frames)
        if bus_watch.missing_ticks(frames, robot.phase) or step > STEP_MAX or change > CHANGE_MAX:
            self.complain(f"the play afterwards: step {step}, change {change}")
        far = [joint for joint in SWINGING if abs(self.board.servos[joint].present - 540) > POSE_ERROR_MAX]
        if far:
            self.complain(f"the pose was not reached by {far}")
        moved = [joint for joint, goal in self.other_goals.items() if self.board.servos[joint].goal != goal and joint not in self.by_joint]
        if moved:
            self.complain(f"not in the page, but driven: {moved}")

    def finish(self):
        robot = self.robot
        if isinstance(robot, PlayRobot) and "aux" in self.board.leds:
            self.complain("the Aux lamp is still lit")
        where = robot.where()
        if isinstance(robot, PlayRobot) and where.get("missed") != "0":
            self.complain(f"missed ticks: {where.get('missed')}")
        if where.get("faulty") != "00000000":
            self.complain(f"still called faulty: {where.get('faulty')}")
        if self.board.resets != robot.resets:
            self.complain(f"{self.board.resets - robot.resets} resets")


def _list(told):
    return ", ".join(f"{joint} {kind}" for joint, kind in sorted(told))


def try_state(robot, faults):
    """Returns (complaints, ms until the last fault was named, stack headroom)."""
    trial = Trial(robot, faults)
    try:
        for part in (trial.befall, trial.obey_rule, trial.recover, trial.finish):
            part()
    except Violation as violation:
        trial.complain(f"violation: {violation}")
    except AssertionError as error:
        trial.complain(f"no answer: {error}")
    return trial.found, trial.named_ms, robot.board.stack_headroom


robots = {}  # per process: one situation, ready to be copied


def work(name):
    situation, faults = parse(name)
    if situation not in robots:
        kind, words = SITUATIONS[situation]
        robots.clear()
        robots[situation] = kind(*words)
    try:
        return snapshot.attempt(try_state, robots[situation], faults)
    except snapshot.Failed as failed:
        return [str(failed)], 0, 0


# ---- all of them ----


def run(options):
    only = options.only
    options.keep = not only
    names = [only] if only else list(all_states(options.seed))
    if options.sample and not only:
        laid = [name for name in names if name.startswith("play.layer")]
        others = [name for name in names if name not in laid]
        chance = random.Random(options.seed)
        names = sorted({*chance.sample(others, SAMPLE), *chance.sample(laid, 2), *BROKE})
    kept = proof.Kept("faults", options.keep and not options.sample)
    results = dict(zip(names, kept.each(work, names, "states", options.jobs)))
    kept.finish()
    broken = {name: found for name, (found, _, _) in results.items() if found}
    for name, found in broken.items():
        print(f"   tools/prove faults --only {name}")
        for complaint in found:
            print(f"      {complaint}")
    kinds = collections.Counter(len(parse(name)[1]) == 1 for name in names)
    figures = [
        proof.Figure(
            "Every fault of a servo is named on the screen with the joint's number within a second; the rest of the robot does what "
            "the setting says, without a leap; when the fault is over the servo is reported, switched on again and plays.",
            "whole images on the strict board; each fault in each situation, alone, in pairs on one servo and on two, and cables",
            f"{len(names)} states ({kinds[True]} of one fault, {kinds[False]} of more), {len(broken)} broken"
            + "".join(f"; tools/prove faults --only {name}" for name in list(broken)[:3]),
            not broken,
            headline=True,
        )
    ]
    for image, what in (("play", "on Play's console"), ("edit", "in Edit's message row")):
        chosen = [result for name, result in results.items() if name.startswith(image)]
        if chosen:
            named, headroom = max(ms for _, ms, _ in chosen), min(left for _, _, left in chosen)
            figures.append(
                proof.Figure(
                    f"A second is enough: the slowest fault {what}.",
                    "from the moment the servo could tell it to the whole sentence",
                    f"{named:.0f} ms; {len(chosen)} states; least stack headroom {headroom} bytes",
                    named <= NAMED_MS,
                )
            )
    return figures
