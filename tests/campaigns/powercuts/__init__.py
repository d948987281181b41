# SPDX-License-Identifier: MIT
"""The scenes of the power cuts (tests/campaigns/power.py), and the code that plays them."""
