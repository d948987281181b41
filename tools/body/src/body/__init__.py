# SPDX-License-Identifier: MIT
"""The robot's body: what it is made of (description), and how it moves (physics). See ../../README.md."""
