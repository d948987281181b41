# SPDX-License-Identifier: MIT
"""A robot with Edit and pages to play, for tests of Edit's effects on servos: 5 a pose, open at the start; 6 a loop with exit page 7; 8 a
long page; 9 and 10 are each other's exit page."""

from tests.sim.edit_robot import page, robot

POSE = page("pose", [(64, {1: 400, 2: 700}), (64, {3: 612})], code=1)


def start(**options):
    pages = {
        1: page("neutral", [(40, {})]),
        5: POSE,
        6: page("loop", [(40, {1: 560}), (40, {1: 464})], next=6, exit=7),
        7: page("end", [(30, {})]),
        8: page("long", [(255, {1: 800}), (255, {1: 200})], repeat=20, exit=7, speed=64),
        9: page("la", [(30, {})], next=9, exit=10),
        10: page("lb", [(30, {})], exit=9),
    }
    pages.update(options.pop("pages", {}))
    r = robot(pages=pages, **options)
    r.line("page 5")
    return r


def goals(r):
    return {joint: r.board.servos[joint].goal for joint in range(1, 19)}


def writes_since(r, mark):
    return [bytes(packet) for _, packet in r.board.packets[mark:] if packet[4] == 3]
