#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The pages that the C codec and the Python codec must read in the same way: VECTORS. page_vectors.py OUT.H writes them as a C table for
tests/unit/test_page_vectors.c.

Based only on the specification of the page: it builds bytes by offset and states by hand what each page means. It must not
import m512, so that no codec checks itself.
"""

import sys

ORDER = ["OK", "CHECKSUM", "STEPS", "SCHEDULE", "SPEED", "LINK", "POSITION"]


def empty():
    """The empty page of the specification without its checksum."""
    page = bytearray(512)
    page[15], page[16], page[22], page[24] = 1, 0x0A, 32, 32
    for joint in range(31):
        page[32 + joint] = 0x55
        for step in range(7):
            page[64 + 64 * step + 2 * joint + 1] = 0x40
    return page


def put(page, step, joint, word):
    page[64 + 64 * step + 2 * joint] = word & 0xFF
    page[64 + 64 * step + 2 * joint + 1] = word >> 8


VECTORS = []


def vector(name, page, fault, playable, checksum=None, words=(), **fields):
    """`checksum` None: the correct one, computed here by the rule "all 512 bytes sum to 0xFF modulo 256"."""
    assert len(page) == 512
    if checksum is None:
        page[31] = 0
        page[31] = (255 - sum(page) % 256) % 256
    else:
        page[31] = checksum
    VECTORS.append(
        {
            "name": name,
            "fault": fault,
            "fault_number": ORDER.index(fault),
            "playable": playable,
            "fields": dict(fields, checksum=page[31]),
            "words": [{"step": s, "joint": j, "word": w, "used": u} for s, j, w, u in words],
            "hex": bytes(page).hex(),
        }
    )


DEFAULTS = dict(
    play_count=1,
    schedule=0x0A,
    steps=0,
    play_code=0,
    speed=32,
    dxl_setup=0,
    accel_time=32,
    next_page=0,
    exit_page=0,
    linked1_page=0,
    linked1_code=0,
    linked2_page=0,
    linked2_code=0,
)


def pose(steps=1, **changes):
    """A page of `steps` steps with joint 1 at 512."""
    page = empty()
    page[20] = steps
    for step in range(min(steps, 7)):
        put(page, step, 1, 512)
        page[64 + 64 * step + 63] = 64
    for offset, value in changes.items():
        page[int(offset[1:])] = value
    return page


def with_word(word, step=0, joint=5, steps=1):
    page = pose(steps)
    put(page, step, joint, word)
    return page


def build():
    # The empty page's checksum, computed by hand: 1 + 10 + 32 + 32 + 31 * 0x55 + 217 * 0x40 = 16598 = 0x40D6; 0xFF - 0xD6 = 0x29.
    vector("empty", empty(), "OK", False, 0x29, [(0, 0, 0x4000, False), (6, 30, 0x4000, False)], **DEFAULTS)
    vector("erased flash", bytearray(b"\xff" * 512), "CHECKSUM", True, 0xFF, steps=255)
    vector("all zero", bytearray(512), "CHECKSUM", False, 0x00, steps=0, speed=0)
    vector("all zero, sealed", bytearray(512), "SPEED", False, 0xFF, steps=0, speed=0)

    page = empty()
    page[0:4] = b"wave"
    for offset, value in enumerate([2, 0, 0, 0, 0, 2, 0x11, 64, 7, 16, 12, 13, 14, 0x15, 15, 0x16], 15):
        page[offset] = value
    page[32 + 3] = 0x37
    put(page, 0, 0, 0)
    put(page, 0, 3, 1023)
    put(page, 1, 3, 0x4000 | 600)
    put(page, 1, 30, 258)
    page[64 + 62], page[64 + 63] = 128, 255
    page[128 + 62], page[128 + 63] = 0, 1
    vector(
        "every field",
        page,
        "OK",
        True,
        None,
        [(0, 0, 0, True), (0, 3, 1023, True), (1, 3, 0x4258, False), (1, 30, 0x0102, True), (1, 0, 0x4000, False)],
        play_count=2,
        schedule=0,
        steps=2,
        play_code=0x11,
        speed=64,
        dxl_setup=7,
        accel_time=16,
        next_page=12,
        exit_page=13,
        linked1_page=14,
        linked1_code=0x15,
        linked2_page=15,
        linked2_code=0x16,
    )
    VECTORS[-1].update(title="wave", compliance={"2": 0x55, "3": 0x37}, pauses=[128, 0], times=[255, 1])

    page = pose()
    page[0:14] = b"old\0tail\0x\0\0\0\0"
    vector("name with a tail behind the NUL", page, "OK", True, None, **dict(DEFAULTS, steps=1))
    VECTORS[-1]["title"] = "old"
    page = pose()
    page[0:14] = b"fourteen chars"
    vector("name without a NUL", page, "OK", True)
    VECTORS[-1]["title"] = "fourteen chars"

    vector("seven steps", pose(7), "OK", True, steps=7)
    vector("eight steps", pose(8), "STEPS", True, steps=8)
    vector("255 steps", pose(255), "STEPS", True, steps=255)
    vector("play count 0", pose(1, b15=0), "OK", False, play_count=0)
    vector("schedule speed base", pose(1, b16=0), "OK", True, schedule=0)
    vector("schedule 1", pose(1, b16=1), "SCHEDULE", True, schedule=1)
    vector("schedule 0x0B", pose(1, b16=0x0B), "SCHEDULE", True, schedule=0x0B)
    vector("page speed 0", pose(1, b22=0), "SPEED", True, speed=0)
    vector("page speed 1", pose(1, b22=1), "OK", True, speed=1)
    for offset, name in ((25, "next_page"), (26, "exit_page"), (27, "linked1_page"), (29, "linked2_page")):
        vector(f"{name} 127", pose(1, **{f"b{offset}": 127}), "OK", True, **{name: 127})
        vector(f"{name} 128 counts as none", pose(1, **{f"b{offset}": 128}), "OK", True, **{name: 128})
    vector("linked codes may be anything", pose(1, b28=255, b30=200), "OK", True, linked1_code=255, linked2_code=200)
    vector("reserved bytes are kept", pose(1, b14=9, b17=1, b18=2, b19=3, b63=0x55), "OK", True)

    vector("position 1023", with_word(1023), "OK", True, None, [(0, 5, 1023, True)])
    vector("position 1024", with_word(1024), "POSITION", True, None, [(0, 5, 1024, True)])
    vector("torque off, in pages of the original", with_word(0x2000 | 337), "OK", True, None, [(0, 5, 0x2151, False)])
    vector("unused with bits under the flag", with_word(0x43FF), "OK", True, None, [(0, 5, 0x43FF, False)])
    vector("unused and torque off", with_word(0x6000), "OK", True, None, [(0, 5, 0x6000, False)])
    vector("top bit alone", with_word(0x8000), "POSITION", True, None, [(0, 5, 0x8000, True)])
    vector("top bit and unused", with_word(0xC000), "OK", True, None, [(0, 5, 0xC000, False)])
    vector("joint 30, step 6", with_word(1024, 6, 30, 7), "POSITION", True, None, [(6, 30, 1024, True)])
    vector("bad position in an unused step", with_word(1024, 1), "OK", True, None, [(1, 5, 1024, True)])

    # The first fault in the order of page_status_t is reported.
    page = pose(9, b16=3, b22=0, b25=200)
    vector("all faults, checksum first", page, "CHECKSUM", True, 0)
    vector("all faults, then steps", pose(9, b16=3, b22=0, b25=200), "STEPS", True)
    vector("schedule before speed and link", pose(1, b16=3, b22=0, b25=200), "SCHEDULE", True)
    vector("speed before link", pose(1, b22=0, b25=200), "SPEED", True)
    page = with_word(4095)
    page[25] = 200
    vector("a link that counts as none, and a bad position", page, "POSITION", True)

    # The sum does not detect exchanged bytes, so the fields must be checked as well.
    page = pose()
    page[15], page[16] = page[16], page[15]
    vector("exchanged bytes pass the sum", page, "SCHEDULE", True, play_count=0x0A, schedule=1)


def c_table():
    yield "/* Made by page_vectors.py. */"
    for number, vector in enumerate(VECTORS):
        data = ", ".join(f"0x{byte:02X}" for byte in bytes.fromhex(vector["hex"]))
        yield f"static const uint8_t page_{number}[512] = {{{data}}};"
        words = ", ".join(f"{{{w['step']}, {w['joint']}, {w['word']}, {int(w['used'])}}}" for w in vector["words"])
        yield f"static const word_vector_t words_{number}[] = {{{words or '{0, 0, 0, 0}'}}};"
    yield "static const page_vector_t page_vectors[] = {"
    for number, vector in enumerate(VECTORS):
        name = vector["name"].replace('"', "'")
        yield (f'    {{"{name}", page_{number}, {vector["fault_number"]}, {int(vector["playable"])}, words_{number}, {len(vector["words"])}}},')
    yield "};"


build()

if __name__ == "__main__":
    with open(sys.argv[1], "w", encoding="utf-8") as header:
        header.write("\n".join(c_table()) + "\n")
