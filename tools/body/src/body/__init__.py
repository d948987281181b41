# SPDX-License-Identifier: MIT
"""The robot's body: its parts (description) and its motion (physics). See ../../README.md."""
