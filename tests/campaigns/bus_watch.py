# SPDX-License-Identifier: MIT
"""Checks the traffic on the servo bus: every tick has a frame, no goal leaps, and only permitted joints are driven."""

from cm5sim.board import CYCLES_PER_TICK, sync_goals

WRITE, REG_WRITE, SYNC_WRITE = 3, 4, 0x83
TORQUE_AT, GOAL_AT = 24, 30


def phase_of(board):
    """Returns a cycle at which a tick begins."""
    board.run_to("__vector_12")
    return board.now_cycles


def frames_of(packets):
    """Returns [(cycle, {joint: goal})] of the SYNC WRITEs that carry goals."""
    return [(cycle, goals) for cycle, packet in packets if (goals := sync_goals(packet))]


def missing_ticks(frames, phase):
    """Returns the number of ticks without a frame, between the first and the last frame. A frame may be late by less than a tick while
    the board waits for a servo that has just become silent. The next frame is then on time in the same tick, and none is missing."""
    ticks = [(cycle - phase) // CYCLES_PER_TICK for cycle, _ in frames]
    lost = ticks[-1] - ticks[0] + 1 - len(ticks) if ticks else 0
    return abs(lost) + sum(b - a > 2 for a, b in zip(ticks, ticks[1:]))


def largest_steps(frames):
    """Returns (largest step of a goal between two ticks, largest change of that step), over all joints."""
    step_max = change_max = 0
    goal, step, last = {}, {}, 0
    for cycle, goals in frames:
        if cycle - last > 1.5 * CYCLES_PER_TICK:
            goal = step = {}
        last, steps = cycle, {}
        for joint, pos in goals.items():
            if joint in goal:
                steps[joint] = pos - goal[joint]
                step_max = max(step_max, abs(steps[joint]))
                if joint in step:
                    change_max = max(change_max, abs(steps[joint] - step[joint]))
        goal, step = goals, steps
    return step_max, change_max


def last_step(frames, failed):
    """Returns the largest step of a goal into the last frame, over joints without fault. It is 0 or 1 if they slowed to a stop."""
    if len(frames) < 2:
        return 0
    (_, before), (_, last) = frames[-2:]
    return max((abs(pos - before[joint]) for joint, pos in last.items() if joint in before and joint not in failed), default=0)


def written(packets, address, value=None):
    """Returns the IDs of the servos for which a WRITE or REG WRITE covered this address (with this value, if given)."""
    return {
        packet[2]
        for _, packet in packets
        if packet[4] in (WRITE, REG_WRITE) and packet[5] <= address < packet[5] + len(packet) - 7 and value in (None, packet[6 + address - packet[5]])
    }
