# SPDX-License-Identifier: MIT
"""The robots of endurance.py: one that walks for an hour (walk.py), and an editor that saves continuously (edit.py)."""
