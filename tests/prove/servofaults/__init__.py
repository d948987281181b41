# SPDX-License-Identifier: MIT
"""What befalls the servos of faults.py (model.py), the robots it befalls (robots.py)."""
