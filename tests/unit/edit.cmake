# SPDX-License-Identifier: MIT
# Edit's pure modules. What is one with its screen, its commands and the flash: tests/sim/test_edit_*.py, on the image.
foreach(module edit_undo edit_cells page_edit edit_keys)
    string(REGEX REPLACE "^edit_" "" file ${module})
    m512_unit_test(test_${module} TARGET_TOO SOURCES firmware/edit/${file}.c INCLUDES firmware/edit)
endforeach()
