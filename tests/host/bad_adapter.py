#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""An adapter between a program and a servo bus, as bad as one likes: bad_adapter.py BUS LINK [OPTION...]

BUS is the servos' side (cm5sim --bus-pty), LINK becomes the port that a program opens. Packets are delayed both ways, in order; they
are repeated, or lose or change a byte, by chance. What is sent has at most 1 ms of jitter, a frame of USB: a driver holds back what it
hears, not what it sends. (Otherwise the servo's answer and the next packet would meet on the line.) On SIGUSR1 the plug is pulled, on
SIGUSR2 it is put back. --log takes a line for each packet that the program sent, "> HEX", each piece that it is given, "< HEX", "pulled"
and "back", and "late" when this process or the servos' was held up, which no real adapter and no servo is.
"""

import argparse
import collections
import fcntl
import os
import random
import select
import signal
import struct
import time
import tty

EVERYBODY = 254
TCGETS2, TCSETS2 = 0x802C542A, 0x402C542B
TERMIOS2 = "4I20B2I"  # flags, line and characters, the rates
CBAUD, BOTHER = 0x100F, 0x1000


def rate_of(port):
    return struct.unpack(TERMIOS2, fcntl.ioctl(port, TCGETS2, bytes(44)))[-1]


def set_rate(port, rate):
    fields = list(struct.unpack(TERMIOS2, fcntl.ioctl(port, TCGETS2, bytes(44))))
    if fields[-1] != rate:
        fields[2], fields[-2], fields[-1] = fields[2] & ~CBAUD | BOTHER, rate, rate
        fcntl.ioctl(port, TCSETS2, struct.pack(TERMIOS2, *fields))


LATE_S = 0.01  # servos answer within 1 ms
ANSWER_S = 0.02  # longest wait of a packet for the answer to the one before, in case this process or the servos' is held up


class Way:
    """One direction: packets wait here until they are due."""

    def __init__(self, asked, chance, jitter):
        self.asked, self.chance, self.jitter = asked, chance, jitter
        self.waiting, self.last = collections.deque(), 0.0
        self.free = 0.0

    def put(self, data, rate=0):
        if self.chance.random() < self.asked.drop:
            at = self.chance.randrange(len(data))
            data = data[:at] + data[at + 1 :]
        if data and self.chance.random() < self.asked.flip:
            at = self.chance.randrange(len(data))
            data = data[:at] + bytes([data[at] ^ 1 << self.chance.randrange(8)]) + data[at + 1 :]
        delay = self.asked.latency + self.chance.uniform(-self.jitter, self.jitter)
        self.last = max(self.last, time.monotonic() + max(0, delay) / 1000)
        self.waiting.append((self.last, data, rate))

    def due(self):
        """Yields (bytes, rate) of each packet that is due."""
        while self.waiting and self.next() <= time.monotonic():
            yield self.waiting.popleft()[1:]

    def next(self):
        """Time at which the first packet may leave."""
        return max(self.waiting[0][0], self.free)


def packets(data):
    """The complete packets in `data`, and the rest of it."""
    found = []
    while len(data) >= 4:
        size = data[3] + 4
        if data[:2] != b"\xff\xff":
            data = data[1:]
        elif len(data) < size:
            break
        else:
            found.append(data[:size])
            data = data[size:]
    return found, data


class Adapter:
    def __init__(self, asked):
        self.asked = asked
        self.bus = os.open(asked.bus, os.O_RDWR | os.O_NOCTTY)
        tty.setraw(self.bus)
        chance = random.Random(asked.seed)
        self.out, self.back = Way(asked, chance, min(asked.jitter, 1)), Way(asked, chance, asked.jitter)
        self.log = open(asked.log, "a", encoding="ascii", buffering=1) if asked.log else None  # noqa: SIM115 (until the end)
        self.master, self.begun, self.heard, self.wanted = -1, b"", b"", True
        self.asked_at = {}  # servo: when the oldest unanswered packet was passed on
        signal.signal(signal.SIGUSR1, lambda *_: self.want(False))
        signal.signal(signal.SIGUSR2, lambda *_: self.want(True))

    def want(self, there):
        self.wanted = there

    def say(self, line):
        if self.log:
            self.log.write(line + "\n")

    def plug(self):
        self.master, slave = os.openpty()
        tty.setraw(slave)
        temporary = self.asked.link + ".new"
        os.symlink(os.ttyname(slave), temporary)
        os.chmod(os.ttyname(slave), 0o666)
        os.rename(temporary, self.asked.link)
        os.close(slave)
        self.say("back")

    def pull(self):
        os.unlink(self.asked.link)
        os.close(self.master)
        self.master = -1
        self.out.waiting.clear()
        self.back.waiting.clear()
        self.say("pulled")

    def from_program(self):
        try:
            data = os.read(self.master, 4096)
        except OSError:  # no program has it open
            time.sleep(0.005)
            return
        found, self.begun = packets(self.begun + data)
        for packet in found:
            self.say("> " + packet.hex())
            self.out.put(packet, rate_of(self.master))
            if self.asked.echo:
                self.back.put(packet)

    def turn(self):
        if self.wanted != (self.master >= 0):
            (self.plug if self.wanted else self.pull)()
        now = time.monotonic()
        wait = max(0, min([way.next() - now for way in (self.out, self.back) if way.waiting] + [0.05]))
        ready, _, _ = select.select([self.bus] + [self.master] * (self.master >= 0), [], [], wait)
        if time.monotonic() - now > wait + LATE_S:
            self.say("late")
        if self.bus in ready:
            data = os.read(self.bus, 4096)
            self.back.put(data)
            found, self.heard = packets(self.heard + data)
            if any(time.monotonic() - self.asked_at.pop(packet[2], now) > LATE_S for packet in found):
                self.say("late")
            if found:  # only after a complete answer: the next packet would collide with the rest of it
                self.out.free = 0.0
        if self.master in ready:
            self.from_program()
        for data, rate in self.out.due():
            set_rate(self.bus, rate)
            os.write(self.bus, data)
            self.asked_at.setdefault(data[2], time.monotonic())
            self.out.free = time.monotonic() + ANSWER_S * (data[2] != EVERYBODY)
            self.heard = b""
        for data, _ in self.back.due() if self.master >= 0 else ():
            self.say("< " + data.hex())
            os.write(self.master, data)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("bus")
    parser.add_argument("link")
    parser.add_argument("--latency", type=float, default=0, metavar="MS", help="each way")
    parser.add_argument("--jitter", type=float, default=0, metavar="MS", help="more or less, by chance")
    parser.add_argument("--echo", action="store_true", help="repeats what it is sent")
    parser.add_argument("--drop", type=float, default=0, metavar="SHARE", help="of the packets lose a byte")
    parser.add_argument("--flip", type=float, default=0, metavar="SHARE", help="of the packets have a false bit")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--log")
    adapter = Adapter(parser.parse_args())
    while True:
        adapter.turn()


if __name__ == "__main__":
    main()
