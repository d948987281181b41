# SPDX-License-Identifier: MIT
"""The scenes of the power cuts (tests/prove/power.py) and what plays them."""
