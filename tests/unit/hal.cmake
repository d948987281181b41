# SPDX-License-Identifier: MIT
# Portable halves of hal/ and the fakes.
m512_unit_test(test_dxl_packet TARGET_TOO SOURCES hal/dxl_packet.c)
