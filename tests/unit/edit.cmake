# SPDX-License-Identifier: MIT
# Edit's logic on the PC: undo and cells alone, the session over the fake flash, the screen over the fake console.
m512_unit_test(test_edit_undo TARGET_TOO SOURCES firmware/edit/undo.c INCLUDES firmware/edit)
m512_unit_test(test_edit_cells TARGET_TOO SOURCES firmware/edit/cells.c INCLUDES firmware/edit)
m512_unit_test(test_page_edit TARGET_TOO SOURCES firmware/edit/page_edit.c INCLUDES firmware/edit)
m512_unit_test(test_edit_keys TARGET_TOO SOURCES firmware/edit/keys.c INCLUDES firmware/edit)
m512_unit_test(test_edit_session
    SOURCES firmware/edit/session.c firmware/edit/undo.c firmware/edit/cells.c firmware/common/page_store.c
        motion/page.c tests/fake/fake_flash.c tests/fake/fake_system.c
    INCLUDES firmware/edit firmware/common)

# The whole editor over the fakes, for what is one with its screen and its commands. The image is written for ints of
# 16 bits, where -Wconversion means nothing.
if(NOT M512_AVR)
    file(GLOB stage CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/firmware/edit/*.c ${CMAKE_SOURCE_DIR}/firmware/common/*.c)
    list(REMOVE_ITEM stage ${CMAKE_SOURCE_DIR}/firmware/edit/main.c
        ${CMAKE_SOURCE_DIR}/firmware/common/page_service.c ${CMAKE_SOURCE_DIR}/firmware/common/performer_shape.c)
    list(TRANSFORM M512_PLAYER_SMALL PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE player)
    list(APPEND stage ${player})
    foreach(source hal/bus_call hal/debounce hal/dxl_packet tests/fake/fake_bus tests/fake/fake_console tests/fake/fake_eeprom tests/fake/fake_flash
            tests/fake/fake_panel tests/fake/fake_system tests/fake/fake_time tests/unit/editor_stage)
        list(APPEND stage ${CMAKE_SOURCE_DIR}/${source}.c)
    endforeach()
    add_library(editor_stage STATIC ${stage})
    target_include_directories(editor_stage PUBLIC ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/tests/unit
        ${CMAKE_SOURCE_DIR}/tests/fake ${CMAKE_SOURCE_DIR}/hal/host ${CMAKE_SOURCE_DIR}/hal ${CMAKE_SOURCE_DIR}/motion ${CMAKE_SOURCE_DIR}/linker
        ${CMAKE_SOURCE_DIR}/firmware/common ${CMAKE_SOURCE_DIR}/firmware/edit ${UNITY_DIR})
    target_compile_definitions(editor_stage PUBLIC CONSOLE_TX_BYTES=64 BUS_PACKET_BYTES=102 DXL_ANSWER_PARAMS=20
        PERFORMER_EVENTS=7u SHELL_WORD_COLUMNS=8u SHELL_SHORT_COLUMNS=4u)
    target_compile_options(editor_stage PRIVATE ${M512_WARNINGS} -Wno-conversion -Wno-sign-conversion ${M512_SANITIZE})
    set_target_properties(editor_stage PROPERTIES EXPORT_COMPILE_COMMANDS OFF) # tools/dev/lint knows these from their own image
endif()
foreach(test screen commands editor)
    m512_unit_test(test_edit_${test})
    if(NOT M512_AVR)
        target_link_libraries(test_edit_${test} PRIVATE editor_stage)
    endif()
endforeach()
