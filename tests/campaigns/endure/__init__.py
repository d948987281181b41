# SPDX-License-Identifier: MIT
"""The robots of endurance.py: one that walks for an hour (walk.py), an editor that saves for ever (edit.py)."""
