# SPDX-License-Identifier: MIT
"""A second implementation of the player: the order of steps and the exact law of motion."""
