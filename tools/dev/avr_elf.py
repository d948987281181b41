# SPDX-License-Identifier: MIT
"""Contents of an AVR ELF file, for the checkers in this folder. Works with the binutils of gcc 5 and of gcc 14.

An assembler may keep its local labels (.L.., .Loc.3, L0 with a control character) among the symbols: they are not functions. A file that
cannot be understood raises Unreadable, so that it does not pass as clean.
"""

import re
import subprocess
from dataclasses import dataclass

INSTRUCTION = re.compile(r"^\s*([0-9a-f]+):\t((?:[0-9a-f]{2} )+)\s*\t(\S+)(?:\t([^;]*))?(?:;(.*))?$")
HEAD = re.compile(r"^([0-9a-f]+) <.+>:$")
LINE = re.compile(r"^(\S.*\.\w+):\d+(?: \(discriminator \d+\))?$")
SYMBOL = re.compile(r"^\s*\d+: ([0-9a-f]{8})\s+(\d+|0x[0-9a-f]+) (\w+)\s+\w+\s+\w+\s+(\S+) (.+)$")
DATA_START = 0x800000


class Unreadable(Exception):
    """The file is not an image that this module understands; the text says why."""


@dataclass
class Symbol:
    name: str
    address: int
    size: int
    kind: str  # FUNC, OBJECT, NOTYPE


@dataclass
class Instruction:
    address: int
    size: int
    mnemonic: str
    operands: str
    comment: str
    function: int  # address of its function; None in a table
    source: str  # source file of its line; "" if unknown


def tool(*arguments):
    done = subprocess.run([str(argument) for argument in arguments], check=False, capture_output=True, text=True)
    if done.returncode:
        raise Unreadable(f"{arguments[0]}: {done.stderr.strip()}")
    return done.stdout


def symbols(elf):
    """All symbols of functions, tables and variables, and labels without a type."""
    found = []
    for match in filter(None, map(SYMBOL.match, tool("avr-readelf", "-sW", elf).splitlines())):
        address, size, kind, section, name = match.groups()
        if kind in ("FUNC", "OBJECT", "NOTYPE") and section not in ("UND", "ABS") and name[0] != "." and name.isprintable() and "^" not in name:
            found.append(Symbol(name, int(address, 16), int(size, 0), kind))
    if not any(symbol.name == "main" for symbol in found):
        raise Unreadable(f"{elf}: no main among its symbols; was it stripped?")
    return found


def places(elf):
    """{address: symbol} of the code, including its tables. Of several names at one address, prefers a function's."""
    best = {}
    for symbol in sorted(symbols(elf), key=lambda symbol: (symbol.kind == "NOTYPE", -symbol.size, symbol.name)):
        if symbol.address < DATA_START:
            best.setdefault(symbol.address, symbol)
    return best


def instructions(elf):
    """The instructions of the code, in order."""
    at, rows, function, source = places(elf), [], None, ""
    for line in tool("avr-objdump", "-dl", elf).splitlines():
        match = INSTRUCTION.match(line)
        if match:
            address = int(match[1], 16)
            if address in at:
                function = None if at[address].kind == "OBJECT" else address
            rows.append(Instruction(address, len(match[2].split()), match[3], (match[4] or "").strip(), match[5] or "", function, source))
        elif LINE.match(line):
            source = LINE.match(line)[1]
        elif HEAD.match(line) and int(HEAD.match(line)[1], 16) in at:
            source = ""
    if not any(row.function is not None and at[row.function].name == "main" for row in rows):
        raise Unreadable(f"{elf}: no instruction of main in what avr-objdump -d says")
    return rows
