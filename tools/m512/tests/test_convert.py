# SPDX-License-Identifier: MIT
"""`m512 convert` and its file formats: figures with real files, losses, and bad input."""

import json
import random
from fractions import Fraction

import pytest

from m512.errors import FileError, RefusedError
from m512.files import formats, mtn, scale12
from m512.files.image import Image, from_bytes, from_hex, to_hex
from m512.files.page import EMPTY, Page


def test_convert_mtn_to_image_equals_the_image_made_from_the_description(m512, sample, tmp_path):
    out = tmp_path / "out.bin"
    assert m512("convert", sample("robot.mtn"), out).exit_code == 0
    assert out.read_bytes() == sample("robot_128p.bin").read_bytes()


def test_a_mtn_is_one_by_its_contents(m512, sample, tmp_path):
    (tmp_path / "robot.txt").write_bytes(sample("robot.mtn").read_bytes())
    assert m512("convert", tmp_path / "robot.txt", tmp_path / "out.bin").exit_code == 0
    assert (tmp_path / "out.bin").read_bytes() == sample("robot_128p.bin").read_bytes()


@pytest.mark.parametrize("name", ["robot_128p.bin", "robot_12bit_256p.bin"])
@pytest.mark.parametrize("suffix", [".m512", ".hex"])
def test_convert_every_image_to_text_and_hex_and_back(m512, sample, tmp_path, name, suffix):
    middle, out = tmp_path / f"x{suffix}", tmp_path / "y.bin"
    bits = "12" if "12bit" in name else "10"
    assert m512("convert", sample(name), middle, "--bits", bits).exit_code == 0
    assert m512("convert", middle, out).exit_code == 0
    assert out.read_bytes() == sample(name).read_bytes()


def test_convert_mtn_to_image_and_back_loses_two_rates(m512, sample, tmp_path):
    image, again = tmp_path / "x.bin", tmp_path / "y.mtn"
    result = m512("convert", sample("robot.mtn"), image, "--pages", "256")
    assert "rate 3; it becomes 32 / 10 = 3.20" in result.stderr and "rate 2.7; it becomes 32 / 11 = 2.91" in result.stderr
    assert m512("convert", image, again).stderr == ""
    before, after = (path.read_bytes()[:-2].split(b"\n") for path in (sample("robot.mtn"), again))
    different = [(a, b) for a, b in zip(before, after) if a != b]
    assert len(before) == len(after) and len(different) == 2
    assert [a.replace(b"3.0", b"3.2").replace(b"2.7", b"2.9") for a, _ in different] == [b for _, b in different]


def test_convert_12_bit_scaled_is_the_same_angle_within_rounding(sample):
    """A 12-bit unit is 360 / 4096 degrees about 2048, a 10-bit unit 300 / 1024 about 512. Values out of range are clipped."""
    before = from_bytes(sample("robot_12bit_256p.bin").read_bytes(), 12)
    scale12.keep_joints(before, range(1, 19))
    scaled, report = scale12.scaled(before, 10)
    cut = compared = 0
    for number, page in before.items():
        for step in range(page.steps):
            for joint in range(1, 19):
                wanted = 512 + Fraction(page.word(step, joint) - 2048) * 360 / 4096 * 1024 / 300
                cut += not -0.5 < wanted < 1023.5
                assert abs(scaled[number].word(step, joint) - min(max(wanted, 0), 1023)) <= 0.5, (number, step, joint)
                compared += 1
    assert cut and compared > 1000
    assert any(line.startswith(f"{cut} positions cut at the end") for line in report)


def test_convert_12_bit_there_and_back_is_within_rounding():
    image = Image.empty()
    image[1].steps = 1
    for joint in range(31):
        image[1].set_word(0, joint, joint * 33)
    image[1].seal()
    up, _ = scale12.scaled(image, 12)
    down, _ = scale12.scaled(up, 10)
    assert down.to_bytes() == image.to_bytes() and up[1].word(0, 0) == 341  # 2048 - 512 / 0.3


@pytest.mark.parametrize("steps", [0, 2, 3, 7])
def test_a_trim_is_scaled_with_the_positions(m512, tmp_path, steps):
    """100 and -5 units of 10 bits are 29.3 and -1.5 degrees, which 12 bits express by 333 and -17 units of 0.088 degrees. Page 0 is no
    motion, however many steps it says."""
    image = Image.empty()
    image[0].steps = steps
    image[0].set_word(6, 4, 800)
    for joint, words in {1: (0x4000, 0x4000, 100), 2: (0x4000, 0x4000, -5 & 0xFFFF), 3: (512, 501, -11 & 0xFFFF)}.items():
        for step, word in enumerate(words):
            image[0].set_word(step, joint, word)
    image[0].seal()
    formats.save(tmp_path / "x.bin", image)
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--bits", "10", "--scale", "12")
    scaled = formats.load(tmp_path / "y.bin", 12)
    page = scaled[0]
    assert page.trims()[:4] == [0, 333, -17, -37] and "3 trims of page 0 scaled" in result.stderr, result.stderr
    assert [page.word(step, 3) for step in (0, 1)] == [2048, 2011] and not page.fault(scaled.kind), "501 is 11 units from 512, 36.7 of 12 bits"
    assert page.word(6, 4) == (3008 if steps == 7 else 800)
    m512("convert", tmp_path / "y.bin", tmp_path / "z.bin", "--bits", "12", "--scale", "10")
    assert (tmp_path / "z.bin").read_bytes() == (tmp_path / "x.bin").read_bytes()


def trimmed(steps, trims, name=b""):
    """An image whose page 0 has these trims, by joint, and says so many steps."""
    image = Image.empty()
    image[0].steps, image[0].name = steps, name
    for joint, trim in trims.items():
        for step, word in enumerate((512, 512 + trim, trim & 0xFFFF)):
            image[0].set_word(step, joint, word)
    image[0].seal()
    return image


@pytest.mark.parametrize("steps", [0, 2, 3, 7])
def test_joints_that_are_left_out_take_their_trims_along(m512, tmp_path, steps):
    """A word of -5 has the bits of an unused joint, as a position; as a trim it has its sign."""
    formats.save(tmp_path / "x.bin", trimmed(steps, {1: 5, 2: -5, 3: 5, 4: -5, 5: 0}))
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--joints", "1..2")
    assert result.exit_code == 0 and "loss: 2 trims of page 0 left out (IDs 3 4)" in result.stderr, result.stderr
    assert "loss: 6 positions of joints left out (IDs 3 4 5)" in result.stderr
    page = formats.load(tmp_path / "y.bin", 10)[0]
    assert page.trims()[:6] == [0, 5, -5, 0, 0, 0] and not page.fault()
    assert [page.word(step, 3) for step in (0, 1, 2)] == [0x4000] * 3 and [page.word(step, 1) for step in (0, 1)] == [512, 517]


@pytest.mark.parametrize("steps", [0, 2, 3])
def test_trims_that_differ_are_told_as_trims(m512, tmp_path, steps):
    for name, trim in (("x.bin", 5), ("y.bin", -7)):
        formats.save(tmp_path / name, trimmed(steps, {2: trim}, b"robot"))
    lines = m512("diff", tmp_path / "x.bin", tmp_path / "y.bin").stdout.splitlines()
    assert lines == ["page 0, ID 2: trim 5 -> -7", 'page 0 "robot", step 2, ID 2: 517 -> 505 (-12)']
    assert "   0  (trim)" in m512("pages", tmp_path / "x.bin", "list").stdout


def image_of(bits, pages, high=None):
    """Pages of two steps about the centre for `bits`. `high`: the page with one position beyond 1023."""
    image = Image.empty(256)
    for number in range(1, pages + 1):
        image[number].steps = 2
        image[number].set_time(0, 50)
        image[number].set_time(1, 50)
        for joint in range(31):
            image[number].set_word(0, joint, 300 + joint if bits == 10 else 1500 + 40 * joint)
        if number == high:
            image[number].set_word(1, 4, 1400)
        image[number].seal()
    return image


@pytest.mark.parametrize("suffix", [".bin", ".hex"])
def test_a_12_bit_image_says_so_once(m512, tmp_path, suffix):
    path = tmp_path / f"op{suffix}"
    formats.save(path, image_of(12, 60))
    for command in (("pages", path, "check"), ("pages", path, "list"), ("convert", path, tmp_path / f"y{suffix}"), ("diff", path, path)):
        result = m512(*command)
        told = result.stderr + result.stdout
        assert result.exit_code == 0 and "amaged" not in told.lower(), told
        assert told.count("looks like 12 bit (positions up to 2700 in pages 1..60)") == (command[0] != "diff")
        assert told.count("--bits 12 --scale 10") == (command[0] != "diff")
    assert (tmp_path / f"y{suffix}").read_bytes() == path.read_bytes()
    insisted = m512("convert", path, tmp_path / "z.bin", "--bits", "10")
    assert insisted.stderr.count("\n") < 70 and "looks like 12 bit" in insisted.stderr
    result = m512("convert", path, tmp_path / "t.bin", "--scale", "10", "--pages", "128")
    assert result.exit_code == 0 and result.stderr.count("\n") == 2 and "1860 positions scaled from 12 to 10 bits" in result.stderr
    assert "looks like 12 bit" in result.stderr and "--scale" not in result.stderr  # what is being done is not advised
    assert m512("pages", tmp_path / "t.bin", "check").exit_code == 0


def few_high(tmp_path, count=4):
    """A 12-bit image that is taken for 10 bits: nine pages of 1:1000 and one with `count` words above 1023."""
    image = Image.empty(256)
    image.bits = 12
    for number in range(1, 11):
        image[number].steps = 2
        for joint in range(1, 19):
            image[number].set_word(0, joint, 2000 + joint if number == 10 and joint <= count else 1000)
        image[number].seal()
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    (tmp_path / "x.hex").write_text(to_hex(image))


@pytest.mark.parametrize("scale", ["10", "12"])
@pytest.mark.parametrize("kind", ["bin", "hex"])
def test_an_image_that_may_have_either_resolution_is_not_scaled_by_guess(m512, tmp_path, monkeypatch, kind, scale):
    monkeypatch.chdir(tmp_path)
    few_high(tmp_path)
    told = m512("convert", f"x.{kind}", "y.bin", "--scale", scale)
    assert told.exit_code == 5 and "page 10 (up to 2004)" in told.stderr and "--bits 12" in told.stderr, told.stderr
    assert not (tmp_path / "y.bin").exists()
    for bits in ("10", "12"):
        done = m512("convert", f"x.{kind}", "y.bin", "--scale", scale, "--bits", bits, "--force")
        assert done.exit_code == 0 and ("nothing is scaled" in done.stderr) == (bits == scale), done.stderr
        assert (f"positions scaled from {bits} to {scale} bits" in done.stderr) == (bits != scale)


def test_what_is_on_page_0_leaves_the_resolution_of_the_motions_clear(m512, tmp_path):
    """Page 0 is no motion: a robot takes a trim from it, and programs leave anything there."""
    image = image_of(10, 3)
    image[0].steps = 3
    image[0].set_word(0, 7, 2004)
    image[0].seal()
    formats.save(tmp_path / "x.bin", image)
    done = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--scale", "12")
    assert done.exit_code == 0 and "positions scaled from 10 to 12 bits" in done.stderr, done.stderr


@pytest.mark.parametrize("bits", [10, 12])
def test_a_scale_that_changes_nothing_says_so(m512, tmp_path, bits):
    image = image_of(bits, 3)
    image.bits = bits
    for name in ("x.bin", "x.m512"):
        formats.save(tmp_path / name, image)
    for name in ("x.bin", "x.m512"):
        done = m512("convert", tmp_path / name, tmp_path / "y.bin", "--scale", bits, "--force")
        assert done.exit_code == 0 and f"note: nothing is scaled: the positions have {bits} bits already" in done.stderr
        assert "scaled" not in m512("convert", tmp_path / name, tmp_path / "y.bin", "--force").stderr


@pytest.mark.parametrize("says, bits", [("12", "10"), ("10", "12"), ("", "12"), ("12", "12"), ("10", "10"), ("", "10")])
def test_bits_that_a_file_states_itself_are_not_overruled_without_a_word(m512, tmp_path, says, bits):
    path, other = tmp_path / "x.m512", says != bits and (says or "10") != bits
    path.write_text("motion512 1\n" + (f"bits {says}\n" if says else "") + f"page 1 a\n  step 9 | 1:{'2000' if says == '12' else '600'}\n")
    for words in (("convert", path, tmp_path / "y.bin"), ("pages", "--bits", bits, path, "check"), ("diff", path, path)):
        done = m512(*words, *([] if "pages" in words else ["--bits", bits]))
        assert done.exit_code == 0 and (f"--bits {bits} has no effect on a text" in done.stderr) == other, (words, done.stderr)


@pytest.mark.parametrize("bits, says", [(12, "12-bit positions mean nothing to this board"), (10, "pages 128..150: no room among")])
def test_the_simulated_board_refuses_what_the_real_one_cannot_play(m512, monkeypatch, tmp_path, bits, says):
    from m512.board.sim import Simulator

    monkeypatch.setenv("M512_CM5SIM", "/bin/true")
    formats.save(tmp_path / "x.bin", image_of(bits, 150))
    with pytest.raises(RefusedError, match=says):
        Simulator("/bin/true", tmp_path / "x.bin")
    flashed = m512("flash", tmp_path / "x.bin", "--dry-run", "-p", "nowhere")
    assert flashed.exit_code == 5 and says in flashed.stderr and "x.bin: " in flashed.stderr
    put = m512("put", tmp_path / "x.bin", "1", "-p", "nowhere")
    assert ("x.bin: 12-bit positions mean nothing" in put.stderr) == (bits == 12), put.stderr


def test_a_12_bit_image_is_known_by_the_joints_that_move(tmp_path):
    """Joints that the robot lacks hold 0 or arbitrary values; complete images found on the internet are like that."""
    image = image_of(12, 30)
    for number in range(1, 31):
        for joint in range(8, 31):
            image[number].set_word(0, joint, 0 if joint % 7 else 0x9D00)
        image[number].seal()
    assert formats.decode(image.to_bytes(), tmp_path / "x.bin").bits == 12


def test_a_10_bit_image_with_a_mistake_is_no_12_bit_image(m512, tmp_path):
    formats.save(tmp_path / "x.bin", image_of(10, 5, high=3))
    result = m512("pages", tmp_path / "x.bin", "check")
    assert "looks like" not in result.stderr and result.stdout.startswith("page 3: damaged: position beyond 1023: step 2 ID 4")


def test_pages_that_do_not_fit_are_refused_or_named_in_one_line(m512, tmp_path):
    image = image_of(10, 240)
    image[5].exit = 239
    image[5].seal()
    formats.save(tmp_path / "x.bin", image)
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--pages", "128")
    assert result.exit_code == 0 and result.stderr.splitlines() == [
        "loss: pages 128..240: no room among 128 pages, left out",
        "loss: page 5: links to pages that are left out are now empty (exit 239)",
    ]


# .mtn by example


def mtn_file(pages, version="1.01", enable=range(1, 19), comma=False, trailer=None):
    lines = ["type=motion", f"version={version}", "enable=" + " ".join(str(int(j in enable)) for j in range(26))]
    if version.endswith("1"):
        lines.append("motor_type=" + " ".join("0" * 26))
    for page in pages:
        lines += ["page_begin", f"name={page.get('name', '')}", "compliance=" + " ".join("5" * 26), f"play_param={page.get('param', '0 0 1 1.0 32')}"]
        lines += ["step=" + " ".join(["512"] * 26) + f" {step}" for step in page.get("steps", [])]
        lines += ["page_end"]
    body = "\n".join(lines) + "\n"
    body = b"\xef\xbb\xbf" + (body.replace(".", ",") if comma else body).encode()
    return body + (mtn.file_checksum(body) if trailer is None else trailer)


def test_mtn_bytes_of_a_page_are_where_the_specification_says():
    image = mtn.read(mtn_file([{"name": "wave", "param": "3 4 2 1.5 20", "steps": ["0.080 0.400"]}]))
    data = image[1].data
    assert data[:14] == b"wave" + bytes(10) and data[15:17] == b"\x02\x0a"
    assert [data[20], data[22], data[24], data[25], data[26], data[63]] == [1, 21, 20, 3, 4, 0x55]
    assert data[32:58] == bytes([0x55] * 26) and data[58:63] == bytes(5)
    assert image[1].word(0, 1) == 512 and image[1].word(0, 0) == image[1].word(0, 25) == 0x4200
    assert image[1].word(0, 26) == image[1].word(6, 30) == 0 and image[1].word(1, 3) == 0x4200
    assert [data[64 + 62], data[64 + 63]] == [10, 50] and sum(data) % 256 == 0xFF
    assert bytes(image[0]) == EMPTY


def test_mtn_decimal_commas_and_version_100():
    one = mtn.read(mtn_file([{"steps": ["0.080 0.400"]}]))
    assert mtn.read(mtn_file([{"steps": ["0.080 0.400"]}], comma=True)).to_bytes() == one.to_bytes()
    assert mtn.read(mtn_file([{"steps": ["0.080 0.400"]}], version="1.00")).to_bytes() == one.to_bytes()


@pytest.mark.parametrize(
    "change, says",
    [
        (lambda p: p.update(param="0 0 1 0 32"), "rate 0 gives no page speed"),
        (lambda p: p.update(param="0 0 1 0.125 32"), "rate 0.125 gives no page speed"),
        (lambda p: p.update(param="0 0 1 1.0"), "play_param has 4 values, not 5"),
        (lambda p: p.update(param="0 0 256 1.0 32"), "repeat 256 is not a number 0..255"),
        (lambda p: p.update(steps=["0 2.5"]), "time 2.5 s is not 0..2.04 s"),
        (lambda p: p.update(steps=["0"]), "step has 27 values, not 28"),
        (lambda p: p.update(steps=["0 x"]), "a value is not a number"),
        (lambda p: p.update(steps=["0 1", "0 1\nhallo"]), '"step=" or "page_end" expected'),
    ],
)
def test_mtn_error_names_the_line(change, says):
    page = {"steps": ["0 1"]}
    change(page)
    with pytest.raises(FileError, match="x.mtn:[0-9]+: ") as caught:
        mtn.read(mtn_file([page]), "x.mtn")
    assert says in str(caught.value)


def test_mtn_losses_are_named():
    image = Image.empty()
    page = image[5]
    page.steps, page.schedule, page.code, page.link1_page, page.link1_code = 1, 0, 3, 7, 4
    page.name, page.speed = b"a\nb", 48
    page.set_compliance(2, 0x57)
    page.set_word(0, 1, 300)
    page.set_word(0, 28, 400)
    page.seal()
    image[6].steps = 1
    image[6].set_word(0, 2, 1)
    image[6].seal()
    losses = mtn.write(image)[1]
    for text in (
        "the name changes ('ab')",
        "speed base is not known there",
        "play codes are left out (3)",
        "links by code are left out (page 7 on code 4)",
        "positions of joints above ID 25 are left out (IDs 28)",
        "the page speed is no rate of one decimal (48 becomes 45)",
        "the clockwise one is taken (IDs 2)",
    ):
        assert any(loss.startswith('page 5 "a\\x0ab": ') and text in loss for loss in losses), text
    assert any(
        loss.startswith("pages 5 ") and "and 6: joints that some steps leave alone would be driven there to 512" in loss and "6: IDs 1" in loss
        for loss in losses
    )
    assert "no effect on playing" in losses[-1]


def test_a_mtn_holds_the_joints_that_a_step_leaves_alone(m512, tmp_path):
    """`enable=` is for the whole file. What is not used in a step keeps its last target (PAGE_FORMAT.md), so that is what the file says."""
    (tmp_path / "a.m512").write_text(
        "motion512 1\n"
        "page 4 far\n next mid\n step 1s | 1:300 2:700 3:444\n step 1s | 1:310 3:-\n"
        "page 7 mid\n next off\n step 1s | 1:320 3:?512\n"
        "page 2 off\n repeat 0\n next end\n step 1s | 2:999\n"
        "page 9 end\n next end\n step 1s | 1:330\n step 1s | 2:650\n step 1s | 1:340\n"
        "page 5 alone\n step 1s | 1:350\n"
        "page 20 broken\n exit out\n step 1s | 1:360 2:701 3:445\n"
        "page 21 out\n step 1s | 1:370\n"
    )
    wrote = m512("convert", tmp_path / "a.m512", tmp_path / "a.mtn")
    assert wrote.exit_code == 0
    image = mtn.read((tmp_path / "a.mtn").read_bytes())
    assert {n: [[image[n].word(k, j) for j in (1, 2, 3)] for k in range(image[n].steps)] for n in (4, 7, 9, 5, 21)} == {
        4: [[300, 700, 444], [310, 700, 444]],
        7: [[320, 700, 444]],
        9: [[330, 700, 444], [330, 650, 444], [340, 650, 444]],
        5: [[350, 512, 512]],
        21: [[370, 701, 445]],
    }
    held = next(line for line in wrote.stderr.splitlines() if "held there at their last position" in line)
    assert "4: IDs 2 at 700, IDs 3 at 444" in held and '"alone"' not in held
    guessed = next(line for line in wrote.stderr.splitlines() if "driven there to 512" in line)
    assert guessed.startswith('loss: page 5 "alone": ') and guessed.endswith("(IDs 2 3)")


def test_the_joints_that_a_mtn_does_not_know_are_told_when_they_would_move(m512, tmp_path):
    """FILES.md: IDs 26..30 read as 0 in all steps, as in RoboPlus' own images. PAGE_FORMAT.md: that is a position, not "unused"."""
    (tmp_path / "a.m512").write_text("motion512 1\npage 1 x\n step 1s | 0..25:300\n")
    (tmp_path / "b.m512").write_text("motion512 1\npage 1 x\n byte63 0x55\n spare 3 9 | 1:5\n step 1s | 0..25:300 26..30:0\n")
    telling = "servos 26..30: m512 reads a .mtn as position 0 for them, which --joints 0..25 avoids"
    assert telling in m512("convert", tmp_path / "a.m512", tmp_path / "a.mtn").stderr
    kept = m512("convert", tmp_path / "b.m512", tmp_path / "b.mtn").stderr
    assert "(no effect on playing)" in kept and telling not in kept
    for options, word in (((), 0), (("--joints", "0..25"), 0x4000)):
        assert m512("convert", tmp_path / "a.mtn", tmp_path / "a.bin", "--force", *options).exit_code == 0
        page = from_bytes((tmp_path / "a.bin").read_bytes())[1]
        assert {page.word(0, joint) for joint in range(26, 31)} == {word} and page.word(0, 25) == 300


def test_mtn_losses_of_many_pages_are_one_line_a_kind():
    image = Image.empty()
    for number in range(1, 121):
        image[number].steps, image[number].code, image[number].name = 1, number, b"p%d" % number
        image[number].seal()
    assert mtn.write(image)[1][0] == ("pages 1..120: play codes are left out (1: 1; 2: 2; 3: 3; 4: 4; 5: 5; 6: 6 and 114 more)")
    assert len(mtn.write(image)[1]) == 2


def test_mtn_refuses_what_it_cannot_hold(m512, tmp_path):
    """A damaged page of the user's is not silently left out. Pages that hold nothing are no loss."""
    image = Image.empty()
    image[7].steps = 1
    image[7].seal()
    image[7].data[100] ^= 1
    image[8].data[:] = bytes([0xFF]) * 512
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.mtn")
    assert result.exit_code == 5 and not (tmp_path / "y.mtn").exists()
    assert "page 7 cannot be written into a .mtn" in result.stderr and "--damaged drop" in result.stderr
    assert m512("convert", tmp_path / "x.bin", tmp_path / "y.mtn", "--damaged", "drop").exit_code == 0
    image.bits = 12
    with pytest.raises(RefusedError, match="10 bits and these have 12"):
        mtn.write(image)


def test_mtn_every_page_speed_reads_back_or_is_a_loss():
    for speed in range(1, 256):
        rate = mtn.rate_of(speed)
        assert rate is None or 32 // rate == speed
    assert [float(mtn.rate_of(s)) for s in (32, 21, 15, 64, 26)] == [1.0, 1.5, 2.1, 0.5, 1.2]


# Intel HEX


def test_hex_addresses_of_both_kinds():
    assert to_hex(Image.empty(128)).startswith(":020000040000FA\n:10E000")
    assert ":020000040001F9\n:10E000" in to_hex(Image.empty(256))


def test_hex_of_a_few_pages_and_of_other_things():
    from io import StringIO

    from intelhex import IntelHex

    def text(address, data):
        file, out = IntelHex(), StringIO()
        file.frombytes(data, offset=address)
        file.write_hex_file(out)
        return out.getvalue()

    image = from_hex(text(0xE000 + 512 * 5, bytes(Page().seal()) * 2))
    assert len(image.pages) == 128 and "2 of 128" in image.notes[0]
    with pytest.raises(FileError, match="no motion area"):
        from_hex(text(0, b"abc"))
    with pytest.raises(FileError, match="whole 512-byte pages"):
        from_hex(text(0xE000, b"abc"))
    with pytest.raises(FileError, match="not a good Intel HEX"):
        from_hex(":00000001FE\n")


# Bad input: always one sentence and exit code 4, never a traceback (the fixture fails on other exceptions)


def files_of_every_kind():
    image = Image.empty()
    image[1].steps = 1
    image[1].set_word(0, 1, 5)
    image[1].seal()
    return {
        ".bin": image.to_bytes(),
        ".hex": to_hex(image).encode(),
        ".mtn": mtn_file([{"steps": ["0 1"]}] * 3),
        ".m512": b"motion512 1\npage 1 a\nstep 5 | 1:5\n",
    }


@pytest.mark.parametrize("suffix", [".bin", ".hex", ".mtn", ".m512"])
def test_bad_input_truncated_anywhere(tmp_path, suffix):
    whole = files_of_every_kind()[suffix]
    cuts = sorted({0, 1, 2, 3, len(whole) - 1} | set(range(0, len(whole), max(1, len(whole) // 20))))
    for cut in cuts:
        try:
            formats.decode(whole[:cut], tmp_path / f"x{suffix}")
        except FileError as error:
            assert str(error)


def test_convert_refuses_what_is_there_and_says_what_it_did(m512, tmp_path):
    (tmp_path / "x.bin").write_bytes(bytes(65024) + EMPTY)
    result = m512("convert", tmp_path / "x.bin", tmp_path / "x.bin")
    assert result.exit_code == 5 and "--force" in result.stderr
    assert m512("convert", tmp_path / "no.bin", tmp_path / "y.bin").exit_code == 4
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--damaged", "ask")
    assert result.exit_code == 5 and "page 0: checksum is 0x00 and should be 0xFF" in result.stderr
    result = m512("convert", tmp_path / "x.bin", tmp_path / "y.bin", "--damaged", "drop", "--json")
    assert json.loads(result.stdout)["damaged"] == list(range(127)) and (tmp_path / "y.bin").read_bytes() == EMPTY * 128
    assert m512("convert", tmp_path / "x.bin", tmp_path / "y.txt").exit_code == 4


@pytest.mark.parametrize("size", [65536, 65024, 131072])
def test_convert_a_file_of_which_no_page_is_whole_is_no_motion_file(m512, tmp_path, size):
    """Other content with the size of an image is refused. Erased flash counts as an image."""
    for name, data in {"noise": random.Random(size).randbytes(size), "half": random.Random(1).randbytes(size // 2 // 512 * 512)}.items():
        (tmp_path / f"{name}.bin").write_bytes(data.ljust(size, b"\xff"))
        for how in ("ask", "keep", "drop"):
            result = m512("convert", tmp_path / f"{name}.bin", tmp_path / "y.bin", "--damaged", how)
            assert result.exit_code == 4 and f"{name}.bin: none of its" in result.stderr, result.stderr
            assert not (tmp_path / "y.bin").exists()
    (tmp_path / "erased.bin").write_bytes(b"\xff" * size)
    result = m512("convert", tmp_path / "erased.bin", tmp_path / "y.bin")
    assert result.exit_code == 0 and (tmp_path / "y.bin").read_bytes() == b"\xff" * size, result.stderr


@pytest.mark.parametrize("joints", ["", ",", " "])
def test_an_empty_list_of_joints_is_refused(m512, tmp_path, joints):
    (tmp_path / "x.m512").write_text("motion512 1\npage 1 x\n  step 1s | 1:512\n")
    for words in (("convert", tmp_path / "x.m512", tmp_path / "y.m512"), ("layer", "wave", "-p", "none")):
        result = m512(*words, "--joints", joints)
        assert result.exit_code == 2 and "--joints: no joint is called ''" in result.stderr
    assert not (tmp_path / "y.m512").exists()


def test_losses_of_a_mtn_count_the_pages_that_there_are(m512, tmp_path):
    from m512.files.text import read_text

    image = read_text("motion512 1\npage 1 x\n  step 1s | 1:512\npage 9 y\n  step 1s | 1:512\n")
    for number in (1, 9):
        image[number].set_word(6, 1, 100)
        image[number].seal()
    (tmp_path / "x.bin").write_bytes(image.to_bytes())
    assert "loss: 2 pages: what lies in unused steps" in m512("convert", tmp_path / "x.bin", tmp_path / "x.mtn").stderr
