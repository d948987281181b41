# SPDX-License-Identifier: MIT
"""Results of body campaigns: one line of JSON for each body, written as soon as it was tried.

An interrupted campaign resumes, and one of 1,000 bodies can be done in parts. A line counts only for the conditions in its key: the pages
that the motion can reach, how it is driven, the body file and the version of MuJoCo. A changed motion therefore starts again by itself. The
key does not cover the player or the servos: after changing those, delete the file.
"""

import hashlib
import json
import pathlib

import mujoco

PAGE_BYTES = 512


def reachable(library, number):
    """Returns the numbers of the pages that a play of this page can reach."""
    playable = {other: page for other, page in library.items() if other and page.is_playable}
    found, waiting = set(), {number}
    while waiting:
        other = waiting.pop()
        found.add(other)
        page = playable[other]
        waiting |= {getattr(page, name) for name in (*page.LINKS, *page.PARTNERS)} & set(playable) - found
    return found


def key_of(library, number, promise, robot, where):
    """Returns the key of a result. where: what drove the motion, "player" or "board"."""
    image = library.to_bytes()
    pages = b"".join(image[PAGE_BYTES * page : PAGE_BYTES * (page + 1)] for page in sorted(reachable(library, number)))
    how = (promise.page, promise.seconds, promise.keys, promise.lie, promise.floor, where)
    return hashlib.sha256(pages + repr((*how, mujoco.__version__)).encode() + robot.xml().encode()).hexdigest()[:16]


class Tried:
    """The file of results. Only the process that runs the campaign writes to it."""

    def __init__(self, path):
        self.path, self._found = pathlib.Path(path), {}
        for line in self.path.read_text(encoding="utf-8").splitlines() if self.path.exists() else ():
            try:
                one = json.loads(line)
                self._found.setdefault(one["key"], {})[one["seed"]] = (one["kept"], one["said"])
            except (ValueError, KeyError):  # incomplete: the campaign ended during the write
                continue

    def of(self, key):
        """Returns {seed: (kept, message)}."""
        return dict(self._found.get(key, {}))

    def add(self, key, seed, result, **about):
        """about: additional facts for readers of the file."""
        kept, said = result
        self._found.setdefault(key, {})[seed] = (kept, said)
        self.path.parent.mkdir(parents=True, exist_ok=True)
        torn = self.path.exists() and not self.path.read_bytes().endswith(b"\n")
        with self.path.open("a", encoding="utf-8") as file:
            file.write(("\n" if torn else "") + json.dumps({**about, "key": key, "seed": seed, "kept": bool(kept), "said": said}) + "\n")


def seeds_said(seeds):
    """ "1000-1099, 1150": as people write them."""
    runs = []
    for seed in sorted(seeds):
        if runs and seed == runs[-1][1] + 1:
            runs[-1][1] = seed
        else:
            runs.append([seed, seed])
    return ", ".join(str(first) if first == last else f"{first}-{last}" for first, last in runs)
