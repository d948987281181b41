# SPDX-License-Identifier: MIT
"""Takes some pages of an image, and all that they lead to, into an image with room for them.

A page keeps its number if the new image has it. The others get free numbers, in order. Links and blend partners follow; link codes and a
page's own remote code stay. A link to a page that holds nothing, where a play ends, becomes empty, because another page may take that
number; it is listed as a loss.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from m512.errors import RefusedError
from m512.files.image import Image
from m512.files.page import Page
from m512.files.wording import field_text, named_pages_text, pages_text

LINKS = Page.LINKS + Page.PARTNERS


@dataclass
class Excerpt:
    image: Image
    moved: dict[int, int] = field(default_factory=dict)  # old number -> new one, of all pages taken
    left: list[int] = field(default_factory=list)  # pages that hold something and were not taken
    losses: list[str] = field(default_factory=list)  # links that became empty

    def notes(self, whole: Image, wanted: Iterable[int]) -> list[str]:
        """What was taken, renumbered and left out, in words."""
        more = sorted(set(self.moved) - set(wanted))
        out = [f"{_named(whole, more)}: taken too, because what was asked for leads there"] if more else []
        out += (
            [f"renumbered: {', '.join(_runs({old: new for old, new in self.moved.items() if old != new}))}"]
            if any(old != new for old, new in self.moved.items())
            else []
        )
        return out + ([f"{_named(whole, self.left)}: left out"] if self.left else [])


def excerpt(image: Image, wanted: Iterable[int], count: int) -> Excerpt:
    """The pages `wanted` and all that they lead to, in an image of `count` pages. RefusedError: more pages than that."""
    used = set(image.used())
    taken = _reached(image, set(wanted) & used, used) - {0}
    room = range(1, count)
    if len(taken) > len(room):
        raise RefusedError(f"with all that they lead to these are {len(taken)} pages, and there is room for {len(room)}. Ask for fewer")
    kept = {number: number for number in taken if number in room}
    free = iter(sorted(set(room) - set(kept)))
    moved = {**kept, **{number: next(free) for number in sorted(taken - set(kept))}}
    out = Image([Page() for _ in range(count)], 0, image.bits, list(image.notes), dict(image.joints), image.form)
    out.given = None if image.given is None else set(moved.values())
    if image.first == 0:
        out[0] = image[0]
    losses = []
    for old, new in moved.items():
        out[new] = image[old]
        if not image[old].fault(image.kind):
            losses += _follow(out[new], new, moved)
    return Excerpt(out, moved, sorted(used - taken - {0}), losses)


def _reached(image: Image, start: set[int], used: set[int]) -> set[int]:
    found, todo = set(start), list(start)
    while todo:
        page = image[todo.pop()]
        links = set() if page.fault(image.kind) else {getattr(page, link) for link in LINKS} & used - found
        found |= links
        todo += links
    return found


def _follow(page: Page, number: int, moved: dict[int, int]) -> list[str]:
    """Returns the losses, with the page's new number."""
    losses = []
    for link in LINKS:
        target = getattr(page, link)
        if target and target not in moved:
            losses.append(f'page {number} "{page.title}": {field_text(link)} {target} becomes none, because page {target} holds no motion')
        setattr(page, link, moved.get(target, 0))
    page.seal()
    return losses


def _named(image: Image, numbers: list[int]) -> str:
    return named_pages_text({number: image[number].title for number in numbers})


def _runs(moved: dict[int, int]) -> list[str]:
    """["page 200 becomes 5", "pages 130..140 become 6..16"]."""
    runs: list[list[int]] = []
    for old in sorted(moved):
        if runs and old == runs[-1][-1] + 1 and moved[old] == moved[old - 1] + 1:
            runs[-1].append(old)
        else:
            runs.append([old])
    return [f"{pages_text(run)} become{'s' if len(run) == 1 else ''} {pages_text(moved[old] for old in run).split(' ', 1)[1]}" for run in runs]
