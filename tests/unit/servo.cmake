# SPDX-License-Identifier: MIT
# The simulator's servos and their wire.
set(servo_sources tools/sim/servo.c tools/sim/servo_motion.c tools/sim/servo_fault.c tools/sim/servo_protocol.c
    tools/sim/servo_bus.c)
foreach(test test_servo test_servo_bus test_servo_fault)
    m512_unit_test(${test} SOURCES ${servo_sources} INCLUDES tools/sim)
    if(TARGET ${test})
        target_link_libraries(${test} PRIVATE m)
    endif()
endforeach()
