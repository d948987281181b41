# SPDX-License-Identifier: MIT
"""A state of a simulated robot, tried many times: each try runs in a copy of the process (fork), the original stays as it is.

So a thousand experiments begin in exactly the same cycle of the same play, and any one of them can be repeated alone.
"""

import os
import pickle
import traceback


class Failed(Exception):
    """The try itself broke down: the text is its traceback."""


def attempt(work, *arguments):
    """work(*arguments) in a copy of this process; its result, which must be picklable."""
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
