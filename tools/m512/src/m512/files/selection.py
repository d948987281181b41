# SPDX-License-Identifier: MIT
"""Which pages a user means, for every command, in a file and on a board:

    12  wave       one page that holds something, or page 0, by number or name (exact, else unambiguous regardless of case)
    20..25         those of them that hold something
    all            all that hold something, except page 0, the robot's trim
    wave:40        page `wave` becomes number 40; 20..25:60 becomes 60..65

A page may be called "a:b", and the word means it. A page called "all" or "1..2" only its number means: the word would mean several pages
as well. WordError: the input means no page, or could mean two things. EmptyPageError: the pages hold nothing.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from typing import Callable, Protocol

from m512.errors import EmptyPageError, M512Error, WordError

NUMBER_MOST = 255  # the largest page number on any board
RANGE = r"([0-9]{1,9})\.\.([0-9]{1,9})"


class Pages(Protocol):
    """The pages of a file or of a board."""

    def find(self, word: str) -> int:
        """The page for a number or a name. M512Error: none, or several with that name."""

    def is_named(self, word: str) -> bool:
        """Whether a page has exactly this name."""

    def used(self) -> list[int]:
        """Pages that hold something: they have steps or a name, or are damaged."""


def find(word: str, names: Mapping[int, str], error: Callable[[str], M512Error], whose: str = "") -> int:
    """The number of the page with that name."""
    for fold in (str, str.lower):
        hits = [number for number, name in names.items() if fold(name) == fold(word)]
        if len(hits) == 1:
            return hits[0]
        if hits:
            raise error(f"page name {word!r} is not unique: pages " + ", ".join(map(str, hits)))
    if word == "all" or re.fullmatch(RANGE, word):
        raise error(f"{word} means several pages, and one is asked for")
    raise error(f"no page{whose} is called {word!r}")


def holding(word: str, pages: Pages) -> int:
    """The number of one page. EmptyPageError: it holds nothing."""
    number = pages.find(word)
    if number and number not in pages.used():
        raise EmptyPageError(f"page {number} holds nothing")
    return number


def page_number(text: str) -> int | None:
    """The number, or None if the text is not a number of up to 9 digits."""
    return int(text) if re.fullmatch("[0-9]{1,9}", text) else None


def number_range(text: str) -> tuple[int, int] | None:
    """(1, 6) for `1..6`; None if the text is not a range."""
    match = re.fullmatch(RANGE, text)
    if not match:
        return None
    low, high = int(match.group(1)), int(match.group(2))
    if low > high:
        raise WordError(f"{text}: a range goes upwards")
    return low, high


def numbers(words: Iterable[str], pages: Pages) -> list[int]:
    """The pages that the words mean, each once, in the order of the words."""
    return list(dict.fromkeys(number for word in words for number in _meant(word, pages)))


def moves(words: Iterable[str], pages: Pages) -> list[tuple[int, int]]:
    """[(source number, target number)]. WordError: two sources for one target."""
    out = [move for word in words for move in _moves(word, pages)]
    taken: dict[int, int] = {}
    for there, here in dict.fromkeys(out):
        if here in taken:
            raise WordError(f"pages {taken[here]} and {there} would both become page {here}")
        taken[here] = there
    return list(dict.fromkeys(out))


def means_pages(word: str, pages: Pages) -> bool:
    """Whether a word means pages even if none is called so."""
    name, _, target = word.rpartition(":")
    is_several = word == "all" or re.fullmatch(RANGE, word) is not None
    return is_several or page_number(target) is not None and (means_pages(name, pages) or page_number(name) is not None or pages.is_named(name))


def _moves(word: str, pages: Pages) -> list[tuple[int, int]]:
    name, colon, target = ("", "", "") if pages.is_named(word) else word.rpartition(":")
    if not colon:
        return [(number, number) for number in _meant(word, pages)]
    first = page_number(target)
    if first is None or first > NUMBER_MOST:
        raise WordError(f"{word}: behind the colon stands the number of the page that it becomes, 0..{NUMBER_MOST}, and not {target!r}")
    if name == "all":
        raise WordError(f"{word}: all pages keep their numbers; say 1..127:{first} to move them")
    span = None if pages.is_named(name) else number_range(name)
    meant = _meant(name, pages)
    low = span[0] if span else meant[0]
    return [(number, number - low + first) for number in meant]


def _meant(word: str, pages: Pages) -> list[int]:
    if pages.is_named(word):
        number = pages.find(word)
        if means_pages(word, pages):
            several = ", or 1..127 for all pages" if word == "all" else ""
            raise WordError(f"page {number} is called {word!r}, too: say {number} for that page{several}")
        return [number]
    span = number_range(word)
    if word != "all" and not span:
        return [holding(word, pages)]
    low, high = span or (1, NUMBER_MOST)
    found = [number for number in pages.used() if low <= number <= high]
    if not found:
        raise EmptyPageError(f"{word}: none of these pages holds anything")
    return found
