# SPDX-License-Identifier: MIT
# The journal, who can write flash, and the pure halves of the boot loader.
m512_unit_test(test_journal SOURCES firmware/common/journal.c tests/fake/fake_flash.c)
m512_unit_test(test_page_service SOURCES firmware/common/page_service.c tests/fake/fake_boot_call.c tests/fake/fake_eeprom.c)
m512_unit_test(test_boot_parse SOURCES firmware/boot/parse.c TARGET_TOO)
m512_unit_test(test_boot_frame SOURCES firmware/boot/frame.c INCLUDES firmware/common)
