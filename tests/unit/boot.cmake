# SPDX-License-Identifier: MIT
# The journal, who can write flash, and the pure halves of the boot loader.
m512_unit_test(test_journal SOURCES firmware/common/journal.c tests/fake/fake_flash.c)
