# SPDX-License-Identifier: MIT
"""The size report's stack figures, for frames whose size is known from the source."""

import pathlib
import subprocess

import pytest

TOOL = pathlib.Path(__file__).parents[3] / "tools" / "dev" / "size_report"

# leaf: 40 bytes of frame and two pushed bytes of Y; pointed: 300 and two, called through a table in flash.
SOURCE = """
#include <avr/io.h>
#include <avr/interrupt.h>
#include <avr/pgmspace.h>
volatile char v;
volatile char big[%d];
static void __attribute__((noinline)) leaf(void) { volatile char b[40]; b[0] = v; PORTB = b[0]; }
static void __attribute__((noinline)) pointed(void) { volatile char x[300]; x[0] = v; leaf(); }
static void __attribute__((noinline)) other(void) { PORTC = 1; }
static void (*const table[])(void) PROGMEM = { pointed, other };
ISR(TIMER1_OVF_vect, ISR_NAKED) { asm volatile("push r0\\n push r1\\n pop r1\\n pop r0\\n reti"); }
int main(void) { big[v] = 1; for (;;) ((void (*)(void))pgm_read_word(&table[v & 1]))(); }
"""


def report(tmp_path, big, name="play-x", options=("-g",)):
    source, elf = tmp_path / "t.c", tmp_path / f"{name}.elf"
    source.write_text(SOURCE % big)
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-flto", *options, source, "-o", elf], check=True)
    return subprocess.run([TOOL, "--paths", elf], capture_output=True, text=True)


def test_deepest_path_goes_through_the_table(tmp_path):
    done = report(tmp_path, 10)
    assert done.returncode == 0, done.stderr
    fields = next(line for line in done.stdout.splitlines() if line.startswith("play-x")).split()
    # main 2 (gcc 7: 0), call 2, pointed 302, call 2, leaf 42; the interrupt: return address and two pushes.
    assert fields[5] in ("350", "348") and fields[6] == "4"
    assert "pointed(302) > leaf(42)" in done.stdout


def test_files_are_told_with_their_code(tmp_path):
    """other() is LDI, OUT, RET."""
    one, two, elf = tmp_path / "one.c", tmp_path / "two.c", tmp_path / "play-x.elf"
    one.write_text("#include <avr/io.h>\nvoid __attribute__((noinline)) other(void) { PORTC = 1; }\n")
    two.write_text("#include <avr/io.h>\nvoid other(void);\nint main(void) { for (;;) { other(); PORTB = 2; other(); } }\n")
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-g", "-flto", "-ffunction-sections", one, two, "-o", elf], check=True)
    done = subprocess.run([TOOL, "--files", elf], capture_output=True, text=True)
    counts = {line.split()[1].rsplit("/", 1)[-1]: int(line.split()[0]) for line in done.stdout.splitlines() if line.endswith(".c")}
    assert counts["one.c"] == 6 and counts["two.c"] > 6


def test_ram_over_budget_fails_and_says_so(tmp_path):
    done = report(tmp_path, 3800)
    assert done.returncode == 1
    assert "over budget: play-x: data + bss + stack" in done.stderr


def test_flash_budget_of_the_loader_is_smaller(tmp_path):
    assert " 8192 " in report(tmp_path, 10, "boot-x").stdout
    assert " 49152 " in report(tmp_path, 10, "edit-x").stdout


# Two functions that call each other, and the same without the call back.
RECURSION = """
#include <avr/io.h>
volatile char v;
static void __attribute__((noinline)) down(char count);
static void __attribute__((noinline)) step(char count) { PORTB = count; %s PORTC = count; }
static void __attribute__((noinline)) down(char count) { PORTD = count; step(count - 1); PORTE = count; }
int main(void) { for (;;) down(v); }
"""


@pytest.mark.parametrize("way_back, is_fault", [("if (count) down(count);", True), ("", False)])
@pytest.mark.parametrize("options", [(), ("-g",)], ids=["", "-g"])  # -g: a newer assembler leaves a label before each line
def test_recursion_is_a_fault(tmp_path, way_back, is_fault, options):
    source, elf = tmp_path / "t.c", tmp_path / "play-x.elf"
    source.write_text(RECURSION % way_back)
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", *options, "-fno-optimize-sibling-calls", source, "-o", elf], check=True)
    done = subprocess.run([TOOL, elf], capture_output=True, text=True)
    assert done.returncode == is_fault, done.stderr
    assert ("calls itself: its stack has no bound" in done.stderr) == is_fault


# The player's only pointers are page sources. `other` is deeper and its address is taken too, but it is not called.
PLAYER = """
#include <avr/io.h>
volatile char v;
static void __attribute__((noinline)) source_read(void) { volatile char b[50]; b[0] = v; PORTB = b[0]; }
static void __attribute__((noinline)) other(void) { volatile char b[60]; b[0] = v; PORTC = b[0]; }
void (*volatile pointers[])(void) = { source_read, other };
static void __attribute__((noinline)) tick(void) { pointers[0](); PORTB = 1; }
int main(void) { for (;;) tick(); }
"""


def test_pointers_of_the_player_reach_page_sources_only(tmp_path):
    source, elf = tmp_path / "motion" / "player.c", tmp_path / "play-x.elf"
    source.parent.mkdir()
    source.write_text(PLAYER)
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", "-g", source, "-o", elf], check=True)
    done = subprocess.run([TOOL, "--paths", elf], capture_output=True, text=True)
    assert "tick(0) > source_read(52)" in done.stdout


def built(tmp_path, text, *options):
    source, elf = tmp_path / "t.c", tmp_path / "play-x.elf"
    source.write_text(text)
    subprocess.run(["avr-gcc", "-mmcu=atmega128", "-Os", *options, source, "-o", elf], check=True)
    return subprocess.run([TOOL, elf], capture_output=True, text=True)


def test_an_image_without_symbols_is_refused(tmp_path):
    done = report(tmp_path, 10, options=("-s",))
    assert done.returncode == 1 and "no main among its symbols" in done.stderr


def test_a_stack_that_is_made_in_an_unknown_way_is_refused(tmp_path):
    done = built(
        tmp_path,
        """
#include <avr/io.h>
static void __attribute__((noinline)) odd(void) { SP = SP - 100; PORTB = SPL; SP = SP + 100; }
int main(void) { for (;;) odd(); }
""",
    )
    assert done.returncode == 1 and "odd moves the stack pointer in a way that this report does not know" in done.stderr


def test_a_call_to_nowhere_is_refused(tmp_path):
    done = built(tmp_path, 'int main(void) { for (;;) __asm__ volatile("call 0x8000"); }')
    assert done.returncode == 1 and "main goes to 0x08000, where no function is" in done.stderr


# A frame made by the compiler's common routine, as in the images.
@pytest.mark.parametrize("options", [(), ("-mcall-prologues", "-mrelax", "-g")], ids=" ".join)
@pytest.mark.parametrize("size", [1, 6, 7, 63, 64, 300])
def test_frames_of_every_size_are_counted(tmp_path, size, options):
    done = built(
        tmp_path,
        f"""
#include <avr/io.h>
volatile char v;
static void __attribute__((noinline)) framed(void) {{ volatile char b[{size}]; for (uint8_t i = 0; i < sizeof b; i++) b[i] = v; PORTB = b[0]; }}
int main(void) {{ for (;;) framed(); }}
""",
        *options,
    )
    assert done.returncode == 0, done.stderr
    fields = done.stdout.splitlines()[1].split()
    # Y is saved if there is a frame; the call from main; main's own return address.
    assert size + 2 <= int(fields[5]) - 4 <= size + 2 + 4
