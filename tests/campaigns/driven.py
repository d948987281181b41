# SPDX-License-Identifier: MIT
"""A driven walk: the shipped image on the simulated board, a body, and a hand on the stick that sends `@drive` lines.

    outcome = drive(image, page=20, ready=1, seconds=60, hand=hand)

hand(look) is called twenty times a second. It returns (blend, rate, amplitude) in percent, or a line to type, or None to stay silent as if
the cable were pulled. It sees what a person sees: the robot's position and heading.
"""

import math
from dataclasses import dataclass, field

from body.chance import NOMINAL
from body.description import Description, load
from body.physics import Physics
from body.trial import FALLEN, look, stands
from tests.campaigns.onboard import OnBoard

TICKS_A_LINE = 6  # 47 ms: a joystick's twenty lines a second
AFTER_TICKS = 96  # standing time before the feet are checked: 0.75 s


@dataclass
class Driven:
    """The result of a drive."""

    fell_s: float = None  # time of the fall; None: no fall
    ended: bool = False  # the play ended
    on_feet: bool = False
    track: list = field(default_factory=list)  # one trial.Look for each call of the hand
    goals: list = field(default_factory=list)  # {servo: goal} of each frame on the bus, if requested

    def said(self):
        how = f"fell after {self.fell_s:.1f} s" if self.fell_s is not None else "on its feet" if self.on_feet else "not on its feet"
        last = self.track[-1]
        return f"{how}; {last.x_mm:.0f} mm forward, {last.y_mm:.0f} to the left, turned {last.heading:.0f} degrees in {last.time_s:.1f} s"


def drive(image, page, ready, seconds, hand, robot="humanoid", variation=NOMINAL, keep_goals=False):
    """Plays `page` for at most `seconds`. ready: the page that brings the robot to its feet first. With keep_goals, Driven.goals holds
    the frames sent since the play began."""
    robot = robot if isinstance(robot, Description) else load(str(robot))
    physics = Physics(robot, variation)
    player = OnBoard(image, physics)
    player.stand_up(ready)
    player.start(page)
    player.board.clear_trace()
    outcome, zero_s = Driven(), physics.time_s
    frame = physics.x_mm, physics.y_mm, math.radians(physics.heading)
    playing = True
    while playing and physics.time_s - zero_s < seconds:
        outcome.track.append(look(physics, frame, zero_s))
        wish = hand(outcome.track[-1])
        if isinstance(wish, str):
            player.board.send(wish + "\r")
        elif wish is not None:
            player.board.send("@drive {:.0f} {:.0f} {:.0f}\r".format(*wish))
        playing = player.run(TICKS_A_LINE)
        if physics.upright < FALLEN:
            outcome.fell_s = physics.time_s - zero_s
            return outcome
    outcome.ended = not playing
    if keep_goals:
        outcome.goals = [frame.goals for frame in player.board.trace if len(frame.goals) > 1]
    player.run(AFTER_TICKS)
    outcome.on_feet = stands(physics)
    if physics.upright < FALLEN:
        outcome.fell_s = physics.time_s - zero_s
    return outcome


class Stick:
    """A stick moved by hand. It moves 50 % per second towards the wanted position."""

    A_LINE = 2.5  # percent

    def __init__(self, blend=0.0, rate=100.0, amplitude=100.0):
        self.at = (blend, rate, amplitude)

    def towards(self, *wish):
        """Returns the position one line later: (blend, rate, amplitude)."""
        self.at = tuple(at + max(-self.A_LINE, min(self.A_LINE, to - at)) for at, to in zip(self.at, wish))
        return self.at


class Eight:
    """A hand that steers a figure of eight by sight: a circle to the left, then one to the right, `length_mm` across both.

    The robot responds late: a line acts two steps later, and the trunk's sway averages out only over a whole cycle. So the hand steers for
    the robot's future position. It corrects errors of position and of heading. At the end it releases the stick, and the board's watchdog
    stops the walk.
    """

    FULL = 1 / 240  # curvature (1 / radius in mm) at blend 100, as measured with the library on the nominal body
    CYCLE_LINES = 9  # lines per walk cycle of 56 ticks
    LATE_S = 0.5
    BACK_MM = 130.0  # distance within which it returns to the path

    def __init__(self, length_mm=1000.0):
        self.radius = length_mm / 4
        self.turns = 0.0  # position along the path, 0..2: the first turn to the left, the second to the right
        self.farthest_mm, self._seen = 0.0, []

    @property
    def done(self):
        return self.turns >= 1.99

    def path(self, turns):
        """Returns the point, the direction (radians) and the curvature of the path at this position."""
        side = 1 if turns < 1 else -1
        around = 2 * math.pi * min(turns, 2) * side
        return self.radius * math.sin(around) * side, side * self.radius * (1 - math.cos(around)), around, side / self.radius

    def __call__(self, seen):
        self._seen = [*self._seen[-self.CYCLE_LINES :], seen]
        if self.done:
            return None
        x, y, looks = self._soon()
        self.turns = self._nearest(x, y)
        px, py, along, curve = self.path(self.turns)
        beside = (y - py) * math.cos(along) - (x - px) * math.sin(along)  # offset to the left of the path
        turned = (looks - along + math.pi) % (2 * math.pi) - math.pi
        wish = curve - 2 * turned / self.BACK_MM - beside / self.BACK_MM**2
        self.farthest_mm = max(self.farthest_mm, abs(beside))
        return max(-100, min(100, -100 * wish / self.FULL)), 100, 100

    def _soon(self):
        """Predicts position and heading: the mean over a cycle, projected half a cycle and LATE_S ahead."""
        count, first, last = len(self._seen), self._seen[0], self._seen[-1]
        mean = [sum(getattr(place, name) for place in self._seen) / count for name in ("x_mm", "y_mm", "heading")]
        seconds = max(last.time_s - first.time_s, 1e-3)
        later = seconds / 2 + (self.LATE_S if count > self.CYCLE_LINES else 0)
        looks, turn = math.radians(mean[2]), math.radians(last.heading - first.heading) / seconds
        speed = math.dist((last.x_mm, last.y_mm), (first.x_mm, first.y_mm)) / seconds
        middle = looks + turn * later / 2
        return mean[0] + speed * later * math.cos(middle), mean[1] + speed * later * math.sin(middle), looks + turn * later

    def _nearest(self, x, y):
        """Returns the position along the path: the nearest point, from the last position to an eighth of a turn further."""
        return min((self.turns + k / 400 for k in range(51)), key=lambda turns: math.dist(self.path(turns)[:2], (x, y)))


def rounds(track, middle):
    """Returns how often a track circles a point; positive to the left."""
    angles = [math.atan2(seen.y_mm - middle[1], seen.x_mm - middle[0]) for seen in track]
    return sum((b - a + math.pi) % (2 * math.pi) - math.pi for a, b in zip(angles, angles[1:])) / (2 * math.pi)
