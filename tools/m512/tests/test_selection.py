# SPDX-License-Identifier: MIT
"""The pages that an argument means: one parser and one error for every command, for files and boards."""

import re

import pytest

from m512.errors import EmptyPageError, FileError, WordError
from m512.files import selection
from m512.files.image import Image
from m512.files.page import Page
from m512.files.text import read_text

TEXT = """motion512 1
page 3 wave
  step 50 | 1:500
page 4 "a:b"
  step 50 | 1:510
page 5 "1..2"
  next wave
  step 50 | 1:520
page 7 "12"
  step 50 | 1:530
page 20 bow
  step 50 | 1:540
page 21 broken
  step 50 | 1:550
  checksum 0x11
page 30 ; erased
"""
IMAGE = read_text(TEXT)


@pytest.mark.parametrize(
    "words, expected",
    [
        (["wave"], [(3, 3)]),
        (["WAVE"], [(3, 3)]),
        (["3:40"], [(3, 40)]),
        (["wave:0"], [(3, 0)]),
        (["a:b"], [(4, 4)]),
        (["a:b:9"], [(4, 9)]),
        (["5:60"], [(5, 60)]),
        (["12"], [(12, 12)]),
        (["3..5"], [(3, 3), (4, 4), (5, 5)]),
        (["2..7:60"], [(3, 61), (4, 62), (5, 63), (7, 65)]),
        (["all"], [(3, 3), (4, 4), (5, 5), (7, 7), (20, 20), (21, 21)]),
        (["wave", "3"], [(3, 3)]),
        (["wave:40", "20:41"], [(3, 40), (20, 41)]),
        (["1..127:1"], [(n, n) for n in (3, 4, 5, 7, 20, 21)]),
    ],
)
def test_what_arguments_mean(words, expected):
    assert selection.moves(words, IMAGE) == expected
    if all(there == here for there, here in expected) and words != ["1..127:1"]:
        assert selection.numbers(words, IMAGE) == [there for there, _ in expected]


@pytest.mark.parametrize(
    "word",
    ["wave:4o", "wave:", "wave:-1", "wave:+5", "wave:1_0", "wave: 4", "wave:\uff14", "3:256", "3:99999999999", "all:4", "3..5:x", "9..4", "wave:4:o"],
)
def test_what_means_nothing_is_an_error_that_names_the_word(word):
    with pytest.raises(WordError) as caught:
        selection.moves([word], IMAGE)
    assert word in str(caught.value) or ascii(word) in ascii(str(caught.value))


@pytest.mark.parametrize("name, word", [("all", "all"), ("1..9", "1..9"), ("1..9", "1..9:60"), ("wave:9", "wave:9"), ("3:9", "3:9")])
def test_a_name_that_means_other_pages_as_well_is_refused(name, word):
    """`get all` of a robot with a page called "all" once read that page alone, without a word."""
    image = read_text(TEXT)
    image[20].name = name.encode()
    with pytest.raises(WordError, match="page 20 is called .*say 20"):
        selection.moves([word], image)
    assert image.find(name) == 20  # where one page is asked for


@pytest.mark.parametrize("word", ["waves", "", "\u00b3", "200", "9" * 5000, "3..", ":4"])
def test_a_page_that_is_not_there(word):
    with pytest.raises(FileError):
        selection.moves([word], IMAGE)


@pytest.mark.parametrize("word, said", [("8", "page 8 holds nothing"), ("8..11", "8..11: none of these pages holds anything")])
def test_pages_that_hold_nothing(word, said):
    with pytest.raises(EmptyPageError, match=said):
        selection.moves([word], IMAGE)


def test_two_pages_do_not_go_to_one_place():
    with pytest.raises(WordError, match="pages 3 and 20 would both become page 40"):
        selection.moves(["wave:40", "bow:40"], IMAGE)


@pytest.fixture
def lib(tmp_path):
    (tmp_path / "lib.m512").write_text(TEXT)
    (tmp_path / "other.m512").write_text("motion512 1\n")
    return tmp_path / "lib.m512"


def test_every_command_refuses_it_with_the_same_sentence(m512, started, lib):
    edit = started("edit-cm5.hex", text=TEXT.replace("1:500", "1:333"))
    before = bytes(edit.board.flash[0xE000:0x1E000])
    for word in ("wave:4o", "wave:", "wave:1_0", "9..4", "all:4"):
        put = m512("put", lib, word, "-p", edit.path)
        merge = m512("pages", lib.with_name("other.m512"), "merge", lib, word, "-o", lib.with_name("new.bin"))
        assert put.exit_code == merge.exit_code == 2
        assert put.stderr.splitlines()[-1] == merge.stderr.splitlines()[-1] and word in put.stderr
    assert bytes(edit.board.flash[0xE000:0x1E000]) == before and not lib.with_name("new.bin").exists()


def test_ranges_of_a_board_and_of_a_file(m512, started, lib):
    edit = started("boot-cm5.hex", "edit-cm5.hex", text=TEXT)  # saving needs the loader
    assert m512("run", "-p", edit.path).exit_code == 0
    edit.pass_time(2)
    got = lib.with_name("got.bin")
    assert m512("get", "2..6", "bow", "-o", got, "-p", edit.path).exit_code == 0
    assert read_text(TEXT)[3] == selection_image(got)[3] and selection_image(got).used() == [3, 4, 5, 20]
    assert m512("get", "all", "--force", "-o", got, "-p", edit.path).exit_code == 0
    assert selection_image(got)[21] == IMAGE[21] and selection_image(got).used() == [3, 4, 5, 7, 20, 21]  # a damaged page is kept byte for byte
    put = m512("put", lib, "3..5:60", "-p", edit.path)
    assert put.exit_code == 0, put.stderr
    area = bytes(edit.board.flash[0xE000:0x1E000])
    assert [area[512 * n + 66] + 256 * area[512 * n + 67] for n in (60, 61, 62)] == [500, 510, 520]
    assert area[512 * 62 + 25] == 60  # its link was updated
    shown = m512("pages", lib, "show", "3..5").stdout
    assert [shown.count(f"page {n}") for n in (3, 4, 5, 7)] == [1, 1, 1, 0]
    assert m512("pages", lib, "delete", "3..21", "-o", lib.with_name("less.bin")).exit_code == 0
    assert selection_image(lib.with_name("less.bin")).used() == []


def test_a_range_of_a_board_from_0_has_its_trim(m512, started, lib):
    """@list tells no page without steps and name, as a trim is."""
    play = started("play-cm5.hex", text=TEXT.replace("page 3 wave", "page 0\n  offset 1:5 3:-7\npage 3 wave"))
    got = lib.with_name("got.bin")
    for words, trims, used in (
        (["0..5"], {1: 5, 3: -7}, [0, 3, 4, 5]),
        (["1..5"], {}, [3, 4, 5]),
        (["0", "all"], {1: 5, 3: -7}, [0, 3, 4, 5, 7, 20, 21]),
    ):
        assert m512("get", *words, "--force", "-o", got, "-p", play.path).exit_code == 0
        image = selection_image(got)
        assert {joint: trim for joint, trim in enumerate(image[0].trims()) if trim} == trims and image.used() == used
    said = m512("get", "all", "--force", "-o", got, "-p", play.path).stderr
    assert "note: page 0, the robot's trim, is left behind" in said and selection_image(got).used() == [3, 4, 5, 7, 20, 21]


def selection_image(path):
    from m512.files import formats

    return formats.load(path)


@pytest.mark.parametrize(
    "words",
    [
        ("pages", "LIB", "show", "50"),
        ("pages", "LIB", "extract", "50", "-o", "NEW"),
        ("pages", "LIB", "delete", "99", "-o", "NEW"),
        ("pages", "OTHER", "merge", "LIB", "50:3", "-o", "NEW"),
        ("convert", "LIB", "NEW", "--only", "50"),
        ("put", "LIB", "50", "-p", "none"),
        ("pages", "LIB", "copy", "50", "3", "--replace", "-o", "NEW"),
        ("pages", "LIB", "renumber", "50", "60", "-o", "NEW"),
        ("pages", "LIB", "mirror", "50", "60", "-o", "NEW"),
        ("pages", "LIB", "retime", "50", "2", "-o", "NEW"),
        ("pages", "LIB", "time", "50"),
        ("pages", "LIB", "show", "50..60"),
    ],
)
def test_an_empty_page_is_refused_by_its_number_as_in_a_range(m512, lib, words):
    files = {"LIB": lib, "OTHER": lib.with_name("other.m512"), "NEW": lib.with_name("new.bin")}
    result = m512(*(files.get(word, word) for word in words))
    number = "99" if "99" in words else "50"
    assert result.exit_code == 4 and re.search(rf"\b{number}\b.* holds (nothing|anything)", result.stderr), result.stderr
    assert not lib.with_name("new.bin").exists()


@pytest.mark.parametrize("words", [("show", "50"), ("time", "50"), ("copy", "50", "60", "--in-place"), ("rename", "50", "new", "--in-place")])
def test_an_erased_page_is_an_empty_one(m512, lib, words):
    path = lib.with_name("erased.bin")
    data = bytearray(selection_image(lib).to_bytes())
    data[512 * 50 : 512 * 51] = b"\xff" * 512
    path.write_bytes(data)
    result = m512("pages", path, *words)
    assert result.exit_code == 4 and "page 50 holds nothing" in result.stderr and not result.stdout, result.stderr
    assert path.read_bytes() == data


def test_an_empty_page_of_a_board_is_refused_by_its_number(m512, started, lib):
    edit = started("edit-cm5.hex", text=TEXT)
    result = m512("get", "3", "50", "-o", lib.with_name("got.bin"), "-p", edit.path)
    assert result.exit_code == 4 and "page 50 holds nothing" in result.stderr and not lib.with_name("got.bin").exists()
    assert m512("get", "0", "-o", lib.with_name("got.bin"), "-p", edit.path).exit_code == 0  # the trim may be absent


@pytest.mark.parametrize("action", ["copy", "renumber", "mirror"])
@pytest.mark.parametrize("number", ["1_0", "+9", "\uff14", "256", "4o"])
def test_targets_of_single_pages_are_plain_numbers(m512, lib, action, number):
    result = m512("pages", lib, action, "wave", number, "-o", lib.with_name("new.bin"))
    assert result.exit_code == 2 and "no page number" in result.stderr and not lib.with_name("new.bin").exists()


def test_a_damaged_page_without_steps_is_one_of_all_as_it_is_one_by_its_number():
    image = Image.empty(128)
    torn = bytearray(image[5].data)
    torn[100] ^= 1
    image[5] = Page(torn)
    assert selection.numbers(["5"], image) == [5] == selection.numbers(["1..9"], image) == selection.numbers(["all"], image)
