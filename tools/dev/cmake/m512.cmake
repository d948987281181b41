# SPDX-License-Identifier: MIT
# How this project builds things: warnings, images, unit tests, target tests, simulator tests.

# Warnings are errors, in both worlds.
set(M512_WARNINGS -Wall -Wextra -Werror -Wshadow -Wconversion -Wundef -Wstrict-prototypes -Wmissing-prototypes
    -Wold-style-definition -Wwrite-strings -Wpointer-arith)
if(M512_AVR)
    # gcc 5.4 warns of every `u8 += u8` and `u8 << n` under -Wconversion; the host build has the useful half.
    list(REMOVE_ITEM M512_WARNINGS -Wconversion)
endif()
set(M512_SANITIZE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)

# m512_image(<target> BOARD cm5|cm2 KIND app|boot|test SOURCES ... [DIR sub] [DEFINES ...] [OPTIONS ...])
# OPTIONS: compiler options of this image alone, given to the link-time compiler as well.
# Links one AVR image and writes <target>.elf and <target>.hex below build/firmware[/sub].
# app, boot: at the addresses of linker/memory_map.h; test: a program of its own from address 0.
function(m512_image target)
    cmake_parse_arguments(ARG "" "BOARD;KIND;DIR" "SOURCES;DEFINES;OPTIONS" ${ARGN})
    set(out ${M512_FIRMWARE_DIR}/${ARG_DIR})
    add_executable(${target} ${ARG_SOURCES})
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}
        ${CMAKE_SOURCE_DIR}/hal/avr ${CMAKE_SOURCE_DIR}/hal ${CMAKE_SOURCE_DIR}/motion ${CMAKE_SOURCE_DIR}/linker)
    target_compile_definitions(${target} PRIVATE F_CPU=16000000UL ${ARG_DEFINES})
    if(ARG_BOARD STREQUAL "cm2")
        target_compile_definitions(${target} PRIVATE BOARD_PINS_H="pins_cm2.h")
    else()
        target_compile_definitions(${target} PRIVATE BOARD_PINS_H="pins_cm5.h")
    endif()
    target_compile_options(${target} PRIVATE ${M512_WARNINGS} ${ARG_OPTIONS})
    target_link_options(${target} PRIVATE ${ARG_OPTIONS})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${out} SUFFIX .elf)
    if(NOT ARG_KIND STREQUAL "test")
        add_custom_command(OUTPUT ${target}.ld
            COMMAND ${CMAKE_C_COMPILER} -E -P -x c -I${CMAKE_SOURCE_DIR}/linker
                    ${CMAKE_SOURCE_DIR}/linker/${ARG_KIND}.ld.in -o ${target}.ld
            DEPENDS ${CMAKE_SOURCE_DIR}/linker/${ARG_KIND}.ld.in ${CMAKE_SOURCE_DIR}/linker/memory_map.h
            VERBATIM)
        add_custom_target(${target}_ld DEPENDS ${target}.ld)
        add_dependencies(${target} ${target}_ld)
        target_link_options(${target} PRIVATE -T ${CMAKE_CURRENT_BINARY_DIR}/${target}.ld)
        set_target_properties(${target} PROPERTIES LINK_DEPENDS
            "${CMAKE_SOURCE_DIR}/linker/${ARG_KIND}.ld.in;${CMAKE_SOURCE_DIR}/linker/memory_map.h")
    endif()
    target_link_options(${target} PRIVATE -Wl,-Map=${out}/${target}.map)
    # The last step of linking: what an image says of itself (tools/dev/app_record).
    string(REGEX MATCH "^(play|edit)" kind ${target})
    if(NOT kind)
        set(kind other)
    endif()
    if(ARG_KIND STREQUAL "app")
        add_custom_command(TARGET ${target} POST_BUILD COMMAND ${CMAKE_SOURCE_DIR}/tools/dev/app_record app
            ${out}/${target}.elf --board ${ARG_BOARD} --kind ${kind} --version ${PROJECT_VERSION})
    elseif(ARG_KIND STREQUAL "boot")
        add_custom_command(TARGET ${target} POST_BUILD COMMAND ${CMAKE_SOURCE_DIR}/tools/dev/app_record boot ${out}/${target}.elf)
    endif()
    add_custom_command(TARGET ${target} POST_BUILD
        COMMAND avr-objcopy -O ihex -R .eeprom -R .fuse -R .lock -R .noinit ${out}/${target}.elf ${out}/${target}.hex)
endfunction()

# m512_pack_texts(<image> <variable> SOURCE...)
# Packs the texts of these sources, together, into the build folder (tools/dev/pack_texts): <variable> becomes the list of
# sources to build instead. The image's include path must have the originals' folders.
function(m512_pack_texts image variable)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${image}-texts)
    set(made ${folder}/texts.c)
    foreach(source ${ARGN})
        get_filename_component(name ${source} NAME)
        list(APPEND made ${folder}/${name})
    endforeach()
    set(tool ${CMAKE_SOURCE_DIR}/tools/dev/pack_texts)
    add_custom_command(OUTPUT ${made} BYPRODUCTS ${folder}/texts.h ${folder}/text_pairs.h ${folder}/texts.txt
        COMMAND ${tool} --out ${folder} ${ARGN} DEPENDS ${tool} ${ARGN} COMMENT "Packing the texts of ${image}" VERBATIM)
    add_custom_target(${image}-texts DEPENDS ${made})
    set(${variable} ${made} PARENT_SCOPE)
endfunction()

# unity: the C test framework, compiled once a world.
# m512_unity(): makes that target on first use.
function(m512_unity)
    if(TARGET unity)
        return()
    endif()
    add_library(unity OBJECT ${UNITY_DIR}/unity.c)
    target_include_directories(unity PUBLIC ${UNITY_DIR})
    target_compile_options(unity PRIVATE -w)
    if(M512_AVR)
        target_include_directories(unity PUBLIC ${CMAKE_SOURCE_DIR}/tests/target)
        target_compile_definitions(unity PUBLIC UNITY_INCLUDE_CONFIG_H F_CPU=16000000UL)
    else()
        target_compile_options(unity PRIVATE ${M512_SANITIZE})
    endif()
endfunction()

# m512_checked(<variable> SOURCE...)
# Production and fake sources (paths from the top) for programs of the PC, with all warnings, ASan and UBSan. Each is
# compiled once, whoever links it: <variable> becomes the list of their objects.
set(M512_CHECKED_INCLUDES . tests/fake tests/unit hal motion linker firmware/common)
list(TRANSFORM M512_CHECKED_INCLUDES PREPEND ${CMAKE_SOURCE_DIR}/)
function(m512_checked variable)
    set(objects)
    foreach(source ${ARGN})
        string(REGEX REPLACE "[/.]" "_" name checked_${source})
        if(NOT TARGET ${name})
            add_library(${name} OBJECT ${CMAKE_SOURCE_DIR}/${source})
            target_include_directories(${name} PRIVATE ${M512_CHECKED_INCLUDES} ${UNITY_DIR})
            target_compile_options(${name} PRIVATE ${M512_WARNINGS} ${M512_SANITIZE})
        endif()
        list(APPEND objects $<TARGET_OBJECTS:${name}>)
    endforeach()
    set(${variable} ${objects} PARENT_SCOPE)
endfunction()

# m512_unit_test(<test_name> SOURCES ... [INCLUDES ...] [TARGET_TOO])
# One Unity program from <test_name>.c in the current folder and the production sources it links.
# Host world: a ctest under ASan and UBSan. With TARGET_TOO: the AVR world builds the same file as
# build/firmware/tests/<test_name>.hex, and the host world runs that on the simulated ATmega128 as ctest target.<name>.
# INCLUDES: folders of headers that the test itself needs beyond M512_CHECKED_INCLUDES.
function(m512_unit_test name)
    cmake_parse_arguments(ARG "TARGET_TOO" "" "SOURCES;INCLUDES" ${ARGN})
    list(TRANSFORM ARG_INCLUDES PREPEND ${CMAKE_SOURCE_DIR}/)
    string(REGEX REPLACE "^test_" "" short ${name})
    m512_unity()
    if(M512_AVR)
        if(ARG_TARGET_TOO)
            list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_SOURCE_DIR}/)
            m512_image(${name} BOARD cm5 KIND test DIR tests SOURCES ${name}.c ${ARG_SOURCES}
                ${CMAKE_SOURCE_DIR}/tests/target/target_main.c ${CMAKE_SOURCE_DIR}/hal/avr/trap.c)
            target_include_directories(${name} PRIVATE ${ARG_INCLUDES})
            target_link_libraries(${name} PRIVATE unity)
        endif()
        return()
    endif()
    m512_checked(objects ${ARG_SOURCES})
    add_executable(${name} ${name}.c ${objects})
    target_include_directories(${name} PRIVATE ${M512_CHECKED_INCLUDES} ${ARG_INCLUDES})
    target_compile_options(${name} PRIVATE ${M512_WARNINGS} ${M512_SANITIZE})
    target_link_options(${name} PRIVATE ${M512_SANITIZE})
    target_link_libraries(${name} PRIVATE unity)
    add_test(NAME unit.${short} COMMAND ${name})
    if(ARG_TARGET_TOO)
        add_test(NAME target.${short} COMMAND target_runner ${M512_FIRMWARE_DIR}/tests/${name}.hex)
    endif()
endfunction()

# m512_pytest(<ctest name> <file or folder> [TIMEOUT s] [COST s]): a pytest file, run with the interpreter of the project's
# virtual environment (build/venv, made by tools/dev/setup) when there is one. COST: see tests/CMakeLists.txt.
# No plugins: no test needs one, and pytest would rewrite the whole of hypothesis for its plugin (0.6 s a file). What Python compiles
# is kept in build/pycache.
function(m512_pytest name path)
    cmake_parse_arguments(ARG "" "TIMEOUT;COST" "" ${ARGN})
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 600)
    endif()
    if(NOT ARG_COST)
        set(ARG_COST 3)
    endif()
    add_test(NAME ${name} COMMAND ${M512_PYTHON} -m pytest -q -p no:cacheprovider ${CMAKE_CURRENT_SOURCE_DIR}/${path})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} COST ${ARG_COST}
        ENVIRONMENT "PYTHONPATH=${CMAKE_SOURCE_DIR}/tools/sim/python:${CMAKE_SOURCE_DIR}/tools/m512/src:${CMAKE_SOURCE_DIR}/tools/body/src:${CMAKE_SOURCE_DIR}/tools/campaign;PYTHONPYCACHEPREFIX=${CMAKE_SOURCE_DIR}/build/pycache;PYTEST_DISABLE_PLUGIN_AUTOLOAD=1;M512_BUILD=${CMAKE_SOURCE_DIR}/build")
endfunction()

if(NOT M512_AVR)
    if(EXISTS ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
        set(M512_PYTHON ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
    else()
        find_package(Python3 REQUIRED COMPONENTS Interpreter)
        set(M512_PYTHON ${Python3_EXECUTABLE})
    endif()
endif()
