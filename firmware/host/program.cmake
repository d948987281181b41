# SPDX-License-Identifier: MIT
# Play and Edit as programs for a PC: the sources of the images, over hal/host instead of hal/avr.
set(M512_HOST_SOURCES hal/host/bus.c hal/host/console.c hal/host/echo.c hal/host/memory.c hal/host/panel.c hal/host/system.c
    hal/host/time.c firmware/common/page_service.c firmware/host/program.c)
# The machine below them, and the beginning.
set(M512_PC_SOURCES firmware/host/main.c hal/host/pc/files.c hal/host/pc/machine.c hal/host/pc/options.c hal/host/pc/port.c
    hal/host/pc/terminal.c)

# m512_program(<name> IMAGE <folder of the image> SOURCES ... [DEFINES ...])
function(m512_program name)
    cmake_parse_arguments(ARG "" "IMAGE" "SOURCES;DEFINES" ${ARGN})
    set(host_sources ${M512_HOST_SOURCES})
    if(NOT M512_WASM)
        list(APPEND host_sources ${M512_PC_SOURCES})
    endif()
    list(TRANSFORM host_sources PREPEND ${CMAKE_SOURCE_DIR}/)
    set(sources ${ARG_SOURCES} ${host_sources})
    list(REMOVE_DUPLICATES sources)
    add_executable(${name} ${sources})
    m512_program_settings(${name} ${ARG_IMAGE} ${ARG_DEFINES})
    if(M512_WASM)
        m512_web_settings(${name} ${ARG_IMAGE})
    endif()
endfunction()

# For the page in the browser: build/wasm/servos-<image>.wasm. The page is the machine below it, so machine.h is imported.
function(m512_web_settings name image)
    # The host build has the warnings; each version of clang finds others.
    target_compile_options(${name} PRIVATE -Wno-conversion -Wno-error)
    target_link_options(${name} PRIVATE -Wl,--export=program_start
        -Wl,--allow-undefined-file=${CMAKE_SOURCE_DIR}/hal/host/web/machine.syms)
    set_target_properties(${name} PROPERTIES OUTPUT_NAME servos-${image} SUFFIX .wasm
        RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR} LINK_DEPENDS ${CMAKE_SOURCE_DIR}/hal/host/web/machine.syms)
endfunction()

function(m512_program_settings name image)
    target_include_directories(${name} PRIVATE ${CMAKE_SOURCE_DIR}/firmware/${image} ${CMAKE_SOURCE_DIR}/firmware/common
        ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/hal/host ${CMAKE_SOURCE_DIR}/hal ${CMAKE_SOURCE_DIR}/motion ${CMAKE_SOURCE_DIR}/linker)
    string(REPLACE . , version ${PROJECT_VERSION})
    target_compile_definitions(${name} PRIVATE _GNU_SOURCE PROGRAM_VERSION=${version} ${ARGN})
    target_compile_options(${name} PRIVATE ${M512_WARNINGS})
    # The main of the image is called by the main of firmware/host.
    set_source_files_properties(${CMAKE_SOURCE_DIR}/firmware/${image}/main.c PROPERTIES
        COMPILE_OPTIONS "-Dmain=image_main;-Wno-missing-prototypes")
endfunction()

# The same in simulated time (hal/host/simtime): a shared object, which begins anew each time that it is loaded.
# m512_simtime_program(<name> ...), as above
function(m512_simtime_program name)
    if(M512_WASM)
        return()
    endif()
    cmake_parse_arguments(ARG "" "IMAGE" "SOURCES;DEFINES" ${ARGN})
    set(host_sources ${M512_HOST_SOURCES})
    list(TRANSFORM host_sources PREPEND ${CMAKE_SOURCE_DIR}/)
    set(sources ${ARG_SOURCES} ${host_sources})
    list(REMOVE_DUPLICATES sources)
    add_library(${name} MODULE EXCLUDE_FROM_ALL ${sources})
    m512_program_settings(${name} ${ARG_IMAGE} ${ARG_DEFINES})
    # Its own functions, whatever the program that loads it has of the same name.
    target_compile_options(${name} PRIVATE -O2 -fno-semantic-interposition)
    target_link_options(${name} PRIVATE -Wl,-Bsymbolic)
endfunction()
