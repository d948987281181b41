# SPDX-License-Identifier: MIT
"""The commands motion512-play and motion512-edit: each runs the program of that name next to this file."""
import os
import pathlib
import sys


def _become(name):
    program = pathlib.Path(__file__).with_name(name)
    os.execv(program, [str(program), *sys.argv[1:]])


def play():
    _become("motion512-play")


def edit():
    _become("motion512-edit")
