# SPDX-License-Identifier: MIT
"""A body in MuJoCo: it moves the servo shafts and has a place in the world.

    physics = Physics(load("humanoid"))            # or with a Variation (chance.py)
    physics.stand({11: 609, 12: 415, ...})         # on its soles in this pose
    board.attach(physics)                          # cm5sim: in lock step with the simulated board
    physics.upright, physics.x_mm, physics.heading # while it runs

One step is 1/1024 s. The simulated servos step the body through `seam` and set its torques.
"""

import ctypes
import functools
import pathlib
from math import atan2, cos, degrees, radians, sin

import mujoco
import numpy

from .chance import NOMINAL
from .description import UNITS_PER_RADIAN

STEP_S = 1 / 1024
PUSH_S = 1 / 32
ROOT_NUMBERS, ROOT_SPEEDS = 7, 6  # of the free joint, in qpos and qvel
P, D, I32 = ctypes.c_void_p, ctypes.POINTER(ctypes.c_double), ctypes.c_int32


class SeamJoint(ctypes.Structure):
    """servo_mujoco_joint_t"""

    _fields_ = [("angle", D), ("speed", D), ("torque", D), ("direction", ctypes.c_double), ("offset_rad", ctypes.c_double), ("id", I32)]


class Seam(ctypes.Structure):
    """servo_mujoco_t"""

    _fields_ = [("mj_step", P), ("model", P), ("data", P), ("joints", ctypes.POINTER(SeamJoint)), ("count", I32)]


@functools.cache
def _mj_step():
    """Address of mj_step in the library loaded by the Python package."""
    folder = pathlib.Path(mujoco.__file__).parent
    found = sorted(folder.glob("libmujoco*.so*")) + sorted(folder.glob("libmujoco*.dylib")) + sorted(folder.glob("mujoco*.dll"))
    if not found:
        raise RuntimeError(f"no MuJoCo library in {folder}; install it again: tools/dev/setup physics")
    return ctypes.cast(ctypes.CDLL(str(found[0])).mj_step, P)


class Physics:
    """A body that stands, walks and falls. Lengths in mm, angles in degrees."""

    def __init__(self, robot, variation=NOMINAL):
        self.robot, self.variation = robot, variation
        self.model = mujoco.MjModel.from_xml_string(robot.xml())
        if abs(self.model.opt.timestep - STEP_S) > 1e-12:
            raise ValueError(f'{robot.path}: the time step must be 1/1024 s (option timestep="0.0009765625")')
        self._vary()
        self.data = mujoco.MjData(self.model)
        self.root = self.model.body(1).id
        self._names = [self.model.geom(geom).name for geom in range(self.model.ngeom)]
        self._places = {
            servo: (self.model.joint(joint.name).qposadr[0], self.model.joint(joint.name).dofadr[0]) for servo, joint in robot.joints.items()
        }
        self.seam = self._make_seam()
        self._turns, self._last_yaw = 0.0, 0.0

    # What varies

    def _vary(self):
        model, change = self.model, self.variation
        model.geom("floor").friction[0] = change.floor_friction
        down = radians(change.tilt)
        size = numpy.linalg.norm(model.opt.gravity)
        model.opt.gravity[:] = size * numpy.array(
            (sin(down) * cos(radians(change.tilt_towards)), sin(down) * sin(radians(change.tilt_towards)), -cos(down))
        )
        model.dof_armature[ROOT_SPEEDS:] = change.rotor_kgm2
        model.dof_frictionloss[ROOT_SPEEDS:] = change.gear_friction_nm
        for body, factor in change.mass.items():
            model.body(body).mass[0] *= factor
            model.body(body).inertia[:] *= factor
        model.body("trunk").ipos[0] += change.trunk_forward_mm / 1000
        for side in ("right", "left"):
            model.geom(f"{side}_sole").pos[0] += change.sole_forward_mm / 1000
            self._lengthen_hand(model.geom(f"{side}_hand"), change.hand_mm / 1000)

    @staticmethod
    def _lengthen_hand(geom, longer):
        """Lengthens the hand, a capsule along the forearm, at its far end."""
        geom.size[1] += longer / 2
        geom.pos[2] -= longer / 2

    def _make_seam(self):
        joints = (SeamJoint * len(self.robot.joints))()
        names = {self.model.actuator(k).trnid[0]: k for k in range(self.model.nu)}
        for place, (servo, joint) in zip(joints, self.robot.joints.items()):
            angle, speed = self._places[servo]
            motor = names[self.model.joint(joint.name).id]
            place.angle, place.speed, place.torque = (
                ctypes.cast(array.ctypes.data + 8 * int(at), D)
                for array, at in ((self.data.qpos, angle), (self.data.qvel, speed), (self.data.ctrl, motor))
            )
            place.direction, place.id = joint.direction, servo
            place.offset_rad = joint.angle(512 - self.variation.zero_units.get(servo, 0.0))
        self._joints = joints  # keeps the array alive with the seam
        return Seam(_mj_step(), self.model._address, self.data._address, joints, len(joints))

    # Poses

    def joint_angle(self, servo, position):
        """Angle of the joint in radians at the servo's `position`, including the error of its zero."""
        joint = self.robot.joints[servo]
        return joint.angle(512 - self.variation.zero_units.get(servo, 0.0)) + joint.direction * (position - 512) / UNITS_PER_RADIAN

    def pose(self, positions):
        """Sets joints ({servo: position}), at rest. The trunk and other joints keep their place."""
        self.data.qvel[:] = 0
        for servo, position in positions.items():
            if servo in self._places:
                self.data.qpos[self._places[servo][0]] = self.joint_angle(servo, position)
        mujoco.mj_forward(self.model, self.data)

    def joint(self, servo):
        """Angle of a joint in radians."""
        return float(self.data.qpos[self._places[servo][0]])

    def stand(self, positions, heading=0.0):
        """Puts the robot on its soles in this pose. The trunk leans as flat soles require."""
        self._root((1, 0, 0, 0))
        self.pose(positions)
        level = numpy.mean([self.data.body(f"{side}_foot").xmat.reshape(3, 3)[:, 2] for side in ("right", "left")], axis=0)
        lean, side = atan2(level[0], level[2]), atan2(level[1], level[2])
        # level: the up direction of the soles, in the trunk's frame
        quat = numpy.zeros(4)
        mujoco.mju_euler2Quat(quat, numpy.array((side, -lean, 0.0)), "xyz")
        self._root(quat, heading)
        self._down_to_the_floor()

    def lie(self, positions, face_down=True, heading=0.0):
        """Puts the robot on the floor in this pose, face down or on its back."""
        self.pose(positions)
        quat = numpy.zeros(4)
        mujoco.mju_euler2Quat(quat, numpy.array((0.0, radians(90 if face_down else -90), 0.0)), "xyz")
        self._root(quat, heading)
        self._down_to_the_floor()

    def hold(self):
        """A hand takes the robot by the trunk, upright, where straight legs just reach the floor."""
        self.data.qpos[:ROOT_NUMBERS] = self.model.qpos0[:ROOT_NUMBERS]
        self.data.qvel[:ROOT_SPEEDS] = 0
        self.data.eq_active[self._hand()] = 1
        mujoco.mj_forward(self.model, self.data)

    def put_down(self, heading=0.0):
        """The hand puts the robot on its soles, keeping its joint angles, and lets go."""
        self.data.eq_active[self._hand()] = 0
        self.stand({}, heading)

    def _hand(self):
        try:
            return self.model.equality("hand").id
        except KeyError:
            raise ValueError(f'{self.robot.path}: no <weld name="hand" body1="trunk">: nothing can hold this robot') from None

    @property
    def fastest_joint(self):
        """Speed of the fastest joint in degrees/s."""
        return degrees(max(abs(self.data.qvel[speed]) for _, speed in self._places.values()))

    def _root(self, quat, heading=0.0):
        turned, about = numpy.zeros(4), numpy.array((cos(radians(heading) / 2), 0, 0, sin(radians(heading) / 2)))
        mujoco.mju_mulQuat(turned, about, numpy.array(quat, dtype=float))
        self.data.qpos[:3] = (0, 0, 1)
        self.data.qpos[3:ROOT_NUMBERS] = turned
        self.data.qvel[:] = 0
        mujoco.mj_forward(self.model, self.data)
        self._turns, self._last_yaw = 0.0, self._yaw()

    def _down_to_the_floor(self):
        self.data.qpos[2] -= self.lowest_mm() / 1000
        mujoco.mj_forward(self.model, self.data)

    def lowest_mm(self):
        """Height of the lowest point that can touch the floor."""
        return 1000 * min(self._lowest(geom) for geom in range(self.model.ngeom) if self.model.geom_contype[geom] and self.model.geom_bodyid[geom])

    def _lowest(self, geom):
        up = numpy.abs(self.data.geom_xmat[geom].reshape(3, 3)[2])
        size, middle = self.model.geom_size[geom], self.data.geom_xpos[geom][2]
        kind = self.model.geom_type[geom]
        if kind == mujoco.mjtGeom.mjGEOM_BOX:
            return middle - up @ size
        if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
            return middle - up[2] * size[1] - size[0]
        return middle - self.model.geom_rbound[geom]

    # Where it is

    @property
    def time_s(self):
        return self.data.time

    @property
    def upright(self):
        """Trunk axis against gravity: 1 upright, 0 lying, -1 upside down."""
        return float(self.data.xmat[self.root][8])

    @property
    def x_mm(self):
        return 1000 * float(self.data.qpos[0])

    @property
    def y_mm(self):
        return 1000 * float(self.data.qpos[1])

    @property
    def z_mm(self):
        return 1000 * float(self.data.qpos[2])

    def _yaw(self):
        rotation = self.data.xmat[self.root].reshape(3, 3)
        return atan2(rotation[1, 0], rotation[0, 0])

    @property
    def heading(self):
        """Degrees turned left since it was placed, including whole turns. Valid only if read at least every half turn."""
        yaw = self._yaw()
        self._turns += (yaw - self._last_yaw + numpy.pi) % (2 * numpy.pi) - numpy.pi
        self._last_yaw = yaw
        return degrees(self._turns)

    def push(self, newton_s, towards):
        """Pushes the trunk from now on. Call let_go() after PUSH_S."""
        force = newton_s / PUSH_S
        self.data.xfrc_applied[self.root][:3] = (force * cos(radians(towards)), force * sin(radians(towards)), 0)

    def let_go(self):
        self.data.xfrc_applied[self.root][:] = 0

    def touching(self):
        """Pairs of names of geoms in contact."""
        return {tuple(sorted((self._names[one], self._names[other]))) for one, other in self.data.contact.geom.tolist()}
