# SPDX-License-Identifier: MIT
"""A robot with limp servos cannot stand. A hand holds it until they drive, then puts it on its soles and lets go."""

from .trial import FALLEN, ON_FEET

STILL_DEGREES_S = 6.0  # a slower joint counts as still
STILL_S = 0.1


class Hand:
    """Call look() regularly while the body is stepped. The hand holds the robot until a knee was driven and all joints have been still for
    STILL_S. From then on it counts falls."""

    def __init__(self, physics):
        self.physics, self.falls, self.fell_at_s = physics, 0, []
        self._knees = [servo for servo, joint in physics.robot.joints.items() if joint.name.endswith("_knee")]
        self._driven, self._still_since, self._standing = False, None, False
        self.put_down_s = None
        physics.hold()
        self._at_start = self._angles()

    def _angles(self):
        return [self.physics.joint(servo) for servo in self._knees]

    def look(self):
        """Returns the latest event: "down", "fell", or None."""
        return self._holding() if self.put_down_s is None else self._watching()

    def _holding(self):
        physics = self.physics
        self._driven = self._driven or any(abs(now - then) > 0.05 for now, then in zip(self._angles(), self._at_start))
        if not self._driven or physics.fastest_joint > STILL_DEGREES_S:
            self._still_since = None
            return None
        if self._still_since is None:
            self._still_since = physics.time_s
        if physics.time_s - self._still_since < STILL_S:
            return None
        physics.put_down()
        self.put_down_s, self._standing = physics.time_s, True
        return "down"

    def _watching(self):
        upright = self.physics.upright
        if self._standing and upright < FALLEN:
            self._standing = False
            self.falls += 1
            self.fell_at_s.append(self.physics.time_s)
            return "fell"
        self._standing = self._standing or upright > ON_FEET
        return None
