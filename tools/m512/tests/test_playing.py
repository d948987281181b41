# SPDX-License-Identifier: MIT
"""`m512 play` and `pose` on a line that loses bytes, and when Ctrl-C or a signal comes at any moment: the robot does what is said."""

import json
import os
from contextlib import nullcontext

import pytest
from play_peer import PlayPeer

from m512 import ui

CTRL_C, TERMINATED = KeyboardInterrupt(), SystemExit(143)


def starts(robot):
    return [request for request in robot.asked if request.split()[0] in ("play", "move")]


@pytest.mark.parametrize("page", ["1", "2"])  # page 1 has gone on to page 2 before the loss is known
def test_a_play_whose_answer_is_lost_is_followed(m512, page):
    with PlayPeer(damaged=["play"], where=[None, None, CTRL_C]) as robot:
        result = m512("play", page, "--wait", "-p", robot.path)
    assert result.exit_code == 130 and "playing: page 2" in result.stderr, result.stderr
    assert starts(robot) == [f"play {page}"] and robot.state == "idle"


def test_a_play_whose_answer_is_lost_is_reported_as_one(m512):
    with PlayPeer(damaged=["play"]) as robot:
        result = m512("play", "2", "-p", robot.path)
    assert result.exit_code == 0 and "page 2 plays" in result.stderr and robot.state == "playing", result.stderr


def test_a_play_that_has_ended_before_its_answer_is_missed_is_not_begun_again(m512):
    with PlayPeer(damaged=["play"], says="Ended after page 3") as robot:
        result = m512("play", "3", "-p", robot.path)
    assert result.exit_code == 0 and starts(robot) == ["play 3"], result.stderr


def test_a_move_whose_answer_is_lost_has_worked(m512, monkeypatch):
    monkeypatch.setattr("play_peer.MOVE_SECONDS", 9)  # longer than m512 waits for an answer
    with PlayPeer(damaged=["move"]) as robot:
        result = m512("pose", "1:900", "-p", robot.path)
    assert result.exit_code == 0 and len(starts(robot)) == 1, result.stderr


LATE, FAULT = "The computer came 0.1 s late: breaking off", "Ended for the fault of a servo in page 2 (b)"


@pytest.mark.parametrize(
    "says, told",
    [
        ("", ""),  # lost
        ("Ended after page 2 (Ended. Page 3)", ""),
        ("Stopped after page 2", ""),
        ("Broken off in page 2", ""),  # by somebody
        (f"{LATE}\nBroken off in page 2", LATE),
        ("Nobody drives any more: stopping\nPage 2 step 1 repetition 9\nStopped after page 2", "Nobody drives any more: stopping"),
        ("Ended. Page 3 is damaged", "Ended. Page 3 is damaged"),
        ("\nMotion512 Play 1.0.0 for CM-5, last reset: external\n18 servos: 1-18", "the board has restarted (external)"),
        (f"Servo 5 does not answer\nServo 5 answers again\n{FAULT}", f"Servo 5 does not answer; {FAULT}"),
    ],
)
def test_a_play_that_the_robot_breaks_off_is_told_with_its_reason(m512, says, told):
    """`m512 play a --wait && m512 play b` once continued with b."""
    with PlayPeer(says=says) as robot:
        result = m512("play", "2", "--wait", "--json", "-p", robot.path)
    assert json.loads(result.stdout)["state"] == "idle"
    if told:
        assert result.exit_code == 8 and result.stderr.endswith(f"m512: the robot has broken off the motion: {told}\n"), result.stderr
    else:
        assert result.exit_code == 0 and "broken off" not in result.stderr, result.stderr


def test_a_play_is_refused_while_another_one_goes_on(m512):
    for damaged, rate in (([], []), (["play"], []), (["play", "where"], []), ([], ["--rate", "300"])):  # of the one that goes on
        with PlayPeer(damaged=damaged) as robot:
            robot.state, robot.page = "playing", 2
            result = m512("play", "2", *rate, "-p", robot.path)
        assert result.exit_code == 8 and "something plays" in result.stderr, result.stderr
        assert not {"stop", "rate 300"} & set(robot.asked) and robot.state == "playing"


@pytest.mark.parametrize("words", [("play", "9"), ("play", "9", "--wait"), ("drive", "9"), ("layer", "9")])
def test_an_empty_page_of_a_board_is_refused_by_its_number_and_stops_nothing(m512, words, monkeypatch):
    """With the exit code that an empty page of a file has."""
    monkeypatch.setattr("m512.cli.shape._keys", lambda: nullcontext())
    with PlayPeer() as robot:
        result = m512(*words, "-p", robot.path)
    assert result.exit_code == 4 and "page 9 has no action" in result.stderr and "stop" not in robot.asked, result.stderr


@pytest.mark.parametrize(
    "joints, asked, says",
    [(("1:600", "9:500"), [], "no answer from servos 9: nothing was moved"), (("1:600", "2:500"), ["aim 1 600", "aim 2 500"], "joint 2: None of")],
)
def test_an_aim_that_one_joint_cannot_take_says_which_and_what_was_moved(m512, joints, asked, says):
    with PlayPeer() as robot:
        result = m512("aim", *joints, "-p", robot.path)
    assert result.exit_code == 8 and says in result.stderr and [line for line in robot.asked if line.startswith("aim")] == asked, result.stderr
    assert ("holds joint 1 now" in result.stderr and "m512 free" in result.stderr) == bool(asked), result.stderr


@pytest.mark.parametrize(
    "answer, code, says", [("1:500:1 2:?:0", 0, "no answer from servos 2: the step leaves them out"), ("1:?:1", 8, "no servo answers")]
)
def test_a_pose_as_text_names_the_servos_that_do_not_answer(m512, monkeypatch, answer, code, says):
    monkeypatch.setattr(PlayPeer, "do_pose", lambda _: f"{answer} OK")
    with PlayPeer() as robot:
        result = m512("pose", "--text", "-p", robot.path)
    assert result.exit_code == code and says in result.stderr and result.stdout == ("" if code else "step 1s | 1:500\n"), result.stderr


@pytest.mark.parametrize("words", [("play", "2"), ("play", "2", "--wait"), ("pose", "1:900")])
def test_ctrl_c_while_the_start_is_answered_stops_the_robot(m512, words):
    with PlayPeer(play=[CTRL_C], move=[CTRL_C]) as robot:
        result = m512(*words, "-p", robot.path)
    assert result.exit_code == 130 and "stopped by Ctrl-C" in result.stderr, result.stderr
    assert robot.state == "idle" and "stop" in robot.asked and len(starts(robot)) == 1


@pytest.mark.parametrize("first", [{"play": [CTRL_C]}, {"where": [CTRL_C]}])
def test_a_second_ctrl_c_while_the_stop_is_answered_stops_at_once(m512, first):
    with PlayPeer(**first, stop=[CTRL_C]) as robot:
        result = m512("play", "2", "--wait", "-p", robot.path)
    assert result.exit_code == 130 and "stopped by Ctrl-C" in result.stderr, result.stderr
    assert robot.asked.index("stop") < robot.asked.index("break") and robot.state == "idle"


def test_a_third_ctrl_c_says_that_the_robot_may_still_move(m512):
    with PlayPeer(where=[CTRL_C], stop=[CTRL_C], **{"break": [CTRL_C]}) as robot:
        result = m512("play", "2", "--wait", "-p", robot.path)
    assert result.exit_code == 130 and "may still move" in result.stderr and "m512 stop --now" in result.stderr, result.stderr


AT_THE_START = [{"play": [TERMINATED], "move": [TERMINATED]}, {"play": [CTRL_C], "move": [CTRL_C], "stop": [TERMINATED]}]
WHILE_IT_WAITS = [{"where": [TERMINATED]}, {"where": [CTRL_C], "stop": [TERMINATED]}]


@pytest.mark.parametrize(
    "words, ended",
    [(("play", "2"), ended) for ended in AT_THE_START]  # it does not wait: the play is meant to go on
    + [(words, ended) for words in (("play", "2", "--wait"), ("pose", "1:900")) for ended in AT_THE_START + WHILE_IT_WAITS],
)
def test_a_signal_at_any_moment_stops_the_robot(m512, words, ended):
    with PlayPeer(**ended) as robot:
        result = m512(*words, "-p", robot.path)
        robot.pass_time(2)
    assert result.exit_code == 143 and "stop" in robot.asked and robot.state == "idle", result.stderr


@pytest.mark.parametrize("mute, words", [("where", ("play", "2", "--wait")), ("play where", ("play", "2")), ("stop", ("play", "2", "--wait"))])
def test_a_robot_that_no_longer_answers_is_said_to_go_on(m512, mute, words):
    with PlayPeer(play=[CTRL_C] if mute == "stop" else []) as robot:
        play = robot.do_play
        robot.do_play = lambda *rest: (robot.mute.update(mute.split()), play(*rest))[1]
        result = m512(*words, "-p", robot.path)
    assert result.exit_code == 7 and "goes on" in result.stderr and "m512 stop" in result.stderr, result.stderr


@pytest.mark.parametrize("board, says", [("cm5", "then search again"), ("pc", "then repeat the command")])
def test_servos_without_power_are_said_in_words_that_help_there(m512, board, says):
    """The program for an adapter ends with the command, and nobody can type `servos find` into it."""
    with PlayPeer() as robot:
        robot.do_ver = lambda: f"image=play board={board} version=1.0 pages=128 OK"
        robot.do_play = lambda *_: "ERR 3 No servo answers: check power and cable, then search again"
        result = m512("play", "2", "-p", robot.path)
    assert result.exit_code == 8 and says in result.stderr, result.stderr


@pytest.mark.parametrize("quiet, exit_code", [((), 0), (("play", "where", "stop"), 7)])
def test_a_drive_plays_its_page_or_says_that_it_may_go_on(m512, monkeypatch, quiet, exit_code):
    from contextlib import contextmanager

    from m512.board.driving import Keys
    from m512.cli import shape

    @contextmanager
    def keys():
        source = Keys()
        source.press(" ")
        yield source

    monkeypatch.setattr(shape, "_keys", keys)
    with PlayPeer() as robot:
        play = robot.do_play
        robot.do_play = lambda *rest: (robot.mute.update(quiet), play(*rest))[1]
        result = m512("drive", "2", "-p", robot.path)
    assert result.exit_code == exit_code and ("it goes on (m512 stop" in result.stderr) == bool(quiet), result.stderr
    assert "stop" in robot.asked


@pytest.mark.parametrize("words", [("play",), ("layer",), ("drive", "2", "--layer")])
def test_a_range_that_goes_down_is_no_page(m512, words):
    with PlayPeer() as robot:
        robot.do_list = lambda: '2:2:"walk" OK'
        result = m512(*words, "5..3", "-p", robot.path)
    assert result.exit_code == 8 and "5..3 means several pages, and one is asked for" in result.stderr, result.stderr


def test_the_same_field_is_the_same_in_each_json(m512):
    """`play --json` once had the bits of `aim` as a number or as text, by chance, and blend=-30 as text."""
    with PlayPeer() as robot:
        for bits, joints in (("00000000", "none"), ("00000006", "1,2"), ("0000000A", "1,3")):
            robot.do_shape = lambda bits=bits: f"rate=120 blend=-30 amplitude={'3C' * 30 + '78'} layer=0 aim={bits} OK"
            fields = json.loads(m512("shape", "--json", "-p", robot.path).stdout)
            assert fields == {"rate": 120, "blend": -30, "amplitude": "60 30:120", "layer": 0, "aim": joints}
            for words in (("stop",), ("torque", "off"), ("play", "2", "--code", "0")):
                robot.do_torque = lambda *_: "OK"
                robot.do_break()
                state = json.loads(m512(*words, "--json", "-p", robot.path).stdout)
                assert fields.items() <= state.items() and state["faulty"] == "00000000" and state["dv"] == 96, words


@pytest.mark.parametrize("words, begun", [(("play", "2", "--wait"), "play 2"), (("pose", "1:900"), "move 60 1 384")])
def test_a_reader_of_remarks_that_has_gone_stops_the_robot(m512, monkeypatch, words, begun):
    with PlayPeer() as robot:
        monkeypatch.setattr("m512.ui.is_unread", lambda: len(robot.asked) > 8)
        result = m512(*words, "-p", robot.path)
    assert result.exit_code == 141 and begun in robot.asked and robot.asked[-1] == "stop", robot.asked
    with PlayPeer() as robot:
        assert m512("play", "2", "-p", robot.path).exit_code == 0 and "stop" not in robot.asked


def test_whether_a_reader_of_remarks_is_there(tmp_path, monkeypatch):
    """On a full disk the work goes on, as in test_trust.py."""
    monkeypatch.setattr(ui, "_unread", False)
    read, write = os.pipe()
    with open("/dev/full", "w") as full, open(tmp_path / "log", "w") as log, os.fdopen(write, "w", buffering=1) as pipe:
        for stream in (full, log, pipe, None):
            monkeypatch.setattr(ui.sys, "stderr", stream)
            assert not ui.is_unread()
        os.close(read)
        monkeypatch.setattr(ui.sys, "stderr", pipe)
        assert ui.is_unread()
        ui.say("this puts the stream off")
        assert ui.is_unread()
