# SPDX-License-Identifier: MIT
"""The order of steps and the two laws of motion, told a second time; drawings of them."""
