# SPDX-License-Identifier: MIT
"""Start and end of the programs, what they store, and exclusive use of port and folder."""

import fcntl
import os
import pty
import re
import resource
import select
import signal
import subprocess
import sys
import termios
import time

import pytest

from m512.files.image import Image, from_bytes
from tests.host.pc_robot import SYNC_WRITE, Disturbed, program, until
from tests.sim.made_page import page

WRITE, REG_WRITE, ACTION, TORQUE, LED = 3, 4, 5, 24, 25
EVERYBODY = 254


@pytest.fixture
def files(tmp_path):
    image = Image.empty()
    image[1] = page("stand", [(40, {})])
    image[2] = page("swing", [(64, {1: 700, 2: 324}), (64, {1: 324, 2: 700})], next=2, exit=1)
    path = tmp_path / "motions.bin"
    path.write_bytes(image.to_bytes())
    return path


def play(robot):
    robot.expect("] ")
    robot.send("play 2\r")
    robot.expect("repetition 1\r\n")


def test_nothing_moves_and_no_torque_is_switched_before_a_person_says_so(make, files):
    robot = make(motions=files).run()
    robot.expect("18 servos: 1-18")
    robot.ask("status")
    for packet in robot.packets():
        assert packet[4] not in (WRITE, REG_WRITE, ACTION), packet.hex()
        assert packet[4] != SYNC_WRITE or packet[5] == LED, packet.hex()


def steps(frames):
    """The largest change of a joint in each frame."""
    return [max(abs(after[joint] - before[joint]) for joint in before) for before, after in zip(frames, frames[1:])]


@pytest.mark.parametrize("off", [False, True])
def test_ctrl_c_slows_down_first_and_leaves_torque_as_it_was_unless_told(make, files, off):
    robot = make(motions=files, arguments=["--off"] if off else []).run()
    play(robot)
    begun = len(robot.frames())
    until(lambda: len(robot.frames()) > begun + 150, "no goals")
    assert robot.stop() == 0
    ways = steps(robot.frames()[begun:])
    fastest = max(ways)
    assert fastest > 3 and ways[-1] <= 1  # it moved, then stopped
    assert max(abs(after - before) for before, after in zip(ways, ways[1:])) < fastest / 2  # without a jolt
    switched = [packet for packet in robot.packets(WRITE) if packet[5] == TORQUE and packet[6] == 0]
    assert [packet[2] for packet in switched] == ([EVERYBODY] * 2 if off else [])
    assert ("is off" if off else "go on holding it") in robot.said.decode()


def is_off_at_the_end(robot, begun):
    """Whether the frames from `begun` on end with a standstill, and all torque was switched off after them."""
    switched = [packet[2] for packet in robot.packets(WRITE) if packet[5] == TORQUE and packet[6] == 0]
    return steps(robot.frames()[begun:])[-1] <= 1 and switched == [EVERYBODY] * 2


def test_signals_at_once_are_one_wish(make, files):
    """`timeout` sends its signal to the program, then to the group."""
    robot = make(motions=files, arguments=["--off"]).run()
    play(robot)
    begun = len(robot.frames())
    until(lambda: len(robot.frames()) > begun + 150, "no goals")
    for number in (signal.SIGTERM, signal.SIGHUP):
        robot.process.send_signal(number)
    assert robot.stop() == 0 and is_off_at_the_end(robot, begun)


def test_a_second_wish_ends_at_once(make, tmp_path):
    """Its play takes a second to slow down."""
    image = Image.empty()
    image[2] = page("slow", [(255, {1: 700}), (255, {1: 324})], next=2, accel=200)
    (tmp_path / "slow.bin").write_bytes(image.to_bytes())
    robot = make(motions=tmp_path / "slow.bin", arguments=["--off"]).run()
    play(robot)
    robot.process.send_signal(signal.SIGINT)
    time.sleep(0.3)
    assert robot.stop() == 130 and "asked twice" in robot.said.decode()
    assert not is_off_at_the_end(robot, 0)


def test_a_second_program_is_refused_port_and_folder(make, files, tmp_path):
    robot = make(motions=files).run()
    robot.expect("] ")
    same_port = subprocess.run([program("edit"), "--robot", tmp_path / "other", robot.port], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert same_port.returncode == 6 and "in use by another program" in same_port.stderr
    same_folder = subprocess.run(
        [program("edit"), "--robot", tmp_path / "robot", "/dev/null"], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    assert same_folder.returncode == 4 and "in use by another program" in same_folder.stderr
    assert " OK" in robot.ask("status")


def test_a_file_is_not_replaced_by_a_link_to_the_console(make, files):
    robot = make(motions=files)
    mine = files.read_bytes()
    asked = subprocess.run(
        [program("play"), "--robot", robot.folder / "robot", f"--pty={files}", robot.port],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=30,
    )
    assert asked.returncode == 6 and f"{files}: File exists" in asked.stderr
    assert files.read_bytes() == mine


def linked_elsewhere(tmp_path, link, prefix=()):
    """A second program, on a port of its own, that is asked for the same link."""
    master, slave = pty.openpty()
    command = [*prefix, program("edit"), "--robot", tmp_path / "other", f"--pty={link}", os.ttyname(slave)]
    asked = subprocess.run(command, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=30)
    os.close(master)
    os.close(slave)
    return asked


def test_the_link_of_a_running_program_is_refused_and_that_of_a_dead_one_is_replaced(make, files, tmp_path):
    link = tmp_path / "console"
    robot = make(motions=files, arguments=[f"--pty={link}"]).run()
    robot.expect("] ")
    port = os.readlink(link)
    asked = linked_elsewhere(tmp_path, link)
    assert asked.returncode == 6 and f"{link}: in use by another program" in asked.stderr
    assert os.readlink(link) == port and " OK" in robot.ask("status")
    robot.process.kill()
    robot.process.wait()
    os.close(robot.end)
    others = [pty.openpty()]  # a terminal of this computer gets the number of the dead program's port
    while os.ttyname(others[-1][1]) != port and len(others) < 50:
        others.append(pty.openpty())
    robot.run().expect("] ")
    assert os.readlink(link) == re.search(r"serial port: (\S+)", robot.said.decode())[1]
    assert robot.stop() == 0 and not os.path.lexists(link)
    for one in sum(others, ()):
        os.close(one)


def test_the_link_of_a_program_whose_client_has_the_port_for_itself_is_refused(make, files, tmp_path):
    """The system lets nobody but a superuser open such a port."""
    link = tmp_path / "console"
    robot = make(motions=files, arguments=[f"--pty={link}"]).run()
    robot.expect("] ")
    port = os.readlink(link)
    drop = ["setpriv", "--bounding-set=-sys_admin"] if os.geteuid() == 0 else []
    with open(link, "rb", buffering=0) as client:
        fcntl.ioctl(client, termios.TIOCEXCL)
        asked = linked_elsewhere(tmp_path, link, drop)
        fcntl.ioctl(client, termios.TIOCNXCL)
    assert asked.returncode == 6 and f"{link}: in use by another program" in asked.stderr
    assert os.readlink(link) == port and robot.stop() == 0


def test_a_link_that_is_no_longer_its_own_is_left_alone(make, files, tmp_path):
    link = tmp_path / "console"
    robot = make(motions=files, arguments=[f"--pty={link}"]).run()
    robot.expect("] ")
    link.unlink()
    link.symlink_to("elsewhere")
    assert robot.stop() == 0 and os.readlink(link) == "elsewhere"
    assert linked_elsewhere(tmp_path, link).returncode == 6 and os.readlink(link) == "elsewhere"


def without_privilege(*command):
    """The command without the privilege that lets root open a port in exclusive use."""
    return (["setpriv", "--bounding-set=-sys_admin"] if os.geteuid() == 0 else []) + [str(word) for word in command]


def test_a_foreign_master_is_refused_the_port(make, files):
    robot = make(motions=files).run()
    robot.expect("] ")
    master = "import sys, dynamixel_sdk\nport = dynamixel_sdk.PortHandler(sys.argv[1])\nport.openPort()"
    asked = subprocess.run(without_privilege(sys.executable, "-c", master, robot.port), capture_output=True, text=True, check=False)
    assert asked.returncode != 0 and "busy" in asked.stderr.lower()
    assert " OK" in robot.ask("status")


def test_the_port_of_somebody_else_is_left_to_him(make, files, tmp_path):
    from m512.board.link import Link

    robot = make(motions=files)
    with Link(str(robot.port)):
        refused = subprocess.run(
            without_privilege(program("play"), "--robot", tmp_path / "robot", robot.port), stdin=subprocess.DEVNULL, capture_output=True, text=True
        )
    assert refused.returncode == 6 and "in use by another program" in refused.stderr


@pytest.mark.parametrize("word, code, text", [("/dev/nowhere", 6, "no such port"), ("/dev/null", 6, "not a serial port"), (None, 2, "usage:")])
def test_what_is_no_port_is_named(tmp_path, word, code, text):
    asked = subprocess.run(
        [program("play"), "--robot", tmp_path / "robot", *([word] if word else [])], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    assert asked.returncode == code and text in asked.stderr
    assert word is None or word in asked.stderr


@pytest.mark.parametrize("number", ["70000", "65536", "0", "-5", "+5", " 5", "4513x", "0x1", "abc", "", "99999999999999999999"])
@pytest.mark.parametrize("option, range", [("--tcp", "1..65535"), ("--rate", "9600..3000000")])
def test_a_number_of_an_option_is_checked(number, option, range):
    if (option, number) not in (("--rate", "70000"), ("--rate", "65536")):
        asked = subprocess.run([program("play"), f"{option}={number}", "/dev/null"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
        assert asked.returncode == 2 and f"{option} {number}: {range}" in asked.stderr


@pytest.mark.parametrize("option", ["--bogus", "--rate"])
def test_an_option_that_is_none_or_has_no_value_points_to_the_help(option):
    asked = subprocess.run([program("play"), option], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert asked.returncode == 2 and option.strip("-") in asked.stderr and "motion512-play --help" in asked.stderr


def test_there_is_one_console():
    asked = subprocess.run([program("play"), "--pty", "--tcp=4514", "/dev/null"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
    assert asked.returncode == 2 and "--pty and --tcp: one console only" in asked.stderr


def test_a_full_disk_keeps_no_half_file(make, files, tmp_path):
    robot = make(motions=files)
    command = [program("play"), "--robot", tmp_path / "robot", robot.port]
    asked = subprocess.run(
        command,
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        restore_signals=False,  # SIGXFSZ stays ignored
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (100000, 100000)),
    )
    assert asked.returncode == 4 and "pages.bin: cannot be written: File too large" in asked.stderr
    assert list((tmp_path / "robot").iterdir()) == []


def test_settings_and_pages_are_there_the_next_time(make, files):
    robot = make(motions=files).run()
    robot.expect("] ")
    robot.ask("settings approach 33")
    assert "swing" in robot.ask("list")
    assert robot.stop() == 0
    robot.motions = None
    robot.run().expect("] ")
    assert re.search(r"approach\s+33", robot.ask("settings"))
    assert "swing" in robot.ask("list")


def test_a_file_that_is_not_ours_is_named_and_left_alone(make, files, tmp_path):
    (tmp_path / "robot").mkdir()
    (tmp_path / "robot" / "pages.bin").write_bytes(b"mine")
    asked = subprocess.run(
        [program("play"), "--robot", tmp_path / "robot", make(motions=files).port], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    assert asked.returncode == 4 and "pages.bin: not a file of" in asked.stderr
    assert (tmp_path / "robot" / "pages.bin").read_bytes() == b"mine"


# Through a pipe


def through_pipe(robot, text, image="play", pause_s=0, **options):
    """Pipes this text into the program, ends the input, and returns what it prints. pause_s: between two readings of 512 bytes."""
    process = subprocess.Popen(
        [program(image), "--robot", robot.folder / "robot", "--motions", robot.motions, robot.port],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        **options,
    )
    with process:
        fcntl.fcntl(process.stdout, fcntl.F_SETPIPE_SZ, 4096)
        process.stdin.write(text.encode())
        process.stdin.close()
        said = b""
        while piece := os.read(process.stdout.fileno(), 512):
            said += piece
            time.sleep(pause_s)
    assert process.returncode == 0
    return said.decode()


# The disk takes files up to this size: nothing; the journal (8 KiB) and pages 1..79, but not page 100.
@pytest.mark.parametrize("room, said, name", [(0, "Not saved: flash error", b""), (40960, "Not saved: the next start tries again", b"xyz")])
def test_a_save_that_a_disk_refuses_says_what_the_next_start_does(make, files, tmp_path, room, said, name):
    robot = make(motions=files)
    through_pipe(robot, "", "edit")
    heard = through_pipe(
        robot,
        "page 100\rinsert 0\rname xyz\rsave\r",
        "edit",
        restore_signals=False,  # SIGXFSZ stays ignored
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_FSIZE, (room, room)),
    )
    assert said in heard, heard
    pages = tmp_path / "robot" / "pages.bin"
    assert from_bytes(pages.read_bytes())[100].name == b""
    through_pipe(robot, "", "edit")
    assert from_bytes(pages.read_bytes())[100].name == name


def test_every_line_of_a_pipe_is_carried_out_before_its_end_ends_the_program(make, files):
    said = through_pipe(make(motions=files), "settings approach 33\r" + 40 * "version\r" + "settings\nplay 2\r")
    assert said.count("] version") == 40 and re.search(r"approach\s+33", said.split("] settings\r\n")[1])
    assert "] play 2" in said and "Bad" not in said


@pytest.mark.parametrize("image, end_of_list", [("play", "2 pages, 0 damaged"), ("edit", "swing")])
def test_a_slow_reader_of_a_pipe_gets_every_answer(make, files, image, end_of_list):
    assert through_pipe(make(motions=files), 12 * "help\rlist\r", image, pause_s=0.02).count(end_of_list) == 12


def test_the_end_of_a_pipe_ends_a_play_softly(make, files):
    robot = make(motions=files)
    assert "] play 2" in through_pipe(robot, "on\rplay 2\r")
    ways = steps(robot.frames())
    assert len(ways) > 5 and ways[-1] <= 1


# On a terminal


class Terminal:
    """The program on its own terminal."""

    def __init__(self, robot, image="play", arguments=(), owned=False):
        """owned: the terminal is the program's own, so that it is told when the terminal goes."""
        self.master, self.slave = pty.openpty()
        self.before, self.shown = termios.tcgetattr(self.slave), b""
        self.process = subprocess.Popen(
            [program(image), "--robot", robot.folder / "robot", "--motions", robot.motions, *arguments, robot.port],
            stdin=self.slave,
            stdout=self.slave,
            stderr=self.slave,
            start_new_session=owned,
            preexec_fn=(lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0)) if owned else None,
        )

    def expect(self, text):
        def look():
            if select.select([self.master], [], [], 0)[0]:
                self.shown += os.read(self.master, 65536)
            return text.encode() in self.shown

        until(look, lambda: f"{text!r} did not come: {self.shown!r}")

    def send(self, data):
        os.write(self.master, data)

    def ended(self):
        def look():
            if select.select([self.master], [], [], 0)[0]:
                self.shown += os.read(self.master, 65536)
            return self.process.poll() is not None

        until(look, lambda: f"it goes on: {self.shown!r}")
        return self.process.returncode

    def hang_up(self):
        """Closes it, as a window or ssh does."""
        for end in (self.master, self.slave):
            if end is not None:
                os.close(end)
        self.master = self.slave = None

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
        self.process.wait()
        self.hang_up()


@pytest.fixture
def terminal(make, files):
    one = Terminal(make(motions=files))
    yield one
    one.close()


def test_the_terminal_is_as_before_after_ctrl_c(terminal):
    terminal.expect("] ")
    assert termios.tcgetattr(terminal.slave) != terminal.before
    terminal.send(b"status\r")
    terminal.expect("Nothing is playing")
    terminal.send(b"\x03")
    assert terminal.ended() == 0
    assert termios.tcgetattr(terminal.slave) == terminal.before


def test_a_program_that_was_stopped_takes_its_terminal_again(make, files):
    terminal = Terminal(make(motions=files), owned=True)
    terminal.expect("] ")
    raw = termios.tcgetattr(terminal.slave)
    terminal.process.send_signal(signal.SIGSTOP)
    termios.tcsetattr(terminal.slave, termios.TCSANOW, terminal.before)  # the shell's own way
    terminal.process.send_signal(signal.SIGCONT)
    until(lambda: termios.tcgetattr(terminal.slave) == raw, "keys still wait for Enter")
    terminal.close()


def test_the_terminal_is_as_before_after_a_crash(terminal):
    terminal.expect("] ")
    terminal.process.send_signal(signal.SIGSEGV)
    assert terminal.ended() == -signal.SIGSEGV
    assert termios.tcgetattr(terminal.slave) == terminal.before


def test_keys_are_buttons_of_the_panel(terminal):
    """START stops the play; an arrow calls its code, which no page here has."""
    terminal.expect("] ")
    terminal.send(b"\x14\x1b[A")
    terminal.expect("code 1")
    terminal.send(b"play 2\r")
    terminal.expect("repetition 1")
    terminal.send(b"\x14s")
    terminal.expect("Stopped after page 1")
    terminal.send(b"\x03")
    assert terminal.ended() == 0


@pytest.mark.parametrize("wishes", [b"", b"\x03", b"\x03\x03"])
def test_a_closed_terminal_is_no_second_wish(make, files, wishes):
    """The signal and the end of input are one event, and nobody pressed anything."""
    robot = make(motions=files)
    terminal = Terminal(robot, arguments=["--off"], owned=True)
    terminal.expect("] ")
    terminal.send(b"play 2\r")
    terminal.expect("repetition 1")
    begun = len(robot.frames())
    until(lambda: len(robot.frames()) > begun + 150, "no goals")
    terminal.send(wishes)
    terminal.hang_up()
    until(lambda: terminal.process.poll() is not None, "it goes on")
    assert terminal.process.returncode == 0 and is_off_at_the_end(robot, begun)


@pytest.fixture
def editor(make, files):
    one = Terminal(make(motions=files), "edit")
    yield one
    one.close()


def test_the_first_ctrl_c_is_for_edit_and_the_second_ends_it(editor, tmp_path):
    editor.expect("Ctrl-C twice ends")
    editor.expect("HELP explains")
    editor.send(b"page 99\r")
    editor.send(b"name host\r")
    editor.expect("* unsaved")
    editor.send(b"nonsense\x03")  # on a board Ctrl-C leaves the line
    editor.expect("Ctrl-C again within 2 s ends the program: unsaved edits are lost")
    editor.send(b"save\r")
    until(lambda: from_bytes((tmp_path / "robot" / "pages.bin").read_bytes())[99].name == b"host", lambda: f"not saved: {editor.shown!r}")
    time.sleep(2.5)  # the next Ctrl-C counts as a first one again
    editor.send(b"\x03\x03")
    assert editor.ended() == 0
    assert termios.tcgetattr(editor.slave) == editor.before


def test_a_ctrl_c_after_two_seconds_is_a_first_one_again(editor):
    editor.expect("HELP explains")
    for _ in range(2):
        editor.shown = b""
        editor.send(b"\x03")
        editor.expect("Ctrl-C again")
        time.sleep(2.5)
    editor.send(b"\x1d")
    assert editor.ended() == 0


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
def test_a_signal_ends_edit_at_once(editor, number):
    editor.expect("HELP explains")
    editor.process.send_signal(number)
    assert editor.ended() == 0


# A computer that hangs, sleeps, or has a slow disk

HANG = """
#include <poll.h>
#include <signal.h>
#include <unistd.h>
int ppoll(struct pollfd *fds, nfds_t count, const struct timespec *wait, const sigset_t *mask)
{
    (void)wait; (void)mask;
    while (access(NOW, F_OK) == 0) { pause(); }
    return poll(fds, count, 1);
}
"""
SLEEP = """
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
int clock_gettime(clockid_t which, struct timespec *time)
{
    const long result = syscall(SYS_clock_gettime, which, time);
    time->tv_sec += which == CLOCK_BOOTTIME && access(NOW, F_OK) == 0 ? 3600 : 0;  /* the other clocks do not count sleep */
    return (int)result;
}
"""
SLOW_DISK = """
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
static int slowly(long call, int file)
{
    struct timespec left = {.tv_nsec = 600000000};
    while (nanosleep(&left, &left) != 0) { }  /* a signal does not interrupt a disk */
    return (int)syscall(call, file);
}
int fsync(int file) { return slowly(SYS_fsync, file); }
int fdatasync(int file) { return slowly(SYS_fdatasync, file); }
"""


def made(tmp_path, source):
    """A library that replaces functions of the C library. Its file NOW is tmp_path / "now"."""
    (tmp_path / "made.c").write_text(source)
    subprocess.run(["cc", "-shared", "-fPIC", f'-DNOW="{tmp_path / "now"}"', "-o", tmp_path / "made.so", tmp_path / "made.c"], check=True)
    return str(tmp_path / "made.so")


def test_a_program_that_hangs_is_ended_with_a_sentence(make, files, tmp_path, monkeypatch):
    robot = make(motions=files)
    monkeypatch.setenv("LD_PRELOAD", made(tmp_path, HANG))
    robot.run().expect("] ")
    monkeypatch.delenv("LD_PRELOAD")
    (tmp_path / "now").touch()
    until(lambda: robot.process.poll() is not None, "it hangs")
    assert robot.process.returncode == 70
    assert b"hung for a second" in robot.said + robot.process.stderr.read()


def test_a_disk_that_takes_seconds_for_a_save_is_no_hang(make, files, tmp_path):
    """The first start makes the files, and the save is six syncs in a row."""
    slow = dict(os.environ, LD_PRELOAD=made(tmp_path, SLOW_DISK))
    through_pipe(make(motions=files), "page 100\rinsert 0\rname xyz\rsave\r", "edit", env=slow)
    assert from_bytes((tmp_path / "robot" / "pages.bin").read_bytes())[100].name == b"xyz"


def test_a_play_is_broken_off_after_a_sleep_of_the_computer(make, files, tmp_path, monkeypatch):
    robot = make(motions=files)
    monkeypatch.setenv("LD_PRELOAD", made(tmp_path, SLEEP))
    robot.run()
    monkeypatch.delenv("LD_PRELOAD")
    play(robot)
    (tmp_path / "now").touch()
    with pytest.raises(Disturbed, match="0.1 s late"):
        robot.expect("Stopped")
