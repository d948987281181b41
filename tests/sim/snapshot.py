# SPDX-License-Identifier: MIT
"""Runs many attempts from one state of a simulated robot: each runs in a copy of the process (fork), so the original does not change.

A thousand attempts start in exactly the same cycle of the same play, and each can be repeated alone.
"""

import os
import pickle
import traceback


class Failed(Exception):
    """The attempt itself raised an exception; the text is its traceback."""


def attempt(work, *arguments):
    """Runs work(*arguments) in a copy of this process. Returns its result, which must be picklable."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        os.close(read)
        try:
            result = (True, work(*arguments))
        except BaseException:  # pylint: disable=broad-except  (everything goes to the parent)
            result = (False, traceback.format_exc())
        with os.fdopen(write, "wb") as pipe:
            pickle.dump(result, pipe)
        os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        data = pipe.read()
    os.waitpid(child, 0)
    if not data:
        raise Failed("the copy died without a word")
    good, result = pickle.loads(data)
    if not good:
        raise Failed(result)
    return result
