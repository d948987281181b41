# SPDX-License-Identifier: MIT
"""The command cm5sim with a small robot (robot/robot.c): interfaces, exit codes, wrong usage."""

import fcntl
import io
import os
import pathlib
import re
import signal
import socket
import subprocess
import termios
import time

import pexpect
import pytest
import serial

from cm5sim.flow import DEAF_CYCLES, Flow
from tests.sim.sim_command import CM5SIM, ROBOT, Running, run

# --- interfaces ---


def test_pipe_is_answered_and_the_run_ends_by_itself():
    done = run(ROBOT, stdin=b"hop")
    assert done.returncode == 0
    assert done.stdout == b"ready\r\nhoservo 3: 00\r\n"
    assert done.stderr == b""


@pytest.mark.parametrize("pace", ["--fast", "--realtime"])
def test_a_long_pipe_waits_for_the_robots_room(pace):
    """The robot takes 128 bytes at once, and sends XOFF."""
    done = run("play-cm5.hex", pace, stdin=b"".join(b"rate %d\r" % rate for rate in range(51, 91)) + b"status\r")
    said = done.stdout.translate(None, b"\x11\x13")
    assert done.returncode == 0 and said.count(b" OK\r\n") == 41 and b"lost" not in said
    assert b"rate 90" in said and b"Torque on" in said.partition(b"status")[2]


def test_a_program_that_obeys_no_rule_of_the_flow_still_gets_what_is_typed():
    taken: list[bytes] = []
    flow = Flow(taken.append)
    flow.type(bytes(range(32, 132)))
    for _ in range(10):
        flow.feed(0, 1, 0)
    assert len(b"".join(taken)) == 64  # as much as there is room for before it says something
    flow.feed(0, DEAF_CYCLES + 1, 0)
    assert len(b"".join(taken)) == 80
    flow.hear(b"\x13", DEAF_CYCLES + 2)
    flow.feed(0, DEAF_CYCLES + 3, 0)
    assert len(b"".join(taken)) == 80
    flow.feed(0, 2 * DEAF_CYCLES + 3, 0)
    flow.feed(0, 2 * DEAF_CYCLES + 4, 1)  # the chip has started again
    assert b"".join(taken) == bytes(range(32, 132)) and not flow


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


KINDS = pytest.mark.parametrize("option, kind", [("--pty", [ROBOT, "--no-stdio"]), ("--bus-pty", [])])


@KINDS
def test_link_of_a_running_program_is_refused_and_that_of_a_dead_one_is_replaced(tmp_path, option, kind):
    link = tmp_path / "robot"
    with Running(*kind, f"{option}={link}") as robot:
        port = robot.message(r"(/dev/pts/\d+)")
        second = run(*kind, f"{option}={link}", "--time", "100ms")
        assert second.returncode == 4 and f"{link}: in use by another program" in second.stderr.decode()
        assert os.readlink(link) == port
        robot.stop(signal.SIGKILL)
    others = [os.openpty()]  # a terminal of this computer gets the number of the dead program's port
    while os.ttyname(others[-1][1]) != port and len(others) < 50:
        others.append(os.openpty())
    with Running(*kind, f"{option}={link}") as robot:
        assert robot.message(r"(/dev/pts/\d+)") == os.readlink(link)
        assert robot.stop() == 0 and not os.path.lexists(link)
    for end in sum(others, ()):
        os.close(end)


@KINDS
def test_link_that_is_not_its_own_is_left_alone(tmp_path, option, kind):
    link = tmp_path / "robot"
    with Running(*kind, f"{option}={link}") as robot:
        robot.message(r"(/dev/pts/\d+)")
        link.unlink()
        link.symlink_to("elsewhere")
        assert robot.stop() == 0 and os.readlink(link) == "elsewhere"
    done = run(*kind, f"{option}={link}", "--time", "100ms")
    assert done.returncode == 4 and f"{link}: File exists" in done.stderr.decode()
    assert os.readlink(link) == "elsewhere"


def test_port_that_its_client_has_for_itself_is_in_use(tmp_path):
    """The system lets nobody but a superuser open such a port."""
    link = tmp_path / "bus"
    drop = ["setpriv", "--bounding-set=-sys_admin"] if os.geteuid() == 0 else []
    with Running(f"--bus-pty={link}") as bus:
        bus.message(r"(/dev/pts/\d+)")
        with open(link, "rb", buffering=0) as client:
            fcntl.ioctl(client, termios.TIOCEXCL)
            second = subprocess.run([*drop, CM5SIM, f"--bus-pty={link}", "--time", "100ms"], capture_output=True, timeout=60, check=False)
        assert second.returncode == 4 and b"in use by another program" in second.stderr


def test_pty_at_a_wrong_rate_is_garbage_as_on_a_cable():
    with Running(ROBOT, "--pty", "--no-stdio") as robot:
        path = robot.message(r"serial port: (/dev/pts/\d+)")
        with serial.Serial(path, 115200, timeout=1) as port:
            port.write(b"ho")
            assert robot.message(r"rate was set to (\d+) bps") == "115200"  # the bytes have arrived
            assert b"ho" not in port.read(20)
        with serial.Serial(path, 57600, timeout=60) as port:
            port.write(b"ho")
            assert port.read_until(b"ho").endswith(b"ho")


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
        while b"Somebody else" in heard:  # until it has noticed that the first client has left
            with socket.create_connection(("127.0.0.1", port), 60) as third:
                third.sendall(b"h")
                heard = third.recv(100)
        assert heard == b"h"


def test_waiting_robot_costs_little_cpu():
    with Running(ROBOT.parent / "asleep.hex", "--pty", "--no-stdio") as robot:
        robot.message(r"(serial port)")
        time.sleep(0.5)
        before, begun = robot.cpu_seconds(), time.monotonic()
        time.sleep(2)
        assert robot.cpu_seconds() - before < 0.3 * (time.monotonic() - begun)


@pytest.fixture(name="terminal")
def _terminal():
    child = pexpect.spawn(str(CM5SIM), [str(ROBOT), "--servos", "1-3"], timeout=300, env={**os.environ, "TERM": "xterm"})
    child.expect("ready")
    yield child
    child.close(force=True)


def test_terminal_leaves_by_ctrl_bracket_and_restores_the_terminal(terminal):
    terminal.send("h")
    terminal.expect("h")
    terminal.send("\x03x")  # Ctrl-C goes to the robot
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
    terminal.send("\x14s")  # START button of the panel
    terminal.expect("START")
    terminal.send("\x14?")
    terminal.expect("MODE button")
    terminal.send("\x14v")
    terminal.expect("3 +512 +512  off")
    terminal.send("\x14m")  # the MODE button resets
    terminal.expect("ready")
    terminal.send("\x14p")
    terminal.expect("power off")
    for key in ("x", "\x14s"):  # a board without power receives nothing, and the user is informed
        terminal.send(key)
        terminal.expect("the power is off: Ctrl-T p switches it on")
    terminal.send("\x14p")
    terminal.expect("ready")


TITLE = re.compile(rb"\x1b\[2[23];2t|\x1b\]2;[^\a]*\a")


OVERLAY = re.compile(rb"\x1b\[\?1049h(.*?)\x1b\[\?1049l", re.S)


def until(terminal, holds):
    """Reads until the condition holds."""
    end = time.monotonic() + 300
    while not holds():
        assert time.monotonic() < end
        terminal.expect(pexpect.TIMEOUT, timeout=0.1)


def test_terminal_words_for_the_user_leave_the_robots_screen_alone(terminal):
    """Messages appear on the terminal's alternate screen. Without them, the output must be exactly the robot's, including output during a
    message."""
    heard = io.BytesIO()
    terminal.logfile_read = heard
    for keys in ("p\x14?", "xp\x14v", "x\x14hbattery 9\r", "p\x14h", "\x1b[A\r", "\x14r\x14rp", "\x14?"):
        terminal.send(keys)
        terminal.expect(pexpect.TIMEOUT, timeout=0.4)
    terminal.send("x")
    until(terminal, lambda: OVERLAY.sub(b"", heard.getvalue()).count(b"servo 3: 00\r\n") == 4)
    terminal.send("\x1d")
    terminal.expect(pexpect.EOF)
    shown = [part.decode() for part in OVERLAY.findall(heard.getvalue())]
    assert len(shown) >= 7
    for words in ("MODE button", "3    512", "push 3 600", "RC-100", "serial line"):
        assert any(words in part for part in shown), words
    assert not any("servo 3: 00" in part for part in shown)
    alone = run(ROBOT, "--servos", "1-3", "-q", stdin=b"pppp").stdout.split(b"ready\r\n", 1)[1]
    assert TITLE.sub(b"", OVERLAY.sub(b"", heard.getvalue())) == b"\r\n" * heard.getvalue().startswith(b"\r\n") + alone


def test_terminal_hand_pushes_holds_and_lets_go(terminal):
    terminal.send("m")  # servo 3 goes to 600
    terminal.expect("moving")
    terminal.send("\x14hpush 3 400\r\x14v")
    terminal.expect("3 +600 +400  on +0x.. +held")
    terminal.send("x\x14hlet go\r\x14v")
    while terminal.expect(["3 +600 +(599|600|601)  on", "3 +600 +[0-9]+  on"]):  # still moving, so look again
        terminal.send("x\x14v")


@pytest.mark.parametrize(
    "line, says",
    [
        ("push 40 600", "there is no servo 40"),
        ("push 3", "position 0..1023 is missing"),
        ("let it", "let go"),
        ('expect "x"', "only scripts"),
        ("at 5s reset", "no `at`"),
        ("dance", "unknown action"),
    ],
)
def test_terminal_hand_says_what_is_wrong_and_asks_again(terminal, line, says):
    terminal.send(f"\x14hx\x7f{line}\r")
    terminal.expect_exact(says)
    terminal.send("press START\r")
    terminal.expect("START")


def test_terminal_keys_as_remote(terminal):
    terminal.send("\x14r")
    terminal.expect("RC-100")
    terminal.send("\x1b[A")  # arrow up: held for a while, then released
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


# --- violations and wrong usage ---


def test_violation_stops_with_cycle_pc_function_reason_and_code_3():
    done = run(ROBOT, stdin=b"s")
    assert done.returncode == 3
    text = done.stderr.decode()
    assert "violation bus-undriven at cycle " in text and ", PC 0x" in text and " in main" in text
    assert "PE2" in text


def test_allowed_violation_passes():
    assert run(ROBOT, "--allow", "bus-undriven", stdin=b"sh").returncode == 0


@pytest.mark.parametrize(
    "arguments, says",
    [
        ([], "no image given"),
        (["robot.hex", "--board", "cm7"], "cm5 or cm2"),
        (["robot.hex", "--servos", "1-999"], "IDs are 0..253"),
        (["robot.hex", "--servos", "3:mx28"], "models are ax12, ax18 and dx117"),
        (["robot.hex", "--time", "5"], "a time like 10s"),
        (["robot.hex", "--fault", "3:tired"], "no such fault"),
        (["robot.hex", "--allow", "fun"], "no such violation"),
        (["robot.hex", "--tcp=99999"], "ports are"),
        (["robot.hex", "--bus-pty"], "servos alone"),
        (["--bus-pty", "--flash", "f.bin"], "--flash is for a board"),
        (["--bus-pty", "--gdb=3399"], "--gdb is for a board"),
        (["robot.hex", "--no-stdio"], "run for ever"),
    ],
)
def test_wrong_usage_is_explained(arguments, says):
    done = run(*arguments)
    assert done.returncode == 2
    assert says in done.stderr.decode()


@pytest.mark.parametrize("board, other", [("cm5", "cm2"), ("cm2", "cm5")])
def test_an_image_for_the_other_board_is_told(board, other):
    done = run(f"play-{other}.hex", "--board", board, "--time", "100ms", stdin=b"")
    assert f"this image is for the other board: --board {other}" in done.stderr.decode()
    assert "other board" not in run(f"play-{board}.hex", "--board", board, "--time", "100ms", stdin=b"").stderr.decode()


def test_a_bus_alone_needs_no_console():
    with Running("--bus-pty", "--no-stdio") as sim:
        assert sim.message(r"servo bus: (\S+)")
        assert sim.stop() == 0


@pytest.mark.parametrize(
    "arguments",
    [
        ["missing.hex"],
        [ROBOT, "--motions", "missing.bin"],
        [ROBOT, "--motions", ROBOT.with_suffix(".map")],
        [ROBOT, "--fault", "99:silent"],
        [ROBOT, "--trace", "/nowhere/trace.csv"],
    ],
)
def test_unusable_files_are_named(arguments):
    done = run(*arguments)
    assert done.returncode == 4
    assert done.stderr.startswith(b"cm5sim: ") and done.stderr.count(b"\n") == 1


def test_help_shows_examples():
    done = run("--help")
    assert done.returncode == 0
    assert b"cm5sim play-cm5.hex" in done.stdout
