# SPDX-License-Identifier: MIT
"""The PC's side of the line commands of Play and Edit (firmware/common/PROTOCOL.md).

A request is a byte BEGIN, the line and a CRC. An answer is a byte BEGIN and the line. Other text on the line, such as what a person
types and its echo, is skipped here.
"""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from contextlib import suppress

from m512.board.link import Link
from m512.crc16 import crc16
from m512.errors import EXIT_BAD_FILE, BoardError, M512Error, NoAnswerError
from m512.files import selection
from m512.files.image import is_erased
from m512.files.page import EMPTY, JOINTS, PAGE_BYTES, STEP_BYTES, STEPS, Page
from m512.files.wording import named_pages_text

ANSWER_SECONDS = 3.0
TRIES = 3
NAMES_MOST = 16  # damaged pages whose names are read; each takes 0.2 s
DATA_BYTES = 32
PIECES = range(0, PAGE_BYTES, DATA_BYTES)
FIRST_OPEN = 1  # the page that Edit opens when it starts
RESTART_SECONDS = 0.2  # less than a board is silent when it restarts
ERR_WORD, ERR_EMPTY, ERR_CRC, ERR_EDITS, ERR_LINE, ERR_ASKED = 1, 6, 9, 12, 15, 16
# Fields of @where: the pattern of each, and its value when it is missing ("": it is mandatory).
WHERE = {
    **{word: ("[0-9]+", "") for word in ("page", "repetition")},
    **{word: ("[0-9]+", "0") for word in ("step", "code", "dv", "missed", "layer")},
    **{word: ("[0-9A-Fa-f]+", "0") for word in ("faulty", "aim")},
}
# What Play prints for a person (firmware/common/report_event.c): the end of a motion, and why it is not the one that was asked for.
END = re.compile(r"(Ended|Stopped|Broken off)\b.*|The pose is reached")
AS_ASKED = re.compile(r"(Ended|Stopped) after .*|The pose is reached")
BROKEN_OFF = re.compile(
    r"Ended for the fault .*|Ended\. Page \d+ is damaged.*|The computer came .* late.*|The servo adapter is gone.*|Nobody drives .*"
)
RESTARTED = re.compile(r"Motion512 Play .*, last reset: (.*)|.*HELP explains, EXIT leaves.*")  # what Play and Edit begin with
CAUSE = re.compile(r"Servo \d+ (does not|reports (?!no error)|has lost).*")
GREETING_TRIES = 50  # 5 s: Edit draws its screen first
SAID_BYTES = 4096  # more than the sentences of one end
LISTED = r' (\d+):(\d+|!):"([^"]*)"'  # an entry of @list
DAMAGED = "{} came damaged, " + f"{TRIES} times. Is the cable good?"
CHECK = "Check the cable, then "
BEGIN, FLOW = b"\x1e", b"\x11\x13"
NOBODY = "neither Play nor Edit answers"
OLDER = (
    "what runs there shows what is typed, but knows no requests of this m512: an older Play or Edit, or another program. Write a new one: "
    "m512 flash play-cm5.hex (or edit-cm5.hex)"
)


def framed(request: str) -> bytes:
    """A request without the final CR."""
    text = f"@{request} ".encode()
    return BEGIN + text + b"%04X" % crc16(text)


def _with_piece(page: bytes, other: bytes, at: int) -> bytes:
    return page[:at] + other[at : at + DATA_BYTES] + page[at + DATA_BYTES :]


class Client:
    """Play or Edit on a line. Raises NoAnswerError when @ver gets no answer. patience: seconds to wait for the answer to each @ver.
    slack: extra seconds for every later answer, on a line that may run slower than real time."""

    def __init__(self, link: Link, patience: Sequence[float] = (0.9, 1.5), slack: float = 0.0):
        self.link = link
        self.heard = b""  # bytes received when no answer came
        self.said = b""  # the last that was printed for a person since a motion began
        self.version: dict[str, str] = {}
        self._listed: dict[int, tuple[int | None, str]] | None = None  # the answer of listed()
        self._has_trim: bool | None = None  # in a page 0 without steps and name
        self._damaged: dict[int, str] = {}  # names of damaged pages, as far as they have been read
        self.slack = 0.0
        for _ in range(TRIES):
            self.version = self._fields(self._ask_version(patience))
            if self.version.get("image", "").isalpha() and self.version.get("pages", "128") in ("128", "256"):
                break
        else:
            raise NoAnswerError(DAMAGED.format("its name"))
        self.slack = slack

    def _ask_version(self, patience: Sequence[float]) -> str:
        """Sends @ver without CR: Play and Edit execute it after 250 ms. A boot loader has no line to execute then, whatever was typed
        before, and the knock (factory_line.KNOCK) erases it."""
        for seconds in patience:
            try:
                return self.ask("ver", seconds, tries=1, end=b"")
            except NoAnswerError:
                pass
        shown = re.sub(rb"\x1b\[[0-9;?]*[A-Za-z]", b"", self.heard)
        raise NoAnswerError(OLDER if framed("ver")[1:] in shown else NOBODY)

    @staticmethod
    def _fields(text: str) -> dict[str, str]:
        return dict(part.split("=", 1) for part in text.split() if "=" in part)

    def ask(self, request: str, seconds: float = ANSWER_SECONDS, tries: int = TRIES, end: bytes = b"\r") -> str:
        """Sends a request. Returns the answer's text between the word and OK. BoardError: the board answered ERR."""
        word = "@" + request.split()[0]
        for _ in range(tries):
            self.link.write(framed(request) + end)
            line = self._answer(word, seconds + self.slack)
            if line is None:
                continue
            if line == "OK" or line.endswith(" OK"):
                return line[:-2].strip()
            match = re.match(r"ERR (\d+) ?(.*)", line)
            if match:
                if int(match.group(1)) == ERR_LINE:  # the board did not execute it
                    continue
                raise self._error(request, int(match.group(1)), match.group(2))
        raise NoAnswerError(f"no answer to {word}. {CHECK}{self.link.remedy}")

    def _error(self, request: str, number: int, text: str) -> BoardError:
        word, *rest = f"@{request}".split()
        if number == ERR_WORD:
            image = self.version.get("image", "this image")
            other = {"edit": "Play", "play": "Edit"}.get(image)
            text = f"{image.capitalize()} does not know {word}" + (f", {other} does" if other else "")
            if other and self.version.get("board") != "pc":  # the programs for an adapter cannot be flashed
                text += f": m512 run {self.file_of(other)}"
        if number == ERR_EDITS:
            text += ". In Edit, SAVE keeps them; PAGE and a number opens another page and asks whether to discard them"
        if self.version.get("board") == "pc":  # each command starts the program anew, and that searches
            text = text.replace("then search again", f"then {self.link.remedy}")
        error = BoardError(text or f"error {number}", number)
        if number == ERR_EMPTY and rest:
            error = BoardError(f"page {rest[0]} has no action: there is nothing to play", number)
            error.exit_code = EXIT_BAD_FILE  # that of an EmptyPageError for a page of a file
        return error

    def _answer(self, word: str, seconds: float) -> str | None:
        """Returns the text after the word in the first complete line that answers. A refusal of a damaged line (ERR_LINE) counts under
        any word. None: no such line within the time."""
        deadline = self.link.now() + seconds
        while True:
            left = deadline - self.link.now()
            if left <= 0:
                return None
            raw, ended = self.link.look_for(b"\n", left)
            if not ended:
                self.heard += raw
                self.said = (self.said + raw.translate(None, FLOW))[-SAID_BYTES:]
                return None
            before, framed_here, answer = raw.translate(None, FLOW).rpartition(BEGIN)
            self.said = (self.said + (before if framed_here else answer))[-SAID_BYTES:]
            said, _, text = answer.decode("ascii", "replace").strip().partition(" ")
            if framed_here and (said == word or text.startswith(f"ERR {ERR_LINE} ")) and re.search(r"(^| )(OK|ERR \d+ .*)$", text):
                return text

    # Pages

    def list_pages(self) -> dict[int, tuple[int | None, str]]:
        """page -> (steps, name), or (None, the fault). The answer has no checksum, and a missing page would be overwritten or not saved.
        So two identical answers in a row are required."""
        before = None
        for _ in range(2 * TRIES):
            text = " " + self.ask("list", 6.0)
            if text == before and re.fullmatch(f"({LISTED})* ?", text):
                return {int(number): (None if steps == "!" else int(steps), name) for number, steps, name in re.findall(LISTED, text)}
            before = text
        raise NoAnswerError(DAMAGED.format("the list of its pages"))

    def find(self, word: str) -> int:
        """The page number for a number or a name."""
        number = selection.page_number(word)
        if number is not None:
            if number < self.pages:
                return number
            raise BoardError(f"the board has no page {number}, only 0..{self.pages - 1}; it has {self._what_it_has()}")
        names = self._names()
        if word.lower() not in map(str.lower, names.values()):
            names.update(self._damaged_names())
        return selection.find(word, names, lambda text: BoardError(f"{text}; it has {self._what_it_has()}"), " of the board")

    def motion(self, word: str) -> int:
        """The number of a playable page, by number or name."""
        number = self.find(word)
        if not 0 < number < self.pages:
            raise BoardError(f"page {number} is no motion: those are pages 1..{self.pages - 1}; the board has {self._what_it_has()}")
        return number

    def _what_it_has(self) -> str:
        damaged = {number: self._damaged.get(number, "") for number in self._damaged_pages()}
        text = ", ".join(f"{n} {name}" for n, name in self._names().items()) or "none"
        if damaged:
            text += f"; damaged: {named_pages_text(damaged)}"
        return text + (", whose names are not all known" if len(damaged) > NAMES_MOST else "")

    def is_named(self, word: str) -> bool:
        return word in self._names().values()

    def used(self) -> list[int]:
        """Pages that hold something, including damaged ones, and page 0 if it holds a trim, which the board's list does not tell."""
        listed = self.listed()
        if self._has_trim is None:
            self._has_trim = 0 not in listed and any(self.page(0).trims())
        return sorted({*listed, 0} if self._has_trim else listed)

    def _names(self) -> dict[int, str]:
        return {number: name for number, (steps, name) in self.listed().items() if steps is not None and name}

    def _damaged_pages(self) -> list[int]:
        return sorted(number for number, (steps, _) in self.listed().items() if steps is None)

    def _damaged_names(self) -> dict[int, str]:
        """The names of the first NAMES_MOST damaged pages. @list gives what is wrong with such a page in place of its name."""
        for number in self._damaged_pages()[:NAMES_MOST]:
            if number not in self._damaged:
                with suppress(BoardError):
                    self._damaged[number] = self.page(number).title
        return {number: name for number, name in self._damaged.items() if name}

    def listed(self) -> dict[int, tuple[int | None, str]]:
        """list_pages(), asked once, and again after save_page()."""
        if self._listed is None:
            self._listed = self.list_pages()
        return self._listed

    def page(self, number: int) -> Page:
        for _ in range(TRIES):
            parts = self.ask(f"page {number}").split()
            try:
                data = bytes.fromhex(parts[1])
                if len(data) == PAGE_BYTES and crc16(data) == int(parts[2], 16) and int(parts[0]) == number:
                    return Page(data)
            except (ValueError, IndexError):
                pass
        raise NoAnswerError(DAMAGED.format(f"page {number}"))

    @property
    def pages(self) -> int:
        """Number of pages on the board: 0..pages - 1."""
        return int(self.version.get("pages", "128"))

    def file_of(self, image: str) -> str:
        """The name of the firmware file for this board."""
        return f"{image.lower()}-{self.version.get('board', 'CM5').lower()}.hex"

    @property
    def can_save(self) -> bool:
        return "save" in self.version.get("can", "").split(",")

    def has_edits(self) -> bool:
        """Whether Edit's page in RAM has unsaved edits. Sends @open 0, which Edit refuses in that case; otherwise page 0 is in RAM
        afterwards."""
        if not self.can_save:
            return False
        try:
            self.ask("open 0")
        except BoardError as error:
            return error.number in (ERR_EDITS, ERR_ASKED)
        return False

    def save_page(self, number: int, page: Page) -> None:
        """Saves a page in the board's flash, by way of the board's page in RAM. After Ctrl-C or a signal it saves that page before it ends: a
        part of it would stay in RAM, as edits that nobody made."""
        self._listed, self._has_trim, self._damaged = None, None, {}
        try:
            self._save_page(number, page)
        except (KeyboardInterrupt, SystemExit):
            with suppress(M512Error):
                self._save_page(number, page)
            raise
        finally:
            if number == 0:  # while Edit has it open, positions are without trim, also those of the next command
                with suppress(M512Error):
                    self.ask(f"open {FIRST_OPEN}")

    def _save_page(self, number: int, page: Page) -> None:
        """If the board restarts meanwhile, the page is opened and sent once more."""
        new = bytes(page)
        for _ in range(TRIES):
            self.open_page(number, page)
            old = self._loaded(number)
            if not self._fill_ram(old, new, PIECES):
                continue
            try:
                self.ask(f"save {number} {crc16(new):04X}", 10.0)
                self.open_page(number, page)  # refused if a page that looked the same was open since a restart: that has edits now
                return
            except BoardError as error:
                if error.number != ERR_CRC:  # RAM as flash again, or the page that cannot be saved would stay as edits that nobody made
                    with suppress(BoardError):
                        self.open_page(number, page)
                    raise
            if bytes(self.page(number)) == new:  # saved before the restart
                return
        raise BoardError(f"the board has restarted {TRIES} times while the page was sent. Check its power supply, then {self.link.remedy}")

    def open_page(self, number: int, page: Page) -> None:
        """Opens a page that is to become `page`. BoardError: the page in RAM has edits, unless they are a part of `page` that m512 sent before
        the cable came off or the board restarted."""
        try:
            self.ask(f"open {number}")
        except BoardError as error:
            if error.number != ERR_EDITS or not self._put_back(number, bytes(page)):
                raise

    def _put_back(self, number: int, new: bytes) -> bool:
        """Gives RAM the bytes of flash back if all of its edits are pieces of `new`, and opens page `number`. They are the first pieces over
        that page; or, over the page that Edit opens when it starts, one piece that was on its way when the board restarted, or all. The CRC
        of RAM tells which, and Edit whether that was right: it opens no other page while there are edits."""
        for base in (number, FIRST_OPEN):
            old = self._loaded(base)
            sent = [new[: at + DATA_BYTES] + old[at + DATA_BYTES :] if base == number else _with_piece(old, new, at) for at in PIECES] + [new]
            crc = self.ask("crc")
            ram = next((part for part in sent if crc == f"{crc16(part):04X}"), None)
            # From the last piece to the first: what an interruption leaves is known, too.
            if ram is not None and self._fill_ram(ram, old, PIECES[::-1]):
                with suppress(BoardError):
                    self.ask(f"open {number}")
                    return True
        return False

    def _fill_ram(self, ram: bytes, wanted: bytes, pieces: Sequence[int]) -> bool:
        """Turns the page in RAM, which is `ram`, into `wanted`. False: it is another page now, because the board has restarted."""
        sure = -math.inf  # when a request was sent, since whose answer the board has had no time to restart
        for at in pieces:
            before, ram = ram, _with_piece(ram, wanted, at)
            if ram == before:
                continue
            for _ in range(TRIES):
                if self.link.now() - sure > RESTART_SECONDS:
                    crc = self.ask("crc")
                    if crc == f"{crc16(ram):04X}":
                        break
                    if crc != f"{crc16(before):04X}":
                        return False
                sure = self.link.now()
                try:
                    self.ask(f"data {at} {ram[at : at + DATA_BYTES].hex()}", tries=1)
                    break
                except NoAnswerError:  # never repeated unseen: a restarted Edit would write it into the page that it has opened
                    sure = -math.inf
            else:
                raise NoAnswerError(f"no answer to @data. {CHECK}{self.link.remedy}")
        return True

    def _loaded(self, number: int) -> bytes:
        """What @open loads. Erased flash is read as Edit's new page (session_new_byte in firmware/edit/session.c), which is not EMPTY."""
        page = self.page(number)
        if not is_erased(page):
            return bytes(page)
        data = bytearray(EMPTY)
        data[16], data[31], data[63] = 0, 0, 0x55
        data[STEP_BYTES + 63 :: STEP_BYTES] = [64] * STEPS
        return bytes(data)

    # Robot

    def pose(self) -> dict[int, tuple[int | None, bool]]:
        """id -> (position, or None when the servo is silent; torque)."""
        out = {}
        for joint, position, torque in re.findall(r"(\d+):(\d+|\?):([01])", self.ask("pose")):
            out[int(joint)] = (None if position == "?" else int(position), torque == "1")
        return out

    def move(self, positions: dict[int, int], degrees_per_second: int) -> None:
        first, last = min(positions), max(positions)
        digits = "".join(f"{positions[j]:03X}" if j in positions else "---" for j in range(first, last + 1))
        self._start(f"move {degrees_per_second} {first} {digits}")

    def torque(self, on: bool, joints: list[int]) -> None:
        self.ask(" ".join(["torque", "on" if on else "off"] + [str(j) for j in joints]))

    def where(self, seconds: float = ANSWER_SECONDS, tries: int = TRIES) -> dict[str, str]:
        """The state of the robot. Answers have no checksum, so the request is repeated when a field is missing or malformed."""
        for _ in range(TRIES):
            found = self._fields(self.ask("where", seconds, tries))
            if found.get("state", "").isalpha() and all(re.fullmatch(form, found.get(word, absent)) for word, (form, absent) in WHERE.items()):
                return found
        raise NoAnswerError(DAMAGED.format("what the robot does"))

    def why_broken_off(self) -> str:
        """Why the motion that this Client has begun, and that has ended, did not come to its end. Empty: it did, or somebody has stopped it."""
        may_be_restarted = b"\xff" in self.said  # a controller begins with it; so may noise
        for _ in range(GREETING_TRIES if may_be_restarted else TRIES):
            if restart := next(filter(None, map(RESTARTED.fullmatch, self._said_lines())), None):
                return "the board has restarted" + (f" ({restart[1]})" if restart[1] else "")
            faulty = int(self.where().get("faulty", "0"), 16)
            if self._has_said(END) or self.version["image"] != "play" and not may_be_restarted:
                break
            self.link.sleep(0.1)  # Play prints the end soon after its state is idle; Edit does not print that of a program's motion
        if not self._has_said(BROKEN_OFF) and (self._has_said(AS_ASKED) or not faulty):
            return ""
        why = [line for line in self._said_lines() if BROKEN_OFF.fullmatch(line) or CAUSE.fullmatch(line)]
        if faulty:
            why.append(f"fault of servo {' '.join(str(joint) for joint in range(JOINTS) if faulty >> joint & 1)} (m512 doctor)")
        return "; ".join(why)

    def _said_lines(self) -> list[str]:
        return re.split("[\r\n]+", self.said.decode("ascii", "replace"))

    def _has_said(self, sentence: re.Pattern[str]) -> bool:
        return any(sentence.fullmatch(line) for line in self._said_lines())

    def shape(self) -> dict[str, str]:
        """What shapes the motion, as shape_in_words() says it."""
        return shape_in_words(self._fields(self.ask("shape")))

    def play(self, page: int, code: int = 0) -> None:
        self._start(f"play {page}" + (f" {code}" if code else ""))

    def _start(self, request: str) -> None:
        """Sends a request that begins a movement. While something moves a board refuses it. So when its answer is lost it is not simply
        repeated: a robot that stood still before, and moves now or has said how a motion ended, has taken it."""
        stood = self.where()["state"] == "idle"
        self.said = b""
        for _ in range(TRIES):
            try:
                self.ask(request, tries=1)
                return
            except NoAnswerError:
                if stood and (self.where()["state"] != "idle" or self._has_said(END)):
                    return
        raise NoAnswerError(f"no answer to @{request.split()[0]}. {CHECK}{self.link.remedy}")


def shape_in_words(found: dict[str, str]) -> dict[str, str]:
    """The fields of @where or @shape with rate, blend, amplitude ("60", or "60 3,4:120" if joints differ), layer (the second page, 0:
    none), aim ("3,4", the joints controlled by code, or "none")."""
    found = dict(found)
    if len(found.get("amplitude", "")) == 2 * JOINTS:
        found["amplitude"] = _by_joints(bytes.fromhex(found["amplitude"]))
    if "aim" in found:
        joints = int(found["aim"], 16)
        found["aim"] = ",".join(str(joint) for joint in range(JOINTS) if joints >> joint & 1) or "none"
    return found


def _by_joints(values: bytes) -> str:
    """The most frequent value, then the other values with their joints."""
    most = max(set(values), key=values.count)
    others = [f"{','.join(str(joint) for joint, at in enumerate(values) if at == value)}:{value}" for value in sorted(set(values) - {most})]
    return " ".join([str(most), *others])
