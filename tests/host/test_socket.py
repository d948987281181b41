# SPDX-License-Identifier: MIT
"""The console as a socket: one client at a time. What another one typed is never carried out later."""

import contextlib
import socket
import subprocess
import sys

from m512.files.image import Image
from tests.host.pc_robot import program, until
from tests.sim.made_page import page


def connected(port):
    """A connection to the console, once the program listens."""

    def connect():
        with contextlib.suppress(ConnectionRefusedError):
            return socket.create_connection(("127.0.0.1", port), timeout=60)

    return until(connect, "nobody listens")


def heard(client, text):
    """What comes up to this text, or until the other side closes."""
    data = b""
    with contextlib.suppress(ConnectionResetError):  # closed with something unread
        while text not in data and (piece := client.recv(4096)):
            data += piece
    return data


def asked(port, line):
    with connected(port) as client, contextlib.suppress(OSError):
        client.sendall(line)
        return heard(client, b"OK")
    return b""


def test_a_second_client_is_refused_by_a_sentence_and_its_line_is_never_carried_out(make, tmp_path):
    image = Image.empty()
    image[1] = page("stand", [(40, {})])
    (tmp_path / "motions.bin").write_bytes(image.to_bytes())
    robot = make()
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    command = [program("play"), "--robot", robot.folder / "robot", "--motions", tmp_path / "motions.bin", f"--tcp={port}"]
    robot.process = robot.start(*command, robot.port)
    with connected(port) as first:
        assert b"] " in heard(first, b"] ")
        with connected(port) as second:
            assert heard(second, b"never") == b"Somebody else is connected to this robot.\r\n"
        asked(port, b"play 1\r")
        m512 = [sys.executable, "-m", "m512", "stop", "--now", "-p", f"socket://127.0.0.1:{port}"]
        refused = subprocess.run(m512, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False, timeout=60)
        assert refused.returncode == 6 and "no other one is connected to it; then repeat the command" in refused.stderr
    answer = until(lambda: b"state=" in (data := asked(port, b"@where\r")) and data, "@where was not answered")
    assert b"state=idle" in answer and robot.frames() == []
