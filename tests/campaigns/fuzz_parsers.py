# SPDX-License-Identifier: MIT
"""Damaged files and answers for m512. Used by fuzz.py.

A file is either read or refused with an m512 error. A file that is read survives conversion through every lossless format. Answers of a
board are the noise of noise.py, in large numbers."""

import binascii
import dataclasses
import pathlib
import random
import re
import tempfile
import time

from tests.campaigns import noise, proof
from tests.campaigns.proof import Figure

FILES = 10_000
ANSWERS = 6_000
COMMANDS = 600
SAMPLE = 100  # the sample is smaller by this factor
TASK = 250
LIMIT_S = 10.0  # of CPU time per file
KINDS = (".m512", ".mtn", ".hex", ".bin")
NUMBERS = (
    *b"0 -1 1 7 30 31 127 128 255 256 1023 1024 65535 65536 0x1F 1e9 99999999999999999999 nan inf .5 1/0 0.0078".split(),
    b"\xd9\xa3",  # a digit, but none of ASCII
)
WORDS = (
    *b"page step spare fill raw link1 next exit self none pose @a mirror same row pairs defaults offset erased checksum code".split(),
    *b"page_begin page_end play_param= step= name= 720dps 3s 200ms \\x41 | ; # .. : , . \\".split(),
    *(b'"', b"\r", b"\0", b"\xff", b"\xef\xbb\xbf", b'include "a.m512"', b"bits 12"),
    *(b":00000001FF\n", b":020000040001F9\n"),
)


@dataclasses.dataclass
class Outcome:
    """The results of many inputs."""

    done: int = 0
    read: int = 0
    findings: list = dataclasses.field(default_factory=list)


def seeds():
    """Returns {suffix: files}: a small set of pages of every kind in every format, and the project's own motion texts."""
    from m512.files import formats
    from m512.files.image import Image
    from m512.files.page import Page

    rng = random.Random("seeds")
    image = Image.empty()
    for number in (1, 2, 5):
        page = Page()
        page.name, page.steps, page.next = f"p {number}".encode(), number + 1, (number + 1) % 4
        page.schedule = 0 if number == 2 else page.schedule
        for step in range(page.steps):
            for joint in range(31):
                page.set_word(step, joint, rng.choice((0x4000, rng.randrange(1024), rng.randrange(1024))))
            page.set_time(step, rng.randrange(256))
            page.set_pause(step, rng.choice((0, 30)))
        image[number] = page.seal()
    out = {".mtn": [formats.encode(pathlib.Path("x.mtn"), image)[0]]}  # the .mtn format cannot hold a damaged page
    image[7].data[33] ^= 1
    out |= {suffix: [formats.encode(pathlib.Path("x" + suffix), image)[0]] for suffix in KINDS if suffix != ".mtn"}
    out[".m512"] += [path.read_bytes() for path in sorted((proof.TOP / "tools" / "motions").glob("*.m512"))]
    return out


def mutate(rng, data, others):
    """Makes a few changes that tend to break parsers."""
    data = bytearray(data)
    for _ in range(rng.choice((1, 1, 1, 2, 3, 8))):
        at = rng.randrange(len(data) + 1)
        kind = rng.choice((0, 0, 1, 2, 3, 4, 4, 4, 4, 5, 5, 6, 7, 8))
        if kind == 0 and at < len(data):
            data[at] ^= 1 << rng.randrange(8)
        elif kind == 1:
            del data[at : at + rng.choice((1, 2, 10, 100, 2000))]
        elif kind == 2:
            data[at:at] = data[at : at + rng.choice((1, 5, 40, 400))]
        elif kind == 3:
            data[at:at] = rng.choice(WORDS)
        elif kind == 4:
            numbers = list(re.finditer(rb"\d+", bytes(data)))
            if numbers:
                number = rng.choice(numbers)
                data[number.start() : number.end()] = rng.choice((*NUMBERS, *[b"%d" % rng.randrange(130)] * 12))
        elif kind == 5:
            lines = bytes(data).split(b"\n")
            i, j = rng.randrange(len(lines)), rng.randrange(len(lines))
            lines[i], lines[j] = lines[j], lines[i] if rng.random() < 0.5 else lines[j]
            data = bytearray(b"\n".join(lines))
        elif kind == 6:
            other = rng.choice(others)
            start = rng.randrange(len(other))
            data[at : at + rng.randrange(60)] = other[start : start + rng.randrange(200)]
        elif kind == 7:
            data[at : at + rng.randrange(4)] = rng.randbytes(rng.randrange(1, 5))
        else:
            words = re.findall(rb"[A-Za-z_=]+", bytes(data)) or [b"x"]
            data[at:at] = b" " + rng.choice(words) + b" "
    return bytes(data)


def mend(suffix, data):
    """Corrects the checksums, so that the code behind their checks is reached."""
    if suffix == ".mtn":
        return data[:-2] + (~sum(data[:-2]) & 0xFFFF).to_bytes(2, "big")
    if suffix != ".hex":
        return data
    lines = []
    for line in data.split(b"\n"):
        try:
            record = binascii.unhexlify(line.strip()[1:-2])
            lines.append(line.strip()[:-2] + b"%02X" % (-sum(record) & 0xFF) if line[:1] == b":" else line)
        except (binascii.Error, ValueError):
            lines.append(line)
    return b"\n".join(lines)


def judge(data, suffix, folder):
    """Returns whether the file was read. Raises an exception if a rule is broken."""
    from m512.errors import M512Error
    from m512.files import formats

    began = time.process_time()
    try:
        image = formats.decode(data, folder / f"x{suffix}")
    except M512Error as error:
        assert str(error).strip(), "an error that says nothing"
        return False
    finally:
        assert time.process_time() - began < LIMIT_S, f"{time.process_time() - began:.0f} s of CPU for one file"
    whole = image.to_bytes()
    if len(image.pages) == 128 and image.first == 0:
        again = formats.decode(formats.encode(folder / "y.hex", image)[0], folder / "y.hex", image.bits)
        assert again.to_bytes() == whole, "Intel HEX gives other pages back"
    text = formats.encode(folder / "y.m512", image)[0]
    assert formats.decode(text, folder / "y.m512").to_bytes() == whole, "the text gives other pages back"
    return True


def files(task):
    """Reads damaged files. task: (seed, count)."""
    seed, count = task
    rng, outcome, originals = random.Random(f"files {seed}"), Outcome(), seeds()
    others = [data for group in originals.values() for data in group]
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(count):
            suffix = rng.choice((".m512", ".m512", ".m512", ".mtn", ".mtn", ".hex", ".bin"))
            data = mutate(rng, rng.choice(originals[suffix]), others)
            data = data[:65536].ljust(65536, b"\xff") if suffix == ".bin" and rng.random() < 0.8 else data
            data = mend(suffix, data) if rng.random() < 0.7 else data
            outcome.done += 1
            try:
                outcome.read += judge(data, suffix, pathlib.Path(folder))
            except Exception as fault:  # pylint: disable=broad-except  (any exception is a finding)
                outcome.findings.append(keep(f"{seed}-{outcome.done}{suffix}", data, fault))
    return outcome


def keep(name, data, fault):
    """Saves the file. Returns its path and the fault."""
    folder = proof.RESULTS / "fuzz" / "m512"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / name).write_bytes(data)
    return f"{(folder / name).relative_to(proof.TOP)}: {type(fault).__name__}: {' '.join(str(fault).split())[:200]}"


def answers(task):
    """Lets m512 talk to noise instead of a board. task: (seed, number of conversations)."""
    from hypothesis import HealthCheck, given, seed, settings

    number, count = task
    outcome = Outcome()
    for talk in noise.TALKS:
        run = settings(max_examples=count // 3, deadline=None, database=None, suppress_health_check=list(HealthCheck))(
            seed(number)(given(noise.pieces())(talk))
        )
        outcome.done += count // 3
        try:
            run()
        except Exception as fault:  # pylint: disable=broad-except
            outcome.findings.append(f"{talk.__name__} with seed {number}: {type(fault).__name__}: {' '.join(str(fault).split())[:200]}")
    return outcome


def commands(task):
    """Gives damaged files to the command line. task: (seed, count). It must end with an m512 exit code and no traceback."""
    from click.testing import CliRunner

    from m512.cli import main

    seed, count = task
    rng, outcome, originals = random.Random(f"commands {seed}"), Outcome(), seeds()
    others = [data for group in originals.values() for data in group]
    with tempfile.TemporaryDirectory() as folder:
        for _ in range(count):
            suffix = rng.choice(KINDS)
            data = mend(suffix, mutate(rng, rng.choice(originals[suffix]), others))
            path = pathlib.Path(folder) / f"x{suffix}"
            path.write_bytes(data)
            words = rng.choice(
                [
                    ["pages", path, "check"],
                    ["pages", path, "list"],
                    ["pages", path, "show", "1"],
                    ["pages", path, "time", "1"],
                    ["convert", path, path.with_name("y.m512"), "--force"],
                    ["diff", path, path],
                ]
            )
            words = [str(word) for word in words]
            result = CliRunner().invoke(main, words)
            outcome.done += 1
            outcome.read += result.exit_code == 0
            if result.exit_code not in (0, 2, 3, 4, 5) or (result.exception and not isinstance(result.exception, SystemExit)):
                outcome.findings.append(keep(f"{seed}-{outcome.done}{suffix}", data, result.exception or ValueError(result.exit_code)))
    return outcome


def figures(options):
    """Returns the figures of m512."""
    return [
        row(options, *what)
        for what in (
            (
                files,
                FILES,
                "m512 reads a file or refuses it in a sentence of its own, and gives back what it has read",
                "damaged .m512, .mtn, Intel HEX and image files, with right checksums in most, through all formats that keep everything",
                "files",
            ),
            (
                commands,
                COMMANDS,
                "m512's commands end with an exit code of theirs and no traceback, whatever the file",
                "pages check, list, show and time, convert and diff on such files",
                "command lines",
            ),
            (
                answers,
                ANSWERS,
                "m512 ends every conversation with a result or an error of its own, whatever answers",
                "the three protocols against noise with the words in it that they look for (hypothesis)",
                "conversations",
            ),
        )
    ]


def row(options, work, count, promise, how, what):
    """Runs many tasks of one kind. Returns their figure."""
    count = max(30, count // SAMPLE) if options.sample else count
    size = min(TASK, count)
    tasks = [(options.seed * 100_000 + i, size) for i in range(-(-count // size))]
    outcomes = proof.each(work, tasks, what, options.jobs)
    findings = [finding for outcome in outcomes for finding in outcome.findings]
    measured = f"{sum(o.done for o in outcomes):,} {what}, {len(findings)} findings"
    if work is not answers:
        measured += f"; {sum(o.read for o in outcomes):,} were still good"
    return Figure(promise, how, "; ".join([measured, *findings[:5]]), not findings)
