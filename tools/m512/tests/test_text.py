# SPDX-License-Identifier: MIT
"""The text format: its words by examples, its errors by line, and its byte-exact round trip by property tests."""

import re

import pytest
from chance import given, settings
from conftest import REPO
from hypothesis import strategies as st

from m512.errors import FileError, TextError
from m512.files.image import Image, from_bytes
from m512.files.page import EMPTY, Page
from m512.files.text import read_text, write_text

HEAD = "motion512 1\nrow 1..4\n"


def page_of(text, number=1):
    return read_text(HEAD + text)[number]


def positions(page, step, joints=(1, 2, 3, 4)):
    return [page.word(step, joint) for joint in joints]


def error(text):
    with pytest.raises(TextError) as caught:
        read_text(text)
    return str(caught.value)


# Meaning


@pytest.mark.parametrize(
    "statement, advice",
    [("step 3s | 1:512", "Raise the page's speed"), ("step 1s pause 3s | 1:512", "in speed base lower it"), ("accel 3s", "There is no longer ramp")],
)
def test_a_time_too_long_for_a_byte_gets_advice_that_helps(statement, advice):
    """PAGE_FORMAT.md: in time base the page's speed makes steps and pauses longer, in speed base pauses shorter; it does not scale a ramp."""
    said = error(f"motion512 1\npage 1\n {statement}\n")
    assert "3s is 384 ticks" in said and advice in said


def test_text_page_without_statements_is_the_empty_page():
    assert bytes(page_of("page 1")) == EMPTY


def test_text_header_fields_land_in_their_bytes():
    page = page_of("""
page 1 wave
  code L+B1; repeat 3; base speed; speed 40; accel 16
  next self; exit 9; link1 U 5; link2 B4 none
  dxl_setup 7; byte63 0x55; softness 5 3:7 4:1/2
""")
    data = page.data
    assert data[:14] == b"wave" + bytes(10)
    assert [data[15], data[16], data[20], data[21], data[22], data[23], data[24]] == [3, 0, 0, 4 + 16, 40, 7, 16]
    assert list(data[25:31]) == [1, 9, 5, 1, 0, 128]
    assert [data[32 + 2], data[32 + 3], data[32 + 4], data[63]] == [0x55, 0x77, 0x12, 0x55]
    assert sum(data) % 256 == 0xFF


def test_text_step_words_stand_where_the_specification_says():
    page = page_of("page 1\nstep 64 pause 9 | 1 2 3 1023\n")
    assert page.data[64 + 2 : 64 + 10] == bytes([1, 0, 2, 0, 3, 0, 0xFF, 0x03])
    assert [page.data[64 + 62], page.data[64 + 63], page.data[20]] == [9, 64, 1]
    assert page.word(0, 0) == page.word(0, 30) == 0x4000


def test_text_joints_by_id_list_range_and_name():
    page = page_of("joint 4 hand\npage 1\nstep 1 | 1:10 2,3:20 hand:30 5..7:40\n")
    assert [page.word(0, j) for j in range(1, 9)] == [10, 20, 20, 30, 40, 40, 40, 0x4000]


def test_text_times_in_seconds_and_milliseconds_are_ticks_of_a_128th():
    page = page_of("page 1\naccel 125ms\nstep 0.5s pause 1s | 1:1\nstep 250ms | 1:2\nstep 7.8125ms | 1:3")
    assert page.accel == 16
    assert [page.time(k) for k in range(3)] == [64, 32, 1] and page.pause(0) == 128


def test_text_speed_in_degrees_per_second():
    assert page_of("page 1\nbase speed\nstep 360dps | 1:1").time(0) == 128  # 256 = 720 degrees/s


def test_text_degrees_count_from_the_centre():
    page = page_of("page 1\nstep 1 | 1:30deg 2:-30deg 3:0deg")  # 300 degrees = 1024 units, 512 = centre
    assert positions(page, 0)[:3] == [614, 410, 512]


def test_text_pose_same_relative_and_not_used():
    page = page_of("""
pose stand | 500 510 520 530
pose arms  | 3:100
page 1
  step 1 | @stand @arms 1:+5
  step 2 | same 2:-10 4:-
  step 3 | @stand . . 7 -
""")
    assert positions(page, 0) == [505, 510, 100, 530]
    assert positions(page, 1) == [505, 500, 100, 0x4000]
    assert positions(page, 2) == [500, 510, 7, 0x4000]


def test_text_mirror_exchanges_pairs_about_512():
    page = page_of("page 1\nstep 1 | 1:400 2:512 3:- 4:600\nstep 1 | mirror same")
    assert positions(page, 1) == [512, 624, 424, 0x4000]


def test_text_pairs_may_be_given_and_a_single_joint_turns_round():
    page = page_of("pairs 1-4 2\npage 1\nstep 1 | 1:400 2:500 3:300\nstep 1 | mirror same")
    assert positions(page, 1) == [0x4000, 524, 300, 624]


def test_text_raw_flags_and_words():
    page = page_of("page 1\nstep 1 | ~300 ?200 0x8001 -")
    assert positions(page, 0) == [0x4000 + 300, 0x2000 + 200, 0x8001, 0x4000]


def test_text_fill_reaches_unused_steps_and_unnamed_joints():
    page = page_of("page 1\nfill 64 | 0..25:~512 26..30:0\nstep 9 | 1:5")
    assert [page.word(0, 0), page.word(0, 1), page.word(0, 30), page.word(6, 1)] == [0x4200, 5, 0, 0x4200]
    assert [page.time(0), page.time(6)] == [9, 64]


def test_text_spare_steps_and_count_keep_what_lies_behind():
    page = page_of("page 1\nsteps 9\nstep 9 | 1:5\nspare 4 7 | 1:6")
    assert page.steps == 9 and page.word(4, 1) == 6 and page.time(4) == 7


def test_text_raw_is_applied_last_and_the_sum_follows():
    page = page_of("page 1 a\nraw 0 62 63\nraw 511 07")
    assert page.name == b"bc" and page.data[511] == 7 and sum(page.data) % 256 == 0xFF


def test_text_checksum_is_taken_literally():
    assert page_of("page 1\nchecksum 0x12").checksum == 0x12


def test_text_links_by_name_number_and_quoted_name():
    image = read_text(HEAD + 'page 1 a\nnext "b c"; exit d\npage 2 "b c"\npage 7 d\nnext 2')
    assert (image[1].next, image[1].exit, image[7].next) == (2, 7, 2)


def test_text_defaults_apply_to_the_pages_that_follow():
    image = read_text("motion512 1\naccel 9\npage 1\naccel 10\npage 2\ndefaults\naccel 11; next self\npage 3")
    assert [image[n].accel for n in (1, 2, 3, 4)] == [10, 9, 11, 32]
    assert image[3].next == 3


def test_text_page_range_with_self_links():
    image = read_text("motion512 1\npage 4..6 x\nnext self")
    assert [image[n].next for n in (4, 5, 6)] == [4, 5, 6] and image[6].name == b"x"


def test_text_trim_offsets_are_signed_words():
    page = read_text("motion512 1\npage 0\noffset 3:-5 4:+2")[0]
    assert page.word(2, 3) == 0xFFFB and page.word(2, 4) == 2


def test_text_include(tmp_path):
    (tmp_path / "poses.m512").write_text("motion512 1\nrow 1..2\npose up | 5 6\naccel 7\n")
    main = tmp_path / "main.m512"
    main.write_text('motion512 1\ninclude "poses.m512"\npage 1\nstep 1 | @up\n')
    page = read_text(main.read_text(), str(main), tmp_path)[1]
    assert positions(page, 0, (1, 2)) == [5, 6] and page.accel == 7


def test_text_continued_line_and_comments():
    page = page_of('page 1 "a#b"   # c\nstep 1 | 1 2 \\\n 3 4 # d')
    assert page.name == b"a#b" and positions(page, 0) == [1, 2, 3, 4]


# Errors name file, line and what to do


@pytest.mark.parametrize(
    "line, says",
    [
        ("page 128", "page must be 0..127"),
        ("pag 1", "unknown word pag"),
        ('page 1 "x', "a quote is opened and not closed"),
        ("page 1 abcdefghijklmn", "at most 13 characters, not 14"),
        ("page 1 \u00e9", "ASCII"),
        ("page 1; speed 256", "speed must be 0..255, not 256"),
        ("page 1; speed fast", "speed is a number 0..255, not fast"),
        ("page 1; next nowhere", "no page is called nowhere"),
        ("page 1; next 128", "a link must be 0..127"),
        ("page 1 a; page 2 a; next a", "name of pages 1, 2"),
        ("page 1; page 1", "page 1 is there already (text:3)"),
        ("page 1; step 3s | 1:1", "3s is 384 ticks"),
        ("page 1; step 1ms | 1:1", "less than half a tick"),
        ("page 1; step 1 | 1:1024", "a position must be 0..1023, not 1024"),
        ("page 1; step 1 | 31:1", "joints are IDs 0..30"),
        ("page 1; step 1 | 5", "1 position; the row has 4 joints"),
        ("page 1; step 1 | 1:+5", "there is no position to change"),
        ("page 1; step 1 | same", "no step before"),
        ("page 1; step 1 | @x", "no pose is called x"),
        ("page 1; step 1 | mirror", "mirror @pose or mirror same"),
        ("page 1; step 1 | 1:0; step 1 | mirror same", "mirror image of position 0"),
        ("page 1" + "; step 1 | 1:1" * 8, "a page has 7 steps"),
        ("step 1 | 1:1", "step belongs into a page"),
        ("page 1; step 90dps | 1:1", "the page has time base"),
        ("page 1; base speed; step 1s | 1:1", "the page has speed base"),
        ("page 1; base fast", "base is time or speed"),
        ("page 1; code X", "keys of U D L R"),
        ("page 1; step 1 | 1:", "a position is a number"),
        ("page 1; step 99999999999999999999s | 1:1", "time is a number 0..255"),
        ("page " + "9" * 5000, "a number 0..127 or a range"),
        ("page 1; step 1 | " + "9" * 5000 + ":1", "no joint is called"),
        ("page 1; speed " + "9" * 5000, "speed is a number"),
        ("page 1; raw 510 00 00 00", "beyond the page's 512"),
        ("page 1; raw 0 0g", "pairs of hex digits"),
        ("joint 1 a; joint 2 a", "a is joint 1 already"),
        ("pose p | 1:1; pose p | 1:2", "pose p is there already"),
        ('include "nowhere.m512"', "cannot read nowhere.m512"),
        (f'include "{"x" * 300}.m512"', "cannot read xx"),  # an error of the folder, as that of one without rights
        ("bits 11", "bits are 10 or 12"),
        ("page 5; offset 1:2", "offset belongs into page 0"),
        ("page 5; next 1; next 2", "page 5: next is here a second time, after line 3"),
        ("page 5..9 a; exit 1; exit 1", "page 5..9: exit is here a second time"),
        ("page 5; blend left 1; blend right 2; blend left 3", "page 5: blend left is here a second time"),
        ("page 5; spare 2 1 | 1:1; spare 0x2 1 | 1:1", "page 5: spare 2 is here a second time"),
        ("page 5; softness 1:3; softness 5", "the level of all joints comes first"),
        ("page 0; offset 1:2 3:4; offset 1..2:5", "page 0: the offset of joint 1 is here a second time"),
        ("pages 0..255; pages 0..127", "pages 0..255 was said before"),
        ("bits 12; bits 10", "bits 12 was said before"),
    ],
)
def test_text_error(line, says):
    message = error("motion512 1\nrow 1..4\n" + line)
    assert says in message and message.startswith("text:3: ")


@pytest.mark.parametrize(
    "word", "repeat 1,speed 9,accel 9,base time,code U,link1 U 1,link2 U 1,dxl_setup 1,byte63 1,steps 0,checksum 0,fill 1 | 1:1,erased".split(",")
)
def test_text_a_page_says_one_value_once(word):
    name = word.split()[0]
    assert f"page 5: {name} is here a second time, after line 3" in error(f"motion512 1\npage 5\n{word}\n{word}\n")


def test_text_defaults_may_be_said_again_and_a_page_goes_its_own_way():
    image = read_text(
        "motion512 1\nbits 10; bits 10\nspeed 40; speed 41; softness 1:3; softness 6\npage 1; speed 50; page 2\ndefaults; speed 42\npage 3\n"
    )
    assert [image[n].speed for n in (1, 2, 3)] == [50, 41, 42] and image[1].compliance(1) == 0x66


def test_text_wrong_start_and_version():
    assert 'starts with "motion512 1"' in error("hello")
    assert "format version 2" in error("motion512 2")
    for start in ("motion512", "motion512 1 extra"):
        assert 'starts with "motion512 1" and no other word' in error(start)
    with pytest.raises(FileError, match="empty"):
        read_text("\n# nothing\n")


def test_text_has_so_many_includes_and_no_more(tmp_path):
    """Seven files that include the next ten times each are 1,111,111 includes."""
    for number in range(7):
        (tmp_path / f"{number}.m512").write_text("motion512 1\n" + f"include {number + 1}.m512\n" * 10)
    (tmp_path / "7.m512").write_text("motion512 1\n")
    with pytest.raises(FileError, match="more than 1,000 includes"):
        read_text((tmp_path / "0.m512").read_text(), "0.m512", tmp_path)
    (tmp_path / "many.m512").write_text("motion512 1\n" + "include 7.m512\n" * 1000)
    read_text((tmp_path / "many.m512").read_text(), "many.m512", tmp_path)


@pytest.mark.parametrize("order", ["{0}; {1}", "{1}; {0}"])
@pytest.mark.parametrize(
    "page, statement, steps, fits",
    [
        (0, "offset 3:-5", 2, True),
        (0, "offset 3:-5", 3, False),
        (0, "offset 3:-5", 7, False),
        (5, "spare 4 9 | 1:5", 4, True),
        (5, "spare 4 9 | 1:5", 5, False),
        (5, "spare 0 9 | 1:5", 1, False),
    ],
)
def test_text_what_a_step_of_the_page_would_replace_is_refused(order, page, statement, steps, fits):
    """FORMAT.md: spare K is step K, which the page does not use; the offset is stored as step 2. K counts from 0."""
    text = f"motion512 1\npage {page}; " + order.format(statement, "; ".join(["step 9 | 1:7"] * steps))
    if not fits:
        assert f"page {page}: {' '.join(statement.split()[: 1 if page == 0 else 2])} sets step" in error(text)
        return
    words = read_text(text)[page].words(2 if page == 0 else 4)
    assert words[3] == 0xFFFB if page == 0 else words[1] == 5


@pytest.mark.parametrize("base, step", [("speed", "0.5s"), ("time", "90dps")])
def test_text_error_of_a_unit_names_the_file_of_the_page(tmp_path, base, step):
    """Only the whole text tells the base of a page, because `base` may come after the step."""
    with pytest.raises(TextError, match=r"other\.m512:4: a (time|speed) in "):
        included(tmp_path, 'include "other.m512"\npage 9\n\n\n\n', f"page 5\n# a comment\nstep {step} | 1:5\nbase {base}\n")


def test_text_error_of_a_link_names_the_file_of_its_statement(tmp_path):
    """Also of a default: the page is in another file."""
    with pytest.raises(TextError, match=r"other\.m512:2: no page is called nowhere"):
        included(tmp_path, 'include "other.m512"\n\n\npage 9\n', "next nowhere\n")
    with pytest.raises(TextError, match=r"main:3: no page is called nowhere"):
        included(tmp_path, 'include "other.m512"\npage 9; next nowhere\n', "page 8\n")


@pytest.mark.parametrize("sign", ["\x0b", "\x0c", "\x1c", "\x1d", "\x1e", "\x85", "\u2028", "\u2029"], ids=ascii)
def test_text_only_a_line_end_ends_a_comment(sign):
    """FORMAT.md: lines end with LF, CR LF or CR. Unicode knows more line ends, and editors put them into comments unseen."""
    image = read_text(f"motion512 1 # one{sign}page 3\npage 5 # two{sign}speed 99\nspeed 40")
    assert (image[5].speed, image[3] == Page()) == (40, True)
    assert error(f"motion512 1\n# a{sign}b\nhallo").startswith("text:3: ")


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"], ids=ascii)
def test_text_every_line_end_counts_once(end):
    assert error(end.join(["motion512 1", "page 5 \\", "name", "", "hallo"])).startswith("text:5: ")
    assert error(end.join(["motion512 1", "page 5 \\", "name \\", "", "hallo"])).startswith("text:5: ")
    assert "the last line ends in a backslash" in error(end.join(["motion512 1", "page 5 \\", ""]))


def test_an_error_in_a_line_that_is_continued_names_all_its_lines():
    assert error("motion512 1\npage 5\n step 1 | 512 \\\n 5l2 \\\n 512\n").startswith("text:3-5: ")
    assert error("motion512 1\npage 5 \\\nname; repeat 1\nrepeat 2").endswith("is here a second time, after line 2")
    assert error("motion512 1\npage 5 \\\nname \\\n").startswith("text:3: the last line ends in a backslash")


def included(tmp_path, main, other):
    (tmp_path / "other.m512").write_text("motion512 1\n" + other)
    return read_text("motion512 1\n" + main, "main", tmp_path)


def test_text_a_page_goes_on_after_an_include(tmp_path):
    """FORMAT.md: a page ends where the next page starts. A text of poses and defaults starts none."""
    image = included(tmp_path, 'page 1; speed 40\ninclude "other.m512"\nnext 2; step 9 | @up\npage 2', "accel 7; pose up | 1:500\n")
    assert (image[1].speed, image[1].next, image[1].steps, image[1].accel) == (40, 2, 1, 32)
    assert (image[2].speed, image[2].next, image[2].steps, image[2].accel) == (32, 0, 0, 7)


@pytest.mark.parametrize("before", ["", "page 1; "])
@pytest.mark.parametrize("statement", ["next 9", "speed 50", "softness 3", "blend left 3", "step 9 | 1:5", "raw 0 41"])
def test_text_page_statements_after_the_pages_of_an_include_need_a_page(tmp_path, before, statement):
    with pytest.raises(TextError, match=r'main:3: .*"other.m512" has pages, so no page is open after it: write "page" or "defaults" first'):
        included(tmp_path, before + f'include "other.m512"\n{statement}\n', "page 5")
    for opening in ("page 9", "defaults") if statement[:4] != "step" else ("page 9",):
        assert included(tmp_path, before + f'include "other.m512"\nrow 1\n{opening}\n{statement}\n', "page 5")[5] == Page()


def test_text_defaults_of_an_included_text_may_follow_pages(tmp_path):
    for name in ("up", "down"):
        (tmp_path / f"{name}.m512").write_text(f"motion512 1\npose {name} | 1:500\n")
    image = included(tmp_path, 'include "up.m512"\nspeed 40\npage 1\ninclude "other.m512"', 'include "down.m512"\nspeed 50\npage 2\n')
    assert [image[n].speed for n in (1, 2)] == [40, 50]


def test_text_include_in_a_circle(tmp_path):
    file = tmp_path / "a.m512"
    file.write_text('motion512 1\ninclude "a.m512"\n')
    with pytest.raises(TextError, match="circle"):
        read_text(file.read_text(), str(file), tmp_path)


# Round trip


def round_trip(image):
    text = write_text(image)
    assert read_text(text).to_bytes() == image.to_bytes()
    return text


@pytest.mark.parametrize("name, bits", [("robot_128p.bin", 10), ("robot_12bit_256p.bin", 10), ("robot_12bit_256p.bin", 12)])
def test_text_round_trip_of_whole_images(sample, name, bits):
    round_trip(from_bytes(sample(name).read_bytes(), bits))


def test_text_round_trip_without_page_0():
    image = from_bytes(EMPTY * 127)
    assert "pages 1..127" in round_trip(image)


def test_text_round_trip_of_erased_flash_is_short():
    text = round_trip(from_bytes(b"\xff" * 65536))
    assert "page 0..127 ; erased" in text and len(text) < 60


def test_text_round_trip_of_names_that_look_like_words():
    image = Image.empty()
    for number, name in enumerate(
        [b"self", b"none", b"12", b'a"b\\c', b" lead", b"#x", b"14 characters!", b"a\0b", b"\0b", b"\xff\x01", b"tab\t", b"14 characters\\"], 1
    ):
        image[number].data[:14] = name.ljust(14, b"\0")
        image[number].next = number % 12 + 1
        image[number].seal()
    round_trip(image)


def mutations():
    """An ordinary page with a few bytes changed, as after damage or by other programs."""
    change = st.tuples(st.integers(0, 511), st.integers(0, 255))
    return st.tuples(st.integers(0, 8), st.lists(change, max_size=12), st.booleans(), st.booleans())


def mutated(recipe):
    steps, changes, sealed, roboplus = recipe
    page = Page()
    page.steps = steps
    for step in range(min(steps, 7)):
        page.set_time(step, 40 + step)
        for joint in range(1, 19):
            page.set_word(step, joint, 400 + 10 * step + joint)
    if roboplus:
        page.byte63 = 0x55
        for step in range(7):
            for joint in range(31):
                if joint > 25 or step >= steps:
                    page.set_word(step, joint, 0 if joint > 25 else 0x4200)
    for at, value in changes:
        page.data[at] = value
    return page.seal() if sealed else page


@settings(max_examples=40)
@given(st.lists(mutations(), min_size=1, max_size=5), st.sampled_from([10, 12]))
def test_text_round_trip_of_damaged_pages(recipes, bits):
    image = Image.empty()
    image.bits = bits
    for number, recipe in enumerate(recipes):
        image[number] = mutated(recipe)
    round_trip(image)


@settings(max_examples=20)
@given(st.binary(min_size=512, max_size=512))
def test_text_round_trip_of_any_bytes(data):
    image = Image.empty()
    image[3] = Page(data)
    round_trip(image)


# FORMAT.md is correct


def format_md_blocks():
    text = (REPO / "tools" / "m512" / "FORMAT.md").read_text()
    return re.findall(r"^```\n(.*?)^```", text, re.S | re.M), text


def test_format_md_example_reads_as_it_says():
    image = read_text(format_md_blocks()[0][0])
    assert positions(image[12], 0, range(1, 7)) == [512, 512, 300, 723, 512, 512]
    assert positions(image[12], 1, (1, 4)) == [712, 614]
    assert positions(image[12], 2, (1, 4)) == [632, 0x4000]
    assert positions(image[12], 3, range(1, 7)) == [512, 312, 410, 724, 512, 512]
    assert image[12].next == 13 and image[12].code == 1 and image[12].accel == 32


def test_format_md_page_by_hand():
    text = format_md_blocks()[1]
    page = read_text("motion512 1\n" + re.search(r"    page 5 nod\n(    .*\n)+", text).group(0))[5]
    assert page.data[:16] == b"nod" + bytes(11) + bytes([0, 2])
    assert [page.data[i] for i in (16, 20, 22, 24, 31)] == [0x0A, 1, 0x20, 0x20, 0x33]
    assert page.data[66:70] == bytes.fromhex("5802a801") and page.data[126:128] == bytes([8, 40])


def test_text_written_says_damage_in_words_rather_than_bytes():
    image = read_text("motion512 1\npage 1 a\nstep 5 | 1:5\npage 2 b\nstep 5 | 1:5\npage 3 c\nnext 0xC8; base 0x05; speed 0")
    image[1].checksum ^= 0x40
    image[2].steps = 9
    image[2].seal()
    text = round_trip(image)
    assert "raw" not in text and f"checksum 0x{image[1].checksum:02X}" in text and "steps 9" in text
    assert "next 0xC8" in text and "base 0x05" in text and "speed 0" in text and text.count("# damaged:") == 3


def test_text_mirror_pairs_reach_from_1_to_18_unless_said():
    page = page_of("page 1\nstep 1 | 0..18:500\nstep 1 | mirror same")
    assert page.word(1, 0) == 500 and [page.word(1, j) for j in range(1, 19)] == [524] * 18


def test_a_step_in_speed_base_has_a_speed():
    """FORMAT.md: 1..255. A step of speed 0 would never end."""
    text = "motion512 1\npage 1\n  base speed\n  step 8 | 1:500\n  step 0 | 1:600\n"
    for wrong in (text, text.replace("  base speed\n", "") + "  base speed\n"):
        with pytest.raises(TextError, match=r":[45]: a step in speed base has a speed of 1..255"):
            read_text(wrong)
    assert read_text(text.replace("base speed", "base time"))[1].time(1) == 0
    page = read_text(text.replace("step 0", "step 9 "))[1]
    page.set_time(1, 0)
    image = Image.empty()
    image[1] = page.seal()
    assert read_text(write_text(image)).to_bytes() == image.to_bytes()  # an old image stays readable
