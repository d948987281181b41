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

# m512_image(<target> BOARD cm5|cm2 KIND app|boot|test SOURCES ... [DIR sub] [DEFINES ...] [OPTIONS ...] [ORDER file])
# OPTIONS: compiler options of this image alone, given to the link-time compiler as well.
# ORDER: which function stands beside which (tools/order_functions).
# Links one AVR image and writes <target>.elf and <target>.hex below build/firmware[/sub].
# app, boot: at the addresses of linker/memory_map.h; test: a program of its own from address 0.
function(m512_image target)
    cmake_parse_arguments(ARG "" "BOARD;KIND;DIR;ORDER" "SOURCES;DEFINES;OPTIONS" ${ARGN})
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
        set(order "")
        if(ARG_ORDER)
            set(order -DFUNCTION_ORDER="${ARG_ORDER}")
        endif()
        add_custom_command(OUTPUT ${target}.ld
            COMMAND ${CMAKE_C_COMPILER} -E -P -x c -I${CMAKE_SOURCE_DIR}/linker ${order}
                    ${CMAKE_SOURCE_DIR}/linker/${ARG_KIND}.ld.in -o ${target}.ld
            DEPENDS ${CMAKE_SOURCE_DIR}/linker/${ARG_KIND}.ld.in ${CMAKE_SOURCE_DIR}/linker/memory_map.h ${ARG_ORDER}
            VERBATIM)
        add_custom_target(${target}_ld DEPENDS ${target}.ld)
        add_dependencies(${target} ${target}_ld)
        target_link_options(${target} PRIVATE -T ${CMAKE_CURRENT_BINARY_DIR}/${target}.ld)
        set_target_properties(${target} PROPERTIES LINK_DEPENDS
            "${CMAKE_SOURCE_DIR}/linker/${ARG_KIND}.ld.in;${CMAKE_SOURCE_DIR}/linker/memory_map.h;${ARG_ORDER}")
    endif()
    target_link_options(${target} PRIVATE -Wl,-Map=${out}/${target}.map)
    # The last step of linking: what an image says of itself (tools/app_record).
    string(REGEX MATCH "^(play|edit)" kind ${target})
    if(NOT kind)
        set(kind other)
    endif()
    if(ARG_KIND STREQUAL "app")
        add_custom_command(TARGET ${target} POST_BUILD COMMAND ${CMAKE_SOURCE_DIR}/tools/app_record app
            ${out}/${target}.elf --board ${ARG_BOARD} --kind ${kind} --version ${PROJECT_VERSION})
    elseif(ARG_KIND STREQUAL "boot")
        add_custom_command(TARGET ${target} POST_BUILD COMMAND ${CMAKE_SOURCE_DIR}/tools/app_record boot ${out}/${target}.elf)
    endif()
    add_custom_command(TARGET ${target} POST_BUILD
        COMMAND avr-objcopy -O ihex -R .eeprom -R .fuse -R .lock -R .noinit ${out}/${target}.elf ${out}/${target}.hex)
endfunction()

# m512_pack_texts(<image> <variable> SOURCE...)
# Packs the texts of these sources, together, into the build folder (tools/pack_texts): <variable> becomes the list of
# sources to build instead. The image's include path must have the originals' folders.
function(m512_pack_texts image variable)
    set(folder ${CMAKE_CURRENT_BINARY_DIR}/${image}-texts)
    set(made ${folder}/texts.c)
    foreach(source ${ARGN})
        get_filename_component(name ${source} NAME)
        list(APPEND made ${folder}/${name})
    endforeach()
    set(tool ${CMAKE_SOURCE_DIR}/tools/pack_texts)
    add_custom_command(OUTPUT ${made} BYPRODUCTS ${folder}/texts.h ${folder}/text_pairs.h ${folder}/texts.txt
        COMMAND ${tool} --out ${folder} ${ARGN} DEPENDS ${tool} ${ARGN} COMMENT "Packing the texts of ${image}" VERBATIM)
    add_custom_target(${image}-texts DEPENDS ${made})
    set(${variable} ${made} PARENT_SCOPE)
endfunction()

# m512_unit_test(<test_name> SOURCES ... [INCLUDES ...] [TARGET_TOO])
# One Unity program from <test_name>.c in the current folder and the production sources it links.
# Host world: a ctest under ASan and UBSan. With TARGET_TOO: the AVR world builds the same file as
# build/firmware/tests/<test_name>.hex, and the host world runs that on the simulated ATmega128 as ctest target.<name>.
function(m512_unit_test name)
    cmake_parse_arguments(ARG "TARGET_TOO" "" "SOURCES;INCLUDES" ${ARGN})
    list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_SOURCE_DIR}/)
    list(TRANSFORM ARG_INCLUDES PREPEND ${CMAKE_SOURCE_DIR}/)
    string(REGEX REPLACE "^test_" "" short ${name})
    if(M512_AVR)
        if(ARG_TARGET_TOO)
            m512_image(${name} BOARD cm5 KIND test DIR tests SOURCES ${name}.c ${ARG_SOURCES}
                ${UNITY_DIR}/unity.c ${CMAKE_SOURCE_DIR}/tests/target/target_main.c ${CMAKE_SOURCE_DIR}/hal/avr/trap.c)
            target_include_directories(${name} PRIVATE ${UNITY_DIR} ${CMAKE_SOURCE_DIR}/tests/target ${ARG_INCLUDES})
            target_compile_definitions(${name} PRIVATE UNITY_INCLUDE_CONFIG_H)
            set_source_files_properties(${UNITY_DIR}/unity.c PROPERTIES COMPILE_OPTIONS "-w")
        endif()
        return()
    endif()
    add_executable(${name} ${name}.c ${ARG_SOURCES} ${UNITY_DIR}/unity.c)
    target_include_directories(${name} PRIVATE ${UNITY_DIR} ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/tests/fake
        ${CMAKE_SOURCE_DIR}/hal ${CMAKE_SOURCE_DIR}/motion ${CMAKE_SOURCE_DIR}/linker ${ARG_INCLUDES})
    target_compile_options(${name} PRIVATE ${M512_WARNINGS} ${M512_SANITIZE})
    target_link_options(${name} PRIVATE ${M512_SANITIZE})
    set_source_files_properties(${UNITY_DIR}/unity.c PROPERTIES COMPILE_OPTIONS "-w")
    add_test(NAME unit.${short} COMMAND ${name})
    if(ARG_TARGET_TOO)
        add_test(NAME target.${short} COMMAND target_runner ${M512_FIRMWARE_DIR}/tests/${name}.hex)
    endif()
endfunction()

# m512_pytest(<ctest name> <file or folder> [TIMEOUT s]): a pytest file, run with the interpreter of the project's
# virtual environment (build/venv, made by tools/setup) when there is one.
function(m512_pytest name path)
    cmake_parse_arguments(ARG "" "TIMEOUT" "" ${ARGN})
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 600)
    endif()
    add_test(NAME ${name} COMMAND ${M512_PYTHON} -m pytest -q -p no:cacheprovider ${CMAKE_CURRENT_SOURCE_DIR}/${path})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT}
        ENVIRONMENT "PYTHONPATH=${CMAKE_SOURCE_DIR}/tools/sim/python:${CMAKE_SOURCE_DIR}/tools/m512/src;PYTHONDONTWRITEBYTECODE=1;M512_BUILD=${CMAKE_SOURCE_DIR}/build")
endfunction()

if(NOT M512_AVR)
    if(EXISTS ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
        set(M512_PYTHON ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
    else()
        find_package(Python3 REQUIRED COMPONENTS Interpreter)
        set(M512_PYTHON ${Python3_EXECUTABLE})
    endif()
endif()
