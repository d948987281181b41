# SPDX-License-Identifier: MIT
"""The simulated CM-5 / CM-2 board for Python tests: class Board (board.py) and its servos (servo.py)."""

from .board import Board, PowerCut, Violation

__all__ = ["Board", "PowerCut", "Violation"]
