# SPDX-License-Identifier: MIT
"""For faults.py: the faults of servos (model.py) and the robots that have them (robots.py)."""
