# SPDX-License-Identifier: MIT
"""tools/release: the checksums are right, and its products work where nothing else is installed. The programs come from the build folder
here. tools/release --twice shows that the same sources, built in two folders, give the same bytes."""

import os
import pathlib
import platform
import re
import subprocess
import sys
import sysconfig
import zipfile

import pytest

TOP = pathlib.Path(__file__).parents[3]
BUILD = TOP / "build"


def release(*arguments, umask=0o022, cwd=TOP, **environment):
    return subprocess.run(
        [sys.executable, TOP / "tools" / "release", *map(str, arguments)],
        check=False,
        text=True,
        capture_output=True,
        cwd=cwd,
        umask=umask,
        env={**os.environ, "SOURCE_DATE_EPOCH": "1700000000", **environment},
    )


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    """A release made in another folder, with other modes, time zone, language and hash seed."""
    folder = tmp_path_factory.mktemp("a name") / "robot"
    done = release("--from", BUILD, folder, umask=0o077, cwd="/", TZ="Asia/Seoul", LC_ALL="C", PYTHONHASHSEED="7")
    assert done.returncode == 0, done.stderr
    return folder


def files(folder):
    return sorted(path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


def test_release_has_a_right_sum_for_every_file(made):
    folder = made
    done = subprocess.run(["sha256sum", "-c", "--strict", "SHA256SUMS"], check=False, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
    named = {line.split("  ")[1] for line in (folder / "SHA256SUMS").read_text().splitlines()}
    assert named == {str(name) for name in files(folder)} - {"SHA256SUMS"}


def test_release_names_the_compiler_of_its_images(made):
    version = subprocess.run(["avr-gcc", "-dumpfullversion", "-dumpversion"], check=True, capture_output=True, text=True).stdout.strip()
    assert f"compiled with\nGCC {version} for the AVR" in (made / "README.md").read_text(encoding="utf-8")


def test_release_names_only_files_that_it_has(made):
    folder = made
    text = (folder / "README.md").read_text(encoding="utf-8")
    assert "@" not in text
    words = {word.strip("`,;:()[]") for word in text.replace("`", " ").replace("(", " ").replace(")", " ").split()}
    named = {
        word.split(":")[-2] if word.startswith("flash:w:") else word
        for word in words
        if word.startswith(("firmware/", "motions/", "python/", "flash:w:"))
    }
    assert len(named) > 20 and [name for name in named if not (folder / name).exists()] == []


def test_release_holds_no_path_of_this_computer_but_in_debug_information(made):
    """With --from, the programs are those of the build folder. What the release itself makes must not contain the path."""
    folder = made
    made_here = [name for name in files(folder) if name.suffix not in (".elf", ".gz")]
    assert [str(name) for name in made_here if str(TOP).encode() in (folder / name).read_bytes()] == []


def test_release_holds_no_name_that_chance_made(made):
    """Symbol tables contain the names of the linker's temporary files."""
    elves = sorted((made / "firmware").glob("*.elf"))
    assert len(elves) == 8
    for elf in elves:
        assert set(re.findall(rb"/tmp/cc(\w{6})\.", elf.read_bytes())) <= {b"XXXXXX"}


@pytest.fixture(scope="module")
def installed(made, tmp_path_factory):
    """A fresh virtual environment with the two wheels. What they need from PyPI comes from the current one."""
    venv = tmp_path_factory.mktemp("user") / "venv"
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", venv], check=True)
    site = pathlib.Path(
        subprocess.run(
            [venv / "bin" / "python", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"], check=True, capture_output=True, text=True
        ).stdout.strip()
    )
    (site / "needs.pth").write_text(sysconfig.get_path("purelib") + "\n")
    wheels = [wheel for wheel in sorted((made / "python").glob("*.whl")) if wheel.stem.endswith(("any", platform.machine()))]
    subprocess.run(
        [
            sys.executable,
            "-m",
            "pip",
            "-q",
            "--disable-pip-version-check",
            "--python",
            venv / "bin" / "python",
            "install",
            "--no-index",
            "--no-deps",
            *wheels,
        ],
        check=True,
    )
    return venv / "bin"


def as_a_user(program, *arguments, cwd):
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("M512", "PYTHON", "LD_"))}
    return subprocess.run(
        [program, *arguments],
        check=False,
        capture_output=True,
        text=True,
        cwd=cwd,
        timeout=800,
        env={**environment, "PATH": "/usr/bin:/bin"},
        stdin=subprocess.DEVNULL,
    )


def test_release_names_on_the_wheels_of_programs_what_they_need(made, tmp_path):
    """manylinux_2_NN_MACHINE: that processor, and no symbol of a C library newer than 2.NN."""
    wheels = list((made / "python").glob("motion512-*.whl"))
    assert wheels
    for wheel in wheels:
        minor, machine = re.search(r"-py3-none-manylinux_2_(\d+)_(\w+)\.whl$", wheel.name).groups()
        with zipfile.ZipFile(wheel) as files:
            programs = [files.extract(f"motion512/motion512-{image}", tmp_path / machine) for image in ("play", "edit")]
        said = subprocess.run(["readelf", "-h", "-V", "-W", *programs], check=True, capture_output=True, text=True, env={"LC_ALL": "C"}).stdout
        assert {name.lower().replace("-", "_") for name in re.findall(r"Machine: .*?([Xx]86-64|AArch64)", said)} == {machine}
        assert max(int(young) for young in re.findall(r"Name: GLIBC_2\.(\d+)", said)) <= int(minor)


def test_release_brings_the_terms_of_what_the_simulator_links(made):
    (wheel,) = (made / "python").glob("cm5sim-*.whl")
    with zipfile.ZipFile(wheel) as files:

        def text(name):
            return files.read(f"cm5sim/robot/{name}").decode()

        assert "GNU GENERAL PUBLIC LICENSE" in text("LICENSE.GPL-3") and "GNU LESSER" in text("LICENSE.LGPL-3")
        libraries = [name.rpartition("/")[2] for name in files.namelist() if ".so." in name and not name.endswith(".copyright")]
        assert len(libraries) == 2
        for library in libraries:
            assert "Copyright" in text(f"lib/{library}.copyright")
            assert f"lib/{library}: source package" in text("SOURCE_OFFER.txt")


def test_release_plays_on_the_simulator_after_pip_install_alone(installed, tmp_path):
    done = as_a_user(installed / "m512", "play", "wave", "--sim", "--wait", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    # Without the simulator's wheel, the message says what to install.
    (installed / "cm5sim").rename(installed / "elsewhere")
    done = as_a_user(installed / "m512", "play", "wave", "--sim", cwd=tmp_path)
    (installed / "elsewhere").rename(installed / "cm5sim")
    assert done.returncode == 9 and "install its wheel" in done.stderr and len(done.stderr.strip().splitlines()) == 1


def test_release_drives_servos_on_an_adapter(installed, tmp_path):
    bus = tmp_path / "bus"
    servos = subprocess.Popen([installed / "cm5sim", f"--bus-pty={bus}", "--servos", "1-3"], stderr=subprocess.PIPE, text=True)
    try:
        servos.stderr.readline()  # cm5sim prints its port once it is ready
        done = as_a_user("/usr/bin/env", f"M512_ROBOT={tmp_path / 'robot'}", installed / "m512", "pose", "-p", f"bus:{bus}", cwd=tmp_path)
    finally:
        servos.terminate()
        servos.communicate()
    assert done.returncode == 0 and done.stdout.count("limp") == 3, done.stdout + done.stderr


def test_release_brings_the_command_and_the_binding(installed, tmp_path):
    (tmp_path / "walk.txt").write_text('expect "] " within 2s\nsend "version\\r"\nexpect "Play" within 1s\n')
    done = as_a_user(installed / "cm5sim", "play-cm5.hex", "--script", "walk.txt", "--fast", "--trace", "walk.csv", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    binding = "from cm5sim import Board; b = Board(images=['play-cm5.hex']); print('runs' if b.run(ms=50) else 'stands')"
    done = as_a_user(installed / "python", "-c", binding, cwd=tmp_path)
    assert done.stdout == "runs\n", done.stderr


def test_release_brings_the_bodies(installed, tmp_path):
    (tmp_path / "ask.txt").write_text('expect "] " within 2s\n')
    done = as_a_user(installed / "cm5sim", "play-cm5.hex", "--script", "ask.txt", "--body", "humanoid", cwd=tmp_path)
    assert done.returncode == 0 and "cm5sim: body: the hand held it to the end" in done.stderr, done.stderr


def test_release_draws_its_plots(installed, tmp_path):
    (tmp_path / "ask.txt").write_text('expect "] " within 2s\n')
    done = as_a_user(installed / "cm5sim", "play-cm5.hex", "--script", "ask.txt", "--plot", "joints.svg", cwd=tmp_path)
    assert done.returncode == 0 and (tmp_path / "joints.svg").stat().st_size > 1000, done.stderr


def test_release_refuses_what_would_be_half_a_release(tmp_path):
    (tmp_path / "there").mkdir()
    done = release("--from", BUILD, tmp_path / "there")
    assert done.returncode == 1 and "is there already" in done.stderr
    done = release("--from", tmp_path, tmp_path / "new")
    assert done.returncode == 1 and "boot-cm5.hex is missing" in done.stderr and not (tmp_path / "new").exists()
