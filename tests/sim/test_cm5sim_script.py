# SPDX-License-Identifier: MIT
"""Scripts of the command cm5sim with a small robot (robot/robot.c): effects, and reports of failures and mistakes."""

import subprocess

import pytest

from cm5sim import words
from cm5sim.bus import ends_whole
from tests.sim.sim_command import CM5SIM, ROBOT, Running, play, run

# --- scripts ---

GOOD = """\
# The whole language.
expect "ready" within 100ms
at 200ms send "p"
expect "servo 3: 00\\r\\n"
goal 3 == 512              # still where it stood
torque 3 == 0
send "m"
expect "moving"
goal 3 == 600
torque 3 == 1
present 3 >= 599 within 500ms
register 3 28 == 32
temperature 3 <= 40
servo 3 push 400
present 3 < 450
present 3 >= 598 within 1s
push 3 400
wait 100ms
present 3 == 400
let go
present 3 >= 598 within 1s
push 3 410
let go 3
servo 3 clear
servo 2 load -0.3
servo 2 load 0
panel PLAY off
panel POWER on
send "l"
panel PLAY on
press START 50ms
expect "START"
wait 20ms
press START 0
expect "START"
release START
rc U+3
expect "rc 0041"
press START 20ms
expect no "rc" for 200ms
rc L 150ms
expect "rc 0004"
expect "rc 0004"
expect "rc 0000"
servo 3 silent 1 times
send "p"
expect "silent"
servo 3 checksum
send "p"
expect "garbled"
servo 3 clear
send "p"
expect "3: 00"
battery 5.5
send "p"
expect "3: 01"
battery 9.6
after 10ms reset
expect "ready"
power off
expect no "ready" for 200ms
power on
expect "ready"
send "\\x68\\x0d"
expect "h\\r"
note "half way"
wait 2ticks
quit
send "never reached"
"""


def test_script_of_everything_passes(tmp_path):
    done = play(tmp_path, GOOD)
    assert done.stderr.decode().endswith(" s: half way\n"), done.stderr.decode()
    assert done.returncode == 0


@pytest.mark.parametrize(
    "line, says",
    [
        ('expect "hello" within 20ms', '"hello" did not come within 0.020 s'),
        ("goal 3 == 600 within 10ms", "it is 512 after 0.010 s"),
        ("present 99 == 1", "there is no servo 99"),
        ("panel PLAY on within 1ms", "the LED is not lit"),
        ('expect no "ready" for 1s', '"ready" came, and should not have'),
    ],
)
def test_script_failure_names_line_and_time(tmp_path, line, says):
    done = play(tmp_path, f"# a comment\n\n{line}\n")
    assert done.returncode == 1
    assert "script.txt:3: at " in done.stderr.decode()
    assert says in done.stderr.decode()


def test_script_relations_hold_and_fail(tmp_path):
    right = ("== 512", "!= 511", "< 513", "> 511", "<= 512", "<= 513", ">= 512", ">= 511")
    assert play(tmp_path, "".join(f"present 3 {what} within 1ms\n" for what in right)).returncode == 0
    for wrong in ("== 511", "!= 512", "< 512", "> 512", "<= 511", ">= 513"):
        assert play(tmp_path, f"present 3 {wrong} within 1ms\n").returncode == 1, wrong


def test_script_after_counts_from_the_end_of_the_line_before(tmp_path):
    done = play(tmp_path, 'wait 300ms\nafter 200ms note "now"\nat 700ms note "then"\n')
    assert done.stderr.decode().split() == "cm5sim: 0.500 s: now cm5sim: 0.700 s: then".split()


def test_script_failure_shows_what_the_robot_said(tmp_path):
    done = play(tmp_path, 'expect "rea"\nexpect "go" within 50ms\n')
    assert done.returncode == 1
    assert 'the robot said: "dy\\r\\n"' in done.stderr.decode()


LASTING = ("dead", "duplicate", "overload", "overheating", "low-voltage", "angle-limit", "blocked")  # tools/sim/servo/servo_fault.h

MISTAKES = [
    ("send p", 'a "text" to send is missing here'),
    ('send "p', 'a closing " is missing'),
    ('send "\\q"', "unknown escape"),
    ("jump 3", "unknown action"),
    ("wait", "a time like 500ms"),
    ("wait 5", "a time like 500ms"),
    ('at 5x send "p"', "a time like 500ms"),
    ("goal 3 = 5", "a comparison is missing"),
    ("goal 300 == 5", "a servo ID 0..253"),
    ("goal 3 == 5 within", "a time like 500ms"),
    ("press FIRE", "buttons are UP DOWN"),
    ("rc U+7", "keys are U D L R 1..6"),
    ("servo 3 tired", "what about the servo?"),
    ("servo 3 silent 2", '"times" is missing'),
    *((f"servo 3 {fault} 2 times", f"{fault} lasts until `servo 3 clear`") for fault in LASTING),
    ("servo 3 push 2000", "a position 0..1023"),
    ("panel NOSE on", "LEDs are POWER"),
    ("power maybe", "on or off"),
    ("quit now", "too many words"),
    ('expect ""', "an empty text"),
    ('expect no "x"', "for how long?"),
]


def test_script_mistakes_are_named_with_their_lines_all_at_once(tmp_path):
    done = play(tmp_path, 'expect "ready"\n' + "".join(f"{line}\n" for line, _ in MISTAKES))
    assert done.returncode == 2 and done.stdout == b""  # nothing ran
    told = done.stderr.decode().splitlines()
    assert len(told) == len(MISTAKES), told
    for number, (told_line, (_, says)) in enumerate(zip(told, MISTAKES), 2):
        assert f"script.txt:{number}: " in told_line and says in told_line


def test_script_of_an_editor_that_marks_its_files(tmp_path):
    """A byte-order mark of UTF-8 is skipped. UTF-16, which PowerShell writes, is named."""
    for text, code, says in (("\ufeff".encode() + b'expect "ready"\r\n', 0, b""), ('expect "ready"'.encode("utf-16"), 2, b"save it as UTF-8")):
        (tmp_path / "marked.txt").write_bytes(text)
        done = run(ROBOT, "--script", tmp_path / "marked.txt")
        assert done.returncode == code and says in done.stderr, done.stderr


def test_script_presses_no_button_of_a_board_without_a_panel(tmp_path):
    (tmp_path / "press.txt").write_text("press START\n")
    done = run("play-cm2.hex", "--board", "cm2", "--script", tmp_path / "press.txt")
    assert done.returncode == 1 and ": a CM-2 has no panel" in done.stderr.decode()
    (tmp_path / "press.txt").write_text('press MODE 50ms\nexpect "] " within 2s\n')
    assert run("play-cm2.hex", "--board", "cm2", "--script", tmp_path / "press.txt").returncode == 0


def test_script_cut_short_has_not_passed(tmp_path):
    done = play(tmp_path, 'expect "ready"\nwait 10s\n', "--time", "500ms")
    assert done.returncode == 1 and b"script.txt:2: the run ended here" in done.stderr
    (tmp_path / "long.txt").write_text('expect "ready"\nnote "under way"\nwait 1000s\n')
    with Running(ROBOT, "--script", tmp_path / "long.txt", "--realtime") as robot:
        robot.message("(under way)")
        assert robot.stop() == 1


def test_script_goes_on_when_nobody_reads(tmp_path):
    (tmp_path / "s.txt").write_text('expect "ready"\nwait 100ms\nsend "p"\nexpect "00"\n')
    done = subprocess.run(
        f"({CM5SIM} {ROBOT} --script s.txt --realtime; echo code $? >&2) | true", shell=True, cwd=tmp_path, stderr=subprocess.PIPE, check=False
    )
    assert done.stderr.endswith(b"code 0\n")


# --- words ---


@pytest.mark.parametrize(
    "text, cycles",
    [
        ("1s", 16000000),
        ("1.5s", 24000000),
        ("500ms", 8000000),
        ("20us", 320),
        ("128ticks", 16000000),  # 128 ticks a second
        ("1tick", 125000),
        ("2min", 1920000000),
        ("7cycles", 7),
        ("0", 0),
        *((wrong, None) for wrong in ("", "s", "5", "5x", "-1s", "1s2", "nan", "inf", "1e99s", "five", "9999999999s")),
    ],
)
def test_duration_is_in_cycles_of_16_mhz(text, cycles):
    assert words.duration(text) == cycles


@pytest.mark.parametrize("text, value", [("253", 253), ("0x1f", 31), ("010", 10), *((wrong, None) for wrong in ("254", "-1", "", "12a", "0x", "1f"))])
def test_number_keeps_to_its_range(text, value):
    assert words.number(text, 0, 253) == value


@pytest.mark.parametrize(
    "text, word", [("U", 1), ("d+L+r", 14), ("1+6", 16 + 512), ("u+U", 1), ("0", 0), *((wrong, None) for wrong in ("", "7", "U+", "UD", "+"))]
)
def test_rc_keys_are_the_bits_of_the_remote(text, word):
    assert words.rc_keys(text) == word


@pytest.mark.parametrize(
    "line, found",
    [
        (rb'  send	"a # \r\n\x41\"\\" within 2s# rest', [(b"send", False), (b'a # \r\nA"\\', True), (b"within", False), (b"2s", False)]),
        (rb'"a\0b\x00"', [(b"a\0b\0", True)]),
        ('note "müde"'.encode(), [(b"note", False), ("müde".encode(), True)]),
        (b'"a""b"c', [(b"a", True), (b"b", True), (b"c", False)]),
        (b"   # nothing", []),
        (b"", []),
    ],
)
def test_split_finds_words_texts_and_comments(line, found):
    assert words.split(line) == found


@pytest.mark.parametrize("line", [b'"open', rb'"\q"', rb'"\x4"', b'"\\', rb'a "\"'])
def test_split_names_what_is_wrong(line):
    with pytest.raises(ValueError, match="closing|unknown escape"):
        words.split(line)


PING = bytes([0xFF, 0xFF, 3, 2, 1, 0xF9])


@pytest.mark.parametrize("before", [b"", b"\x00", b"\xff", PING, PING[:5]])
def test_end_of_a_packet_is_seen(before):
    """Not after a packet that is cut short: later bytes complete it."""
    assert ends_whole(before + PING) == (before != PING[:5])
    assert not any(ends_whole(PING[:count]) for count in range(len(PING)))
