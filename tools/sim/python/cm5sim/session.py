# SPDX-License-Identifier: MIT
"""One run of cm5sim: the board, everything connected to it, and the actions of a user or a script."""

from __future__ import annotations

import sys
import time
from contextlib import ExitStack
from typing import TYPE_CHECKING, Any

from . import script as scripts
from . import terminal
from .board import CYCLES_PER_TICK, Board, Violation
from .console import LINE_BPS, Console
from .files import keep, load_memories, memories, plug_in_servos
from .flow import Flow
from .library import CYCLES_PER_MS
from .options import EXIT_EXPECTATION, EXIT_FILE, EXIT_GOOD, EXIT_VIOLATION, NEVER, Options
from .servo import Servo
from .terminal import Keys, Terminal
from .trace import Trace

if TYPE_CHECKING:
    from .in_body import Watch

SLICE_CYCLES = 2 * CYCLES_PER_MS  # in real time, keys are polled this often
LINGER_CYCLES = 1000 * CYCLES_PER_MS  # after the end of piped input, this much silence ends the run
SILENT_CYCLES = 300 * CYCLES_PER_MS  # after this much silence the robot has drawn its screen
NOTE_CYCLES = 1500 * CYCLES_PER_MS
HELD_CYCLES = 600 * CYCLES_PER_MS  # longer than a keyboard's first repeat delay
RC_REPEAT_CYCLES = 100 * CYCLES_PER_MS  # a held remote repeats its packet
CYCLES_PER_S = 1000 * CYCLES_PER_MS
LATE_S = 0.25  # this far behind, the real-time clock starts anew
RECORD_AT, BOARDS = 0x8C, {1: "cm5", 2: "cm2"}  # firmware/common/app_record.h
NO_PANEL = "a CM-2 has no panel"
POWER_IS_OFF = "the power is off: Ctrl-T p switches it on"
HAND_HELP = """\
A hand at the robot. One line, then Enter; Enter alone goes back.

  push 3 600      turns the horn of servo 3 to position 600 and holds it there
  let go          lets go of all (let go 3: of one)
  battery 7.0     volts
  servo 5 silent  a fault, until `servo 5 clear`
and every other action that a script may have.

"""


class Session:
    """Usage: open(); run() unless open() failed; close(); then exit_code."""

    def __init__(self, options: Options, script: scripts.Script | None, watch: Watch | None = None) -> None:
        self.options, self.script, self.watch = options, script, watch
        self.done, self.exit_code = False, EXIT_GOOD
        self.interrupted = False  # set by a signal
        self.board = Board(options.board, seed=options.seed, keep_packets=False)
        self.heard = bytearray()  # robot's output, for a script
        self.heard_from = 0  # end of the last match
        self._traffic = 0  # cycle of the newest byte in either direction
        self._port_rate = 0
        self._buttons: dict[str, int] = {}  # held buttons: cycle of release
        self._rc_keys: dict[int, int] = {}  # held keys of the remote by bit: cycle of release
        self._rc_word = self._rc_next = 0  # last word sent; cycle of the next repetition while held
        self._explained = False
        self._flow = Flow(self.send)
        self._trace: Trace | None = None
        self._closing = ExitStack()
        self._line_end = "\n"  # of messages

    def open(self) -> None:
        """OSError: a file or port cannot be used."""
        options, board = self.options, self.board
        board.allow(*options.allow)
        load_memories(board, options, self.say)
        self._tell_wrong_board()
        plug_in_servos(board.servos, options)
        if self.watch:
            self.watch.attach(board, self.complain)
        self.console = Console(options, self._typed, self._sent)
        self._closing.callback(self.console.close)
        if options.trace or options.plot:
            self._trace = Trace(board.servos, options.trace, options.plot)
        if options.pty is not None and self.console.port:
            self.complain(f"serial port: {self.console.port.path}")
        if options.tcp is not None:
            self.complain(f"serial port: tcp 127.0.0.1:{self.console.tcp_port}")
        self.terminal = Terminal(self.console, raw=self.console.reads_stdin)
        self._closing.callback(self.terminal.close)
        self.keys = Keys(options.rc)
        if self.terminal.raw:
            self._line_end = "\r\n"
            keyboard = "; keyboard: RC-100" if options.rc else ""
            self.say(f"{options.board[:2].upper()}-{options.board[2]} with {len(board.servos)} servos. "
                     f"Ctrl-] leaves, Ctrl-T ? shows the keys{keyboard}.")  # fmt: skip
        board.power_on()
        if options.gdb is not None:  # the chip is on, so that the debugger finds it at its first instruction
            self.say(f"waiting for avr-gdb: target remote :{options.gdb}")
            board.gdb(options.gdb)

    def _tell_wrong_board(self) -> None:
        """An image for the other board finds no servos: its pins are others. Our images say for which board they are (app_record.h)."""
        record = bytes(self.board.flash[RECORD_AT : RECORD_AT + 16])
        if record.startswith(b"M512") and record[10] in BOARDS and BOARDS[record[10]] != self.options.board:
            self.complain(f"this image is for the other board: --board {BOARDS[record[10]]}")

    def interrupt(self) -> None:
        """Ends the run soon. May be called from another thread."""
        self.interrupted = True
        self.board.stop()

    # Messages

    def complain(self, text: str) -> None:
        """Prints a message on standard error."""
        print(f"cm5sim: {text}", file=sys.stderr, end=self._line_end, flush=True)

    def say(self, text: str) -> None:
        if not self.options.quiet:
            self.complain(text)

    def note(self, text: str) -> None:
        """Shows a message for a moment over the robot's screen, if there is one."""
        if self.terminal.draws:
            self.terminal.show("note", text)
            self.terminal.until = self.board.now_cycles + NOTE_CYCLES
        else:
            self.say(text)

    def page(self, kind: str, text: str) -> None:
        """Shows text over the robot's screen, or on standard error."""
        if self.terminal.draws:
            self.terminal.show(kind, text)
        else:
            print(text, file=sys.stderr, end="", flush=True)

    def end(self, exit_code: int) -> None:
        """Ends the run. The first exit code that is not 0 is kept."""
        self.done = True
        self.exit_code = self.exit_code or exit_code

    # What a user or a script does

    def servo(self, number: int) -> Servo:
        if number not in self.board.servos:
            raise scripts.Failed(f"there is no servo {number}; --servos says which there are")
        return self.board.servos[number]

    def send(self, data: bytes) -> None:
        if data:
            self.board.send(data)
            self._traffic = self.board.now_cycles

    def _lacks(self, button: str) -> bool:
        return self.options.board == "cm2" and button != "MODE"

    def press(self, button: str, cycles: int) -> None:
        """Holds a button for this time. MODE holds the chip in reset. A CM-2 has no other."""
        if self._lacks(button):
            raise scripts.Failed(NO_PANEL)
        self._buttons[button] = self.board.now_cycles + cycles
        self.board.press(button)

    def release(self, button: str) -> None:
        self._buttons.pop(button, None)
        self.board.release(button)

    def _rc_send(self, word: int) -> None:
        self.board.rc(word)
        self._rc_word = word
        self._traffic = self.board.now_cycles
        self._rc_next = self._traffic + RC_REPEAT_CYCLES

    def rc_once(self, word: int) -> None:
        """Sends one packet, without holding, repetition or release."""
        self.board.rc(word)
        self._traffic = self.board.now_cycles

    def rc_hold(self, keys: int, cycles: int) -> None:
        """Holds keys of the remote for a while. Further keys join the chord."""
        for bit in range(10):
            if keys >> bit & 1:
                self._rc_keys[1 << bit] = self.board.now_cycles + cycles
        if sum(self._rc_keys) != self._rc_word:
            self._rc_send(sum(self._rc_keys))

    def power(self, on: bool) -> None:
        if on:
            self.board.power_on()
        else:
            self.board.power_off()

    def _hands(self) -> int:
        """Releases what was held long enough and repeats the remote's packets. Returns the cycle at which it must run next."""
        if not (self._buttons or self._rc_keys or self._rc_next):
            return NEVER
        now = self.board.now_cycles
        for button in [button for button, until in self._buttons.items() if until <= now]:
            self.release(button)
        self._rc_keys = {key: until for key, until in self._rc_keys.items() if until > now}
        held = sum(self._rc_keys)
        if held != self._rc_word or (held and now >= self._rc_next):
            self._rc_send(held)
        if not held:
            self._rc_next = 0
        return min([*self._buttons.values(), *self._rc_keys.values(), *([self._rc_next] if held else [])], default=NEVER)

    def find(self, text: bytes) -> bool:
        """Searches for text after the last match. On success, the next search begins after it."""
        at = self.heard.find(text, self.heard_from)
        if at >= 0:
            self.heard_from = at + len(text)
        return at >= 0

    # Input

    def _sent(self, data: bytes) -> None:
        self._follow_rate()
        self.send(data)

    def _typed(self, data: bytes) -> None:
        if not self.terminal.raw and not self.keys.rc:
            self._flow.type(data)
        else:
            for byte in data:
                self._take_key(byte)
        self._feed()

    def _feed(self) -> None:
        self._flow.feed(self.board.waiting, self.board.now_cycles, self.board.resets)

    def _take_key(self, byte: int) -> None:
        shown = self.terminal.shows
        if shown == "line" and byte != terminal.LEAVE:
            line = self.terminal.type(byte)
            if line is not None:
                error = scripts.act_at_once(self, line)
                if error:
                    self.page("line", f"{HAND_HELP}{error}\n\n> ")
                elif self.terminal.shows == "line":
                    self.terminal.hide()
            return
        self.terminal.hide()
        if shown != "page" or byte in (terminal.LEAVE, terminal.PREFIX):
            self._press_key(*self.keys.take(byte))
        if byte == terminal.CTRL_C and not shown and self.terminal.raw and not self._explained:
            self._explained = True
            self.note("Ctrl-C goes to the robot. Ctrl-] ends the simulator, Ctrl-T ? shows its keys.")

    def _press_key(self, kind: str, value: Any) -> None:
        powered = self.board.powered
        if kind in ("byte", "rc", "button") and not powered:
            self.note(POWER_IS_OFF)
        elif kind == "byte":
            self._flow.type(bytes([value]))
        elif kind == "rc":
            self.rc_hold(value, HELD_CYCLES)
        elif kind == "button" and self._lacks(value):
            self.note(NO_PANEL)
        elif kind == "button":
            self.press(value, HELD_CYCLES // 3)
        elif kind == "exit":
            self.end(EXIT_GOOD)
        elif kind == "help":
            self.page("page", terminal.HELP)
        elif kind == "mode":
            self.note("keyboard: RC-100 (Ctrl-T r ends)" if value else "keyboard: serial line")
        elif kind == "power":
            self.power(not powered)
            self.note("power off (Ctrl-T p switches it on)" if powered else "power on")
        elif kind == "servos":
            self.page("page", self._servo_table())
        elif kind == "line":
            self.page("line", f"{HAND_HELP}> ")

    def _servo_table(self) -> str:
        rows = ["ID  goal  present  torque  error byte\n"]
        for servo in self.board.servos:
            torque = "on" if servo.register(24, 1) else "off"
            more = ("  held" if servo.held else "") + ("" if servo.powered else "  no power")
            rows.append(f"{servo.id:<3} {servo.goal:4}  {servo.present:7}  {torque:<6}  0x{servo.alarm_bits:02X}{more}\n")
        return "".join(rows)

    def _follow_rate(self) -> None:
        """Follows the rate set by the client of the pty. At a wrong rate both ends receive garbage, as on a cable."""
        rate = self.console.port.rate if self.console.port else 0
        if rate == self._port_rate or not 300 <= rate <= 4000000:
            return
        self._port_rate = rate
        self.board.baud(rate)
        if not 0.96 * LINE_BPS <= rate <= 1.04 * LINE_BPS:
            self.say(f"the serial port's rate was set to {rate} bps; the robot's is {LINE_BPS}: both hear garbage")

    # The run

    def run(self) -> None:
        options, board, script, console = self.options, self.board, self.script, self.console
        by_default = not script or options.pty is not None or options.tcp is not None
        begun = time.monotonic()
        real = options.pace == "real" or (not options.pace and by_default)
        self._begin_pace()
        self._begun -= time.process_time()  # counts the start-up time too: the robot is on since the command was given
        tick = 0
        wake = 0 if script else NEVER
        while not self.done:
            now = board.now_cycles
            until = min((now // CYCLES_PER_TICK + 1) * CYCLES_PER_TICK, options.time, self._hands(), wake)
            if real:
                until = min(until, now + SLICE_CYCLES)
            if until > now:
                try:
                    board.run(cycles=until - now)
                except Violation as violation:
                    self._report(violation)
            now = board.now_cycles
            if self._trace and now // CYCLES_PER_TICK != tick:
                tick = now // CYCLES_PER_TICK
                self._trace.row(tick, now)
            self._hear(now)
            if script and not self.done:
                wake = script.step(self)
            real = real and not (not options.pace and self._is_alone())
            self._wait_for_clock(real)
            self._follow_rate()
            if self.interrupted or now >= options.time:
                self._stop()
            elif not script and ((console.stdout_ended and not options.no_stdio) or self._is_answered()):
                self.end(EXIT_GOOD)
        self.terminal.leave_screen()
        if options.summary:
            self._summarize(begun)

    def _hear(self, now: int) -> None:
        """Takes new output from the robot and updates what the user sees."""
        fresh = self.board.take()
        if fresh:
            self._traffic = now
            self._flow.hear(fresh, now)
            self.console.put(fresh)
            if self.script:
                self.heard += fresh
        self._feed()
        if self.terminal.shows == "note" and now >= self.terminal.until:
            self.terminal.hide()
        if self.console.cleared and now - self._traffic > SILENT_CYCLES and self.terminal.draws and not self.terminal.shows:
            self.terminal.hint(self.board.resets + 1)

    def _begin_pace(self) -> None:
        self._begun, self._begun_cycles = time.monotonic(), self.board.now_cycles

    def _left(self) -> float:
        """Seconds until the wall clock reaches the simulated time; negative: late."""
        return (self.board.now_cycles - self._begun_cycles) / CYCLES_PER_S - (time.monotonic() - self._begun)

    def _wait_for_clock(self, real: bool) -> None:
        left = self._left() if real else 0
        if left < -LATE_S:
            self._begin_pace()
        self.console.wait(left)
        while real and not self.interrupted and not self.done and (left := self._left()) > 0:
            self.console.wait(left)

    def _report(self, violation: Violation) -> None:
        self.terminal.leave_screen()
        ms = violation.cycle / CYCLES_PER_MS
        self.complain(f"violation {violation.kind} at cycle {violation.cycle} ({ms:.3f} ms), PC 0x{violation.pc:05X} "
                      f"in {violation.function}: {violation.text}")  # fmt: skip
        self.end(EXIT_VIOLATION)

    def _is_alone(self) -> bool:
        """True when piped input was the only input and has ended: then no person waits for real time."""
        return self.console.stdin_ended and self.options.pty is None and self.options.tcp is None

    def _is_answered(self) -> bool:
        """True when the robot has had time to reply to the last input."""
        silent = self.board.now_cycles - self._traffic > LINGER_CYCLES
        return self._is_alone() and self.options.time == NEVER and silent and self.board.waiting == 0 and not self._flow

    def _stop(self) -> None:
        """Ends the run after a signal or --time. A script that has not reached its end has failed."""
        if self.script and not self.done:
            self.complain(f"{self.script.place}: the run ended here, before the script")
            self.end(EXIT_EXPECTATION)
        self.end(EXIT_GOOD)

    def _summarize(self, begun: float) -> None:
        """Prints the figures of --summary."""
        board, busy, real = self.board, time.process_time(), time.monotonic() - begun
        simulated = board.now_cycles / CYCLES_PER_S
        self.complain(f"simulated {simulated:.3f} s in {real:.3f} s, {busy:.3f} s of this PC's CPU: "
                      f"{simulated / busy:.1f} times real time on one core")  # fmt: skip
        load = 100 * board.busy_cycles / max(board.now_cycles, 1)
        self.complain(f"CPU busy {load:.1f} %, stack headroom {board.stack_headroom} bytes, {board.resets} resets")
        for name, uart in (("bus", board.uart(0)), ("console", board.uart(1))):
            self.complain(f"{name}: {uart.sent} bytes out, {uart.received} in, {uart.overruns} overruns, {uart.framing} framing errors")

    def close(self, opened: bool) -> None:
        """Writes the files to keep, if the session was opened."""
        try:
            self._closing.close()
        finally:
            self._line_end = "\n"
            self._keep(opened)
            self.board.close()

    def _keep(self, opened: bool) -> None:
        for failure in keep(memories(self.options, self.board.servos, self.board) if opened else {}, self._trace):
            self.complain(failure)
            self.end(EXIT_FILE)
