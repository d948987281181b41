# SPDX-License-Identifier: MIT
# hal/host over a computer that the test controls. Compiled with the numbers of the PC (hal/host/target.h), so these share no objects
# with the tests of the board's code.
if(NOT M512_AVR)
    function(m512_host_unit_test name)
        m512_unity()
        m512_test_main(${name})
        list(TRANSFORM ARGN PREPEND ${CMAKE_SOURCE_DIR}/)
        add_executable(${name} ${CMAKE_CURRENT_BINARY_DIR}/${name}_main.c ${CMAKE_SOURCE_DIR}/tests/fake/fake_machine.c ${ARGN})
        target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/hal/host ${CMAKE_SOURCE_DIR}/hal
            ${CMAKE_SOURCE_DIR}/motion ${CMAKE_SOURCE_DIR}/linker ${CMAKE_SOURCE_DIR}/firmware/common ${CMAKE_SOURCE_DIR}/tests/fake)
        target_compile_options(${name} PRIVATE ${M512_WARNINGS} ${M512_SANITIZE})
        target_link_options(${name} PRIVATE ${M512_SANITIZE})
        target_link_libraries(${name} PRIVATE unity)
        string(REGEX REPLACE "^test_" "" short ${name})
        add_test(NAME unit.${short} COMMAND ${name})
        m512_needs(unit.${short} host:${name})
    endfunction()

    set(lines hal/host/bus.c hal/host/echo.c hal/host/system.c hal/host/console.c hal/host/time.c hal/bus_core.c hal/bus_call.c hal/dxl_packet.c)
    m512_host_unit_test(test_host_echo hal/host/echo.c)
    m512_host_unit_test(test_host_bus ${lines} hal/host/memory.c)
    m512_host_unit_test(test_host_console ${lines} hal/host/memory.c)
    m512_host_unit_test(test_host_memory ${lines} hal/host/memory.c firmware/common/page_service.c firmware/common/journal.c
        firmware/common/settings.c)
endif()
