# SPDX-License-Identifier: MIT
"""`m512 pages` and `m512 diff`: the effect of actions on bytes, refusals and messages."""

import json

import pytest
from mtn_files import Block, body, checksum, made
from mtn_files import step as mtn_step

from m512.files import formats
from m512.files.image import Image, from_bytes
from m512.files.page import EMPTY, Page
from m512.files.text import read_text
from m512.pages import operations
from m512.pages.difference import images

TEXT = """motion512 1
row 1..4
page 1 stand
  step 1s | 512 512 512 512
page 3 walk
  code U; repeat 2; next self; exit 5; link1 L 7
  softness 5 1:7
  step 50 | 400 500 600 700
  step 50 pause 20 | 410 510 - 710
page 5 stop
  step 25 | 512 512 512 512
page 7 left
  next walk
  step 25 | 100 200 300 400
"""


@pytest.fixture
def lib(tmp_path):
    path = tmp_path / "lib.bin"
    path.write_bytes(read_text(TEXT).to_bytes())
    return path


def image(path):
    return from_bytes(path.read_bytes())


def words(page, step=0):
    return [page.word(step, joint) for joint in (1, 2, 3, 4)]


def test_pages_list_as_table_and_json(m512, lib):
    out = m512("pages", lib, "list").stdout
    assert [line.split()[0] for line in out.splitlines()] == ["page", "1", "3", "5", "7"]
    assert "next 3  exit 5  link1(L) 7" in out
    rows = json.loads(m512("pages", lib, "list", "--json").stdout)
    assert rows[1]["name"] == "walk" and rows[1]["seconds"] == round(120 / 128, 3) and rows[1]["links"]["link1"] == 7


@pytest.mark.parametrize("option", ["--help", "-h"])
@pytest.mark.parametrize(
    "before, after",
    [
        ([], ["list"]),
        (["list"], []),
        (["list"], ["LIB"]),
        (["list", "LIB"], []),
        (["LIB", "list"], []),
        (["LIB"], ["list"]),
        (["none.bin", "list"], []),
        (["none.bin"], []),
        (["LIB", "lst"], []),
    ],
)
def test_pages_shows_help_wherever_it_is_asked_for(m512, lib, option, before, after):
    words = [str(lib) if word == "LIB" else word for word in [*before, option, *after]]
    result = m512("pages", *words)
    # click's own rule for a group: --help in the first place is about the group
    about = "Number, name, steps, play time" if "list" in before + after and before else "List, check, edit, merge"
    assert result.exit_code == 0 and about in " ".join(result.stdout.split()) and not result.stderr, result.stderr


def test_pages_without_a_question_for_help_says_what_is_wrong(m512, lib):
    assert "No such command 'lst'" in m512("pages", lib, "lst").stderr
    renamed = m512("pages", lib, "rename", "walk", "--in-place", "--", "-h")
    assert renamed.exit_code == 0 and image(lib)[3].name == b"-h", renamed.stderr


def test_pages_show_is_the_text_format(m512, lib):
    out = m512("pages", lib, "show", "walk").stdout
    assert "page 3 walk" in out and "link1 L left" in out and "pause 20" in out


def test_pages_check_names_what_is_wrong(m512, lib):
    assert m512("pages", lib, "check").exit_code == 0
    broken = image(lib)
    broken[5] = Page()
    broken[7].data[100] ^= 1
    lib.write_bytes(broken.to_bytes())
    result = m512("pages", lib, "check")
    assert result.exit_code == 3
    assert 'page 3 "walk": exit leads to page 5, which has no action' in result.stdout
    assert "page 7" in result.stdout and "damaged: checksum is" in result.stdout


def test_pages_rename(m512, lib):
    assert m512("pages", lib, "rename", "walk", "march", "--in-place").exit_code == 0
    assert image(lib)[3].name == b"march" and not image(lib)[3].fault()
    assert m512("pages", lib, "rename", "march", "much too long a name", "--in-place").exit_code == 2


@pytest.mark.parametrize("name", ["grün", "日本", "a\nb", "\x1b[2J"])
def test_pages_rename_takes_no_letter_that_a_page_cannot_hold(m512, lib, name):
    before = lib.read_bytes()
    result = m512("pages", lib, "rename", "walk", name, "--in-place")
    assert result.exit_code == 2 and "ASCII" in result.stderr and lib.read_bytes() == before


def test_pages_rename_takes_a_name_away_and_refuses_one_that_nobody_sees(m512, lib):
    before = lib.read_bytes()
    result = m512("pages", lib, "rename", "walk", "  ", "--in-place")
    assert result.exit_code == 2 and "'  ': nobody sees" in result.stderr and lib.read_bytes() == before
    assert m512("pages", lib, "rename", "walk", "", "--in-place").exit_code == 0 and image(lib)[3].name == b""


def test_pages_says_that_the_file_comes_first(m512, lib):
    result = m512("pages", "list", lib)
    assert result.exit_code == 2 and f"the file comes first: m512 pages {lib} list" in result.stderr


def test_pages_rename_to_a_number_says_what_the_number_means(m512, lib):
    result = m512("pages", lib, "rename", "walk", "12", "--in-place")
    assert result.exit_code == 0 and "12 means page 12" in result.stderr


@pytest.mark.parametrize("name", ["all", "1..3", "stand:9"])
def test_pages_rename_to_a_word_for_pages_says_what_it_means(m512, lib, name):
    result = m512("pages", lib, "rename", "walk", name, "--in-place")
    assert (
        result.exit_code == 0 and "note: page 3 has a word for pages for a name: where pages are asked for, only its number means it" in result.stderr
    )


def test_pages_rename_leaves_the_trim_without_a_name(m512, lib):
    before = lib.read_bytes()
    result = m512("pages", lib, "rename", "0", "hello", "--in-place")
    assert result.exit_code == 5 and "page 0 is a robot's trim and no motion" in result.stderr and lib.read_bytes() == before


def test_pages_rename_to_a_name_that_is_taken_twice_counts_them(m512, lib):
    assert m512("pages", lib, "rename", "stop", "stand", "--in-place").exit_code == 0
    result = m512("pages", lib, "rename", "walk", "stand", "--in-place")
    assert result.stderr == "note: pages 1 and 5 are called 'stand', too: only the numbers tell them apart\n"


def test_pages_rename_to_a_name_that_is_taken_says_so(m512, lib):
    assert (
        m512("pages", lib, "rename", "walk", "stand", "--in-place").stderr
        == "note: page 1 is called 'stand', too: only the numbers tell them apart\n"
    )
    assert m512("pages", lib, "rename", "stop", "halt", "--in-place").stderr == ""


@pytest.mark.parametrize(
    "words", [("copy", "walk", "0"), ("copy", "0", "9"), ("mirror", "walk", "0"), ("merge", "LIB", "walk:0"), ("merge", "LIB", "0:9")]
)
@pytest.mark.parametrize("replace", [(), ("--replace",)])
def test_pages_no_motion_takes_the_place_of_the_trim(m512, lib, words, replace):
    before = lib.read_bytes()
    result = m512("pages", lib, *(str(lib) if word == "LIB" else word for word in words), *replace, "--in-place")
    assert result.exit_code == 5 and "page 0 is a robot's trim and no motion" in result.stderr
    assert lib.read_bytes() == before


@pytest.mark.parametrize(
    "words",
    [
        ("convert", "mine.m512", "mine.m512", "--force"),
        ("convert", "lib.bin", "mine.m512"),  # refused without --force, as always
        ("convert", "link.m512", "mine.m512", "--force"),
        ("convert", "mine.m512", "link.m512", "--force"),
        ("pages", "mine.m512", "rename", "walk", "march", "--in-place"),
        ("pages", "mine.m512", "rename", "walk", "march", "-o", "mine.m512", "--force"),
    ],
)
def test_a_text_is_not_rewritten_in_its_own_place(m512, lib, monkeypatch, words):
    """Comments, poses and names were once lost: --force only answered "is there already"."""
    monkeypatch.chdir(lib.parent)
    mine = lib.parent / "mine.m512"
    mine.write_text(TEXT + "# a comment\n")
    (lib.parent / "link.m512").symlink_to(mine)
    assert m512(*words).exit_code == 5
    assert mine.read_text() == TEXT + "# a comment\n"


def test_a_mtn_whose_rate_becomes_another_as_on_the_robot_is_written_in_its_own_place(m512, tmp_path):
    mine = tmp_path / "mine.mtn"
    text = body([Block("wave", steps=[mtn_step()]), Block("bow", steps=[mtn_step()])]).replace(b" 1 1.0 32", b" 1 3.0 32", 1)
    mine.write_bytes(text + checksum(text))
    done = m512("pages", mine, "rename", "2", "hello", "--in-place")
    assert done.exit_code == 0 and "it becomes 32 / 10 = 3.20" in done.stderr and b"name=hello" in mine.read_bytes()


@pytest.mark.parametrize(
    "old, new, says",
    [
        (b"motor_type=0 ", b"motor_type=4 ", "line 4 (motor_type) would change"),
        (b"name=bow", "name=걷기 시작 천천히".encode(), "line 12 (name) would change"),
        (b"name=bow", b"name=a bow with both hands", "line 12 (name) would change"),
        (b"name=bow", b"name=b\xffw", "line 12 (name) would change"),
        (b" 0.400\n", b" 0.395\n", "line 9 (step) would change"),
        (b"page_end", b"\n".join([b"step=" + b" ".join([b"9"] * 26) + b" 0.0 0.4"] * 8 + [b"page_end"]), "would change"),
    ],
)
def test_a_mtn_that_a_page_cannot_hold_is_not_written_in_its_own_place(m512, tmp_path, old, new, says):
    """The user's only file once lost names, motor types and steps of pages that nobody had changed."""
    mine = tmp_path / "mine.mtn"
    text = body([Block("wave", steps=[mtn_step()]), Block("bow", steps=[mtn_step()]), Block("nod", steps=[mtn_step()])]).replace(old, new, 1)
    mine.write_bytes(text + checksum(text))
    before = mine.read_bytes()
    done = m512("pages", mine, "rename", "3", "hello", "--in-place")
    assert done.exit_code == 5 and says in done.stderr and "-o new.mtn" in done.stderr and "loss:" not in done.stderr, done.stderr
    assert mine.read_bytes() == before
    assert m512("pages", mine, "rename", "3", "hello", "-o", tmp_path / "new.mtn").exit_code == 0


def test_a_mtn_keeps_in_its_own_place_what_pages_taken_would_change(m512, lib, tmp_path):
    """The flags of the joints hold for the whole file: a page that moves one more joint would move it in all pages."""
    mine = tmp_path / "mine.mtn"
    mine.write_bytes(made([Block("bow", steps=[mtn_step()])], enable=range(1, 6)))
    before = mine.read_bytes()
    done = m512("pages", mine, "merge", lib, "walk:2", "--in-place")
    assert done.exit_code == 5 and "joints that some steps leave alone" in done.stderr and mine.read_bytes() == before, done.stderr


@pytest.mark.parametrize(
    "old, new",
    [
        (b"", b""),
        (b"version=1.01", b"version=1,01"),
        (b" 0.400\n", b" 0,4\n"),
        (b" 1.0 32", b" 1.000 32"),
        (b"version=1.01\nenable=", b"version=1.00\nenable="),
        (b"\n", b"\r\n"),
    ],
)
@pytest.mark.parametrize("full", [True, False])
def test_a_mtn_that_a_page_can_hold_is_written_in_its_own_place(m512, tmp_path, old, new, full):
    mine = tmp_path / "mine.mtn"
    mine.write_bytes(body([Block("bow", steps=[mtn_step()]), Block("nod", steps=[mtn_step()])], full=full).replace(old, new))
    done = m512("pages", mine, "rename", "2", "hello", "--in-place")
    assert done.exit_code == 0 and "loss:" not in done.stderr and formats.load(mine)[2].name == b"hello", done.stderr


def test_a_torn_page_is_not_empty(m512, lib, tmp_path):
    """A write that is cut leaves the first half of the empty page before the second half of a motion."""
    data = bytearray(lib.read_bytes())
    data[9 * 512 : 10 * 512] = EMPTY[:256] + data[3 * 512 + 256 : 4 * 512 - 1] + b"\x01"
    lib.write_bytes(data)
    for words in (("copy", "walk", "9"), ("renumber", "walk", "9"), ("merge", lib, "walk:9"), ("mirror", "walk", "9")):
        done = m512("pages", lib, *words, "--in-place")
        assert done.exit_code == 5 and "page 9 is not empty" in done.stderr and lib.read_bytes() == data, words
    assert m512("pages", lib, "copy", "walk", "9", "--replace", "--in-place").exit_code == 0
    large = tmp_path / "large.bin"
    large.write_bytes(EMPTY * 200 + data[9 * 512 : 10 * 512] + EMPTY * 55)
    done = m512("convert", large, tmp_path / "small.bin", "--pages", "128")
    assert done.exit_code == 0 and "loss: page 200: no room among 128 pages, left out" in done.stderr and "kept" not in done.stderr, done.stderr


def test_a_text_of_ours_is_written_in_its_own_place(m512, lib, tmp_path):
    """It contains nothing that would be lost."""
    ours = tmp_path / "ours.m512"
    assert m512("convert", lib, ours).exit_code == 0
    assert m512("convert", ours, ours, "--force").exit_code == 0
    assert m512("pages", ours, "rename", "walk", "march", "-o", ours, "--force").exit_code == 0
    assert "march" in ours.read_text()


def test_pages_mirror_wants_two_joints_for_a_pair(m512, lib):
    result = m512("pages", lib, "mirror", "walk", "--pairs", "1-1", "--in-place")
    assert result.exit_code == 2 and "1-1: pairs are 1-2 3-4 ..." in result.stderr


def test_pairs_stand_as_in_a_text_too(m512, lib, tmp_path):
    for pairs, name in (("1-3,2-4", "a.bin"), ("1-3 2-4", "b.bin")):
        assert m512("pages", lib, "mirror", "walk", "20", "--pairs", pairs, "-o", tmp_path / name).exit_code == 0
    assert (tmp_path / "a.bin").read_bytes() == (tmp_path / "b.bin").read_bytes()


@pytest.mark.parametrize("word", ["1..5", "5..3", "all"])
def test_several_pages_for_one_are_refused_as_what_they_are(m512, lib, word):
    for action in (("pages", lib, "time", word), ("pages", lib, "copy", word, "20", "-o", lib.parent / "new.bin")):
        result = m512(*action)
        assert result.exit_code == 4 and f"{word} means several pages, and one is asked for" in result.stderr


def test_no_name_at_all_is_no_folder(m512, lib):
    for words in (
        ("convert", "", "x.bin"),
        ("convert", lib, ""),
        ("pages", "", "list"),
        ("diff", "", lib),
        ("pages", lib, "merge", "", "1", "--in-place"),
    ):
        result = m512(*words)
        assert result.exit_code == 2 and "an empty name" in result.stderr and "folder" not in result.stderr, (words, result.stderr)


@pytest.mark.parametrize("encoding", ["utf-16", "cp949"])
def test_a_text_in_another_encoding_is_told_how_to_be_saved(m512, tmp_path, encoding):
    (tmp_path / "a.m512").write_bytes((TEXT + "# \ud30c\ub3c4\n").encode(encoding))
    result = m512("convert", tmp_path / "a.m512")
    assert result.exit_code == 4 and "save it as UTF-8" in result.stderr


def test_diff_calls_no_page_damaged_for_having_12_bits(m512, lib, tmp_path):
    high = tmp_path / "high.bin"
    high.write_bytes(read_text("motion512 1\nbits 12\npage 20 a\n  step 1s | 1..4:2048\n").to_bytes())
    assert 'page 20 "a": empty -> 1 step' in m512("diff", lib, high).stdout
    assert 'page 20 "a": 1 step -> empty' in m512("diff", high, lib).stdout


def test_diff_says_that_two_files_have_different_bits(m512, lib, tmp_path):
    high = tmp_path / "high.bin"
    high.write_bytes(read_text("motion512 1\nbits 12\npage 1 stand\n  step 1s | 1..4:2048\n").to_bytes())
    result = m512("diff", lib, high)
    assert result.exit_code == 3
    assert f"note: {high}: looks like 12 bit (positions up to 2048 in page 1) and is read so" in result.stderr
    assert f"note: {lib} has positions of 10 bits and {high} of 12: scale one of them first (m512 convert --scale)" in result.stderr
    assert m512("diff", lib, lib).stderr == ""


def test_pages_merge_takes_a_trim_over_as_a_trim(m512, lib, tmp_path):
    other = image(lib)
    other[0] = other[1].copy()
    (tmp_path / "other.bin").write_bytes(other.to_bytes())
    assert m512("pages", lib, "merge", tmp_path / "other.bin", "0", "--in-place").exit_code == 0
    assert image(lib)[0].data == other[0].data


TRIM = "motion512 1\npage 0\n  offset 1:-5 2:+3\npage 1 stand\n  step 1s | 1:512\n"


@pytest.fixture
def trimmed(tmp_path):
    path = tmp_path / "trimmed.bin"
    path.write_bytes(read_text(TRIM).to_bytes())
    return path


def test_pages_a_trim_is_not_overwritten_unasked(m512, lib, trimmed):
    before = trimmed.read_bytes()
    refused = m512("pages", trimmed, "merge", lib, "0", "--in-place")
    assert refused.exit_code == 5 and "page 0 is not empty" in refused.stderr and trimmed.read_bytes() == before
    assert m512("pages", trimmed, "merge", lib, "0", "--replace", "--in-place").exit_code == 0
    assert bytes(image(trimmed)[0]) == EMPTY


@pytest.mark.parametrize("words", [("mirror", "0"), ("retime", "0", "2")])
def test_pages_a_trim_is_not_changed_as_a_motion_is(m512, trimmed, words):
    before = trimmed.read_bytes()
    assert m512("pages", trimmed, *words, "--in-place").exit_code == 5
    assert trimmed.read_bytes() == before


def test_pages_a_trim_that_goes_is_told(m512, trimmed, tmp_path):
    assert "the robot's trim, is left behind" in m512("pages", trimmed, "extract", "1", "-o", tmp_path / "a.bin").stderr
    assert "trim" not in m512("pages", trimmed, "extract", "0", "1", "-o", tmp_path / "b.bin").stderr
    assert "held the robot's trim" in m512("pages", trimmed, "delete", "0", "-o", tmp_path / "c.bin").stderr


def test_pages_a_trim_is_shown_in_its_own_words(m512, trimmed):
    assert "offset 1:-5 2:+3" in m512("pages", trimmed, "show", "0").stdout


def test_diff_of_trims_names_the_joints(m512, trimmed, tmp_path):
    (tmp_path / "other.m512").write_text(TRIM.replace("1:-5 2:+3", "2:+5"))
    (tmp_path / "erased.m512").write_text(TRIM.replace("offset 1:-5 2:+3", "erased"))
    found = m512("diff", trimmed, tmp_path / "other.m512")
    assert found.exit_code == 3 and found.stdout.splitlines() == ["page 0, ID 1: trim -5 -> 0", "page 0, ID 2: trim 3 -> 5 (+2)"]
    found = m512("diff", tmp_path / "erased.m512", trimmed)
    assert found.exit_code == 3 and found.stdout.splitlines() == ["page 0, ID 1: trim 0 -> -5", "page 0, ID 2: trim 0 -> 3 (+3)"]


def test_pages_delete_passes_over_what_is_empty(m512, lib):
    """m512 advises a delete behind a write that broke off, and does not know how far that came."""
    result = m512("pages", lib, "delete", "50", "left", "60..70", "--in-place")
    assert result.exit_code == 0 and bytes(image(lib)[7]) == EMPTY, result.stderr
    assert "page 50 holds nothing" in result.stderr and "60..70: none of these pages holds anything" in result.stderr


def test_pages_delete_of_page_0_is_no_loss_of_links(m512, lib):
    """A link of 0 means no link."""
    assert m512("pages", lib, "delete", "0", "--in-place").stderr == ""


def test_pages_renumber_names_its_own_option(m512, lib):
    refused = m512("pages", lib, "renumber", "walk", "5", "--in-place")
    assert refused.exit_code == 5 and "--swap" in refused.stderr and "--replace" not in refused.stderr
    before = lib.read_bytes()
    assert m512("pages", lib, "renumber", "walk", "3", "--in-place").exit_code == 0 and lib.read_bytes() == before


def test_pages_of_a_backup_are_in_its_file(m512, tmp_path):
    found = m512("pages", tmp_path, "list")
    assert found.exit_code == 4 and "motions.bin" in found.stderr


def test_pages_time_of_a_page_without_steps_is_an_error(m512, lib):
    assert m512("pages", lib, "rename", "12", "later", "--in-place").exit_code == 0
    result = m512("pages", lib, "time", "later")
    assert result.exit_code == 4 and "page 12 has no action" in result.stderr and not result.stdout


def test_pages_copy_keeps_self_links_on_the_copy(m512, lib):
    assert m512("pages", lib, "copy", "walk", "20", "--in-place").exit_code == 0
    assert image(lib)[20].next == 20 and image(lib)[20].exit == 5 and image(lib)[3].next == 3
    result = m512("pages", lib, "copy", "1", "3", "--in-place")
    assert result.exit_code == 5 and "is not empty" in result.stderr


def test_pages_delete_tells_who_still_links_there(m512, lib):
    result = m512("pages", lib, "delete", "left", "--in-place")
    assert bytes(image(lib)[7]) == EMPTY and 'page 3 "walk" still links to page 7 (link1 page)' in result.stderr


def test_pages_renumber_takes_all_links_along(m512, lib):
    assert m512("pages", lib, "renumber", "walk", "30", "--in-place").exit_code == 0
    now = image(lib)
    assert bytes(now[3]) == EMPTY and now[30].next == 30 and now[7].next == 30 and not now[7].fault()
    assert m512("pages", lib, "renumber", "walk", "7", "--in-place").exit_code == 5
    assert m512("pages", lib, "renumber", "walk", "7", "--swap", "--in-place").exit_code == 0
    now = image(lib)
    assert now[7].name == b"walk" and now[7].next == 7 and now[7].link1_page == 30 and now[30].next == 7


def test_pages_extract_and_merge_with_links(m512, lib, tmp_path):
    assert m512("pages", lib, "extract", "walk", "left", "-o", tmp_path / "two.m512").stderr == 'note: page 3 "walk": exit 5 is left behind\n'
    (tmp_path / "new.bin").write_bytes(EMPTY * 128)
    result = m512("pages", tmp_path / "new.bin", "merge", tmp_path / "two.m512", "walk:40", "left:41", "--in-place")
    now = image(tmp_path / "new.bin")
    assert now[40].next == 40 and now[40].link1_page == 41 and now[41].next == 40 and now[40].exit == 5
    assert 'page 40 "walk": exit 5 is not among the pages taken and leads to page 5 of the target, which is empty' in result.stderr
    assert m512("pages", tmp_path / "new.bin", "merge", lib, "all", "--in-place").exit_code == 0
    assert image(tmp_path / "new.bin")[5].name == b"stop"


def test_pages_mirror(m512, lib):
    assert m512("pages", lib, "mirror", "walk", "60", "--in-place").exit_code == 0
    page = image(lib)[60]
    assert words(page, 0) == [524, 624, 324, 424] and words(page, 1) == [514, 614, 314, 0x4000]
    assert (page.compliance(1), page.compliance(2)) == (0x55, 0x77)
    m512("pages", lib, "mirror", "60", "--in-place")
    assert words(image(lib)[60], 0) == [400, 500, 600, 700]


def test_pages_retime_and_time(m512, lib):
    result = m512("pages", lib, "retime", "walk", "1.5", "--in-place")
    page = image(lib)[3]
    assert [page.time(0), page.time(1), page.pause(1), page.accel] == [75, 75, 30, 48]
    assert "0.938 s -> 1.406 s" in result.stderr
    assert m512("pages", lib, "retime", "walk", "9", "--in-place").exit_code == 5
    result = m512("pages", lib, "retime", "walk", "0", "--in-place")
    assert result.exit_code == 2 and "0: the factor is 0.01..100" in result.stderr
    out = json.loads(m512("pages", lib, "time", "left", "--json").stdout)
    assert [p["page"] for p in out["pages"]] == [7, 3] and out["end"] == "goes on with page 3 for ever"
    assert out["pages"][1]["seconds"] == pytest.approx(2 * 180 / 128, abs=0.01)


def test_a_play_ends_in_a_ring_of_pages_that_are_passed_over(m512, tmp_path):
    """LAWS.md, rule 2: a page that was already passed over ends the play. One page of the ring that plays keeps it going."""
    text = """motion512 1
page 1 a
 next 5
 step 128 | 1:300
page 5 b
 repeat 0
 next 6
 step 128 | 1:300
page 6 c
 repeat %d
 next 5
 step 128 | 1:300
"""
    for repeat, end in ((0, "ends at page 5, which has repeat 0"), (1, "goes on with page 5 for ever")):
        (tmp_path / "x.bin").write_bytes(read_text(text % repeat).to_bytes())
        assert json.loads(m512("pages", tmp_path / "x.bin", "time", "1", "--json").stdout)["end"] == end


@pytest.mark.parametrize(
    "pages, problem",
    [
        ("page 12 via\n repeat 0\n next 99\n step 9 | 1:512\n", "page 12, which is passed over (repeat 0) to page 99, which has no action"),
        ("page 12 via\n repeat 0\n next 12\n step 9 | 1:512\n", "page 12, which is passed over (repeat 0) to page 12 again"),
        ("page 12 via\n repeat 0\n next 2\n step 9 | 1:512\n", ""),
        ("page 12 via\n repeat 0\n step 9 | 1:512\n", ""),
        ("page 12 end\n next 12\n step 9 | 1:512\n", ""),
    ],
)
def test_check_follows_pages_that_are_passed_over(m512, tmp_path, pages, problem):
    """The board ends such a play with a fault: LAWS.md, section 1 rule 2."""
    path = tmp_path / "x.bin"
    path.write_bytes(read_text(f"motion512 1\npage 2 b\n next 12\n step 9 | 1:512\n{pages}").to_bytes())
    result = m512("pages", path, "check", "--json")
    found = [row["problem"] for row in json.loads(result.stdout)]
    assert (result.exit_code, len(found)) == ((3, 1) if problem else (0, 0)) and problem in "".join(found), result.stdout


@pytest.mark.parametrize("base, factor, fits", [("time", "4", "raise"), ("speed", "4", "lower"), ("speed", "0.25", "raise")])
def test_the_advice_of_a_refused_retime_is_followed(m512, tmp_path, base, factor, fits):
    """Four times the length, or a quarter of it, by the page's speed alone."""
    text = f"motion512 1\npage 1 x\n base {base}\n speed %d\n step 100 pause 100 | 1:300\n step 100 pause 100 | 1:700\n"
    path, seconds = tmp_path / "x.bin", {}
    for speed in (8, 32, 128):
        path.write_bytes(read_text(text % speed).to_bytes())
        seconds[speed] = json.loads(m512("pages", path, "time", "1", "--json").stdout)["pages"][0]["seconds"]
    path.write_bytes(read_text(text % 32).to_bytes())
    result = m512("pages", path, "retime", "1", factor, "--in-place")
    assert result.exit_code == 5 and f"at most 255 fit: {fits} the page's speed instead" in result.stderr
    assert seconds[128 if fits == "raise" else 8] / seconds[32] == pytest.approx(float(factor), rel=0.02)


@pytest.mark.parametrize("accel, factor, after", [(1, "0.3", 1), (4, "0.1", 1), (4, "0.5", 2), (0, "3", 0)])
def test_pages_retime_leaves_no_page_without_its_ramp(m512, tmp_path, accel, factor, after):
    """With a ramp of 0 the joints start at full speed. That is for the user to say."""
    path = tmp_path / "x.bin"
    path.write_bytes(read_text(f"motion512 1\npage 1 x\n accel {accel}\n step 50 | 1:300\n step 50 | 1:700\n").to_bytes())
    assert m512("pages", path, "retime", "1", factor, "--in-place").exit_code == 0
    assert image(path)[1].accel == after


def test_pages_time_ends_where_no_page_follows(m512, tmp_path):
    """Also in a complete image, which has a page 0."""
    path = tmp_path / "fast.bin"
    (tmp_path / "fast.m512").write_text(FAST)
    assert m512("convert", tmp_path / "fast.m512", path).exit_code == 0
    out = json.loads(m512("pages", path, "time", "1", "--json").stdout)
    assert [p["page"] for p in out["pages"]] == [1] and out["end"] == "ends"


FAST = """motion512 1
row 1..2
page 1 fast
  accel 0
  step 50 | 400 512
  step 12 | 496 512
  step 12 | 400 512
"""


def test_pages_time_says_where_a_servo_cannot_follow(m512, tmp_path):
    """96 units in 12 ticks are 300 degrees/s. An AX-12 reaches 59 rpm = 354 degrees/s at 12 V: 327 at 11.1, 283 at 9.6."""
    path = tmp_path / "fast.bin"
    path.write_bytes(read_text(FAST).to_bytes())
    said = m512("pages", path, "time", "fast").stdout.splitlines()
    assert said[-2:] == [
        f"page   1 step {step}: too fast at 9.6 V: joint 1 is asked for 300 degrees/s, an unloaded AX-12 does 283" for step in (2, 3)
    ]
    assert len(said) == 4
    assert not json.loads(m512("pages", path, "time", "fast", "--volts", "11.1", "--json").stdout)["too_fast"]
    assert m512("pages", path, "time", "fast", "--volts", "2").exit_code == 2


@pytest.mark.parametrize("fast", ["step 12 | 640 512", "step 12 pause 10 | 640 512", "step 2 | 440 512", "step 1 | 420 512"])
@pytest.mark.parametrize("page", ["", "  next 2\npage 2 slow\n  accel 0\n"])
def test_pages_time_does_not_blame_the_step_after_the_fast_one(m512, tmp_path, fast, page):
    """The fast step moves 20 units in each tick, which are 750 degrees/s. The one after it moves on by half a unit in each tick."""
    path = tmp_path / "fast.m512"
    path.write_text(f"motion512 1\nrow 1..2\npage 1 fast\n  accel 0\n  step 50 | 400 512\n  {fast}\n{page}  step 48 | - 536\n")
    found = json.loads(m512("pages", path, "time", "fast", "--json").stdout)["too_fast"]
    assert found == [{"page": 1, "step": 2, "joint": 1, "degrees_s": 750}]


TWELVE = """motion512 1
bits 12
page 1 slow
  accel 0
  base speed
  next 2
  step 128 | 1:2048
  step 128 | 1:4095 2:2048
page 2 back
  accel 0
  step 100 | 1:2048
  step 20 | 1:4095
"""


def test_pages_time_ends_at_a_page_without_steps(m512, tmp_path):
    """A play passes over a page with repeat 0 (PAGE_FORMAT.md, byte 15), and not over one without steps (byte 20)."""
    path = tmp_path / "gap.m512"
    path.write_text("motion512 1\npage 1\n next 2\n step 0.5s | 1:1\npage 2 none\n next 3\npage 3\n step 0.5s | 1:9\n")
    out = json.loads(m512("pages", path, "time", "1", "--json").stdout)
    assert [part["page"] for part in out["pages"]] == [1] and out["end"] == "ends at page 2, which is empty"
    path.write_text(path.read_text().replace("none\n", "none\n repeat 0\n step 1s | 1:5\n"))
    out = json.loads(m512("pages", path, "time", "1", "--json").stdout)
    assert [part["page"] for part in out["pages"]] == [1, 3] and out["end"] == "ends"


def test_pages_time_begins_in_the_first_pose(m512, tmp_path):
    """The approach leads there before the play. In speed base a step takes 40 M 32 / (3 s p) ticks (PAGE_FORMAT.md)."""
    path = tmp_path / "speed.m512"
    path.write_text("motion512 1\npage 1\n base speed\n repeat 2\n step 32 | 1:300\n step 32 | 1:700\n")
    once = 40 * 400 * 32 / (3 * 32 * 32) / 128
    out = json.loads(m512("pages", path, "time", "1", "--json").stdout)
    assert out["seconds"] == pytest.approx(3 * once, abs=0.02)  # there, back and there again


def test_pages_time_counts_the_degrees_of_12_bit_positions(m512, tmp_path):
    """FORMAT.md: 4096 units are 360 degrees, and speed 256 is 720 degrees/s. So half a turn at 128, 360 degrees/s, takes half a second.
    Half a turn in 20 ticks is 1152 degrees/s, and in 100 ticks 230, for which 9.6 V are enough (59 rpm at 12 V)."""
    path = tmp_path / "twelve.m512"
    path.write_text(TWELVE)
    out = json.loads(m512("pages", path, "time", "slow", "--json").stdout)
    assert out["pages"][0]["seconds"] == pytest.approx(0.5, abs=0.02)
    assert [(part["page"], part["step"]) for part in out["too_fast"]] == [(1, 2), (2, 2)]
    assert out["too_fast"][1]["degrees_s"] == pytest.approx(1152, rel=0.01)
    path.write_text(TWELVE.replace("step 20", "step 100").replace("speed", "time"))
    assert json.loads(m512("pages", path, "time", "slow", "--json").stdout)["too_fast"] == []


@pytest.mark.parametrize(
    "pauses, following, looked", [(10, "next none", True), (40, "next none", False), (20, "next self", False), (10, "next self", True)]
)
def test_pages_time_says_how_far_it_has_looked(m512, tmp_path, pauses, following, looked):
    """A play of more than a minute, one pass and what follows it, is not looked at to its end."""
    path = tmp_path / "long.m512"
    path.write_text(f"motion512 1\npage 1 long\n  repeat {pauses}\n  {following}\n  step 1s pause 1s | 1:500\n")
    said = m512("pages", path, "time", "long").stdout
    assert ("for joints that are too fast, only the first 60 s were looked at" in said) != looked, said
    out = json.loads(m512("pages", path, "time", "long", "--json").stdout)
    assert (out["looked_at_s"] < 60) == looked


def test_pages_actions_want_a_place_for_the_result(m512, lib):
    before = lib.read_bytes()
    result = m512("pages", lib, "rename", "walk", "x")
    assert result.exit_code == 2 and "say where the result goes: -o FILE, or --in-place" in result.stderr and lib.read_bytes() == before


def test_pages_unknown_and_ambiguous_names(m512, lib):
    assert "no page is called 'fly'" in m512("pages", lib, "show", "fly").stderr
    m512("pages", lib, "copy", "walk", "20", "--in-place")
    assert "not unique: pages 3, 20" in m512("pages", lib, "show", "walk").stderr


def test_pages_damaged_pages_are_not_worked_on(lib):
    broken = image(lib)
    broken[3].data[70] ^= 1
    with pytest.raises(Exception, match="page 3 is damaged"):
        operations.copy(broken, 3, 40)


def test_pages_help_of_every_action_has_an_example(m512):
    from m512.cli.pages import pages

    for name in pages.commands:
        out = m512("pages", "x", name, "--help").stdout
        assert "Example" in out, name


# diff


def test_diff_says_where_and_what(m512, lib, tmp_path):
    new = tmp_path / "new.m512"
    new.write_text(
        TEXT.replace("400 500 600 700", "400 530 600 -")
        .replace("pause 20", "pause 30")
        .replace("page 5 stop", "page 6 stop")
        .replace("code U", "code D")
        .replace("exit 5", "exit 6")
    )
    result = m512("diff", lib, new)
    assert result.exit_code == 3
    assert result.stdout.splitlines() == [
        'page 3 "walk": exit 5 -> 6',
        'page 3 "walk": code U -> D',
        'page 3 "walk", step 1, ID 2: 500 -> 530 (+30)',
        'page 3 "walk", step 1, ID 4: 700 -> -',
        'page 3 "walk", step 2: pause 20 -> 30',
        'page 5 "stop": 1 step -> empty',
        'page 6 "stop": empty -> 1 step',
    ]
    assert m512("diff", lib, lib).exit_code == 0
    rows = json.loads(m512("diff", lib, new, "--json").stdout)
    assert rows[2] == {"page": 3, "name": "walk", "what": "", "before": "500", "after": "530", "step": 1, "joint": 2}


def test_diff_finds_every_single_byte():
    a = read_text(TEXT)
    for at in range(512):
        b = from_bytes(a.to_bytes())
        b[3].data[at] ^= 1
        assert images(a, b), at


LINKED = "motion512 1\npage 3 a\n  next 1\n  exit 9\n  link1 U 8\n  link2 D 4\n  blend left 2\n  step 1s | 1:500\npage 4 d\n  step 1s | 1:5\n"


def test_merge_says_which_page_of_the_target_a_link_leads_to(m512, tmp_path):
    (tmp_path / "a.m512").write_text(LINKED)
    (tmp_path / "b.m512").write_text("motion512 1\n" + "".join(f"page {n} {name}\n  step 1s | 1:500\n" for n, name in ((1, "ready"), (8, '""'))))
    result = m512("pages", tmp_path / "b.m512", "merge", tmp_path / "a.m512", "3:20", "4:9", "-o", tmp_path / "c.bin")
    leads = ['next 1 @page 1 "ready" of the target', 'exit 9 @page 9 "d" of the target', "link1 page 8 @page 8 of the target"]
    leads += ["blend left 2 @page 2 of the target, which is empty"]
    assert result.exit_code == 0 and result.stderr.splitlines() == [
        f'note: page 20 "a": {text.replace("@", "is not among the pages taken and leads to ")}' for text in leads
    ]
    assert image(tmp_path / "c.bin")[20].link2_page == 9


def test_extract_says_which_partners_are_left_behind(m512, tmp_path):
    """FORMAT.md: a blend partner is a page, like the target of a link."""
    (tmp_path / "a.m512").write_text(
        "motion512 1\npage 3 a\n  link1 U 8\n  blend right 4\n  blend left 5\n  step 1s | 1:500\n"
        "page 4 b\n  step 1s | 1:500\npage 5 c\n  step 1s | 1:500\npage 8 d\n  step 1s | 1:500\n"
    )
    result = m512("pages", tmp_path / "a.m512", "extract", "3", "4", "-o", tmp_path / "b.bin")
    assert result.stderr.splitlines() == [f'note: page 3 "a": {what} is left behind' for what in ("link1 page 8", "blend left 5")]


def test_diff_says_once_what_empty_pages_have_that_has_no_effect(m512, tmp_path):
    """A .mtn fills unused steps and joints in its own way. For 124 empty pages one line is enough."""
    (tmp_path / "a.m512").write_text("motion512 1\npage 1 a\n  step 1s | 1:500 2:500\npage 3 c\n  step 1s | 1:400\n")
    assert m512("convert", tmp_path / "a.m512", tmp_path / "a.mtn").exit_code == 0
    found = m512("diff", tmp_path / "a.m512", tmp_path / "a.mtn")
    said = found.stdout.splitlines()
    assert found.exit_code == 3
    assert [line for line in said if not line.startswith(("page 1 ", "page 3 "))] == [
        "pages 2 and 4..127: empty in both; bytes without effect differ"
    ]
    assert len([line for line in said if "unused step" in line]) == 2


def test_diff_images_of_different_size():
    a, b = Image.empty(128), Image.empty(256)
    b[200] = read_text(TEXT)[3]
    assert [str(change) for change in images(a, b)] == ['page 200 "walk": only in the second']


def test_check_names_motions_that_their_code_never_calls(m512, tmp_path):
    """A code calls the lowest playable page that has it (REMOTE.md)."""
    step = "  step 1s | 1:512\n"
    text = f"motion512 1\npage 3 empty\n  code U\npage 20 a\n  code U\n{step}page 21 b\n  code D\n{step}page 40 c\n  code U\n{step}"
    (tmp_path / "x.m512").write_text(text)
    result = m512("pages", tmp_path / "x.m512", "check")
    told = 'note: page 40 "c": code U calls page 20, which has it, too, and never this one\n'
    assert result.exit_code == 0 and result.stderr == told, result.stderr


def test_check_says_once_what_holds_for_many_pages(m512, tmp_path):
    pages = "".join(f"page {n} p{n}\n  speed {21 if n < 40 else 64}\n  step 1s | 1:512\n" for n in range(10, 42))
    (tmp_path / "a.m512").write_text("motion512 1\n" + pages)
    done = m512("pages", tmp_path / "a.m512", "check")
    notes = [line for line in done.stderr.splitlines() if line.startswith("note:")]
    assert done.exit_code == 0 and len(notes) == 2
    assert notes[0].startswith("note: pages 10..39: speed 21: steps and pauses last 0.6562 times") and '40 "p40"' in notes[1]


def test_a_link_above_127_is_a_note_and_no_damage(m512, tmp_path):
    """LAWS.md: it counts as 0. Edit and the player accept such a page, and so does m512: it is listed, kept, converted and flashed."""
    (tmp_path / "a.m512").write_text("motion512 1\npage 10 hop\n  next 0xC8\n  step 1s | 1:512\n")
    assert m512("convert", tmp_path / "a.m512", tmp_path / "a.bin").exit_code == 0
    checked = m512("pages", tmp_path / "a.bin", "check")
    assert checked.exit_code == 0 and "all good" in checked.stdout
    assert 'note: page 10 "hop": next 200: there is no such page, so the robot follows no link there' in checked.stderr
    listed = m512("pages", tmp_path / "a.bin", "list").stdout
    assert "DAMAGED" not in listed and "next 200" in listed
    assert m512("convert", tmp_path / "a.bin", tmp_path / "b.m512").exit_code == 0
    assert "next 0xC8" in (tmp_path / "b.m512").read_text() and "damaged" not in (tmp_path / "b.m512").read_text()
    assert "ends" in m512("pages", tmp_path / "a.bin", "time", "hop").stdout


def test_erased_flash_is_no_damage_and_no_trim(m512, tmp_path):
    path = tmp_path / "new.bin"
    path.write_bytes(b"\xff" * 65536)
    result = m512("pages", path, "check")
    assert (result.exit_code, result.stdout) == (0, "0 pages in use, all good\n")
    for suffix in ("m512", "hex", "mtn"):
        result = m512("convert", path, tmp_path / f"new.{suffix}")
        assert result.exit_code == 0 and "damaged" not in result.stderr and "trim" not in result.stderr, result.stderr
    assert m512("convert", tmp_path / "new.m512", tmp_path / "again.bin").exit_code == 0
    assert (tmp_path / "again.bin").read_bytes() == path.read_bytes()
