# SPDX-License-Identifier: MIT
"""Makes .mtn files in their real-world forms, and the pages that they mean according to FILES.md (not to our reader)."""

from dataclasses import dataclass, field

BOM = b"\xef\xbb\xbf"


@dataclass
class Block:
    """One page of the text. steps: (26 positions, pause, time), pause and time in units of 8 ms."""

    name: str = ""
    next: int = 0
    exit: int = 0
    repeat: int = 1
    rate: str = "1.0"
    inertia: int = 32
    level: int = 5
    steps: list = field(default_factory=list)


def step(position=512, pause=0, time=50):
    return ([position] * 26 if isinstance(position, int) else list(position), pause, time)


def body(blocks, enable=range(1, 19), version="1.01", full=True):
    """The bytes before the checksum, as RoboPlus writes them. full: adds empty pages up to page 255."""
    lines = ["type=motion", f"version={version}", "enable=" + " ".join(str(int(j in enable)) for j in range(26))]
    if version == "1.01":
        lines.append("motor_type=" + " ".join("0" * 26))
    for block in list(blocks) + [Block()] * (255 - len(blocks) if full else 0):
        lines += [
            "page_begin",
            f"name={block.name}",
            "compliance=" + " ".join([str(block.level)] * 26),
            f"play_param={block.next} {block.exit} {block.repeat} {block.rate} {block.inertia}",
        ]
        lines += [f"step={' '.join(map(str, at))} {pause * 0.008:.3f} {time * 0.008:.3f}" for at, pause, time in block.steps]
        lines.append("page_end")
    return BOM + ("\n".join(lines) + "\n").encode()


def checksum(data):
    total = 0
    for byte in data:
        total = (total + byte) & 0xFFFF
    return bytes([(total >> 8) ^ 0xFF, (total & 0xFF) ^ 0xFF])


def made(blocks, **how):
    """A complete file, as RoboPlus writes it."""
    text = body(blocks, **how)
    return text + checksum(text)


def page_bytes(block, enable=range(1, 19)):
    """The page that a block means according to the specification's table, for up to seven steps."""
    page = bytearray(512)
    page[:14] = block.name.encode().ljust(14, b"\0")
    page[15], page[16], page[20], page[22] = block.repeat, 0x0A, len(block.steps), int(32 / float(block.rate))
    page[24], page[25], page[26] = block.inertia, block.next, block.exit
    page[32:58] = bytes([block.level * 17] * 26)
    page[63] = 0x55
    for k in range(7):
        for joint in range(26):
            word = 0x4200
            if k < len(block.steps):
                word = block.steps[k][0][joint] | (0 if joint in enable else 0x4000)
            at = 64 + 64 * k + 2 * joint
            page[at : at + 2] = bytes([word & 255, word >> 8])
        if k < len(block.steps):
            page[64 + 64 * k + 62], page[64 + 64 * k + 63] = block.steps[k][1:]
    page[31] = (0xFF - sum(page)) % 256
    return bytes(page)


# Accidents that happen to files: (words of the required remark, function from the file's bytes to the changed bytes). The changed file must
# be read like the original.


def _crlf(data):
    return data[:-2].replace(b"\n", b"\r\n") + data[-2:]


ACCIDENTS = {
    "nothing": ("", lambda data: data),
    "a line end behind the checksum": ("something blank added", lambda data: data + b"\n"),
    "a Windows line end behind the checksum": ("something blank added", lambda data: data + b"\r\n"),
    "several line ends behind the checksum": ("something blank added", lambda data: data + b"\n\n\n"),
    "the byte-order mark taken off": ("byte-order mark removed", lambda data: data[3:]),
    "the mark taken off, a line end added": ("byte-order mark removed, something blank added", lambda data: data[3:] + b"\n"),
    "CR LF": ("line ends now CR LF", _crlf),
    "CR LF, no mark, line end added": ("byte-order mark removed, line ends now CR LF, something blank added", lambda data: _crlf(data)[3:] + b"\r\n"),
    "written with CR LF": ("", lambda data: _crlf(data)[:-2] + checksum(_crlf(data)[:-2])),
    "written without the mark": ("", lambda data: data[3:-2] + checksum(data[3:-2])),
    "the mark added to a file that had none": ("byte-order mark added", lambda data: BOM + data[3:-2] + checksum(data[3:-2])),
    "the checksum saved as UTF-8": ("the checksum saved as text", lambda data: data[:-2] + data[-2:].decode("latin-1").encode()),
    "the line end between text and checksum gone": ("as it was written", lambda data: data[:-3] + checksum(data[:-3])),
    "no checksum": ("has no checksum", lambda data: data[:-2]),
    "no checksum, no last line end": ("has no checksum", lambda data: data[:-3]),
    "no checksum, CR LF, no mark": ("has no checksum", lambda data: _crlf(data)[3:-2]),
    "blank lines for a checksum": ("has no checksum", lambda data: data[:-2] + b"\n\n\n\n"),
    "edited by hand, the old checksum": ("edited by hand", lambda data: data[:-2].replace(b"name=hand", b"name=HAND") + data[-2:]),
    "a wrong checksum": ("edited by hand", lambda data: data[:-2] + bytes([data[-2] ^ 1, data[-1] ^ 0x10])),
    "half a checksum": ("edited by hand", lambda data: data[:-2] + b"\x81"),
    "the checksum became question marks": ("edited by hand", lambda data: data[:-2] + "\ufffd\ufffd".encode()),
}


def commas(data):
    """The file as written under a locale with decimal commas, with the checksum of the new text."""
    text = data[:-2].replace(b"version=1.", b"version=1,")
    lines = [line.replace(b".", b",") if line.startswith((b"step=", b"play_param=")) else line for line in text.split(b"\n")]
    text = b"\n".join(lines)
    return text + checksum(text)


def blocks_by_chance(chance, count=5, most_steps=7):
    """Random pages. The first is named "hand" for the accident that renames it."""
    out = []
    for number in range(count):
        steps = [
            step([chance.randrange(1024) for _ in range(26)], chance.randrange(256), chance.randrange(256))
            for _ in range(chance.randint(0, most_steps))
        ]
        out.append(
            Block(
                "hand" if not number else chance.choice(("", "wave", "a b", "Größe", "x" * 13, "näher")),
                chance.randrange(256),
                chance.randrange(256),
                chance.choice((0, 1, 1, 1, 2)),
                chance.choice(("1.0", "0.5", "1.6", "2.0", "0.2", "3.2")),
                chance.randrange(256),
                chance.randint(1, 7),
                steps,
            )
        )
    return out
