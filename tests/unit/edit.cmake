# SPDX-License-Identifier: MIT
# Edit's logic on the PC: undo and cells alone, the session over the fake flash, the screen over the fake console.
m512_unit_test(test_edit_undo TARGET_TOO SOURCES firmware/edit/undo.c INCLUDES firmware/edit)
m512_unit_test(test_edit_cells TARGET_TOO SOURCES firmware/edit/cells.c INCLUDES firmware/edit)
m512_unit_test(test_edit_keys TARGET_TOO SOURCES firmware/edit/keys.c INCLUDES firmware/edit)
m512_unit_test(test_edit_session
    SOURCES firmware/edit/session.c firmware/edit/undo.c firmware/edit/cells.c firmware/common/page_store.c
        motion/page.c tests/fake/fake_flash.c tests/fake/fake_system.c
    INCLUDES firmware/edit firmware/common)
