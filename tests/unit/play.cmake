# SPDX-License-Identifier: MIT
# What Play and Edit share above the hardware: the line shell, the remote control.
m512_unit_test(test_shell SOURCES firmware/common/shell.c firmware/common/text.c INCLUDES firmware/common)
m512_unit_test(test_remote SOURCES hal/remote.c)
