# SPDX-License-Identifier: MIT
"""Sentences about many pages: what applies to several pages is stated once."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

SHOWN_NAMES = 6  # up to this many pages are listed with their names; more get numbers only


def spans(numbers: Iterable[int]) -> list[tuple[int, int]]:
    """[1, 2, 3, 7] -> [(1, 3), (7, 7)]."""
    out: list[tuple[int, int]] = []
    for number in sorted(set(numbers)):
        if out and out[-1][1] == number - 1:
            out[-1] = (out[-1][0], number)
        else:
            out.append((number, number))
    return out


def ranges(numbers: Iterable[int]) -> list[str]:
    """[1, 2, 3, 7] -> ["1..3", "7"]; two neighbours stay separate."""
    texts: list[str] = []
    for low, high in spans(numbers):
        texts += [str(n) for n in range(low, high + 1)] if high - low < 2 else [f"{low}..{high}"]
    return texts


def listed(texts: Sequence[str]) -> str:
    """ "a", "a and b", "a, b and c"."""
    return texts[0] if len(texts) == 1 else ", ".join(texts[:-1]) + " and " + texts[-1]


def pages_text(numbers: Iterable[int]) -> str:
    """ "page 3", "pages 1..3 and 7"."""
    numbers = sorted(set(numbers))
    return f"page {numbers[0]}" if len(numbers) == 1 else "pages " + listed(ranges(numbers))


def named_pages_text(titles: dict[int, str]) -> str:
    """The same with names, if there are few: 'pages 3 "wave" and 7 "bow"'."""
    if len(titles) > SHOWN_NAMES:
        return pages_text(titles)
    texts = [f'{number} "{title}"' if title else str(number) for number, title in sorted(titles.items())]
    return ("page " if len(texts) == 1 else "pages ") + listed(texts)


def counted(count: int, thing: str) -> str:
    """ "1 page", "2 pages"."""
    return f"{count:,} {thing}" + ("" if count == 1 else "s")


def field_text(field: str) -> str:
    """A page's field as users read it: "link1 page" for link1_page."""
    return field.replace("_", " ")


class Findings:
    """Sentences about pages, collected page by page and printed once each. A value is the part that differs from page to page."""

    def __init__(self) -> None:
        self._pages: dict[str, dict[int, tuple[str, str]]] = {}

    def add(self, number: int, title: str, text: str, value: str = "") -> None:
        pages = self._pages.setdefault(text, {})
        before = pages[number][1] + ", " if number in pages and pages[number][1] else ""
        pages[number] = (title, before + value)

    def lines(self) -> list[str]:
        return [self._line(text, found) for text, found in self._pages.items()]

    def _line(self, text: str, found: dict[int, tuple[str, str]]) -> str:
        pages = named_pages_text({number: title for number, (title, _) in found.items()})
        values = [f"{number}: {value}" if len(found) > 1 else value for number, (_, value) in sorted(found.items()) if value]
        more = f" and {len(values) - SHOWN_NAMES} more" if len(values) > SHOWN_NAMES else ""
        return f"{pages}: {text}" + (f" ({'; '.join(values[:SHOWN_NAMES])}{more})" if values else "")
