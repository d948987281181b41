# SPDX-License-Identifier: MIT
"""The operations of `m512 pages`. The functions that change the given image return remarks for the user."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from m512.errors import EmptyPageError, RefusedError, WordError
from m512.files.image import Image, is_erased
from m512.files.page import JOINTS, SCHEDULE_TIME, STEPS, Page, is_used
from m512.files.selection import means_pages, page_number
from m512.files.text.words import code_text
from m512.files.wording import field_text, named_pages_text, pages_text
from m512.motion.player import first_pose, page_seconds

NOMINAL_SPEED = 32


def check(image: Image) -> list[tuple[int, str]]:
    """(page, fault or oddity) for an image. Page 0 is checked as a trim, not as a motion."""
    out = []
    for number, page in image.items():
        if is_erased(page):
            continue
        fault = page.fault_text(image.kind)
        if fault:
            out.append((number, f"damaged: {fault}"))
            continue
        if not number and image.bits == 10 and page.trim_problem():
            out.append((number, page.trim_problem()))
        if not number or not page.is_playable:
            continue
        for link in Page.LINKS:
            problem = _dead_end(image, getattr(page, link))
            if problem:
                out.append((number, f"{field_text(link)} leads to {problem}"))
        if page.link1_page and not page.link1_code or page.link2_page and not page.link2_code:
            out.append((number, "a linked page has no code and is never followed"))
        out += [(number, problem) for problem in _partner_problems(image, page)]
        if page.schedule == SCHEDULE_TIME and any(page.time(k) == 0 for k in range(page.steps)):
            out.append((number, "a step has time 0 and is played in one tick"))
    return out


def _partner_problems(image: Image, page: Page) -> list[str]:
    """Why a blend partner is not used. The firmware then plays the page unblended."""
    out = []
    for side in Page.PARTNERS:
        number, where = getattr(page, side), field_text(side)
        if not number:
            continue
        if not image.first <= number < image.end:
            out.append(f"{where} leads to page {number}, which is not there")
        elif image[number].fault(image.kind) or not image[number].steps:
            out.append(f"{where} leads to page {number}, which is damaged or has no action")
        elif image[number].steps != page.steps:
            out.append(f"{where}: page {number} has {image[number].steps} steps and this one {page.steps}; it is not blended")
    return out


def remarks(image: Image) -> list[tuple[int, str]]:
    """(page, remark) about correct pages that may surprise."""
    out = []
    called: dict[int, int] = {}  # code -> the page that it calls: the lowest one (firmware/common/REMOTE.md)
    for number, page in image.items():
        if number and page.code and not page.fault(image.kind) and page.is_playable and called.setdefault(page.code, number) != number:
            out.append((number, f"code {code_text(page.code)} calls page {called[page.code]}, which has it, too, and never this one"))
        if number and not page.fault(image.kind) and page.is_playable and page.schedule == SCHEDULE_TIME and page.speed != NOMINAL_SPEED:
            factor = page.speed / NOMINAL_SPEED
            out.append(
                (
                    number,
                    f"speed {page.speed}: steps and pauses last {factor:.4g} times what they say "
                    f"(0.5 s becomes {0.5 * factor:.4g} s); {NOMINAL_SPEED} plays them as written",
                )
            )
        beyond = page.links_beyond(image.kind) if number and not page.fault(image.kind) and page.is_playable else []
        if beyond:
            out.append((number, f"{' and '.join(beyond)}: there is no such page, so the robot follows no link there"))
    return out


def _dead_end(image: Image, target: int) -> str:
    """Why a link to this page ends a play with a fault. "": it does not. Pages with repeat 0 are passed over (LAWS.md, section 1 rule 2)."""
    passed: list[int] = []
    while target and image.first <= target < image.end:
        page = image[target]
        way = "".join(f"page {one}, which is passed over (repeat 0) to " for one in passed)
        if page.fault(image.kind) or page.steps == 0:
            return f"{way}page {target}, which has no action"
        if target in passed:
            return f"{way}page {target} again"
        if page.is_playable:
            return ""
        passed.append(target)
        target = page.next
    return ""


def need_good(image: Image, number: int) -> Page:
    page = image[number]
    if is_erased(page):
        raise EmptyPageError(f"page {number} holds nothing: it is erased flash")
    if page.fault(image.kind):
        raise RefusedError(f"page {number} is damaged ({page.fault_text(image.kind)}); repair or delete it first")
    return page


def _need_motion(image: Image, number: int) -> Page:
    page = need_good(image, number)
    if number and page.is_empty:
        raise EmptyPageError(f"page {number} holds nothing")
    return page


def _no_trim(number: int) -> None:
    if number == 0:
        raise RefusedError("page 0 is a robot's trim and no motion")


def rename(image: Image, number: int, name: str) -> list[str]:
    """WordError: not a valid page name."""
    _no_trim(number)
    if not all(" " <= letter <= "~" for letter in name):
        raise WordError(f"{name!r}: a page name is made of ASCII letters, digits, signs and blanks")
    if name and not name.strip():
        raise WordError(f"{name!r}: nobody sees a name of blanks; '' takes the page's name away")
    if len(name) > 13:
        raise WordError(f"{name!r}: a page name has at most 13 characters, not {len(name)}")
    page = need_good(image, number)
    page.name = name.encode("ascii")
    page.seal()
    other = page_number(name)
    if other is not None and other != number:
        return [f"page {number} has a number for a name: where a page is asked for, {name} means page {other}"]
    notes = []
    if means_pages(name, image):
        notes.append(f"page {number} has a word for pages for a name: where pages are asked for, only its number means it")
    same = [n for n, page in image.items() if name and n != number and page.name == name.encode("ascii")]
    if same:
        notes.append(f"{pages_text(same)} {'is' if len(same) == 1 else 'are'} called {name!r}, too: only the numbers tell them apart")
    return notes


def _must_be_free(image: Image, number: int, replace: bool, how: str = "--replace overwrites it") -> None:
    page = image[number]
    title = f' "{page.title}"' if page.name else ""
    is_free = len(set(page.data)) == 1 or page.is_empty and not (number == 0 and any(page.trims()))
    if not is_free and not replace:
        raise RefusedError(f"page {number}{title} is not empty ({how})")


def keep_trim(source: int, target: int) -> None:
    """RefusedError if page 0 would become another page or another page would become page 0. A robot with a motion as its trim stands
    crooked."""
    if (source == 0) != (target == 0):
        raise RefusedError("page 0 is a robot's trim and no motion: it stays page 0, and no other page becomes it")


def copy(image: Image, source: int, target: int, replace: bool = False) -> list[str]:
    keep_trim(source, target)
    _must_be_free(image, target, replace)
    page = _need_motion(image, source).copy()
    relink(page, {source: target})  # a page that links to itself does so after the copy
    image[target] = page.seal()
    return [f"the copy has the same name {page.title!r} and code {page.code}"] if page.name or page.code else []


def delete(image: Image, numbers: Iterable[int]) -> list[str]:
    remarks = []
    gone = set(numbers)
    if 0 in gone and any(image[0].trims()):
        remarks.append("page 0 held the robot's trim")
    for number in gone:
        image[number] = Page()
    gone -= {0}  # a link of 0 is no link
    for number, page in image.items():
        if number not in gone:
            remarks += [
                f'page {number} "{page.title}" still links to page {getattr(page, link)} ({field_text(link)})'
                for link in Page.LINKS + Page.PARTNERS
                if getattr(page, link) in gone
            ]
    return remarks


def relink(page: Page, moved: dict[int, int]) -> bool:
    """Updates links and blend partners to pages that moved. Returns whether one changed (the page is sealed then)."""
    changed = False
    for link in Page.LINKS + Page.PARTNERS:
        target = getattr(page, link)
        if target and target in moved and moved[target] != target:
            setattr(page, link, moved[target])
            changed = True
    if changed:
        page.seal()
    return changed


def renumber(image: Image, source: int, target: int, swap: bool = False) -> list[str]:
    """Moves a page and updates all links in the image."""
    if not source or not target:
        raise RefusedError("page 0 is the trim and stays where it is")
    _need_motion(image, source)
    if source == target:
        return []
    if not swap:
        _must_be_free(image, target, False, "--swap exchanges the two")
    moved = {source: target, target: source}
    image[source].data, image[target].data = image[target].data, image[source].data
    if not swap:
        image[source] = Page()
        del moved[target]
    touched = [number for number, page in image.items() if not page.fault(image.kind) and relink(page, moved)]
    return [f"links changed in pages {', '.join(map(str, touched))}"] if touched else []


def place(image: Image, source: Image, moves: list[tuple[int, int]], replace: bool = False) -> None:
    """Takes pages (source number, target number) from another image and updates the links among them. loose_links() names the others."""
    if source.bits != image.bits:
        raise RefusedError(f"the sources have {image.bits} and {source.bits} bits: scale one of them first (convert --scale)")
    moved = dict(moves)
    for there, here in moves:
        keep_trim(there, here)
        _must_be_free(image, here, replace)
    for there, here in moves:
        page = need_good(source, there).copy()
        relink(page, moved)
        image[here] = page


def loose_links(source: Image, moves: list[tuple[int, int]], titles: Mapping[int, str], end: int) -> list[str]:
    """Where the links of the pages taken lead that are not among them. titles: {number: title} of the pages that the target holds
    afterwards; end: how many it has."""
    taken, remarks = dict(moves), []
    for there, here in moves:
        for link in Page.LINKS + Page.PARTNERS:
            old = getattr(source[there], link)
            if old and old not in taken:
                page = f"{named_pages_text({old: titles.get(old, '')})} of the target"
                where = page if old in titles else f"{page}, which is empty" if old < end else f"page {old}, which the target does not have"
                remarks.append(f'page {here} "{source[there].title}": {field_text(link)} {old} is not among the pages taken and leads to {where}')
    return remarks


def mirror(image: Image, number: int, pairs: dict[int, int], target: int | None = None, replace: bool = False) -> list[str]:
    """Mirrors left to right: joints of a pair exchange positions (p becomes 1024 - p) and softness."""
    target = number if target is None else target
    keep_trim(number, target)
    _no_trim(number)
    _must_be_free(image, target, replace or target == number)
    old, remarks, top = _need_motion(image, number), [], image.kind.pos_max
    page = old.copy()
    for joint, pair in pairs.items():
        page.set_compliance(pair, old.compliance(joint))
        for step in range(STEPS):
            word = old.word(step, joint)
            if is_used(word) and word <= top:
                word = top + 1 - word
                if word > top:
                    word = top
                    if step < page.steps:
                        remarks.append(f"step {step + 1} ID {pair}: {top + 1} is cut to {top}")
            page.set_word(step, pair, word)
    image[target] = page.seal()
    return remarks


def retime(image: Image, number: int, factor: float) -> list[str]:
    """Makes a page take `factor` times as long: step times, pauses and ramp, rounded to ticks."""
    if not 0.01 <= factor <= 100:
        raise WordError(f"{factor:g}: the factor is 0.01..100")
    _no_trim(number)
    page = _need_motion(image, number)
    before = page_seconds(page, bits=image.bits)
    in_time = page.schedule == SCHEDULE_TIME
    for step in range(page.steps):
        page.set_time(step, _scaled(page.time(step), factor if in_time else 1 / factor, 1, f"step {step + 1}", "raise"))
        pause = _scaled(page.pause(step), factor, 0, f"the pause of step {step + 1}", "raise" if in_time else "lower")
        page.set_pause(step, pause)
    page.accel = min(max(round(page.accel * factor), 1 if page.accel else 0), 255)
    page.seal()
    return [f"page {number}: {before:.3f} s -> {page_seconds(page, bits=image.bits):.3f} s (asked for {before * factor:.3f} s)"]


def _scaled(value: int, factor: float, least: int, what: str, instead: str) -> int:
    """instead: what to do with the page's speed, which divides the times in speed base, if the value does not fit."""
    scaled = int(value * factor + 0.5)
    if scaled > 255:
        raise RefusedError(f"{what} would be {scaled} units, at most 255 fit: {instead} the page's speed instead")
    return max(scaled, least) if value else 0


def chain(image: Image, number: int) -> tuple[list[tuple[int, int, float]], str]:
    """[(page, repetitions, seconds)] along the next links, and how the chain ends."""
    out: list[tuple[int, int, float]] = []
    pose = first_pose(image, number)  # the approach leads there
    seen: dict[int, None] = {}
    while True:
        if number in seen:
            ring = list(seen)[list(seen).index(number) :]
            if any(image[one].is_playable for one in ring):
                return out, f"goes on with page {number} for ever"
            return out, f"ends at page {number}, which has repeat 0"
        if image[number].fault(image.kind):
            return out, f"ends at page {number}, which is damaged"
        page = image[number]
        if page.steps == 0:
            return out, f"ends at page {number}, which is empty"
        seen[number] = None
        if page.is_playable:
            once = page_seconds(page, pose, image.bits)
            pose = end_pose(page, pose)
            again = page_seconds(page, pose, image.bits)
            out.append((number, page.repeat, once + (page.repeat - 1) * again))
        if not max(1, image.first) <= page.next < image.end:  # page 0 is the trim: no link leads there
            return out, "ends"
        number = page.next


def end_pose(page: Page, pose: list[int]) -> list[int]:
    out = list(pose)
    for step in range(page.steps):
        for joint in range(JOINTS):
            if is_used(page.word(step, joint)):
                out[joint] = page.word(step, joint)
    return out
