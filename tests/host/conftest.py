# SPDX-License-Identifier: MIT
"""Robots of a test."""

import pytest


@pytest.fixture
def make(tmp_path):
    """Makes robots that end with the test."""
    from tests.host.pc_robot import Robot

    robots = []

    def make(**how):
        robots.append(Robot(tmp_path, **how).__enter__())
        return robots[-1]

    yield make
    for robot in robots:
        robot.__exit__()
