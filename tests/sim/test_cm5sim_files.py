# SPDX-License-Identifier: MIT
"""Files of the command cm5sim: flash, EEPROM, traces, plots; and its port for avr-gdb."""

import csv
import shutil
import signal
import socket
import subprocess
import sys
import time
import xml.etree.ElementTree

import pytest

from tests.sim.sim_command import CM5SIM, ROBOT, TOP, Running, play, run

# --- stored and written files ---


def test_flash_and_eeprom_are_kept(tmp_path):
    kept = ["--flash", tmp_path / "robot.bin", "--eeprom", tmp_path / "robot.eep"]
    motions = tmp_path / "motions.bin"
    motions.write_bytes(bytes([0x42]) + bytes(65535))
    assert run(ROBOT, *kept, "--motions", motions, stdin=b"ew").stdout == b"ready\r\neeprom 00\r\nflash 42\r\n"
    again = run(*kept, stdin=b"ew")  # without an image, which is in the flash
    assert again.stdout == b"ready\r\neeprom 01\r\nflash 42\r\n"
    motions.write_bytes(bytes([0x77]) + bytes(65535))
    careful = run(ROBOT, *kept, "--motions", motions, stdin=b"ew")  # the robot's own pages take precedence
    assert careful.stdout == b"ready\r\neeprom 02\r\nflash 42\r\n"
    assert b"not loaded over them" in careful.stderr
    assert (tmp_path / "robot.bin").stat().st_size == 0x20000


@pytest.mark.parametrize("name", ["M.HEX", "m.ihex"])
def test_intel_hex_is_known_by_its_suffix_in_any_case(tmp_path, name):
    raw, motions, image = tmp_path / "m.bin", tmp_path / name, tmp_path / name.replace("m", "r").replace("M", "R")
    raw.write_bytes(bytes([0x42]) + bytes(65535))
    shutil.copy(ROBOT, image)
    subprocess.run(["avr-objcopy", "-I", "binary", "-O", "ihex", "--change-addresses", "0xE000", raw, motions], check=True)
    assert run(image, "--motions", motions, stdin=b"w").stdout == b"ready\r\nflash 42\r\n"


@pytest.mark.parametrize("arguments", [["{}"], [ROBOT, "--motions", "{}"]])
@pytest.mark.parametrize("name", ["folder", "folder.hex", "folder.elf"])
def test_a_folder_in_place_of_a_file_is_told(tmp_path, name, arguments):
    (tmp_path / name).mkdir()
    done = run(*(str(word).format(tmp_path / name) for word in arguments), "--time", "10ms")
    assert done.returncode == 4 and done.stderr.decode() == f"cm5sim: {tmp_path / name}: Is a directory\n"


def test_a_kept_flash_starts_in_its_boot_loader(tmp_path):
    """START held at a reset opens the loader, which no image of the second run brings."""
    kept = ["--flash", tmp_path / "robot.bin"]
    assert run("boot-cm5.hex", "play-cm5.hex", "--time", "500ms", "--no-stdio", "--fast", *kept).returncode == 0
    held = tmp_path / "held.txt"
    held.write_text('press START 0\nreset\nwait 300ms\nrelease START\nexpect " - " within 3s\n')
    for images in ((), ("play-cm5.hex",)):
        assert run(*images, "--script", held, *kept).returncode == 0, images


def test_servo_eeprom_is_kept(tmp_path):
    kept = tmp_path / "servos.bin"
    assert play(tmp_path, "quit\n", "--servos", "3,7", "--servo-eeprom", kept).returncode == 0
    table = bytearray(kept.read_bytes())
    assert len(table) == 2 * 25 and table[3] == 3 and table[27] == 7
    table[27] = 9
    kept.write_bytes(table)
    assert play(tmp_path, "goal 9 == 512\n", "--servos", "3,7", "--servo-eeprom", kept).returncode == 0


@pytest.mark.parametrize(
    "made, has, other, says",
    [
        ("1-3", "1,2,3", "4-6", "4,5,6"),
        ("1-3", "1,2,3", "1-4", "1,2,3,4"),
        ("4-6", "4,5,6", "4,5,6:dx117", "4,5,6:dx117"),
        ("2,20:dx117", "2,20:dx117", "none", "none"),
        ("none", "none", "3:ax18", "3:ax18"),
    ],
)
def test_other_servos_than_those_of_the_file_are_refused_by_name(tmp_path, made, has, other, says):
    kept = tmp_path / "servos.bin"
    for servos in (made, has):
        assert play(tmp_path, "quit\n", "--servos", servos, "--servo-eeprom", kept).returncode == 0
    before = kept.read_bytes()
    done = play(tmp_path, "quit\n", "--servos", other, "--servo-eeprom", kept)
    assert done.returncode == 4 and f"servos.bin: has servos {has}, not {says}: give --servos {has}, or" in done.stderr.decode()
    assert kept.read_bytes() == before


def test_a_file_of_servos_without_the_ids_at_its_end_is_read(tmp_path):
    """Those of an older cm5sim: the EEPROM areas alone."""
    kept = tmp_path / "servos.bin"
    assert play(tmp_path, "quit\n", "--servos", "3,7", "--servo-eeprom", kept).returncode == 0
    old = bytearray(kept.read_bytes()[: 2 * 24])
    old[17] = 4  # ALARM LED of servo 3
    kept.write_bytes(old)
    assert b"has servos 3,7, not 3,8" in play(tmp_path, "quit\n", "--servos", "3,8", "--servo-eeprom", kept).stderr
    assert play(tmp_path, "register 3 17 == 4\n", "--servos", "3,7", "--servo-eeprom", kept).returncode == 0
    assert kept.stat().st_size == 2 * 25
    kept.write_bytes(b"my thesis")
    assert b"not a file of this kind" in play(tmp_path, "quit\n", "--servos", "3,7", "--servo-eeprom", kept).stderr


def test_servo_settings_of_an_older_run_with_25_servos_are_read(tmp_path):
    """As many bytes as a new file of 24 servos has."""
    kept = tmp_path / "servos.bin"
    assert play(tmp_path, "quit\n", "--servos", "1-25", "--servo-eeprom", kept).returncode == 0
    kept.write_bytes(kept.read_bytes()[: 24 * 25])
    assert play(tmp_path, "quit\n", "--servos", "1-25", "--servo-eeprom", kept).returncode == 0


@pytest.mark.parametrize("script, fault", [("wait 10ms\n", ["--fault", "3:duplicate"]), ("servo 3 duplicate\nwait 10ms\n", [])])
def test_the_second_servo_of_a_fault_is_not_kept(tmp_path, script, fault):
    kept = ["--servos", "3,7", "--servo-eeprom", tmp_path / "servos.bin"]
    for arguments in (fault, fault, []):
        assert play(tmp_path, script, *kept, *arguments).returncode == 0
        assert (tmp_path / "servos.bin").stat().st_size == 2 * 25


def test_file_of_another_kind_is_refused(tmp_path):
    wrong = tmp_path / "robot.bin"
    wrong.write_bytes(b"my thesis")
    done = run(ROBOT, "--flash", wrong)
    assert done.returncode == 4 and b"131072 bytes" in done.stderr
    assert wrong.read_bytes() == b"my thesis"


@pytest.mark.parametrize("option", ["--flash", "--eeprom", "--servo-eeprom"])
def test_path_that_cannot_be_written_is_told_before_the_robot_runs(tmp_path, option):
    done = run(ROBOT, option, tmp_path / "nowhere" / "robot.bin")
    assert done.returncode == 4 and b"nowhere/robot.bin.new: No such file" in done.stderr
    assert done.stdout == b""
    assert run("--bus-pty", "--time", "100ms", "--servo-eeprom", tmp_path / "nowhere" / "s.bin").stderr.startswith(b"cm5sim: /")


def test_a_kept_file_belongs_to_one_run_at_a_time(tmp_path):
    kept, other = tmp_path / "robot.bin", tmp_path / "other.eep"
    for end in (signal.SIGTERM, signal.SIGKILL):
        with Running(ROBOT, "--flash", kept, "--tcp", "--no-stdio") as first:
            first.message("serial port: (tcp)")
            second = run(ROBOT, "--eeprom", other, "--flash", kept)
            assert second.returncode == 4 and second.stdout == b""
            assert b"robot.bin: in use by another cm5sim" in second.stderr and not other.exists()
            first.stop(end)
        assert kept.stat().st_size == 0x20000
        assert run(ROBOT, "--flash", kept).returncode == 0
    assert list(tmp_path.iterdir()) == [kept]


def test_a_link_to_a_kept_file_leads_to_it_afterwards(tmp_path):
    """The link once became a file of its own, and the robot that it had led to stayed old."""
    real, link = tmp_path / "real" / "robot.bin", tmp_path / "link.bin"
    real.parent.mkdir()
    link.symlink_to(real)
    for images in ((ROBOT,), ()):
        with Running(*images, "--flash", link, "--tcp", "--no-stdio") as first:
            first.message("serial port: (tcp)")
            assert b"in use by another cm5sim" in run(ROBOT, "--flash", real).stderr
            first.stop()
        assert link.is_symlink() and real.stat().st_size == 0x20000
    assert sorted(path.name for path in tmp_path.rglob("*")) == ["link.bin", "real", "robot.bin"]


@pytest.mark.parametrize("option", ["--flash", "--eeprom", "--servo-eeprom"])
def test_a_read_only_file_is_refused_and_other_modes_are_kept(tmp_path, option):
    kept = tmp_path / "template.bin"
    once = (ROBOT, "--servos", "1", option, kept, "--time", "10ms", "--no-stdio")
    assert run(*once).returncode == 0
    kept.chmod(0o600)
    assert run(*once).returncode == 0 and kept.stat().st_mode & 0o777 == 0o600
    kept.chmod(0o444)
    done = run(*once)
    assert done.returncode == 4 and done.stderr.decode() == f"cm5sim: {kept}: Permission denied\n"
    assert kept.stat().st_mode & 0o777 == 0o444 and list(tmp_path.iterdir()) == [kept]


def test_a_file_of_the_user_is_not_taken_for_the_new_one(tmp_path):
    mine = tmp_path / "robot.bin.new"
    mine.write_bytes(b"precious")
    done = run(ROBOT, "--flash", tmp_path / "robot.bin", "--time", "10ms", "--no-stdio")
    assert done.returncode == 4 and f"{mine}: holds something" in done.stderr.decode()
    assert mine.read_bytes() == b"precious" and list(tmp_path.iterdir()) == [mine]


def test_a_disk_that_is_full_at_the_end_does_not_stop_the_next_run(tmp_path):
    once = [ROBOT, "--flash", tmp_path / "robot.bin", "--time", "10ms", "--no-stdio"]
    small = ["sh", "-c", 'ulimit -f 16; exec "$@"', "sh", CM5SIM]  # no file can grow beyond 8 or 16 KiB
    done = subprocess.run([*small, *once], capture_output=True, check=False)
    assert done.returncode == 4 and b"robot.bin.new: File too large" in done.stderr, done.stderr
    assert list(tmp_path.iterdir()) == []
    assert run(*once).returncode == 0


@pytest.mark.parametrize(
    "first, second",
    [("--flash", "--eeprom"), ("--script", "--trace"), ("--motions", "--plot"), ("--trace", "--plot"), ("--motions", "--flash"), (None, "--trace")],
)
def test_one_file_for_two_purposes_is_refused(tmp_path, first, second):
    path = tmp_path / "x.hex"
    path.write_bytes(b"mine")
    image = [first, path] if first else [path]
    done = run(*([ROBOT] if first else []), *image, second, f"{tmp_path}/./x.hex")
    assert done.returncode == 2 and f"{first or 'the image'} and {second} need a file each".encode() in done.stderr
    assert path.read_bytes() == b"mine" and list(tmp_path.iterdir()) == [path]


def test_start_that_fails_leaves_no_file(tmp_path):
    assert run("missing.hex", "--flash", tmp_path / "robot.bin").returncode == 4
    assert list(tmp_path.iterdir()) == []


MOVE = 'expect "ready"\nat 100ms send "m"\nat 1s quit\n'


def test_trace_has_goal_and_present_of_every_servo_by_tick(tmp_path):
    trace = tmp_path / "trace.csv"
    assert play(tmp_path, MOVE, "--servos", "1-4", "--trace", trace).returncode == 0
    with open(trace, newline="", encoding="ascii") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == ["tick", "ms"] + [f"{what}{n}" for n in (1, 2, 3, 4) for what in ("goal", "present")]
    assert [int(row["tick"]) for row in rows] == list(range(1, 129))  # 1 s
    assert abs(float(rows[127]["ms"]) - 1000) < 0.01
    assert rows[11]["goal3"] == "" and rows[11]["present3"] == "512"  # limp before the command
    assert rows[127]["goal3"] == "600" and rows[127]["present3"] in ("599", "600")
    middle = [int(row["present3"]) for row in rows]
    assert sorted(middle) == middle and any(520 < position < 590 for position in middle)  # it takes time
    assert {row["present4"] for row in rows} == {"512"}  # not part of the command


def test_plot_is_a_picture(tmp_path):
    svg, png = tmp_path / "move.svg", tmp_path / "move.png"
    assert play(tmp_path, MOVE, "--servos", "1-4", "--plot", svg).returncode == 0
    root = xml.etree.ElementTree.parse(svg).getroot()
    assert root.tag.endswith("svg") and len(list(root.iter("{http://www.w3.org/2000/svg}path"))) > 20
    assert play(tmp_path, MOVE, "--servos", "1-4", "--plot", png).returncode == 0
    assert png.read_bytes().startswith(b"\x89PNG")


def test_a_full_disk_is_told_with_the_name_of_the_trace(tmp_path):
    for script in (MOVE, "at 10s quit\n"):  # told at the end, and in the middle of the run
        done = play(tmp_path, script, "--trace", "/dev/full")
        assert done.returncode == 4 and b"cm5sim: /dev/full: No space left on device" in done.stderr, done.stderr


MEMORIES = {"flash": 0x20000, "eeprom": 0x1000, "servo-eeprom": 3 * 25}


def options(tmp_path, *names):
    return [word for name in names for word in (f"--{name}", tmp_path / name)]


@pytest.mark.parametrize("option, file", [("trace", "t.csv"), ("plot", "x.svg"), *((name, f"{name}.new") for name in MEMORIES)])
def test_a_full_disk_costs_no_other_file(tmp_path, option, file):
    (tmp_path / file).symlink_to("/dev/full")
    arguments = [f"--{option}", tmp_path / file] if option not in MEMORIES else []
    done = play(tmp_path, MOVE, "--servos", "1-3", *options(tmp_path, *MEMORIES), *arguments)
    assert done.returncode == 4 and done.stderr.decode() == f"cm5sim: {tmp_path / file}: No space left on device\n"
    for name in MEMORIES.keys() - {option}:
        assert (tmp_path / name).stat().st_size == MEMORIES[name]


def test_a_picture_whose_folder_has_gone_costs_no_other_file(tmp_path):
    (tmp_path / "pictures").mkdir()
    with Running(ROBOT, "--tcp", "--no-stdio", "--plot", tmp_path / "pictures" / "x.svg", *options(tmp_path, "flash")) as robot:
        robot.message("serial port: (tcp)")
        shutil.rmtree(tmp_path / "pictures")
        assert robot.stop() == 4
        assert robot.process.stderr.read().decode().strip() == f"cm5sim: {tmp_path}/pictures/x.svg: No such file or directory"
    assert (tmp_path / "flash").stat().st_size == MEMORIES["flash"]


@pytest.mark.parametrize("time", ["100ms", "3s"])  # told at the end, and in the middle of the run
def test_a_full_disk_costs_the_bus_no_servo(tmp_path, time):
    done = run("--bus-pty", "--servos", "1-3", "--time", time, "--trace", "/dev/full", *options(tmp_path, "servo-eeprom"))
    assert done.returncode == 4 and done.stderr.decode().splitlines()[1:] == ["cm5sim: /dev/full: No space left on device"]
    assert (tmp_path / "servo-eeprom").stat().st_size == MEMORIES["servo-eeprom"]


def test_two_servos_with_one_id_have_a_diagram_each(tmp_path):
    assert play(tmp_path, MOVE, "--servos", "1-4", "--fault", "3:duplicate", "--plot", tmp_path / "x.svg").returncode == 0
    assert (tmp_path / "x.svg").read_text().count("<!-- joint 3 -->") == 2


def test_a_plot_that_cannot_be_made_is_refused_before_the_run(tmp_path):
    for name, says in (("x.pdf", b"x.pdf: the name must end in .svg or .png"), ("nodir/x.svg", b"nodir/x.svg: No such file or directory")):
        done = play(tmp_path, MOVE, "--plot", tmp_path / name)
        assert done.returncode == 4 and says in done.stderr and b"ready" not in done.stdout, done


def test_plot_without_matplotlib_says_so(tmp_path):
    (tmp_path / "script.txt").write_text(MOVE)
    bare = [sys.executable, "-S", TOP / "tools" / "sim" / "python" / "start.py"]  # no site-packages
    done = subprocess.run([*bare, ROBOT, "--script", tmp_path / "script.txt", "--plot", tmp_path / "move.svg"], capture_output=True, check=False)
    assert done.returncode == 4
    assert b"no picture without matplotlib" in done.stderr and not done.stdout


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def debugged(port, *commands):
    """What avr-gdb prints."""
    words = [word for command in ("set remotetimeout 300", f"target remote :{port}", *commands) for word in ("-ex", command)]
    command = ["avr-gdb", "-batch", *words, ROBOT.with_suffix(".elf")]
    return subprocess.run(command, capture_output=True, text=True, timeout=300, check=False).stdout


@pytest.mark.parametrize(
    "commands, says",
    [
        (("info registers pc", "break say", "continue", "backtrace"), ("pc             0x0 ", "Breakpoint 1, say (", "in main ()")),
        (("break say", "continue", "rwatch heard_head", "continue"), ("read watchpoint 2: heard_head", "Value = ")),
    ],
)
def test_gdb_stops_at_the_first_instruction_at_a_function_and_at_memory(commands, says):
    port = free_port()
    with Running(ROBOT, f"--gdb={port}", "--time", "200ms") as robot:
        robot.message("(waiting for avr-gdb)")
        time.sleep(0.5)
        printed = debugged(port, *commands, "delete", "detach")
        assert all(text in printed for text in says), printed
        assert robot.process.wait(300) == 0
