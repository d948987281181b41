# SPDX-License-Identifier: MIT
"""Which board a factory's boot loader says that it is on. Its banner begins with the board's name ("CM5 Boot loader V1.31"), and loaders of
other boards speak the same words; their flash is laid out in another way, so that what m512 writes would hurt.

    a name of ours         goes on
    a name of the family   refused, whatever the user says
    another name, or none  refused, until the user says which board it is (--board)
"""

from __future__ import annotations

import re

from m512.errors import RefusedError

BOARDS = {"CM5": "cm5", "CM2": "cm2", "CM2+": "cm2"}
OURS = "CM-2, CM-2+ and CM-5"
_BANNER = re.compile(rb"SYSTEM O\.K\. \(([ -~]{1,40}?) boot ?loader\b", re.I)
# A banner of another shape is read for the name of another board alone.
_STRANGER = re.compile(rb"\b((?:CM[- ]?|Open ?C[MR][- ]?)[0-9.]{2,}\w*|Open ?C[MR]\b)", re.I)
_FAMILY = re.compile(r"CM(?![25](?![0-9]))[0-9]|OPENC[MR]")


def name_in(text: bytes) -> str:
    """The board's name in what a loader has said; empty: it is not there, or the line has damaged the banner."""
    found = _BANNER.search(text) or _STRANGER.search(text)
    return found.group(1).decode().strip() if found else ""


def board_of(name: str, told: str = "") -> str:
    """cm5 or cm2, of a name that a loader has said and of what the user has said (cm5, cm2, or nothing). RefusedError: another board, one that
    nobody knows, or one that the user takes for another."""
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
