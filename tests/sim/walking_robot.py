# SPDX-License-Identifier: MIT
"""A robot with Play that walks without end and without output, for tests of changes to a walk (test_play_shape, _layers, _aim)."""

from m512.files.image import from_bytes
from tests.sim.play_robot import ask, motions, page, robot, tick_of, walk_steps

LOOP, CURVE_R, CURVE_L, EXIT, WAVE = 30, 31, 32, 33, 34


def pages():
    """The pages of the other tests, a walk with partners (30), its turns and its exit, and a wave for joints 3 and 5."""
    image = from_bytes(motions())
    image[LOOP] = page("loop", walk_steps(), next=LOOP, exit=EXIT)
    image[LOOP].data[17], image[LOOP].data[18] = CURVE_R, CURVE_L
    image[LOOP].seal()
    image[CURVE_R] = page("curve r", walk_steps(-40), next=CURVE_R, exit=EXIT)
    image[CURVE_L] = page("curve l", walk_steps(40), next=CURVE_L, exit=EXIT)
    image[EXIT] = page("stand", [(40, {})])
    image[WAVE] = page("wave", [(32, {3: 700, 5: 600}), (32, {3: 650, 5: 640})], joints=(3, 5), next=WAVE, exit=0)
    return image.to_bytes()


def looping(**options):
    """A robot that has walked page 30 for three seconds."""
    board = robot(pages=pages(), **options)
    ask(board, "settings talk 0")
    assert ask(board, f"play {LOOP}").endswith("OK")
    board.run(ms=3000)
    board.clear_trace()
    return board


def where(board):
    """The fields of @where."""
    return dict(field.split("=") for field in ask(board, "@where").split() if "=" in field)


def run_of_a_walk(words, ms=6000):
    """{tick: goals} of a walk during which words are typed at given times: [(ms, word)]."""
    board = looping()
    tick = tick_of(board)
    board.clear_trace()
    begin = board.now_ms
    for at, word in words:
        board.run(ms=max(0, at - (board.now_ms - begin)))
        assert ask(board, word).endswith("OK")
    board.run(ms=ms - (board.now_ms - begin))
    return {tick(frame.cycle): frame.goals for frame in board.trace if len(frame.goals) > 1}
