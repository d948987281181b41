# SPDX-License-Identifier: MIT
# The simulator's servos and their wire.
set(servo_sources servo.c servo_motor.c servo_motion.c servo_mujoco.c servo_fault.c servo_protocol.c servo_wire.c servo_bus.c
    servo_set.c)
list(TRANSFORM servo_sources PREPEND tools/sim/servo/)
foreach(test test_servo test_servo_motor test_servo_bus)
    m512_unit_test(${test} SOURCES ${servo_sources} INCLUDES tools/sim/servo)
    if(TARGET ${test})
        target_link_libraries(${test} PRIVATE m)
    endif()
endforeach()
