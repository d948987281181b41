# SPDX-License-Identifier: MIT
"""Effects of Edit on servos: GO, MIRROR, ON, OFF, SET on the work pose, the trim, EXIT, MON; edit/ORIGINAL.md sections 7, 8, 10 and 11, and
"nothing moves by surprise"."""

import pytest

from m512.files.image import Image
from tests.sim.channel import request
from tests.sim.edit_robot import UNUSED, page, robot
from tests.sim.edit_servos import goals, start, writes_since


def test_on_holds_the_pose_made_by_hand_and_off_lets_go():
    with start() as r:
        r.board.servos[3].push_to(300)
        r.line("on")
        assert r.cell(0, 3) == "0300" and r.cell(0, 1) == "0512"
        assert all(r.board.servos[joint].torque for joint in range(1, 19))
        assert abs(r.board.servos[3].present - 300) <= 1
        r.line("off 3 4")
        assert r.cell(0, 3) == "????" and r.cell(0, 5) == "0512"
        assert not r.board.servos[3].torque and r.board.servos[5].torque
        r.line("off")
        assert not any(r.board.servos[joint].torque for joint in range(1, 19))


def test_off_and_on_take_ranges_of_servos():
    with start() as r:
        r.line("on")
        assert r.line("off 1-3 7") == "off 1-3 7"
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1, 2, 3, 7]
        r.line("on 2-7")
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1]
        r.line("off 6-4")  # reversed range
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1, 4, 5, 6]
        r.line("on 4-6")
        for wrong in ("off 3-", "off -3", "off 1-31", "off 1-x"):
            assert r.line(wrong) == f"{wrong} ID must be 0..30"
        assert [joint for joint in range(1, 19) if not r.board.servos[joint].torque] == [1]


@pytest.mark.parametrize("line", ["on", "on 3", "off"])
def test_without_any_servo_on_and_off_say_so(line):
    with start(servos=()) as r:
        assert r.line(line) == f"{line} No servo answers: check power and cable, then search again"


def test_servos_that_answer_read_only_are_driven_and_not_called_dead():
    with start() as r:
        for joint in range(1, 19):
            r.board.servos[joint].write(16, [1])  # status return level; Edit reads it at its start
        r.board.reset()
        r.terminal.screen.reset()
        r.settle(ms=1500)
        r.line("page 5")
        r.line("on")
        mark = len(r.board.packets)
        r.line("go 0", ms=2000)
        assert "ervo" not in r.message
        assert goals(r)[1] == 400 and r.board.servos[1].table[32] == (512 - 400) // 4
        assert len([packet for packet in writes_since(r, mark) if packet[2] == 1]) == 1  # not sent again


def test_a_servo_in_endless_turn_is_not_used():
    with start() as r:
        r.board.servos[5].write(6, [0, 0, 0, 0])  # angle limits; Edit reads them at its start
        r.board.reset()
        r.terminal.screen.reset()
        r.settle(ms=1500)
        r.line("page 5")
        for line in ("on", "go 0", "off 5", "on 5", "play"):
            r.line(line, ms=2000)
            assert not r.board.servos[5].torque and (line != "on 5" or "Not there: ID 5" in r.message)
        assert r.board.servos[1].torque and r.board.servos[5].goal == 512


def test_teaching_off_pose_on_write():
    with start() as r:
        r.line("off")
        r.board.servos[7].push_to(650)
        r.line("on")
        r.line("write")
        assert r.cell(3, 7) == "0650" and r.cell(9, 9) == "003"
        r.line("save")
        assert r.message.endswith("OK")
        assert int.from_bytes(r.flash_page(5)[64 + 128 + 14 : 64 + 128 + 16], "little") == 650


def test_go_moves_every_joint_in_about_the_same_time():
    with start() as r:
        r.line("on")
        r.line("go 0")
        assert r.text(34, 72, 3) == "000" and r.cell(0, 1) == "0400" and r.cell(0, 31) == "000" and r.cell(0, 32) == "064"
        assert goals(r)[1] == 400 and goals(r)[2] == 700
        assert r.board.servos[1].table[32] == (512 - 400) // 4 and r.board.servos[2].table[32] == (700 - 512) // 4
        r.settle(3000)
        assert abs(r.board.servos[2].present - 700) <= 2


@pytest.mark.parametrize("trim", [100, -100])
def test_the_speed_of_a_single_move_is_that_of_the_way_with_a_trim_too(trim):
    """edit/ORIGINAL.md section 4: the distance / 4. The trim moves both ends of the way."""
    trimmed = page("Offset", [(0, {3: 512}), (0, {3: 512 + trim}), (0, {3: trim & 0xFFFF})])
    with start(pages={0: trimmed, 7: page("pose", [(30, {3: 700})])}) as r:
        r.line("page 7")
        r.line("on")
        r.line("go 0", ms=2500)
        assert r.board.servos[3].goal == 700 + trim and r.board.servos[3].table[32] == (700 + trim - 512) // 4
        r.line("goto 0 3")
        r.line("set 560")
        assert r.board.servos[3].goal == 560 + trim and abs(r.board.servos[3].table[32] - 140 // 4) <= 1


def test_go_asks_behind_the_last_step_and_names_joints_without_a_value():
    with start() as r:
        r.line("on")
        r.line("go 4", "n")
        assert goals(r)[1] == 512
        assert r.line("go 4", "y").endswith("No value, not moved: ID 1-18")
        assert goals(r)[1] == 512


def test_go_never_drives_unused_or_released_joints():
    made = page("part", [(64, {1: 400})])
    made.set_word(0, 2, UNUSED | 100)
    made.set_word(0, 3, 0x2000 | 100)
    with start(pages={11: made}, servos=range(1, 20)) as r:
        r.line("page 11")
        r.line("on")
        message = r.line("go 0")
        r.settle(2000)
        assert "No value, not moved: ID 2 19" in message
        assert r.board.servos[2].goal == 512 and r.board.servos[19].goal == 512
        assert not r.board.servos[3].torque and r.board.servos[3].goal == 512
        assert r.cell(0, 3) == "????" and r.cell(0, 1) == "0400"


def test_mirror_exchanges_the_pairs_and_never_drives_empty_joints():
    with start() as r:
        r.line("on")
        r.line("mirror 0")
        assert goals(r)[1] == 1024 - 700 and goals(r)[2] == 1024 - 400 and goals(r)[3] == 512
        before = goals(r)
        r.line("mirror 5")
        assert goals(r) == before
        r.line("pairs 1 3")
        r.line("mirror 1")
        assert goals(r)[1] == 1024 - 612


def test_set_and_keys_on_the_work_pose_move_the_servo():
    with start() as r:
        r.line("on 4")
        r.line("goto 0 4")
        r.line("set 600")
        assert r.board.servos[4].goal == 600 and r.cell(0, 4) == "0600" and r.board.servos[4].table[32] == 22
        r.settle(2500)
        r.keys("]")
        assert r.board.servos[4].goal == 601
        r.keys("{")
        assert r.board.servos[4].goal == 591 and r.board.servos[4].table[32] == 8
        r.keys(" ", ms=200)
        assert r.cell(0, 4) == "????" and not r.board.servos[4].torque
        r.keys(" ")
        assert r.board.servos[4].torque and r.cell(0, 4) != "????"
        r.line("goto 0 20")
        r.line("set 77")
        assert r.cell(0, 20) == "0077"


def test_page_0_computes_the_trim():
    with start() as r:
        r.line("page 0")
        assert r.terminal.row(34)[19:40] == "STP7  MSTR SLAV OFST "
        r.line("goto 1 3")
        r.line("set 512")
        r.line("goto 2 3")
        r.line("set 500")
        assert r.cell(3, 3) == "-012"
        r.line("step 3")
        r.line("save")
        assert r.message.startswith("save OK")
        r.line("page 5")
        r.line("on")
        r.line("go 1")
        assert r.board.servos[3].goal == 612 - 12 and r.cell(0, 3) == "0612"


def test_a_page_is_played_with_the_trim_while_page_0_is_open():
    trimmed = page("Offset", [(0, {3: 512}), (0, {3: 500}), (0, {3: 50})])
    with start(pages={0: trimmed, 7: page("pose", [(30, {3: 600})])}) as r:
        r.line("page 0")
        r.keys("play 7\r", ms=3000)
        assert r.message.endswith("OK") and r.board.servos[3].goal == 650
        assert r.cell(0, 3) == "0650"  # the work pose has no trim here, and neither has GO
        r.line("go 0", ms=1000)
        assert r.board.servos[3].goal == 512


@pytest.mark.parametrize("line", [b"play 7\r", request("@move 60 3 200")])
@pytest.mark.parametrize("trim, at", [(-100, 1010), (150, 20)])
def test_a_trimmed_joint_outside_the_range_of_pages_does_not_leap(trim, at, line):
    """60 degrees/s are 1.6 units a tick, from where the joint stands on. The table shows positions of pages."""
    trimmed = page("Offset", [(0, {3: 512}), (0, {3: 512 + trim}), (0, {3: trim & 0xFFFF})])
    with start(pages={0: trimmed, 7: page("pose", [(30, {3: 600})])}) as r:
        r.board.servos[3].push_to(at)
        r.board.run(ms=500)
        r.board.send(line)
        r.board.run(ms=250)
        r.keys(request("@break"), ms=500)
        assert r.cell(0, 3) == ("0000" if trim > 0 else "1023") and abs(r.board.servos[3].goal - at) < abs(trim) - 13
        r.board.send(line)
        r.board.run(ms=1500)
        row = [at] + [frame.goals[3] for frame in r.board.trace if 3 in frame.goals]
        assert len(row) > 150 and max(abs(b - a) for a, b in zip(row, row[1:])) <= 2


def test_a_damaged_trim_is_told_at_the_start():
    image = Image.empty()
    image[0] = page("Offset", [(0, {3: 512}), (0, {3: 500}), (0, {3: 50})])
    motions = bytearray(image.to_bytes())
    with robot(motions=bytes(motions)) as r:
        assert "trim" not in r.show()
    motions[192 + 2 * 3] ^= 1
    with robot(motions=bytes(motions)) as r:
        assert "Page 0 is damaged: no trim" in r.show()


@pytest.mark.parametrize("line", ["go 2", "mirror 2", "write", "write 2", "move 0 2"])
def test_the_trim_is_no_pose(line):
    """As goals its values would be the limits of a joint's range; a pose there would become the trim."""
    with start() as r:
        r.line("page 0")
        r.line("step 2")
        r.line("on")
        before = [r.board.servos[joint].goal for joint in (1, 2, 3)], r.cell(3, 3)
        assert r.line(line) == f"{line} That column is the trim"
        assert ([r.board.servos[joint].goal for joint in (1, 2, 3)], r.cell(3, 3)) == before


@pytest.mark.parametrize("line", ["insert 1", "insert 0", "delete", "delete 0", "swap 1 2", "paste 2"])
def test_the_columns_of_page_0_stay_in_their_places(line):
    """A pose shifted into the trim's column would move every goal."""
    with start() as r:
        r.line("take 0")
        r.line("page 0")
        r.line("step 3")
        r.line("on")
        before = r.show().splitlines()[:30]
        assert r.line(line) == f"{line} Page 0 is the trim: its columns stay"
        assert r.show().splitlines()[:30] == before


def test_copy_of_a_motion_to_page_0_asks():
    with start() as r:
        r.line("page 0")
        before = r.cell(3, 1)
        r.line("copy 5")
        assert "Page 0 holds the trim. Are you sure?[y/N]" in r.command
        r.keys("n")
        assert r.cell(3, 1) == before


def test_exit_restarts_the_controller():
    with start() as r:
        resets = r.board.resets
        r.line("exit", ms=1500)
        r.settle()
        assert r.board.resets == resets + 1 and r.text(2, 76, 4) == "0001"


def test_mon_says_where_it_is():
    with start() as r:
        assert r.line("mon") == r.line("monitor").replace("monitor MON", "mon MON") and "the image Monitor" in r.message
        assert not r.unsaved


def test_space_behind_a_list_switches_no_joint_until_there_was_none_for_a_while():
    """A user scrolls with spaces, and some are left over when the table is back."""
    with start(rows=24) as r:
        r.line("on")
        r.line("goto 0 1")
        r.keys("help\r", ms=700)
        for _ in range(9):
            r.keys(" ", ms=600)
            assert r.board.servos[1].torque
        assert r.text(1, 65, 4) == "pose"
        r.settle(900)
        r.keys(" ")
        assert not r.board.servos[1].torque


def test_held_space_switches_a_joint_once():
    with start() as r:
        r.line("goto 0 1")
        for _ in range(60):
            r.board.send(" ")
            r.board.run(ms=33)
        r.settle()
        assert r.board.servos[1].torque
        r.settle(900)
        r.keys(" ")
        assert not r.board.servos[1].torque
