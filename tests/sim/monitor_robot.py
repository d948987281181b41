# SPDX-License-Identifier: MIT
"""A robot with the Monitor image on the simulated board, for test_monitor*.py."""

from cm5sim import Board


def robot(servos=range(1, 19)):
    board = Board(images=["monitor-cm5.hex"], servos=servos)
    board.expect("[CID:001(0X01)] ", ms=2000)
    return board


def say(board, *lines):
    """The monitor's output for these lines, as one text."""
    board.take()
    heard = b""
    for line in lines:
        board.send(line.encode() + b"\r")
        board.run(ms=2500 if line in ("search", "scan") else 300 if line == "?" else 120)
        heard += board.take()
    return heard.decode("latin-1")
