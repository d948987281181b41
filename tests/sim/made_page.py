# SPDX-License-Identifier: MIT
"""Builds motion pages for tests."""

from m512.files.page import Page

JOINTS = range(1, 19)


def page(name="", steps=(), joints=JOINTS, **fields):
    """steps: (time, {joint: position}) or (time, {...}, pause). Joints that are not named get 512."""
    made = Page()
    made.name = name.encode()
    made.steps = len(steps)
    for number, step in enumerate(steps):
        time, positions, pause = step if len(step) == 3 else (*step, 0)
        for joint in joints:
            made.set_word(number, joint, positions.get(joint, 512))
        made.set_time(number, time)
        made.set_pause(number, pause)
    for field, value in fields.items():
        setattr(made, field, value)
    return made.seal()
