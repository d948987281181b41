# SPDX-License-Identifier: MIT
# Portable halves of hal/ and the fakes.
m512_unit_test(test_dxl_packet TARGET_TOO SOURCES hal/dxl_packet.c)
m512_unit_test(test_bus_core TARGET_TOO SOURCES hal/bus_core.c hal/dxl_packet.c)
m512_unit_test(test_ring TARGET_TOO SOURCES hal/debounce.c)
# The common half of the firmware that stands on them.
m512_unit_test(test_settings SOURCES firmware/common/settings.c tests/fake/fake_eeprom.c INCLUDES firmware/common)
m512_unit_test(test_page_store SOURCES firmware/common/page_store.c motion/page.c tests/fake/fake_flash.c
    tests/fake/fake_system.c INCLUDES firmware/common)
foreach(test test_servo_link test_servo_link_goals test_servo_link_health)
    m512_unit_test(${test} INCLUDES firmware/common SOURCES tests/unit/servo_link_stage.c
        firmware/common/servo_link.c firmware/common/servo_link_masks.c firmware/common/servo_link_setup.c hal/bus_call.c
        hal/dxl_packet.c tests/fake/fake_bus.c tests/fake/fake_system.c tests/fake/fake_time.c)
endforeach()
