# SPDX-License-Identifier: MIT
"""One motion on one body: does it stand, and where does it go?

    from body.trial import try_motion
    outcome = try_motion(image, page=20, seconds=12)               # 65,536 bytes as in flash; nominal humanoid, exact law
    outcome.fell_s, outcome.forward_mm_s, outcome.turn_deg_s, outcome.on_feet

The player is the firmware's, compiled for this machine. Servos and body are those of the simulated board, without its chip (quick.py). A
trial runs about 30 times as fast as the robot. The same arguments give the same outcome, to the last bit on one machine and one version of
MuJoCo.
"""

import functools
import math
from dataclasses import dataclass, field

from .chance import NOMINAL
from .description import Description, load
from .physics import PUSH_S, Physics
from .quick import Quick

TICKS_PER_S = 128
CHUNK = 4  # ticks between observations, and between keys: 31 ms, about the rate of a remote's packets
FALLEN = 0.5  # cosine of the trunk's tilt: 60 degrees
ON_FEET = 0.9  # tilted by less than 26 degrees
WARM_S = 1.5  # speeds are measured from here on, without the start
SETTLE_S = 0.25  # in the first pose, before the play
AFTER_S = 0.75  # observed after the play
STOP = 255  # code of a stop


@dataclass(frozen=True)
class Look:
    """Position of the trunk: seconds since the start of the play, mm in the frame of the start, degrees to the left."""

    time_s: float
    x_mm: float
    y_mm: float
    heading: float
    upright: float


@dataclass
class Outcome:
    """Result of a trial. Speeds are means from WARM_S on; distances and heading are those of the whole play."""

    seconds: float = 0.0  # length of the play, or time until the fall
    fell_s: float = None  # time of the fall; None: no fall
    ended: bool = False  # the play ended by itself
    on_feet: bool = False  # at the end it is upright, and only its soles touch the floor
    x_mm: float = 0.0
    y_mm: float = 0.0
    heading: float = 0.0
    forward_mm_s: float = 0.0  # along its path, without sway (pace()); negative: backwards
    sideways_mm_s: float = 0.0  # in the robot's frame, to the left
    turn_deg_s: float = 0.0
    track: list = field(default_factory=list)
    loads: dict = field(default_factory=dict)  # servo -> quick.Load
    touched: set = field(default_factory=set)  # pairs of geoms that touched, without the floor

    @property
    def most_units_per_tick(self):
        return max((load.most_units_per_tick for load in self.loads.values()), default=0.0)

    @property
    def most_torque_nm(self):
        """The largest mean torque of a servo."""
        return max((load.torque_nm for load in self.loads.values()), default=0.0)

    def said(self):
        how = f"fell after {self.fell_s:.1f} s" if self.fell_s is not None else "on its feet" if self.on_feet else "not on its feet"
        return (
            f"{how}; {self.x_mm:.0f} mm forward, {self.y_mm:.0f} to the left, turned {self.heading:.0f} degrees in "
            f"{self.seconds:.1f} s ({self.forward_mm_s:.0f} mm/s, {self.turn_deg_s:.1f} degrees/s)"
        )


@functools.lru_cache(maxsize=8)
def _robot(name):
    return load(name)


def first_pose(image, page, robot):
    """{servo: position} of step 1 of a page. Joints that the page does not use are at 512."""
    at = page * 512 + 64
    words = {servo: image[at + 2 * servo] | image[at + 2 * servo + 1] << 8 for servo in robot.servos}
    return {servo: word if word <= 1023 else 512 for servo, word in words.items()}


def try_motion(image, page, seconds, robot="humanoid", variation=NOMINAL, law="exact", keys=(), models=None, pose=None, lie=None, falls=True):
    """Plays `page` for at most `seconds` and returns the Outcome.

    robot     a name, a path, or a Description
    keys      [(second, code)] of a remote in ascending order; code 0: released, 255 (STOP): stop
    models    {servo: "ax18"}; the others are AX-12
    pose      {servo: position} at the start; default: step 1 of the page, where the approach leaves the robot
    lie       "face" or "back": starts lying instead of standing
    falls     False: tilting is not a fall (motions that go to the floor); then only on_feet decides
    """
    robot = robot if isinstance(robot, Description) else _robot(str(robot))
    physics = Physics(robot, variation)
    begin = first_pose(image, page, robot) | (pose or {})
    if lie:
        physics.lie(begin, face_down=lie == "face")
    else:
        physics.stand(begin)
    quick = Quick(image, physics, models)
    quick.torque_on()
    quick.run(int(SETTLE_S * TICKS_PER_S))
    quick.start(page, law)
    return watch(quick, physics, seconds, keys, falls and not lie)


def watch(player, physics, seconds, keys=(), falls=True):
    """Observes a play that has just begun, and returns its Outcome. player: run(ticks) runs and returns whether the play goes on,
    keys(code) holds keys of the remote, loads() returns the servo loads (quick.Quick, tests/campaigns/onboard.py)."""
    keys = list(keys)
    outcome, zero_s = Outcome(), physics.time_s
    frame = physics.x_mm, physics.y_mm, math.radians(physics.heading)
    pushes = sorted(physics.variation.pushes, key=lambda push: push.at_s)
    pushed = None
    playing = True
    while playing and (now := physics.time_s - zero_s) < seconds:
        while keys and keys[0][0] <= now:
            player.keys(keys.pop(0)[1])
        pushed = _push(physics, pushes, pushed, now)
        playing = player.run(CHUNK)
        outcome.track.append(look(physics, frame, zero_s))
        outcome.touched |= {pair for pair in physics.touching() if "floor" not in pair}
        if falls and physics.upright < FALLEN:
            outcome.fell_s = physics.time_s - zero_s
            break
    outcome.seconds, outcome.ended = physics.time_s - zero_s, not playing
    outcome.loads = player.loads()
    physics.let_go()
    if outcome.fell_s is None:
        player.run(int(AFTER_S * TICKS_PER_S))
        if falls and physics.upright < FALLEN:
            outcome.fell_s = physics.time_s - zero_s
        outcome.on_feet = stands(physics)
    _measure(outcome)
    return outcome


def _push(physics, pushes, pushed, now):
    """Begins and ends pushes. Returns when the current push ends."""
    if pushed is not None and now >= pushed:
        physics.let_go()
        pushed = None
    if pushed is None and pushes and pushes[0].at_s <= now:
        push = pushes.pop(0)
        physics.push(push.newton_s, push.towards)
        pushed = now + PUSH_S
    return pushed


def stands(physics):
    """True: upright, with only soles on the floor."""
    on_floor = {name for pair in physics.touching() if "floor" in pair for name in pair} - {"floor"}
    return physics.upright > ON_FEET and on_floor <= {"right_sole", "left_sole"}


def look(physics, frame, zero_s):
    """Present position. frame: (x, y, heading in radians) at zero_s."""
    x0, y0, turned = frame
    x, y = physics.x_mm - x0, physics.y_mm - y0
    return Look(
        physics.time_s - zero_s,
        x * math.cos(turned) + y * math.sin(turned),
        y * math.cos(turned) - x * math.sin(turned),
        physics.heading - math.degrees(turned),
        physics.upright,
    )


def _measure(outcome):
    if not outcome.track:
        return
    last = outcome.track[-1]
    outcome.x_mm, outcome.y_mm, outcome.heading = last.x_mm, last.y_mm, last.heading
    outcome.forward_mm_s, outcome.sideways_mm_s, outcome.turn_deg_s = pace(
        [seen for seen in outcome.track if seen.time_s >= min(WARM_S, last.time_s / 2)]
    )


def pace(looks):
    """(mm/s forward, mm/s to the left, degrees/s) over these looks, in the robot's own frame, in intervals of one second: sway cancels out,
    and a turn does not shorten the distance. Zeros if they span no time."""
    span = looks[-1].time_s - looks[0].time_s if looks else 0
    if span <= 0:
        return 0.0, 0.0, 0.0
    forward = sideways = 0.0
    stride = max(1, round((len(looks) - 1) / span))
    marks = looks[::stride] + ([looks[-1]] if (len(looks) - 1) % stride else [])
    for before, after in zip(marks, marks[1:]):
        ahead = math.radians((before.heading + after.heading) / 2)
        dx, dy = after.x_mm - before.x_mm, after.y_mm - before.y_mm
        forward += dx * math.cos(ahead) + dy * math.sin(ahead)
        sideways += dy * math.cos(ahead) - dx * math.sin(ahead)
    return forward / span, sideways / span, (looks[-1].heading - looks[0].heading) / span
