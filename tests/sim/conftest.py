# SPDX-License-Identifier: MIT
"""The robot of the tests of Edit, for files that ask for it. In its flash are the pages of edit_base.py, or the file's own PAGES.
And the paths of our packages, so that pytest by hand finds them as ctest does."""
import pathlib
import sys

import pytest

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(TOP / path) for path in ("tools/sim/python", "tools/m512/src", "tools/body/src", "tools/campaign")]


@pytest.fixture(scope="module")
def shared(request):
    """One robot with Edit for all tests of a file."""
    import edit_base
    from edit_robot import robot
    with robot(pages=getattr(request.module, "PAGES", edit_base.PAGES)) as one:
        yield one


@pytest.fixture
def r(shared):
    """The file's robot with page 1 as it is in flash, at X1 Y0."""
    from edit_base import opened
    return opened(shared)
