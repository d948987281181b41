# SPDX-License-Identifier: MIT
# The journal and who can write flash. The boot loader itself: tests/sim/test_boot_*.py.
m512_unit_test(test_journal SOURCES firmware/common/journal.c tests/fake/fake_flash.c)
m512_unit_test(test_page_service SOURCES firmware/common/page_service.c tests/fake/fake_boot_call.c tests/fake/fake_eeprom.c)
