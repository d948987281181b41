# SPDX-License-Identifier: MIT
"""Finds the board in the banner of a factory boot loader. The banner begins with the board's name ("CM5 Boot loader V1.31"). Loaders of
other boards use the same commands, but their flash layout differs, so what m512 writes would do harm.

    a supported name       accepted
    a name of the family   refused, whatever the user says
    another name, or none  refused, unless the user names the board (--board)
"""

from __future__ import annotations

import re

from m512.errors import RefusedError

BOARDS = {"CM5": "cm5", "CM2": "cm2", "CM2+": "cm2"}
OURS = "CM-2, CM-2+ and CM-5"
_BANNER = re.compile(rb"SYSTEM O\.K\. \(([ -~]{1,40}?) boot ?loader\b", re.I)
# A banner of another form is searched only for the name of another board.
_STRANGER = re.compile(rb"\b((?:CM[- ]?|Open ?C[MR][- ]?)[0-9.]{2,}\w*|Open ?C[MR]\b)", re.I)
_FAMILY = re.compile(r"CM(?![25](?![0-9]))[0-9]|OPENC[MR]")


def name_in(text: bytes) -> str:
    """The board's name in a loader's output; empty if it is missing or the line has damaged the banner."""
    found = _BANNER.search(text) or _STRANGER.search(text)
    return found.group(1).decode().strip() if found else ""


def board_of(name: str, told: str = "") -> str:
    """cm5 or cm2, from the loader's name for the board and the user's (cm5, cm2 or empty). RefusedError: an unsupported or unknown
    board, or names that contradict each other."""
    plain = re.sub(r"[- _]", "", name).upper()
    board = BOARDS.get(plain, "")
    if not board and _FAMILY.search(plain):
        raise RefusedError(f"the boot loader says that this is a {name}. m512 knows {OURS} only, so nothing was written. Is this the right port?")
    if not board and not told:
        who = f'the boot loader says that it is on a "{name}"' if name else "the boot loader does not say which board it is on"
        raise RefusedError(
            f"{who}, so nothing was written. If you know it, say it behind flash, run, backup, restore, pages or diff: --board cm5, "
            "or --board cm2 for a CM-2 or CM-2+"
        )
    if board and told and board != told:
        raise RefusedError(f"the boot loader says that this is a {name}, and --board says {told}. Nothing was written")
    return board or told
