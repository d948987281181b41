# SPDX-License-Identifier: MIT
"""tools/dev/setup on a machine that lacks something: one sentence names it, and a second run succeeds.

Small scripts stand in for apt. Python's part is real, with packages made here instead of a network. The full test is tools/dev/cleanroom.
"""

import importlib.metadata
import json
import os
import pathlib
import shutil
import subprocess
import sysconfig
import zipfile

import pytest

DEV = pathlib.Path(__file__).parents[1]
USED = ["sh", "sed", "grep", "awk", "head", "tail", "tr", "cat", "mktemp", "readlink", "dirname", "basename", "sort", "xargs", "env", "rm", "id"]
# Output of apt's programs on a machine with a mirror, half a gigabyte free, and nothing installed yet.
MACHINE = {
    "id": "echo 0",
    "dpkg-query": "exit 1",
    "dpkg": "exit 0",
    "apt-cache": "echo Package: $3",
    "df": 'echo "Filesystem 1M-blocks Used Available"; echo "/dev/x 9000 8500 500"',
    "apt-get": 'case "$*" in *--assume-no*) echo "Need to get 41.5 MB of archives."; '
    'echo "After this operation, 1,158 kB of additional disk space will be used.";; *install*) echo "$@" >> installed;; esac',
}


@pytest.fixture
def tree(tmp_path):
    """A tree with only setup and a job of two apt packages and one Python package."""
    top = tmp_path / "tree"
    needs = top / "tools" / "dev" / "needs"
    needs.mkdir(parents=True)
    shutil.copy(DEV / "setup", needs.parent)
    (needs / "job.apt").write_text("# two packages\nfirst\nsecond\n")
    (needs / "job.pip").write_text("# one\nthing>=1\n")
    (needs / "constraints.txt").write_text("thing==1.0\n")
    return top


def system(tree, **programs):
    """Runs setup --system job on a machine where these programs print something else."""
    folder = tree / "bin"
    folder.mkdir(exist_ok=True)
    for name in USED:
        if not (folder / name).exists():
            (folder / name).symlink_to(shutil.which(name))
    for name, text in {**MACHINE, **{key.replace("_", "-"): value for key, value in programs.items()}}.items():
        (folder / name).unlink(missing_ok=True)
        (folder / name).write_text(f"#!/bin/sh\n{text}\n")
        (folder / name).chmod(0o755)
    return subprocess.run(["tools/dev/setup", "--system", "job"], cwd=tree, env={"PATH": str(folder)}, capture_output=True, text=True, check=False)


def refusal_of(done):
    """The only line of a failed run."""
    assert done.returncode == 1
    lines = done.stderr.splitlines()
    assert len(lines) == 1, done.stderr
    return lines[0]


def refusal(done):
    """The same for setup itself."""
    line = refusal_of(done)
    assert line.startswith("setup: ")
    return line


def test_what_is_missing_is_installed(tree):
    done = system(tree)
    assert (done.returncode, done.stderr) == (0, "")
    assert (tree / "installed").read_text().endswith("install first second\n")


def test_without_root_and_sudo_it_names_the_command(tree):
    assert "as root: apt-get install first second" in refusal(system(tree, id="echo 1000"))


def test_a_package_that_no_archive_has_is_named(tree):
    assert refusal(system(tree, apt_cache='[ "$3" = first ] && echo Package: first')).endswith(": second")


def test_without_network_it_says_what_apt_says(tree):
    gone = 'case "$*" in *update*) echo "E: Failed to fetch somewhere  Temporary failure resolving it"; exit 100;; esac'
    sentence = refusal(system(tree, apt_get=gone, apt_cache="exit 100"))
    assert "first second" in sentence and "Temporary failure resolving it" in sentence


def test_an_archive_that_is_gone_does_not_stop_what_needs_it_not(tree):
    gone = f'case "$*" in *update*) echo "E: Failed to fetch a third one"; exit 100;; esac; {MACHINE["apt-get"]}'
    assert system(tree, apt_get=gone).returncode == 0


def test_a_disk_too_small_is_named_before_anything_is_installed(tree):
    small = MACHINE["apt-get"].replace("1,158 kB", "1,158 MB")
    assert "1200 MB of disk are needed, 500 are free" in refusal(system(tree, apt_get=small))
    assert not (tree / "installed").exists()


def test_an_installation_that_fails_says_why(tree):
    torn = f'case "$*" in *assume-no*) ;; *install*) echo "dpkg: error: no space left on device"; exit 100;; esac; {MACHINE["apt-get"]}'
    assert "could not install first second: no space left on device" in refusal(system(tree, apt_get=torn))


def python(tree, wheels):
    """Runs setup --python job, with the packages of a folder as the only ones available. New environments get the pip of this one:
    to install one takes 4 CPU-s, and every build of a new tree shows that it works."""
    bare = """sh -c 'python3 -m venv --without-pip "$1" && for site in "$1"/lib/*/site-packages; do echo PIP > $site/pip.pth; done' sh"""
    setup, made = tree / "tools/dev/setup", "/usr/bin/python3 -m venv"
    text = (DEV / "setup").read_text()
    assert text.count(made) == 1
    setup.write_text(text.replace(made, bare.replace("PIP", sysconfig.get_path("purelib"))))
    return subprocess.run(
        ["tools/dev/setup", "--python", "job"],
        cwd=tree,
        capture_output=True,
        text=True,
        check=False,
        env={"PATH": f"/usr/bin:{os.environ['PATH']}", "PIP_NO_INDEX": "1", "PIP_FIND_LINKS": str(wheels)},
    )


@pytest.fixture
def wheels(tmp_path):
    folder = tmp_path / "wheels"
    folder.mkdir()
    for version in ("1.0", "1.1"):
        with zipfile.ZipFile(folder / f"thing-{version}-py3-none-any.whl", "w") as wheel:
            about = f"thing-{version}.dist-info"
            wheel.writestr("thing.py", f"version = '{version}'\n")
            wheel.writestr(f"{about}/METADATA", f"Metadata-Version: 2.1\nName: thing\nVersion: {version}\n")
            wheel.writestr(f"{about}/entry_points.txt", "[console_scripts]\nthing = thing:version\n")
            wheel.writestr(f"{about}/WHEEL", "Wheel-Version: 1.0\nGenerator: test\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
            wheel.writestr(f"{about}/RECORD", f"thing.py,,\n{about}/METADATA,,\n{about}/entry_points.txt,,\n{about}/WHEEL,,\n{about}/RECORD,,\n")
    return folder


def imported(tree):
    """The version of `thing` in the tree's Python. Checks that it comes from there."""
    said = subprocess.run(
        [tree / "build" / "venv" / "bin" / "python", "-c", "import thing; print(thing.version, thing.__file__)"],
        capture_output=True,
        text=True,
        check=True,
    )
    version, file = said.stdout.split()
    assert file.startswith(str(tree.resolve() / "build" / "venv"))
    return version


def test_python_packages_are_the_pinned_ones_in_a_python_of_this_tree(tree, wheels, tmp_path):
    """One story: an installation that fails, the next one, the tree copied, and a tree that is linked to the packages of another."""
    sentence = refusal(python(tree, tmp_path))
    assert "pip could not install thing>=1: " in sentence and "Traceback" not in sentence
    left = next((tree / "build/venv/lib").glob("*/site-packages")) / "left_over.py"
    left.touch()
    assert python(tree, wheels).returncode == 0
    assert imported(tree) == "1.0" and not left.exists()  # begun anew

    copy = tmp_path / "copy"
    shutil.copytree(tree, copy, symlinks=True)
    assert python(copy, wheels).returncode == 0
    assert imported(copy) == "1.0"
    assert (copy / "build/venv/bin/thing").read_text().startswith(f"#!{copy.resolve()}/build/venv/bin/python")

    other = tmp_path / "other"
    shutil.copytree(tree, other, ignore=shutil.ignore_patterns("build"))
    (other / "build").mkdir()
    (other / "build/venv").symlink_to(tree / "build/venv")
    assert python(other, wheels).returncode == 0
    assert not (other / "build/venv").is_symlink() and imported(other) == imported(tree) == "1.0"


def test_a_program_says_what_it_does_before_anything_is_installed(tree):
    shutil.copy(DEV / "python", tree / "tools/dev")
    (tree / "tool").write_text(
        '#!/usr/bin/env -S sh -c \'exec "${0%/*}/tools/dev/python" "$0" "$@"\'\n"""Does this."""\nimport nothing_that_is_here\n'
    )
    (tree / "tool").chmod(0o755)
    assert subprocess.run([tree / "tool", "--help"], capture_output=True, text=True, check=True).stdout == "Does this.\n"
    assert refusal_of(subprocess.run([tree / "tool", "word"], capture_output=True, text=True, check=False)).endswith("run: tools/dev/build")


def test_a_copied_tree_is_built_where_it_lies(tree):
    """CMake records where its sources are. With the original's records, the copy would build the original."""
    shutil.copy(DEV / "build", tree / "tools/dev/build")
    (tree / "bin").mkdir()
    (tree / "bin/cmake").write_text("#!/bin/sh\nexit 0\n")
    (tree / "bin/cmake").chmod(0o755)
    (tree / "tools/dev/setup").write_text("#!/bin/sh\n")
    for world, home in (("avr", tree), ("host", tree.parent)):
        (tree / "build" / world).mkdir(parents=True)
        (tree / "build" / world / "CMakeCache.txt").write_text(f"M512_TESTS:BOOL=ON\nCMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
    subprocess.run(["tools/dev/build", "configure"], cwd=tree, env={"PATH": f"{tree}/bin:{os.environ['PATH']}"}, check=True)
    assert [(tree / "build" / world).exists() for world in ("avr", "host")] == [True, False]


def test_python_and_the_page_have_the_same_physics():
    pinned = dict(line.split("==") for line in (DEV / "needs/constraints.txt").read_text().splitlines() if not line.startswith("#"))
    page = json.loads((DEV.parent / "visual/package.json").read_text())["dependencies"]["@mujoco/mujoco"]
    assert pinned["mujoco"] == page == importlib.metadata.version("mujoco")
