# SPDX-License-Identifier: MIT
"""Play on the simulated robot: its effects other than text. test_play_sessions.py tests the words."""

import re

import pytest

from cm5sim import Board
from m512.files.image import Image, from_bytes
from tests.sim.play_robot import JOINTS, PAUSE, STOP, UP, ask, motions, page, paste, robot, tick_of, walk_steps

TORQUE, GOAL, PUNCH = 24, 30, 48
UNITS_PER_DEGREE = 1024 / 300


def writes(board):
    """Packets that could move a joint: WRITE, REG WRITE, SYNC WRITE to torque, goal or any address between them."""
    moving = []
    for cycle, packet in board.packets:
        if packet[4] in (3, 4, 0x83) and TORQUE <= packet[5] + packet[6] and packet[5] < PUNCH and packet[5] != 25:
            moving.append((cycle, packet.hex()))
    return moving


def counts(board):
    """The counters of `faults`: {"missed": 0, "late": 0, "overruns": 0, ...}."""
    board.run(ms=50)
    board.take()
    board.send("faults\r", wait=True)
    board.run(ms=200)
    words = board.take().decode("latin-1").replace(":", " ").split()
    return {words[i]: int(words[i + 1]) for i in range(len(words) - 1) if words[i + 1].isdigit()}


def walking(**options):
    board = robot(**options)
    ask(board, "play 4")
    board.expect("Page 4 step 2", ms=4000)
    return board


# --- power-on ---


@pytest.mark.parametrize("button", [None, "UP", "START"])
def test_nothing_moves_at_power_on(button):
    board = robot()
    if button:
        board.press(button)
        board.power_off()
        board.power_on()
    board.run(ms=3000)
    assert writes(board) == []
    assert not any(servo.torque for servo in board.servos)
    assert all(servo.present == 512 for servo in board.servos)


def test_reset_while_playing_moves_nothing_more():
    board = walking()
    board.reset()
    board.run(ms=5)
    board.clear_trace()
    board.expect("] ", ms=2000)
    board.run(ms=2000)
    assert [packet for packet in writes(board)] == []


# --- names ---


@pytest.mark.parametrize(
    "name, typed",
    [
        (" wave", "wave"),
        ("wave, slow", "Wave, slow"),
        ("a.b", "a.b"),
        ("2nd wave", "2nd wave"),
        ("a b c d e f g", "a b c d e f g"),
        ("gr??n", "gr\u00fcn"),
    ],
)
def test_page_plays_by_any_name_that_edit_takes(name, typed):
    image = Image.empty()
    image[9] = page(name, [(30, {1: 560})])
    board = robot(pages=image.to_bytes())
    board.send(f"play {typed}\r".encode())
    assert f"Playing page 9 ({name})" in board.expect("Ended", ms=4000)


def test_name_with_a_foreign_letter_is_not_the_name_without_it():
    image = Image.empty()
    image[9] = page("grn", [(30, {1: 560})])
    board = robot(pages=image.to_bytes())
    board.send("play gr\u00fcn\r".encode())
    assert "No page is named gr??n" in board.expect("\r\n] ")


@pytest.mark.parametrize(
    "line, said", [("play 13 1 1", "Too few or too many words"), ("play 65538", "Page must be 1..127"), ("play 99999999", "Page must be 1..127")]
)
def test_a_number_is_no_name_and_takes_a_code_only(line, said):
    board = robot()
    assert ask(board, line).removesuffix(": try help") == said
    assert re.fullmatch(rf"@play ERR [23] {said}", ask(board, "@" + line))


def test_where_names_the_repetition_that_plays():
    """Not the next one, which is already planned in the last step."""
    image = Image.empty()
    image[9] = page("twice", [(100, {1: 560})], repeat=2)
    board = robot(pages=image.to_bytes())
    ask(board, "play 9")
    board.expect("Playing page 9", ms=4000)
    board.run(ms=100)
    assert " page=9 step=1 repetition=1 " in ask(board, "@where")


# --- which joints are driven ---


def test_absent_unused_and_torque_off_joints_are_never_driven():
    board = robot(servos=[1, 2, 3, 5, 19])
    ask(board, "on")
    board.clear_trace()
    ask(board, "play 22")
    board.expect("Ended", ms=4000)
    driven = set().union(*(frame.goals for frame in board.trace))
    assert driven == {1, 2}  # 3 is unused and 5 torque-off in the page, 19 is in no page, the others are missing
    assert board.servos[1].goal == 560


def test_joint_switched_off_stays_limp():
    board = robot()
    ask(board, "on")
    ask(board, "off 11")
    board.clear_trace()
    ask(board, "play 4")
    board.expect("Page 4 step 2", ms=4000)
    assert all(11 not in frame.goals for frame in board.trace)
    assert not board.servos[11].torque


def test_trim_of_page_0_is_added():
    image = Image.empty()
    image[0] = page("Offset", [(0, {}), (0, {})])
    image[0].set_word(2, 1, 5)
    image[0].set_word(2, 2, 0x10000 - 7)
    image[0].seal()
    image[1] = page("ready", [(40, {})])
    board = robot(pages=image.to_bytes())
    ask(board, "play 1")
    board.expect("Ended", ms=4000)
    board.run(ms=100)
    assert (board.servos[1].goal, board.servos[2].goal, board.servos[3].goal) == (517, 505, 512)


@pytest.mark.parametrize(
    "line, trim, at", [("play 1", -100, 1010), ("@move 60 3 200", -300, 1000), ("aim 3 512", 150, 20), ("swing 3 512 40 2000", -300, 1000)]
)
def test_a_trimmed_joint_outside_the_range_of_pages_does_not_leap(line, trim, at):
    """60 degrees/s are 1.6 units a tick, from where the joint stands on."""
    image = from_bytes(motions())
    image[0] = page("Offset", [(0, {}), (0, {})])
    image[0].set_word(2, 3, trim & 0xFFFF)
    image[0].seal()
    board = robot(pages=image.to_bytes())
    board.servos[3].push_to(at)
    board.run(ms=500)
    ask(board, line)
    board.run(ms=1500)
    row = [at] + [frame.goals[3] for frame in board.trace if 3 in frame.goals]
    assert len(row) > 150 and max(abs(b - a) for a, b in zip(row, row[1:])) <= 2


def test_a_damaged_trim_page_is_told_and_an_erased_one_is_none():
    board = robot(pages=Image.empty().to_bytes())
    assert b"damaged" not in board.console and ask(board, "list") == "0 pages, 0 damaged\n OK"
    damaged = bytearray(Image.empty().to_bytes())
    damaged[200] ^= 1
    board = robot(pages=bytes(damaged))
    assert b"Page 0 is damaged: no trim\r\n" in board.console
    assert ask(board, "list") == "  0 damaged: checksum is wrong\n0 pages, 1 damaged\n OK"
    board = robot(pages=b"\xff" * 512 + bytes(damaged[512:]))
    assert b"damaged" not in board.console


# --- the approach ---


def test_approach_starts_at_the_pose_and_keeps_to_60_degrees_a_second():
    board = robot()
    for joint in JOINTS:
        board.servos[joint].push_to(200 + 30 * joint)
    board.clear_trace()
    ask(board, "play 1")
    board.expect("Playing", ms=10_000)
    frames = [frame for frame in board.trace if len(frame.goals) > 1]
    for joint in JOINTS:
        goals = [frame.goals[joint] for frame in frames if joint in frame.goals]
        assert abs(goals[0] - (200 + 30 * joint)) <= 2
        steps = [abs(b - a) for a, b in zip(goals, goals[1:])]
        assert max(steps) <= 60 * UNITS_PER_DEGREE / 128 + 1  # goals are whole units
        assert sum(steps) == abs(goals[-1] - goals[0])  # straight there


def test_a_code_on_the_way_to_the_first_pose_does_not_make_the_first_step_leap():
    pages = Image.empty()
    pages[1] = page("either", [(60, {})], repeat=0, next=2, link1_page=3, link1_code=UP)
    pages[2] = page("low", [(60, {1: 300})])
    pages[3] = page("high", [(5, {1: 900})], accel=0)
    board = robot(servos=[1], pages=pages.to_bytes())
    board.clear_trace()
    ask(board, "play either")
    board.rc(UP)
    board.expect("Ended after page", ms=8000)
    goals = [frame.goals[1] for frame in board.trace]
    assert goals[-1] == 300
    assert max(abs(after - before) for before, after in zip(goals, goals[1:])) <= 2


def test_approach_off_begins_the_page_where_the_robot_stands():
    board = robot()
    ask(board, "settings approach 0")
    assert "Going" not in ask(board, "play 4") + board.expect("Page 4 step 2", ms=2000)


# --- pause, break, stop ---


def goals_of(board, joint):
    return [frame.goals[joint] for frame in board.trace if joint in frame.goals and len(frame.goals) > 1]


def slows_down_to_a_stand(goals, ticks):
    """Whether speeds only decrease, without turning back (with a tolerance of one unit for rounding)."""
    steps = [b - a for a, b in zip(goals, goals[1:])][:ticks]
    sign = 1 if sum(steps) >= 0 else -1
    sizes = [sign * step for step in steps]
    return all(b <= a + 1 for a, b in zip(sizes, sizes[1:])) and min(sizes) >= -1


@pytest.mark.parametrize("word, said", [("break", "Broken off"), ("pause", "Paused")])
def test_break_and_pause_slow_down_and_hold(word, said):
    board = robot()
    ask(board, "settings approach 0")
    ask(board, "play 14")
    board.run(ms=1500)
    board.clear_trace()
    ask(board, word)
    assert said in board.take().decode("latin-1") or board.expect(said, ms=500)
    board.run(ms=100)
    for joint in (1, 2):
        assert slows_down_to_a_stand(goals_of(board, joint), 32)
    stood = board.servos[1].goal
    board.run(ms=2000)
    assert board.servos[1].goal == stood != 812
    assert board.servos[1].torque


def test_resume_goes_on_to_the_target():
    board = robot()
    ask(board, "play 14")
    board.expect("Playing", ms=8000)
    board.rc(PAUSE)
    board.expect("Paused")
    board.rc(0)
    board.run(ms=1000)
    board.rc(PAUSE)
    board.expect("Ended after", ms=12_000)
    assert (board.servos[1].goal, board.servos[2].goal) == (812, 212)


@pytest.mark.parametrize("word, said", [("resume", "Ended after"), ("stop", "Stopped after")])
def test_a_word_right_behind_pause_is_not_lost(word, said):
    """It comes during the braking."""
    board = robot()
    ask(board, "play 14")
    board.expect("Playing", ms=8000)
    board.send(f"pause\r{word}\r")
    assert "Paused" not in board.expect(said, ms=12_000)
    assert (board.servos[1].goal, board.servos[2].goal) == (812, 212)


def test_second_stop_on_the_remote_breaks():
    board = walking()
    for value in (STOP, 0, STOP):
        board.rc(value)
        board.run(ms=100)
    board.expect("Broken off", ms=400)


def test_stop_held_down_is_one_stop():
    board = walking()
    for _ in range(20):
        board.rc(STOP)
        board.run(ms=50)
    assert "Broken" not in board.expect("Stopped after", ms=4000)


# --- faults ---

FAULTS = [
    ("silent", "Servo 11 does not answer"),
    ("overload", "Servo 11 reports overload"),
    ("overheating", "Servo 11 reports overheating"),
    ("angle-limit", "Servo 11 reports angle limit"),
    ("low-voltage", "Servo 11 reports voltage"),
    ("dead", "Servo 11 does not answer"),
]


@pytest.mark.parametrize("fault, named", FAULTS)
def test_fault_is_named_within_a_second_and_the_robot_holds(fault, named):
    board = walking()
    ask(board, "settings talk 0")
    start = len(board.console)
    board.servos[11].fault(fault)
    board.expect(named, ms=1000)
    assert counts(board)["missed"] == 0
    assert "aux" in board.leds
    board.run(ms=1000)
    is_ended = b"Ended for the fault of a servo" in board.console[start:]
    assert is_ended == (fault != "low-voltage")
    board.clear_trace()
    board.run(ms=1000)
    assert (board.trace == []) == is_ended
    assert all(board.servos[joint].torque for joint in JOINTS if joint != 11)


def test_wrong_answers_are_retried_and_end_nothing():
    board = walking()
    ask(board, "settings talk 0")
    for fault in ("checksum", "short", "noise", "late"):
        board.servos[11].fault(fault, times=2)
        board.run(ms=1000)
        board.servos[11].clear()
    board.run(ms=1000)
    text = board.take().decode("latin-1")
    assert "Ended" not in text and "does not answer" not in text
    assert counts(board)["missed"] == 0


# --- typing ---


def test_bracket_typed_after_a_lone_escape_is_a_character():
    board = robot()
    board.take()
    board.send("a\x1b[A\x1b")  # a terminal sends a sequence at once, a user types later
    board.run(ms=100)
    board.send("[O")
    board.run(ms=50)
    assert board.take().decode() == "a[O"


def test_ctrl_c_drops_the_typed_line():
    board = robot()
    board.send("play 13\x03", wait=True)
    board.run(ms=50)
    assert ask(board, "list").startswith("  1 ready")
    assert board.servos[1].goal == 512 and ask(board, "status").startswith("Nothing is playing")


# --- LEDs ---


def test_lamps():
    board = robot()
    board.run(ms=200)
    assert board.leds == {"power"}
    ask(board, "settings talk 0")
    ask(board, "play 4")
    board.run(ms=1500)
    assert board.leds == {"power", "play"}
    board.send("x")
    board.run(ms=20)
    assert {"txd", "rxd"} <= board.leds
    board.run(ms=200)
    assert ask(board, "\bpause") == " OK"
    board.run(ms=500)
    seen = set()
    for _ in range(10):
        board.run(ms=60)
        seen.add("play" in board.leds)
    assert seen == {True, False}  # it blinks
    ask(board, "break")
    board.run(ms=300)
    assert board.leds == {"power"}


@pytest.mark.parametrize("fault", ["overload", "overheating"])
def test_aux_goes_out_when_the_servo_is_well_and_on_again(fault):
    board = robot()
    ask(board, "on")
    board.servos[5].fault(fault)
    board.run(ms=2000)
    assert "aux" in board.leds
    board.servos[5].clear()
    board.run(ms=2000)
    assert "aux" in board.leds  # its torque is off
    assert "Servo 5 has no torque" in ask(board, "faults")
    ask(board, "on")
    board.run(ms=1000)
    assert board.servos[5].torque and "aux" not in board.leds
    assert "No servo has a fault" in ask(board, "faults")


def test_aux_goes_out_when_heat_is_no_longer_watched():
    board = robot()
    ask(board, "settings hot 25")
    board.expect("is hot", ms=1000)
    assert "aux" in board.leds
    ask(board, "settings hot 0")
    board.expect("No servo is hot any more", ms=1000)
    board.run(ms=10)
    assert "aux" not in board.leds


# --- text delays nothing ---


def test_long_answers_while_walking_make_no_tick_late():
    board = walking()
    ask(board, "settings talk 0")
    tick = tick_of(board)
    board.clear_trace()
    board.take()
    for word in ("list", "help", "settings", "servos", "faults", "@list", "@page 4", "@pose"):
        board.send(word + "\r", wait=True)
        board.run(ms=900)
    ticks = [tick(frame.cycle) for frame in board.trace]
    assert ticks == list(range(ticks[0], ticks[0] + len(ticks)))
    text = board.take().decode("latin-1")
    assert text.count("OK") == 8
    found = counts(board)
    assert (found["missed"], found["late"]) == (0, 0)


def test_stop_on_the_remote_does_not_wait_for_a_long_answer():
    board = walking()
    ask(board, "settings talk 0")
    board.send("list\r@page 1\rhelp\r", wait=True)
    board.rc(STOP)
    board.run(ms=5)
    board.rc(0)
    assert "Stopped" in board.expect("Stopped after", ms=4000)


def test_flood_that_ignores_xoff_harms_nobody():
    """4,000 characters at line rate into a shell that answers: typed bytes are lost and counted, nothing else is lost."""
    board = walking()
    board.send("status\r" * 571)
    for value in (UP, 0) * 10:
        board.rc(value)
    board.send("", wait=True)
    board.run(ms=3000)
    board.send("\r")
    board.run(ms=200)
    found = counts(board)
    assert (found["missed"], found["late"], found["overruns"]) == (0, 0, 0)
    assert found["packets"] > 0 and found["lost"] > 0
    assert board.uart(1).overruns == 0


def test_search_answers_when_it_is_done_and_misses_nothing_typed():
    board = robot(servos=[1, 2, 3])
    board.servos.add(7)
    board.send("servos find\rversion\r", wait=True)
    assert "4 servos: 1-3 7" in board.expect("Motion512 Play", ms=2000)


@pytest.mark.parametrize("line", ["off", "@torque off"])
def test_off_lets_go_of_a_servo_that_the_last_search_missed(line):
    board = robot()
    ask(board, "on")
    board.servos[5].fault("silent")
    assert "17 servos" in ask(board, "servos find")
    board.servos[5].clear()
    ask(board, "off 4")
    assert board.servos[5].torque and not board.servos[4].torque  # it may carry the robot
    ask(board, line)
    assert not any(board.servos[id].torque for id in JOINTS)


def test_one_servo_is_one_servo():
    assert "1 servo: 5\n" in ask(robot(servos=[5]), "servos find")


def test_a_servo_in_endless_turn_is_named_and_not_used():
    board = robot(servos=[4, 5])
    board.servos[5].write(6, [0, 0, 0, 0])  # angle limits
    assert ask(board, "servos find").endswith("1 servo: 4\nNot used, turns without end (both angle limits are 0): 5\n OK")
    ask(board, "on")
    assert ask(board, "aim 5 600") != " OK" and not board.servos[5].torque and board.servos[4].torque


def test_search_in_a_pasted_script_loses_nothing_of_it():
    board = robot(servos=[1, 2, 3])
    words = ["version"] * 20 + ["servos find"] + ["version"] * 60 + ["servos find", "servos find"] + ["version"] * 60
    heard = paste(board, "\r".join(words) + "\r")
    board.run(ms=3000)
    heard += board.take().translate(None, b"\x11\x13")
    assert heard.count(b"Motion512 Play") == 140 and heard.count(b"3 servos: 1-3") == 3
    assert counts(board)["lost"] == 0


# --- settings, boards ---


def test_setting_answered_ok_outlives_a_reset_at_once():
    board = robot()
    assert ask(board, "settings approach 77").endswith("OK")
    board.send("@reset\r", wait=True)
    board.expect("Motion512 Play", ms=2000)
    board.expect("] ", ms=2000)
    assert "approach 77 " in ask(board, "settings")


def test_settings_outlive_power_off():
    board = robot()
    ask(board, "law classic")
    ask(board, "settings approach 77")
    board.run(ms=1500)
    board.power_off()
    board.power_on()
    board.expect("] ", ms=2000)
    assert "approach 77" in ask(board, "settings")
    assert ask(board, "law").startswith("classic")


def test_worn_out_eeprom_loses_no_setting_that_was_answered_ok_unsaid():
    board = robot()
    worn = {0x46}  # approach, in the second of four copies

    def forget():
        memory, at = board.operation(board.operations)
        if memory == "eeprom" and at in worn:
            board.eeprom[at] = 99

    board.on_operation(forget)
    for approach in (77, 33):
        assert ask(board, f"settings approach {approach}") == " OK"
        board.run(ms=1500)
        board.power_off()
        board.power_on()
        board.expect("] ", ms=2000)
        assert f"approach {approach} " in ask(board, "settings")
    worn |= {0x06, 0xC6}  # in all but the newest copy
    assert ask(board, "settings approach 55") == " OK"
    board.expect("Settings not saved: EEPROM error", ms=1500)


def test_cm2_plays_without_a_panel():
    board = robot(kind="cm2", image="play-cm2.hex")
    assert "CM-2" in ask(board, "version")
    ask(board, "play 1")
    board.expect("Ended after page 1", ms=4000)
    assert board.servos[1].goal == 480


def test_motions_of_the_tests_are_what_they_say():
    image = motions()
    assert len(image) == 65536 and image[11 * 512 : 11 * 512 + 4] == b"torn"


def test_a_name_that_two_pages_have_starts_none():
    image = bytearray(motions())
    image[7 * 512 : 8 * 512] = page("WALK", walk_steps()).data
    board = robot(pages=bytes(image))
    assert ask(board, "play walk") == "Say which by its number: pages 4 and 7 are named walk"
    assert ask(board, "@play walk") == "@play ERR 3 Say which by its number: pages 4 and 7 are named walk"
    board.run(ms=500)
    assert "state=idle" in ask(board, "@where")
    assert ask(board, "play turn left").endswith("OK")


def test_where_names_a_page_and_a_step_of_it():
    """At a page's end the next step is planned a tick before it starts. Page and step must belong together even then."""
    image = Image.empty()
    image[5] = page("two", [(9, {1: 560}), (9, {1: 464})], next=6)
    image[6] = page("three", [(9, {1: 560}), (9, {1: 464}), (9, {1: 512})], next=5)
    board, places = robot(pages=image.to_bytes()), []
    ask(board, "play 5")
    board.expect("Page 6 step 2", ms=4000)
    for _ in range(300):
        board.send("@where\r")
        board.run(ms=60)
        found = re.search(r"@where state=play\w* page=(\d) step=(\d)", board.take().decode("latin-1"))
        places.append(found and (int(found[1]), int(found[2])))
    order = [(5, 1), (5, 2), (6, 1), (6, 2), (6, 3)]  # 60 ms, and a step takes 70: the next place is the same, or one or two further
    told = [(before, after) for before, after in zip(places, places[1:]) if before and after]
    assert len(told) > 200 and set(place for pair in told for place in pair) == set(order)
    assert [pair for pair in told if (order.index(pair[1]) - order.index(pair[0])) % 5 > 2] == []


def test_a_restart_on_request_does_not_read_like_a_crash():
    board = robot()
    board.send("@reset\r")
    board.expect("last reset: on request or watchdog", ms=3000)


def test_the_mode_button_at_the_loaders_prompt_is_named_beside_the_power_on():
    """The loader leaves the chip's flags of past resets as they are."""
    board = Board(images=["boot-cm5.hex", "play-cm5.hex"], motions=motions(), servos=JOINTS)
    board.expect("\r\n - ", ms=1000)  # an erased EEPROM: it stays
    board.eeprom[0xFFF] = 0x11
    board.reset()
    board.expect("last reset: power-on, reset button\r", ms=3000)
    board.reset()
    board.expect("last reset: reset button\r", ms=3000)
