# SPDX-License-Identifier: MIT
# Portable halves of hal/ and the fakes.
m512_unit_test(test_dxl_packet TARGET_TOO SOURCES hal/dxl_packet.c)
m512_unit_test(test_bus_core TARGET_TOO SOURCES hal/bus_core.c hal/dxl_packet.c)
m512_unit_test(test_ring TARGET_TOO SOURCES hal/debounce.c)
