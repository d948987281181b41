# SPDX-License-Identifier: MIT
"""The robot of the tests of Edit, for files that ask for it. In its flash are the pages of edit_base.py, or the file's own PAGES."""

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
    """The file's robot with page 1 as it is in flash, at X1 Y0."""
    from tests.sim.edit_base import opened

    return opened(shared)
