# SPDX-License-Identifier: MIT
"""A robot with Play at the end of a line in virtual time, after firmware/common/PROTOCOL.md: page 2 plays for a minute, page 1 leads to it after
a second, page 3 plays for two seconds, a stop takes a second, and so does a move. A test says what happens on the way.

`damaged`: words whose next answer loses a byte, as often as they are in the list. `ended`: word -> the exceptions that m512
gets, once something has begun, while it waits for the answers to that word, as Ctrl-C or a signal causes them. `says`: what the
robot prints for a person at the end of page 2 or 3, soon after its state is idle.
"""

from virtual_peer import VirtualPeer

from m512.crc16 import crc16

BEGIN, CR = 0x1E, 0x0D
STOP_SECONDS = MOVE_SECONDS = 1.0
SAYS_SECONDS = 0.15  # m512 has seen before that the state is idle
PAGE_SECONDS = {1: 1.0, 2: 60.0, 3: 2.0}


class PlayPeer(VirtualPeer):
    def __init__(self, damaged=(), says="", **ended):
        self.damaged, self.ended, self.mute = list(damaged), {word: list(errors) for word, errors in ended.items()}, set()
        self.began, self.says = False, says
        self.asked, self.line, self.error = [], None, None
        self.state, self.page, self.until, self.ended_at = "idle", 0, None, 0.0
        super().__init__()

    # The line

    def on_byte(self, byte):
        if byte == BEGIN:
            self.line = bytearray()
        elif byte == CR and self.line is not None:
            self.act()
        elif self.line is not None:
            self.line.append(byte)

    def on_silence(self, seconds):
        if self.until is not None and self.now() >= self.until:
            self.pass_on()
        if self.began and self.state == "idle" and self.says and self.now() >= self.ended_at + SAYS_SECONDS:
            self.send(b"\r" + self.says.replace("\n", "\r\n").encode() + b"\r\n] ")
            self.says = ""
        if self.line and seconds >= 0.25:
            self.act()

    def act(self):
        line, self.line = bytes(self.line), None
        text, _, digits = line.rpartition(b" ")
        word, *rest = text.decode().removeprefix("@").split()
        if b"%04X" % crc16(text + b" ") != digits:
            answer = "ERR 15 Bytes of this line were lost: nothing was done"
        else:
            self.asked.append(" ".join([word, *rest]))
            answer = getattr(self, f"do_{word}")(*rest)
        if word in self.mute:
            return
        data = f"\x1e@{word} {answer}\r\n".encode()
        if word in self.damaged:
            self.damaged.remove(word)
            data = data.replace(b"OK", b"K").replace(b"ERR", b"RR")
        self.send(data)
        if self.began and self.ended.get(word):
            self.error = self.ended[word].pop(0)

    def get(self, limit, seconds):
        if self.error:
            error, self.error = self.error, None
            raise error
        return super().get(limit, seconds)

    # The robot

    def pass_on(self):
        if (self.state, self.page) == ("playing", 1):
            self.page, self.until = 2, self.now() + PAGE_SECONDS[2]
        else:
            self.state, self.page, self.until, self.ended_at = "idle", 0, None, self.now()

    def do_ver(self):
        return "image=play board=cm5 version=1.0 pages=128 OK"

    def do_shape(self):
        return "rate=100 blend=0 amplitude=100 layer=0 aim=00000000 OK"

    def do_where(self):
        return f"state={self.state} page={self.page} step=1 repetition=1 code=0 dv=96 faulty=00000000 missed=0 {self.do_shape()}"

    def do_pose(self):
        return "1:500:1 2:500:0 OK"

    def do_play(self, page, code="0"):
        if self.state != "idle":
            return "ERR 4 Not while something plays"
        if page == "9":
            return "ERR 6 This page has no action"
        self.began, self.state, self.page, self.until = True, "playing", int(page), self.now() + PAGE_SECONDS[int(page)]
        return "OK"

    def do_rate(self, _):
        return "OK"

    def do_layer(self, page):
        return "ERR 6 This page has no action" if page == "9" else "OK"

    def do_aim(self, joint, *_):
        return "OK" if joint == "1" else "ERR 7 None of these servos can be moved"

    def do_move(self, *_):
        if self.state != "idle":
            return "ERR 4 Not while something plays"
        self.began, self.state, self.until = True, "approach", self.now() + MOVE_SECONDS
        return "OK"

    def do_stop(self):
        if self.state != "idle":
            self.page, self.until = 2, self.now() + STOP_SECONDS
        return "OK"

    def do_break(self):
        self.state, self.page, self.until = "idle", 0, None
        return "OK"

    def do_drive(self, *_):
        return "OK"
