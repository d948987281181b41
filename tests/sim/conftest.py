# SPDX-License-Identifier: MIT
"""The robot of the tests of Edit. Its flash holds the pages of edit_base.py, or PAGES of the test file."""

import pytest


@pytest.fixture(scope="module")
def shared(request):
    """One robot with Edit for all tests of a file."""
    from tests.sim import edit_base
    from tests.sim.edit_robot import robot

    with robot(pages=getattr(request.module, "PAGES", edit_base.PAGES)) as one:
        yield one


@pytest.fixture
def r(shared):
    """The file's robot with page 1 as in flash, at X1 Y0."""
    from tests.sim.edit_base import opened

    return opened(shared)
