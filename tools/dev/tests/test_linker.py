# SPDX-License-Identifier: MIT
"""Our linker scripts (linker/, m512_image of tools/dev/cmake): a section that no script names is an error for each kind of image, and a
change of a file that a script includes links again. Uses a small project with the same toolchain file."""

import os
import pathlib
import shlex
import shutil
import subprocess

import pytest

TOP = pathlib.Path(__file__).parents[3]
BUILD = pathlib.Path(os.environ.get("M512_BUILD", TOP / "build"))

KINDS = ("app", "boot", "test")
PROJECT = """
cmake_minimum_required(VERSION 3.25)
project(small VERSION 1.0.0 LANGUAGES C)
list(APPEND CMAKE_MODULE_PATH ${CMAKE_SOURCE_DIR}/tools/dev/cmake)
set(M512_FIRMWARE_DIR ${CMAKE_SOURCE_DIR}/made)
include(m512)
add_subdirectory(linker)
foreach(kind app boot test)
    m512_image(good-${kind} BOARD cm5 KIND ${kind} SOURCES good.c)
    m512_image(stray-${kind} BOARD cm5 KIND ${kind} SOURCES stray.c)
endforeach()
"""
# app_record: filled in by tools/dev/app_record; dropped if the linker script does not name it.
GOOD = '__attribute__((section(".app_record"), used)) const char app_record[16] = "M512";\nint main(void)\n{\n    for (;;) {\n    }\n}\n'
STRAY = """extern volatile unsigned char sink;
volatile unsigned char sink;
extern const char stray[];
const char stray[] __attribute__((section(".stray"))) = "in RAM, if the linker may choose";
int main(void)
{
    for (;;) {
        sink = (unsigned char)stray[sink];
    }
}
"""


def build(project, *targets, **how):
    return subprocess.run(["cmake", "--build", project / "build", "--target", *targets], capture_output=True, text=True, **how)


@pytest.fixture(scope="module")
def project(tmp_path_factory):
    """The project, with its good images built."""
    folder = tmp_path_factory.mktemp("project")
    for part in ("linker", "tools/dev/cmake"):
        shutil.copytree(TOP / part, folder / part)
    shutil.copy(TOP / "tools/dev/app_record", folder / "tools/dev")
    for name, text in (("CMakeLists.txt", PROJECT), ("good.c", GOOD), ("stray.c", STRAY)):
        (folder / name).write_text(text)
    subprocess.run(
        [
            "cmake",
            "-G",
            "Ninja",
            "-S",
            folder,
            "-B",
            folder / "build",
            "--log-level=WARNING",
            f"-DCMAKE_TOOLCHAIN_FILE={folder}/tools/dev/cmake/avr_toolchain.cmake",
        ],
        check=True,
        capture_output=True,
    )
    done = build(folder, *(f"good-{kind}" for kind in KINDS))
    assert done.returncode == 0, done.stdout
    return folder


@pytest.mark.parametrize("kind", KINDS)
def test_section_without_a_place_is_an_error(project, kind):
    done = build(project, f"stray-{kind}")
    assert done.returncode != 0 and "unplaced orphan section `.stray'" in done.stdout, done.stdout
    assert not (project / "made" / f"stray-{kind}.hex").exists()


@pytest.mark.parametrize(
    "edited, kinds",
    [
        ("app.ld.in", {"app"}),
        ("boot.ld.in", {"boot"}),
        ("test.ld.in", {"test"}),
        ("text.ld.in", {"app", "test"}),
        ("data.ld.in", set(KINDS)),
        ("debug.ld.in", set(KINDS)),
        ("memory_map.h", set(KINDS)),
    ],
)
def test_edit_of_a_script_links_again_what_includes_it(project, edited, kinds):
    images = {kind: project / "made" / f"good-{kind}.elf" for kind in KINDS}
    linked = {kind: image.stat().st_mtime_ns for kind, image in images.items()}
    with open(project / "linker" / edited, "a") as file:
        file.write("/* edited */\n")
    done = build(project, *(f"good-{kind}" for kind in KINDS))
    assert done.returncode == 0, done.stdout
    assert {kind for kind, image in images.items() if image.stat().st_mtime_ns > linked[kind]} == kinds


def test_every_image_is_linked_with_a_script_of_ours_and_strictly():
    images = sorted((BUILD / "firmware").rglob("*.elf"))
    assert len(images) > 80
    commands = subprocess.run(
        ["ninja", "-C", BUILD / "avr", "-t", "commands", *map(str, images)], check=True, capture_output=True, text=True
    ).stdout.splitlines()
    links = [words for words in map(shlex.split, commands) if any(word.endswith(".elf") for word in words) and "-c" not in words]
    assert len(links) == len(images)
    for words in links:
        assert "-Wl,--orphan-handling=error" in words and words[words.index("-T") + 1].startswith(f"{BUILD}/avr/linker/"), words
