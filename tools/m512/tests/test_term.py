# SPDX-License-Identifier: MIT
"""`m512 term` on a terminal of its own: bytes in both directions, its keys, log, files, the boot loader, a pulled cable."""

import os
import shlex
import sys

import pexpect
import pytest
from factory_peer import APP, FactoryPtyPeer
from pty_peer import PtyPeer


class Echo(PtyPeer):
    """Answers a line with "<line>". Like a board, it ends lines with CR LF."""

    def __init__(self):
        self.line, self.lines = bytearray(), []
        super().__init__()

    def on_byte(self, byte):
        if byte == 0x0D:
            self.lines.append(bytes(self.line))
            self.send(b"\r\n<" + bytes(self.line) + b">\r\n] ")
            self.line = bytearray()
        else:
            self.line.append(byte)


@pytest.fixture
def term():
    running = []
    environment = {"PATH": "/usr/bin:/bin", "TERM": "xterm", "PYTHONIOENCODING": "utf-8:strict"}  # strict: as in all languages but C

    def start(*args, output=""):
        command = shlex.join([sys.executable, "-m", "m512", "term", *map(str, args)])
        shell = f"({command}; echo code $? >&2) {output}" if output else f"exec {command}"
        child = pexpect.spawn("/bin/sh", ["-c", shell], timeout=300, encoding="utf-8", env=environment)
        running.append(child)
        return child

    yield start
    for child in running:
        child.close(force=True)


def test_term_passes_bytes_both_ways_and_quits(term, tmp_path):
    with Echo() as board:
        child = term("-p", board.path, "--log", tmp_path / "log")
        child.expect("Ctrl-] q to quit")
        child.send("list\r")
        child.expect("<list>")
        child.send("\x1b[A\x03x\r")  # an arrow and Ctrl-C go to the board
        child.expect("x>")
        assert board.lines == [b"list", b"\x1b[A\x03x"]
        child.send("\x1dh")
        child.expect("call the boot loader")
        board.send(b"\x1b[2;5fscreen")
        child.expect("\x1b\\[2;5fscreen")
        child.send("\x1dq")
        child.expect(pexpect.EOF)
        child.close()
        assert child.exitstatus == 0
    assert b"<list>" in (tmp_path / "log").read_bytes()


def test_a_key_that_is_no_utf8_does_not_end_the_terminal(term):
    """Terminals that are set to Latin-1 send such bytes, and some send them for Alt with a key."""
    with Echo() as board:
        child = term("-p", board.path)
        child.expect("to quit")
        child.send("list\r")
        child.expect("<list>")
        os.write(child.child_fd, b"a\xf6b\r")
        child.expect("b>")
        child.send("where\r")
        child.expect("<where>")
        child.send("\x1dq")
        child.expect(pexpect.EOF)
        child.close()
        assert child.exitstatus == 0


def test_term_sends_a_file_line_by_line(term, tmp_path):
    (tmp_path / "script").write_text("one\ntwo\n\nthree")
    with Echo() as board:
        child = term("-p", board.path)
        child.expect("to quit")
        child.send("\x1ds")
        child.expect("file: ")
        child.send(f"{tmp_path / 'script'}\r")
        child.expect("<three>")
        child.expect("sent")
        assert board.lines == [b"one", b"two", b"", b"three"]
        child.send("\x1ds")
        child.expect("file: ")
        child.send("/no\x00/such\r")  # Ctrl-Space, which no name can have
        child.expect("cannot read /no/such")
        (tmp_path / "binary").write_bytes(bytes(600))
        child.send(f"\x1ds{tmp_path / 'binary'}\r")
        child.expect("binary was not sent: its line 1 has 600 bytes, so it is no text")
        assert len(board.lines) == 4


class Blocked(Echo):
    """Says XOFF with its first answer, and XON when the line `go on` comes."""

    def on_byte(self, byte):
        super().on_byte(byte)
        if byte == 0x0D:
            self.send(b"\x11" if self.lines[-1] == b"go on" else b"\x13")


def test_a_file_is_given_up_when_the_board_does_not_go_on(term, tmp_path, monkeypatch):
    """A lost XON once held the terminal for ever: it took no keys, so that not even Ctrl-] q worked."""
    (tmp_path / "script").write_text("one\ntwo\nthree")
    with Blocked() as board:
        child = term("-p", board.path)
        child.expect("to quit")
        child.send("\x1ds")
        child.expect("file: ")
        child.send(f"{tmp_path / 'script'}\r")
        child.expect("line 2 of .*script and all after it were not sent: the board has said XOFF and no XON for 10 s", timeout=60)
        assert board.lines == [b"one"]
        child.send("go on\r")
        child.expect("<go on>")
        child.send("\x1dq")
        child.expect(pexpect.EOF)


def test_the_log_is_switched_off_while_the_board_sends(monkeypatch):
    """The thread that reads once ended at a log that was being closed: nothing was shown any more, and nothing was said."""
    from m512.board import terminal

    class Line:
        said = [b"one", b"two"]

        def read_some(self, _):
            if len(self.said) == 1:
                it.running = False
            return self.said.pop(0)

    class Log:
        shut = False

        def write(self, data):
            if self.shut:
                raise ValueError("write to closed file")

        def flush(self):
            pass

        def close(self):
            self.shut = True
            it._read(screen)  # what comes while the file is closed

    monkeypatch.setattr(terminal, "Link", lambda url, image: Line())
    it, shown = terminal.Terminal("here"), []
    screen = type("Screen", (), {"write_bytes": staticmethod(shown.append)})
    it.log = Log()
    it._toggle_log(screen)
    assert shown == [b"one", b"two"] and it.log is None


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a full disk")
def test_a_log_that_cannot_be_written_is_told_and_the_terminal_goes_on(term):
    with Echo() as board:
        child = term("-p", board.path, "--log", "/dev/full", "--force")
        child.expect("to quit")
        child.send("list\r")
        child.expect("the log ends here: No space left on device")
        child.send("where\r")
        child.expect("<where>")


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a full disk")
@pytest.mark.parametrize("output, code", [("> /dev/full", 4), ("| true", 141)])
def test_an_output_that_takes_nothing_ends_the_terminal(term, output, code):
    """It once went on and showed nothing, while keys still went to the board."""
    with Echo() as board:
        child = term("-p", board.path, output=output)
        child.expect("to quit")
        child.send("list\r")
        child.expect("nothing that the board sends can be shown any more: .* \\(press a key\\)")
        child.send("x")
        child.expect(f"code {code}\r\n")
        assert board.lines == [b"list"]


class Playing(Echo):
    """Never quiet, so that each line of a file takes its whole time. Reads no faster than a board."""

    def on_silence(self, seconds):
        self.send(b".")

    def _read(self):
        try:
            return os.read(self.master, 64)
        except (OSError, TypeError):
            return b""


QUIT = "\x1dq"


@pytest.mark.parametrize("sending, typed", [("l", "stop\r"), ("l", QUIT), ("s", "stop\r"), ("b", "stop\r"), ("--send", QUIT)])
def test_a_key_ends_a_call_and_a_sending_and_reaches_the_board_at_once(term, tmp_path, sending, typed):
    """A `stop` once waited for the end: 30 s, or longer than a minute."""
    (tmp_path / "script").write_bytes((b"shape" * 13 + b"\r") * 20000 if sending == "b" else b"shape\n" * 60)
    with Playing() as board:
        child = term("-p", board.path, *(["--send", tmp_path / "script"] if sending == "--send" else []))
        child.expect("to quit")
        if sending != "--send":
            child.send("\x1d" + sending)
            child.expect("Press MODE" if sending == "l" else "file: ")
        if sending in "sb":
            child.send(f"{tmp_path / 'script'}\r")
        if sending != "l":
            child.expect("<shape")
        child.send(typed)
        said = {"l": "the call has ended: a key was pressed", "b": "the first [0-9,]+ of 1,320,000 bytes of .*script were sent: a key was pressed"}
        child.expect(said.get(sending, "line [0-9]+ of .*script and all after it were not sent: a key was pressed"), timeout=25)
        if typed == QUIT:
            child.expect(pexpect.EOF, timeout=25)
            child.close()
            assert child.exitstatus == 0
        else:
            child.expect("<stop>", timeout=25)
            assert board.lines[-1] == b"stop"


class Busy(FactoryPtyPeer):
    """An application that echoes what is typed; its person presses MODE after 20 '#'."""

    heard = 0

    def before_the_loader(self, byte):
        if self.state == APP:
            self.heard += 1
            if self.heard < 20:
                self.send(bytes([byte]))
                return True
            self.app_heard += b"#"
        return super().before_the_loader(byte)


def test_an_echo_is_no_boot_loader(term, monkeypatch):
    """Edit echoes what is typed. An echo once ended the calling before MODE was pressed."""
    monkeypatch.setattr("tests.campaigns.badlinks.factory_model.WINDOW", 0.2)
    with Busy(state=APP) as board:
        child = term("-p", board.path)
        child.expect("to quit")
        child.send("\x1dl")
        child.expect("Press MODE")
        child.expect("SYSTEM O.K.", timeout=60)
        child.expect("- ")


def test_term_calls_the_boot_loader(term, monkeypatch):
    # A busy PC may pause for longer than the board's 60 ms. The line ends 0.35 s later.
    monkeypatch.setattr("tests.campaigns.badlinks.factory_model.WINDOW", 0.2)
    with FactoryPtyPeer(state=APP) as board:
        child = term("-p", board.path)
        child.expect("to quit")
        child.send("\x1dl")
        child.expect("Press MODE")
        child.expect("SYSTEM O.K.")
        child.expect("- ")
        assert not board.hurt


def test_term_tells_when_the_cable_comes_off(term):
    with Echo() as board:
        child = term("-p", board.path)
        child.expect("to quit")
        board.pull()
        child.expect("broke")
        child.send("x")
        child.expect("m512: the line to")
        child.expect(pexpect.EOF)
        child.close()
        assert child.exitstatus == 6


def test_term_lists_ports(m512):
    assert m512("term", "--list").exit_code == 0


def test_a_log_does_not_touch_a_file_that_is_there(m512, tmp_path):
    mine = tmp_path / "lib.bin"
    mine.write_bytes(b"mine")
    result = m512("term", "-p", tmp_path / "no-port", "--log", mine, input="")
    assert result.exit_code == 5 and f"{mine} is there already (--force overwrites it)" in result.stderr
    assert m512("term", "-p", tmp_path / "no-port", "--log", mine, "--force", input="").exit_code == 6
    assert mine.read_bytes() == b"mine"  # no port: nothing is logged
    with Echo() as board:
        assert m512("term", "-p", board.path, "--log", mine, "--force", input="list\n").exit_code == 0
    assert b"<list>" in mine.read_bytes() and b"mine" not in mine.read_bytes()
    result = m512("term", "-p", tmp_path / "no-port", "--log", tmp_path, input="")
    assert result.exit_code == 4 and f"{tmp_path} is a folder; name a file in it" in result.stderr


def test_a_log_that_a_key_begins_does_not_touch_a_file_that_is_there(term, tmp_path):
    mine = tmp_path / "lib.bin"
    mine.write_bytes(b"mine")
    with Echo() as board:
        child = term("-p", board.path)
        child.expect("to quit")
        child.send("\x1dg")
        child.expect("log to: ")
        child.send(f"{mine}\r")
        child.expect("is there already")
        child.send("list\r")
        child.expect("<list>")
    assert mine.read_bytes() == b"mine"


def test_what_is_sent_first_is_read_once(m512):
    """A pipe supplies its bytes only once."""
    read, write = os.pipe()
    os.write(write, b"list\nplay 1\n")
    os.close(write)
    with Echo() as board:
        assert m512("term", "-p", board.path, "--send", f"/dev/fd/{read}", input="").exit_code == 0
        assert board.lines == [b"list", b"play 1"]
    os.close(read)
