# SPDX-License-Identifier: MIT
"""tools/dev/pack_texts: what it reads, packs and refuses; and the texts of the images made with it."""

import ast
import importlib.util
import os
import random
import re
import subprocess
from importlib.machinery import SourceFileLoader
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
FIRMWARE = Path(os.environ.get("M512_BUILD", ROOT / "build")) / "firmware"
AVR = Path(os.environ.get("M512_BUILD", ROOT / "build")) / "avr" / "firmware"


def load(path):
    loader = SourceFileLoader("pack_texts", str(path))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("pack_texts", loader))
    loader.exec_module(module)
    return module


tool = load(ROOT / "tools" / "dev" / "pack_texts")


def texts_of(source):
    return [mark.text for mark in tool.find_marks(source)]


# ---- the code ----


def decode(codes, pairs):
    """An independent decoder, from the tool's description: recursive, without a stack."""
    out = b""
    for code in codes:
        part = bytes([code]) if code == 0 or 0x20 <= code < 0x80 else decode(pairs[code], pairs)
        out += part
        if part.endswith(b"\0"):
            break
    return out


def test_every_packed_text_unpacks_to_itself():
    chance = random.Random(7)
    words = ["page", "step", " is ", "servo", "~", "0..127", "aaaa", "the "]
    texts = ["".join(chance.choice(words) for _ in range(chance.randrange(9))).encode() for _ in range(300)]
    packed, pairs = tool.pack(texts)
    assert set(packed) == set(texts)
    assert all(decode(codes, pairs) == text + b"\0" for text, codes in packed.items())
    assert sum(map(len, packed.values())) < sum(map(len, packed)) / 2


def test_nesting_is_bounded():
    # A text of 2,000 equal characters would nest eleven deep: pairs of pairs of pairs.
    packed, pairs = tool.pack([b"x" * 2000, b"x" * 999])
    assert all(tool.waiting(code, pairs) <= tool.DEPTH for code in pairs)
    assert decode(packed[b"x" * 2000], pairs) == b"x" * 2000 + b"\0"


def test_a_pair_that_does_not_pay_is_not_made():
    assert tool.pack([b"abc", b"abd"])[1] == {}


# ---- what is read ----


def test_marks_are_found_with_their_kind_and_name():
    source = 'TEXT("a");\ntext_P(x ? TEXT_P("b") : TEXT_P("c"));\nTEXT_NAMED(help_x, "d");\n'
    assert [(mark.kind, mark.name, mark.text) for mark in tool.find_marks(source)] == [
        ("TEXT", None, b"a"),
        ("TEXT_P", None, b"b"),
        ("TEXT_P", None, b"c"),
        ("TEXT_NAMED", "help_x", b"d"),
    ]


def test_adjacent_literals_and_comments_between_are_one_text():
    assert texts_of('TEXT("one " /* here */\n     "two" // there\n "\\"");') == [b'one two"']


def test_comments_strings_and_the_preprocessor_are_left_alone():
    source = '// TEXT("no")\n/* TEXT("no") */\nputs("TEXT(\\"no\\")");\n#define SAY(x) \\\n  TEXT(x)\nMY_TEXT("no");'
    assert texts_of(source) == []


def test_literals_mean_what_the_compiler_says(tmp_path):
    literals = [r'"plain, ????"', r'"\"\\\'\?"', r'"\101[999;999H\0501\40"', r'"\x5B" "[2J"']
    program = "#include <stdio.h>\nint main(void)\n{\n" + "".join(
        f'    for (const char *c = {literal}; *c; c++) printf("%02x", *c);\n    puts("");\n' for literal in literals
    )
    (tmp_path / "p.c").write_text(program + "    return 0;\n}\n")
    subprocess.run(["cc", "-o", tmp_path / "p", tmp_path / "p.c"], check=True)
    said = subprocess.run([tmp_path / "p"], capture_output=True, text=True, check=True).stdout.split()
    assert [text.hex() for literal in literals for text in texts_of(f"TEXT({literal});")] == said


@pytest.mark.parametrize(
    "line, complaint",
    [
        ("TEXT(name);", "string literals only"),
        ('TEXT(a ? "x" : "y");', "string literals only"),
        ('TEXT("x" NAME "y");', "string literals only"),
        ('TEXT("\\q");', "unknown escape"),
        ('TEXT("a\\0b");', "characters 0x20..0x7F"),
        ('TEXT("a\\r\\n");', "characters 0x20..0x7F"),
        ('TEXT("\\200");', "characters 0x20..0x7F"),
        ('TEXT_NAMED("x");', "needs a name"),
        ('TEXT_NAMED(x, "y"), z;', "semicolon"),
    ],
)
def test_what_it_cannot_read_is_an_error_with_file_and_line(tmp_path, line, complaint):
    (tmp_path / "odd.c").write_text("int x;\n\n" + line + "\n")
    run = subprocess.run([ROOT / "tools/dev/pack_texts", "--out", tmp_path / "out", tmp_path / "odd.c"], capture_output=True, text=True)
    assert run.returncode == 1
    assert "odd.c:3: " in run.stderr and complaint in run.stderr
    assert not (tmp_path / "out").exists()


# ---- what is written ----


def pack_files(folder, **sources):
    paths = []
    for name, text in sources.items():
        paths.append(folder / f"{name}.c")
        paths[-1].write_text(text)
    subprocess.run([ROOT / "tools/dev/pack_texts", "--out", folder / "out", *paths], check=True, capture_output=True)
    return folder / "out"


def test_lines_keep_their_numbers_and_the_name_of_the_original(tmp_path):
    out = pack_files(tmp_path, a='int x;\nTEXT("one"\n     "two"); int __LINE__3;\nTEXT_NAMED(\nn,\n"x")\n;\nint last;\n')
    lines = (out / "a.c").read_text().split("\n")
    assert f'#line 1 "{tmp_path}/a.c"' in lines
    begin = lines.index(f'#line 1 "{tmp_path}/a.c"')
    assert lines[begin + 3].endswith("int __LINE__3;")
    assert lines[begin + 8] == "int last;"


def test_the_same_text_is_stored_once(tmp_path):
    out = pack_files(tmp_path, a='TEXT("again and again");\n', b='f(TEXT_P("again and again"));\n')
    assert (out / "texts.c").read_text().count("PROGMEM = ") == 1
    assert "text_P(text_0);" in (out / "a.c").read_text() and "f(text_0);" in (out / "b.c").read_text()


def test_what_does_not_change_is_not_written_again(tmp_path):
    out = pack_files(tmp_path, a='TEXT("x");\n')
    os.utime(out / "a.c", (1, 1))
    pack_files(tmp_path, a='TEXT("x");\n')
    assert (out / "a.c").stat().st_mtime == 1


# ---- the images ----


def image_symbols(elf):
    """{name without the compiler's suffix: [bytes]} of the symbols in flash."""
    flash = elf.with_suffix(".elf.bin")
    subprocess.run(["avr-objcopy", "-O", "binary", "-j", ".text", elf, flash], check=True)
    data = flash.read_bytes()
    flash.unlink()
    symbols = {}
    for line in subprocess.run(["avr-nm", "-S", elf], capture_output=True, text=True, check=True).stdout.splitlines():
        if found := re.match(r"([0-9a-f]{8}) ([0-9a-f]{8}) [tT] (\w+)", line):
            at, size = int(found[1], 16), int(found[2], 16)
            symbols.setdefault(found[3], []).append(data[at : at + size])
    return symbols


@pytest.mark.parametrize("image", ["edit-cm5", "edit-cm2", "play-cm5", "play-cm2"])
def test_the_texts_of_an_image_unpack_to_the_originals(image):
    elf, kind = FIRMWARE / f"{image}.elf", image.split("-")[0]
    listing = AVR / kind / f"{kind}-texts" / "texts.txt"
    symbols = image_symbols(elf)
    flat = symbols["text_pairs"][0]
    pairs = dict(zip([*range(0x80, 0x100), *range(0x20)], zip(flat[::2], flat[1::2])))
    originals = {}
    for line in listing.read_text().splitlines():
        name, text = line.split("\t")
        originals.setdefault(name, set()).add(ast.literal_eval(text) + b"\0")
    checked = 0
    for name, wanted in originals.items():
        for codes in symbols.get(name, []):
            assert decode(codes, pairs) in wanted, name
            checked += 1
    assert checked > 0.9 * len(originals), "most texts are in the image"
