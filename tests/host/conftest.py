# SPDX-License-Identifier: MIT
"""Robots for a test. Repeats a test that other load on this computer has disturbed."""

import threading
import time

import pytest
from _pytest.runner import runtestprotocol

TRIES = 5
HELD_UP_S = 0.05  # a 10 ms sleep that takes this long


class Watch(threading.Thread):
    """Notices when this computer holds its programs up."""

    def __init__(self):
        super().__init__(daemon=True)
        self.held_up = False

    def run(self):
        while True:
            begun = time.monotonic()
            time.sleep(0.01)
            self.held_up |= time.monotonic() - begun > HELD_UP_S


watch = Watch()


def pytest_sessionstart():
    watch.start()


def pytest_runtest_protocol(item, nextitem):
    """Repeats a failed test if programs were held up meanwhile, because its result means nothing then. The last try counts."""
    for left in reversed(range(TRIES)):
        watch.held_up = False
        reports = runtestprotocol(item, log=False, nextitem=nextitem)
        failed = [str(report.longrepr) for report in reports if report.failed]
        if left == 0 or not failed or not (watch.held_up or "Disturbed" in "".join(failed)):
            break
        item.config.get_terminal_writer().line(f"{item.name}: programs were held up: once more")
    item.ihook.pytest_runtest_logstart(nodeid=item.nodeid, location=item.location)
    for report in reports:
        item.ihook.pytest_runtest_logreport(report=report)
    item.ihook.pytest_runtest_logfinish(nodeid=item.nodeid, location=item.location)
    return True


@pytest.fixture
def make(tmp_path):
    """Makes robots that live until the test ends."""
    from tests.host.pc_robot import Robot

    robots = []

    def make(**how):
        robots.append(Robot(tmp_path, **how).__enter__())
        return robots[-1]

    yield make
    for robot in robots:
        watch.held_up |= robot.was_late()
        robot.__exit__()
