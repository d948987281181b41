# SPDX-License-Identifier: MIT
"""What m512's own tests put before m512, for the page: m512_cases.py quick|all|noise > cases.jsonl

quick, all: every file that they read, and what the page has to make of it. noise: what strange boards say (tests/campaigns/noise.py), a line each, base64.

m512's tests run as they are; what reaches a reader of files is written down, with the test that brought it, so no case of them can be
missing here. `quick` leaves out tests that make files by chance or in great number, and keeps one file of each kind of answer: a kind is
a sentence without its numbers and names, or "read". Each line: {"test", "name", "data" (base64), and what bridge.py says of it here, in
CPython: "error", "no_room", or "sha256" of the image with "notes", "losses", and "is_empty": every page is erased, or good and without a
step}. The last line counts: {"tests", "files", "refused"}.
"""

import base64
import hashlib
import json
import pathlib
import re
import runpy
import sys
import tempfile
import types

import pytest

from m512.files import formats, mtn
from m512.files import image as raw
from m512.files import text as text_files

TOOLS = pathlib.Path(__file__).resolve().parents[2]
bridge = types.SimpleNamespace(**runpy.run_path(str(TOOLS / "visual" / "files" / "bridge.py")))  # as the page's Python runs it

TESTS = ("test_convert.py", "test_mtn_wild.py", "test_text.py", "test_trust.py", "test_pages.py")
#: Made by chance, or of whole robots: of them `all` takes every file.
SLOW = (
    "any_byte_changed or any_bytes or any_characters or damaged_pages or looks_like_something_else or every_accident or real or plays_as_one "
    "or combinations or textconv or standard_input or process_substitution or ctrl_c or help_of or time or 12_bit or long_page"
)
FIRST_OF_SLOW = "every_accident and 1.01-False or long_page_without_room or file_of_a_12_bit"


class Recorder:
    """Takes down (test, suffix, bytes) of every call of a reader while the tests run."""

    def __init__(self):
        self.test, self.tests, self.files = "", set(), {}

    def pytest_runtest_setup(self, item):
        self.test = item.nodeid.split("/")[-1]
        self.tests.add(self.test)

    def take(self, suffix, data):
        if isinstance(data, str):
            data = data.encode("utf-8", "surrogatepass")
        if len(data) < 300_000:
            self.files.setdefault((suffix, bytes(data)), self.test)

    def watch(self, module, name, suffix_of):
        reader = getattr(module, name)

        def watched(data, *more, **options):
            self.take(suffix_of(*more), data)
            return reader(data, *more, **options)

        setattr(module, name, watched)


def run(recorder, chosen):
    arguments = [str(TOOLS / "m512" / "tests" / name) for name in TESTS]
    words = ["-q", "--no-header", "-p", "no:cacheprovider", *(["-k", chosen] if chosen else [])]
    with tempfile.TemporaryDirectory() as folder:
        return pytest.main([*arguments, *words, "--rootdir", str(TOOLS / "m512"), "--basetemp", folder + "/t"], plugins=[recorder])


def kind_of(answer, suffix):
    if "error" not in answer:
        return suffix + (" no room" if "no_room" in answer else " read, " + re.sub(r"[\d,]+|\".*?\"", "#", " ".join(answer["notes"]))[:60])
    return suffix + " " + re.sub(r"\d[\d,.]*|\"[^\"]*\"|'[^']*'", "#", answer["error"].split(": ", 1)[-1])[:50]


def told(suffix, data):
    name = "case" + suffix
    answer = bridge.opened(name, data)
    image = answer.pop("image", None)
    if image:
        pages = [page for _, page in raw.from_bytes(image).items()]
        is_empty = all(raw.is_erased(page) or (page.steps == 0 and not page.fault()) for page in pages)
        answer = {**answer, "sha256": hashlib.sha256(image).hexdigest(), "is_empty": is_empty}
    return {"name": name, **answer}


def noise():
    """Two hundred talks of boards that are none of ours, made by m512's own recipe; the same every time."""
    from hypothesis import HealthCheck, given, settings

    from tests.campaigns.noise import pieces

    talks = []

    @settings(max_examples=200, derandomize=True, database=None, deadline=None, suppress_health_check=list(HealthCheck))
    @given(pieces())
    def take(data):
        talks.append(data)

    take()
    print("\n".join(json.dumps(base64.b64encode(data).decode()) for data in talks))


def main(how):
    recorder = Recorder()
    recorder.watch(formats, "decode", lambda path, *_: pathlib.Path(path).suffix)
    recorder.watch(mtn, "read", lambda *_: ".mtn")
    recorder.watch(raw, "from_hex", lambda *_: ".hex")
    recorder.watch(raw, "from_bytes", lambda *_: ".bin")
    recorder.watch(text_files, "read_text", lambda *_: ".m512")
    real, sys.stdout = sys.stdout, sys.stderr
    codes = [run(recorder, None)] if how == "all" else [run(recorder, f"not ({SLOW})"), run(recorder, FIRST_OF_SLOW)]
    sys.stdout = real
    if any(codes):
        sys.exit("m512's own tests fail")
    kinds, refused = set(), 0
    for (suffix, data), test in list(recorder.files.items()):
        answer = told(suffix, data)
        kind = kind_of(answer, suffix)
        if how == "quick" and kind in kinds:
            continue
        kinds.add(kind)
        refused += "error" in answer
        print(json.dumps({"test": test, "data": base64.b64encode(data).decode(), **answer}))
    print(json.dumps({"tests": len(recorder.tests), "files": len(recorder.files), "kinds": len(kinds), "refused": refused}))


if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in ("quick", "all", "noise"):
        sys.exit(__doc__)
    noise() if sys.argv[1] == "noise" else main(sys.argv[1])
