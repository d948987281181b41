# SPDX-License-Identifier: MIT
"""Tests the page codec with the vectors of tests/models/golden (as for the C codec) and with facts of the specification."""

import pytest
from chance import given
from hypothesis import strategies as st

from m512.files.page import EMPTY, Fault, Kind, Page, is_used
from tests.models.golden.page_vectors import VECTORS

FIELDS = {
    "play_count": "repeat",
    "play_code": "code",
    "accel_time": "accel",
    "next_page": "next",
    "exit_page": "exit",
    "linked1_page": "link1_page",
    "linked1_code": "link1_code",
    "linked2_page": "link2_page",
    "linked2_code": "link2_code",
}


@pytest.mark.parametrize("vector", VECTORS, ids=lambda v: v["name"])
def test_page_vector(vector):
    page = Page(bytes.fromhex(vector["hex"]))
    assert page.fault().name == vector["fault"]
    assert page.fault() == vector["fault_number"]
    assert page.is_playable == vector["playable"]
    for field, value in vector["fields"].items():
        assert getattr(page, FIELDS.get(field, field)) == value, field
    for word in vector["words"]:
        assert page.word(word["step"], word["joint"]) == word["word"]
        assert is_used(word["word"]) == word["used"]
    if "title" in vector:
        assert page.title == vector["title"]
    for joint, value in vector.get("compliance", {}).items():
        assert page.compliance(int(joint)) == value
    assert [page.pause(k) for k in range(len(vector.get("pauses", [])))] == vector.get("pauses", [])
    assert [page.time(k) for k in range(len(vector.get("times", [])))] == vector.get("times", [])


def test_page_empty_is_the_vector_of_that_name():
    assert EMPTY.hex() == next(v for v in VECTORS if v["name"] == "empty")["hex"]


@given(st.binary(min_size=512, max_size=512))
def test_page_any_bytes_are_kept_and_judged(data):
    page = Page(data)
    assert bytes(page) == data
    assert page.fault() in Fault
    assert bool(page.fault_text()) == (page.fault() is not Fault.OK)
    assert page.copy().seal().fault() is not Fault.CHECKSUM


@given(st.integers(0, 6), st.integers(0, 30), st.integers(0, 0xFFFF))
def test_page_word_set_touches_its_two_bytes_only(step, joint, word):
    page = Page()
    page.set_word(step, joint, word)
    assert page.word(step, joint) == word
    changed = [i for i in range(512) if page.data[i] != EMPTY[i]]
    assert set(changed) <= {64 + 64 * step + 2 * joint, 65 + 64 * step + 2 * joint}


def test_page_fault_text_names_field_and_value():
    page = Page()
    page.steps, page.next = 1, 200
    page.set_word(0, 7, 1500)
    page.speed = 0
    assert page.seal().fault_text() == "page speed is 0; position beyond 1023: step 1 ID 7 is 0x05DC"
    assert page.fault_text(Kind(256, 4095)) == "page speed is 0"


def test_page_link_beyond_the_last_page_is_no_fault_but_named():
    """LAWS.md: a link above 127 counts as 0."""
    page = Page()
    page.steps, page.next, page.link2_page = 1, 200, 128
    assert page.seal().fault_text() == ""
    assert page.links_beyond() == ["next 200", "link2 page 128"]
    assert page.links_beyond(Kind(256)) == []
