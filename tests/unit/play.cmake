# SPDX-License-Identifier: MIT
# What Play and Edit share above the hardware: the line shell, the remote control, the play engine; and Play's inputs.
foreach(test test_shell test_shell_line)
    m512_unit_test(${test} TARGET_TOO INCLUDES firmware/common
        SOURCES firmware/common/shell.c firmware/common/shell_line.c firmware/common/shell_words.c firmware/common/text.c tests/unit/shell_stage.c)
endforeach()
m512_unit_test(test_channel TARGET_TOO INCLUDES firmware/common
    SOURCES firmware/common/channel.c firmware/common/shell.c firmware/common/shell_line.c firmware/common/shell_words.c firmware/common/text.c)
m512_unit_test(test_remote TARGET_TOO SOURCES hal/remote.c)
foreach(test test_inputs test_steer)
    m512_unit_test(${test} INCLUDES firmware/common firmware/play
        SOURCES firmware/play/inputs.c firmware/play/steer.c motion/link.c motion/page.c motion/shape.c hal/remote.c hal/debounce.c tests/unit/inputs_stage.c
                tests/fake/fake_console.c tests/fake/fake_panel.c tests/fake/fake_time.c)
endforeach()
set(performer_sources performer.c performer_event.c performer_watch.c performer_shape.c
    servo_link_masks.c)
list(TRANSFORM performer_sources PREPEND firmware/common/)
list(APPEND performer_sources tests/unit/fake_servo_link.c tests/unit/performer_stage.c
    tests/fake/fake_bus.c tests/fake/fake_system.c tests/fake/fake_time.c
    ${M512_PLAYER_FULL})
foreach(test test_performer test_performer_drive test_performer_stop test_performer_fault)
    m512_unit_test(${test} INCLUDES firmware/common SOURCES ${performer_sources})
endforeach()
