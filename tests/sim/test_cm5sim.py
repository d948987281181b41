# SPDX-License-Identifier: MIT
"""The command cm5sim with a small robot (robot/robot.c): its ways in, scripts, files, exit codes."""
import csv
import io
import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import time
import xml.etree.ElementTree

import pexpect
import pytest
import serial

from sim_command import CM5SIM, ROBOT, Running, run


def play(tmp_path, text, *arguments):
    """Runs a script."""
    path = tmp_path / "script.txt"
    path.write_text(text)
    return run(ROBOT, "--script", path, *arguments)


# --- ways in ---

def test_pipe_is_answered_and_the_run_ends_by_itself():
    done = run(ROBOT, stdin=b"hop")
    assert done.returncode == 0
    assert done.stdout == b"ready\r\nhoservo 3: 00\r\n"
    assert done.stderr == b""


def test_image_name_is_found_in_the_build_folder():
    assert run("tests/robot.hex", stdin=b"h").stdout == b"ready\r\nh"


def test_elf_is_an_image_too():
    assert run(ROBOT.with_suffix(".elf"), stdin=b"h").stdout == b"ready\r\nh"


def test_time_ends_a_run():
    begun = time.monotonic()
    done = run(ROBOT, "--time", "300ms", "--realtime")
    assert done.returncode == 0
    assert done.stdout == b"ready\r\n"
    assert time.monotonic() - begun > 0.25


def test_pty_session(tmp_path):
    link = tmp_path / "robot"
    with Running(ROBOT, f"--pty={link}", "--no-stdio", "--servos", "3") as robot:
        path = robot.message(r"serial port: (/dev/pts/\d+)")
        assert os.readlink(link) == path
        with serial.Serial(str(link), 57600, timeout=60) as port:
            port.write(b"p")
            assert port.read_until(b"servo 3: 00\r\n").endswith(b"servo 3: 00\r\n")
        assert robot.stop() == 0
    assert not link.exists() and not link.is_symlink()


def test_pty_at_a_wrong_rate_is_garbage_as_on_a_cable():
    with Running(ROBOT, "--pty", "--no-stdio") as robot:
        path = robot.message(r"serial port: (/dev/pts/\d+)")
        with serial.Serial(path, 115200, timeout=1) as port:
            port.write(b"ho")
            assert b"ho" not in port.read(20)
        with serial.Serial(path, 57600, timeout=60) as port:
            port.write(b"ho")
            assert port.read_until(b"ho").endswith(b"ho")
        assert robot.message(r"rate was set to (\d+) bps") == "115200"


def test_tcp_session_one_client_at_a_time():
    with Running(ROBOT, "--tcp", "--no-stdio") as robot:
        port = int(robot.message(r"tcp 127\.0\.0\.1:(\d+)"))
        with socket.create_connection(("127.0.0.1", port), 60) as first:
            first.sendall(b"p")
            heard = b""
            while b"servo 3: 00\r\n" not in heard:
                heard += first.recv(100)
            with socket.create_connection(("127.0.0.1", port), 60) as second:
                assert b"Somebody else" in second.recv(100)
        heard = b"Somebody else"
        while b"Somebody else" in heard:  # until it has noticed that the first has gone
            with socket.create_connection(("127.0.0.1", port), 60) as third:
                third.sendall(b"h")
                heard = third.recv(100)
        assert heard == b"h"


def test_waiting_robot_costs_little_cpu():
    with Running(ROBOT.parent / "asleep.hex", "--pty", "--no-stdio") as robot:
        robot.message(r"(serial port)")
        time.sleep(0.5)
        before = robot.cpu_seconds()
        time.sleep(2)
        assert robot.cpu_seconds() - before < 0.6


@pytest.fixture(name="terminal")
def _terminal():
    child = pexpect.spawn(str(CM5SIM), [str(ROBOT), "--servos", "1-3"], timeout=300, env={**os.environ, "TERM": "xterm"})
    child.expect("ready")
    yield child
    child.close(force=True)


def test_terminal_leaves_by_ctrl_bracket_and_restores_the_terminal(terminal):
    terminal.send("h")
    terminal.expect("h")
    terminal.send("\x03x")  # Ctrl-C is for the robot
    terminal.expect("\x03x")
    terminal.send("\x1d")
    terminal.expect(pexpect.EOF)
    terminal.close()
    assert terminal.exitstatus == 0


def test_terminal_is_as_before_after_a_signal(tmp_path):
    shell = pexpect.spawn("/bin/sh", timeout=300, cwd=tmp_path, env={**os.environ, "PS1": "$ "})
    shell.sendline(f"stty -a > before; {CM5SIM} {ROBOT} -q; echo code $?; stty -a | diff - before && echo sa''me")
    shell.expect("ready")
    shell.expect(pexpect.TIMEOUT, timeout=0.3)
    pids = [int(pid) for pid in pathlib.Path(f"/proc/{shell.pid}/task/{shell.pid}/children").read_text().split()]
    os.kill(pids[0], signal.SIGTERM)
    shell.expect("code 0")
    shell.expect("same")
    shell.close(force=True)


def test_terminal_knobs(terminal):
    terminal.send("\x14s")  # START of the panel
    terminal.expect("START")
    terminal.send("\x14?")
    terminal.expect("MODE button")
    terminal.send("\x14v")
    terminal.expect("3 +512 +512  off")
    terminal.send("\x14m")  # MODE is reset
    terminal.expect("ready")
    terminal.send("\x14p")
    terminal.expect("power off")
    terminal.send("\x14p")
    terminal.expect("ready")


TITLE = re.compile(rb"\x1b\[2[23];2t|\x1b\]2;[^\a]*\a")
OVERLAY = re.compile(rb"\x1b\[\?1049h(.*?)\x1b\[\?1049l", re.S)


def test_terminal_words_for_the_user_leave_the_robots_screen_alone(terminal):
    """They stand on the terminal's other screen: without them, what came is what the robot said, byte for byte; also what
    it said meanwhile."""
    heard = io.BytesIO()
    terminal.logfile_read = heard
    for keys in ("p\x14?", "xp\x14v", "x\x14hbattery 9\r", "p\x14h", "\x1b[A\r", "\x14r\x14rp", "\x14?"):
        terminal.send(keys)
        terminal.expect(pexpect.TIMEOUT, timeout=0.4)
    terminal.send("x\x1d")
    terminal.expect(pexpect.EOF)
    shown = [part.decode() for part in OVERLAY.findall(heard.getvalue())]
    assert len(shown) >= 7
    for words in ("MODE button", "3    512", "push 3 600", "RC-100", "serial line"):
        assert any(words in part for part in shown), words
    assert not any("servo 3: 00" in part for part in shown)
    alone = run(ROBOT, "--servos", "1-3", "-q", stdin=b"pppp").stdout.split(b"ready\r\n", 1)[1]
    assert TITLE.sub(b"", OVERLAY.sub(b"", heard.getvalue())) == b"\r\n" * heard.getvalue().startswith(b"\r\n") + alone


def test_terminal_hand_pushes_holds_and_lets_go(terminal):
    terminal.send("m")   # servo 3 goes to 600
    terminal.expect("moving")
    terminal.send("\x14hpush 3 400\r")
    terminal.expect(pexpect.TIMEOUT, timeout=0.5)
    terminal.send("\x14v")
    terminal.expect("3 +600 +400  on +0x.. +held")
    terminal.send("x\x14hlet go\r")
    terminal.expect(pexpect.TIMEOUT, timeout=1)
    terminal.send("\x14v")
    terminal.expect("3 +600 +(599|600|601)  on")


@pytest.mark.parametrize("line, says", [
    ("push 40 600", "there is no servo 40"), ("push 3", "position 0..1023 is missing"), ("let it", "let go"),
    ("expect \"x\"", "only scripts"), ("at 5s reset", "no `at`"), ("dance", "unknown action")])
def test_terminal_hand_says_what_is_wrong_and_asks_again(terminal, line, says):
    terminal.send(f"\x14hx\x7f{line}\r")
    terminal.expect_exact(says)
    terminal.send("press START\r")
    terminal.expect("START")


def test_terminal_keys_as_remote(terminal):
    terminal.send("\x14r")
    terminal.expect("RC-100")
    terminal.send("\x1b[A")  # arrow up: held for a while, then let go
    terminal.expect("rc 0001")
    terminal.expect("rc 0000")
    terminal.send("1d")
    terminal.expect("rc 0018")  # a chord: 1 and right
    terminal.expect("rc 0000")
    terminal.send(" ")
    terminal.expect("rc 0200")
    terminal.send("\x14r")
    terminal.expect("serial line")
    terminal.send("w")
    terminal.expect("flash FF")


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


@pytest.mark.parametrize("line, says", [
    ('expect "hello" within 20ms', "\"hello\" did not come within 0.020 s"),
    ("goal 3 == 600 within 10ms", "it is 512 after 0.010 s"),
    ("present 99 == 1", "there is no servo 99"),
    ("panel PLAY on within 1ms", "the LED is not lit"),
    ('expect no "ready" for 1s', "\"ready\" came, and should not have"),
])
def test_script_failure_names_line_and_time(tmp_path, line, says):
    done = play(tmp_path, f"# a comment\n\n{line}\n")
    assert done.returncode == 1
    assert "script.txt:3: at " in done.stderr.decode()
    assert says in done.stderr.decode()


@pytest.mark.parametrize("relation, right, wrong", [
    ("==", 512, 511), ("!=", 511, 512), ("<", 513, 512), (">", 511, 512), ("<=", 512, 511), (">=", 512, 513)])
def test_script_relations_hold_and_fail(tmp_path, relation, right, wrong):
    assert play(tmp_path, f"present 3 {relation} {right} within 1ms\n").returncode == 0
    assert play(tmp_path, f"present 3 {relation} {wrong} within 1ms\n").returncode == 1


def test_script_after_counts_from_the_end_of_the_line_before(tmp_path):
    done = play(tmp_path, 'wait 300ms\nafter 200ms note "now"\nat 700ms note "then"\n')
    assert done.stderr.decode().split() == "cm5sim: 0.500 s: now cm5sim: 0.700 s: then".split()


def test_script_failure_shows_what_the_robot_said(tmp_path):
    done = play(tmp_path, 'expect "rea"\nexpect "go" within 50ms\n')
    assert done.returncode == 1
    assert 'the robot said: "dy\\r\\n"' in done.stderr.decode()


@pytest.mark.parametrize("line, says", [
    ("send p", 'a "text" to send is missing here'),
    ('send "p', 'a closing " is missing'),
    ('send "\\q"', "unknown escape"),
    ("jump 3", "unknown action"),
    ("wait", "a time like 500ms"),
    ("wait 5", "a time like 500ms"),
    ("at 5x send \"p\"", "a time like 500ms"),
    ("goal 3 = 5", "a comparison is missing"),
    ("goal 300 == 5", "a servo ID 0..253"),
    ("goal 3 == 5 within", "a time like 500ms"),
    ("press FIRE", "buttons are UP DOWN"),
    ("rc U+7", "keys are U D L R 1..6"),
    ("servo 3 tired", "what about the servo?"),
    ("servo 3 silent 2", "\"times\" is missing"),
    ("servo 3 push 2000", "a position 0..1023"),
    ("panel NOSE on", "LEDs are POWER"),
    ("power maybe", "on or off"),
    ("quit now", "too many words"),
    ('expect ""', "an empty text"),
    ('expect no "x"', "for how long?"),
])
def test_script_mistakes_are_named_with_their_line(tmp_path, line, says):
    done = play(tmp_path, f'expect "ready"\n{line}\n')
    assert done.returncode == 2
    assert "script.txt:2: " in done.stderr.decode()
    assert says in done.stderr.decode()
    assert done.stdout == b""  # nothing ran


def test_script_cut_short_has_not_passed(tmp_path):
    done = play(tmp_path, 'expect "ready"\nwait 10s\n', "--time", "500ms")
    assert done.returncode == 1 and b"script.txt:2: the run ended here" in done.stderr
    (tmp_path / "long.txt").write_text('expect "ready"\nnote "under way"\nwait 1000s\n')
    with Running(ROBOT, "--script", tmp_path / "long.txt", "--realtime") as robot:
        robot.message("(under way)")
        assert robot.stop() == 1


def test_script_goes_on_when_nobody_reads(tmp_path):
    (tmp_path / "s.txt").write_text('expect "ready"\nwait 100ms\nsend "p"\nexpect "00"\n')
    done = subprocess.run(f"({CM5SIM} {ROBOT} --script s.txt --realtime; echo code $? >&2) | true", shell=True,
                          cwd=tmp_path, stderr=subprocess.PIPE, check=False)
    assert done.stderr.endswith(b"code 0\n")


def test_script_tells_all_mistakes_at_once(tmp_path):
    done = play(tmp_path, "jump\nwait 1s\nhop\n")
    assert ":1: " in done.stderr.decode() and ":3: " in done.stderr.decode()


# --- violations and wrong usage ---

def test_sweep_is_told_in_the_summary():
    done = run(ROBOT, "--sweep", "no_such_thing:12", "--time", "100ms", "--fast", "--summary")
    assert done.returncode == 4 and b"no such function" in done.stderr
    done = run(ROBOT, "--sweep", "put:30", "--time", "1s", "--fast", "--summary", stdin=b"p" * 20)
    match = re.search(rb"sweep of put: (\d+) calls, (\d+) rounds of all places, (\d+) interrupts", done.stderr)
    assert match and int(match[1]) > 100 and int(match[2]) >= 1 and int(match[3]) > 10, done.stderr
    done = run(ROBOT, "--sweep", "put")
    assert done.returncode == 2 and b"FUNCTION:VECTOR" in done.stderr


def test_violation_stops_with_cycle_pc_function_reason_and_code_3():
    done = run(ROBOT, stdin=b"s")
    assert done.returncode == 3
    text = done.stderr.decode()
    assert "violation bus-undriven at cycle " in text and ", PC 0x" in text and " in main" in text
    assert "PE2" in text


def test_allowed_violation_passes():
    assert run(ROBOT, "--allow", "bus-undriven", stdin=b"sh").returncode == 0


@pytest.mark.parametrize("arguments, says", [
    ([], "no image given"),
    (["robot.hex", "--board", "cm7"], "cm5 or cm2"),
    (["robot.hex", "--servos", "1-999"], "IDs are 0..253"),
    (["robot.hex", "--servos", "3:mx28"], "models are ax12, ax18 and dx117"),
    (["robot.hex", "--time", "5"], "a time like 10s"),
    (["robot.hex", "--fault", "3:tired"], "no such fault"),
    (["robot.hex", "--allow", "fun"], "no such violation"),
    (["robot.hex", "--tcp=99999"], "ports are"),
    (["robot.hex", "--bus-pty"], "servos alone"),
    (["robot.hex", "--no-stdio"], "run for ever"),
])
def test_wrong_usage_is_explained(arguments, says):
    done = run(*arguments)
    assert done.returncode == 2
    assert says in done.stderr.decode()


@pytest.mark.parametrize("arguments", [
    ["missing.hex"], [ROBOT, "--motions", "missing.bin"], [ROBOT, "--motions", ROBOT.with_suffix(".map")],
    [ROBOT, "--fault", "99:silent"], [ROBOT, "--trace", "/nowhere/trace.csv"]])
def test_unusable_files_are_named(arguments):
    done = run(*arguments)
    assert done.returncode == 4
    assert done.stderr.startswith(b"cm5sim: ") and done.stderr.count(b"\n") == 1


def test_help_shows_examples():
    done = run("--help")
    assert done.returncode == 0
    assert b"cm5sim play-cm5.hex" in done.stdout


# --- what is kept, what is written ---

def test_flash_and_eeprom_are_kept(tmp_path):
    kept = ["--flash", tmp_path / "robot.bin", "--eeprom", tmp_path / "robot.eep"]
    motions = tmp_path / "motions.bin"
    motions.write_bytes(bytes([0x42]) + bytes(65535))
    assert run(ROBOT, *kept, "--motions", motions, stdin=b"ew").stdout == b"ready\r\neeprom 00\r\nflash 42\r\n"
    again = run(*kept, stdin=b"ew")  # no image: it is in the flash
    assert again.stdout == b"ready\r\neeprom 01\r\nflash 42\r\n"
    motions.write_bytes(bytes([0x77]) + bytes(65535))
    careful = run(ROBOT, *kept, "--motions", motions, stdin=b"ew")  # the robot's own pages win
    assert careful.stdout == b"ready\r\neeprom 02\r\nflash 42\r\n"
    assert b"not loaded over them" in careful.stderr
    assert (tmp_path / "robot.bin").stat().st_size == 0x20000


def test_servo_eeprom_is_kept(tmp_path):
    kept = tmp_path / "servos.bin"
    assert play(tmp_path, "quit\n", "--servos", "3,7", "--servo-eeprom", kept).returncode == 0
    table = bytearray(kept.read_bytes())
    assert len(table) == 2 * 24 and table[3] == 3 and table[27] == 7
    table[27] = 9
    kept.write_bytes(table)
    assert play(tmp_path, "goal 9 == 512\n", "--servos", "3,7", "--servo-eeprom", kept).returncode == 0


def test_file_of_another_kind_is_refused(tmp_path):
    wrong = tmp_path / "robot.bin"
    wrong.write_bytes(b"my thesis")
    done = run(ROBOT, "--flash", wrong)
    assert done.returncode == 4 and b"131072 bytes" in done.stderr
    assert wrong.read_bytes() == b"my thesis"


MOVE = 'expect "ready"\nat 100ms send "m"\nat 1s quit\n'


def test_trace_has_goal_and_present_of_every_servo_by_tick(tmp_path):
    trace = tmp_path / "trace.csv"
    assert play(tmp_path, MOVE, "--servos", "1-4", "--trace", trace).returncode == 0
    with open(trace, newline="", encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["tick", "ms"] + [f"{what}{n}" for n in (1, 2, 3, 4) for what in ("goal", "present")]
    assert [int(row["tick"]) for row in rows] == list(range(1, 129))  # 1 s
    assert abs(float(rows[127]["ms"]) - 1000) < 0.01
    assert rows[11]["goal3"] == "" and rows[11]["present3"] == "512"  # limp before the order
    assert rows[127]["goal3"] == "600" and rows[127]["present3"] in ("599", "600")
    middle = [int(row["present3"]) for row in rows]
    assert sorted(middle) == middle and any(520 < position < 590 for position in middle)  # it takes time
    assert {row["present4"] for row in rows} == {"512"}  # not part of the order


def test_plot_is_a_picture(tmp_path):
    svg, png = tmp_path / "move.svg", tmp_path / "move.png"
    assert play(tmp_path, MOVE, "--servos", "1-4", "--plot", svg).returncode == 0
    root = xml.etree.ElementTree.parse(svg).getroot()
    assert root.tag.endswith("svg") and len(list(root.iter("{http://www.w3.org/2000/svg}path"))) > 20
    assert play(tmp_path, MOVE, "--servos", "1-4", "--plot", png).returncode == 0
    assert png.read_bytes().startswith(b"\x89PNG")


def test_plot_without_matplotlib_says_so(tmp_path, monkeypatch):
    (tmp_path / "python").write_text("#!/bin/sh\nexec python3 -I -S \"$@\"\n")  # no site-packages
    (tmp_path / "python").chmod(0o755)
    monkeypatch.setenv("M512_PYTHON", str(tmp_path / "python"))
    done = play(tmp_path, MOVE, "--plot", tmp_path / "move.svg")
    assert done.returncode == 4
    assert b"no picture without matplotlib" in done.stderr


def test_vcd_is_written(tmp_path):
    vcd = tmp_path / "pins.vcd"
    assert play(tmp_path, MOVE, "--vcd", vcd).returncode == 0
    text = vcd.read_text()
    assert "$timescale" in text and "$enddefinitions" in text and text.count("#") > 10


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.mark.skipif(not shutil.which("avr-gdb"), reason="needs avr-gdb (package gdb-avr)")
def test_gdb_finds_the_chip_at_its_first_instruction_and_stops_at_a_function():
    port = free_port()
    with Running(ROBOT, f"--gdb={port}", "--time", "200ms") as robot:
        robot.message("(waiting for avr-gdb)")
        time.sleep(0.5)
        gdb = subprocess.run(
            ["avr-gdb", "-batch", "-ex", f"target remote :{port}", "-ex", "info registers pc", "-ex", "break say",
             "-ex", "continue", "-ex", "backtrace", "-ex", "delete", "-ex", "detach", ROBOT.with_suffix(".elf")],
            capture_output=True, text=True, timeout=300, check=False)
        assert "pc             0x0 " in gdb.stdout
        assert "Breakpoint 1, say (" in gdb.stdout and "in main ()" in gdb.stdout
        assert robot.process.wait(300) == 0
