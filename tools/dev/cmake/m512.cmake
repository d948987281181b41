# SPDX-License-Identifier: MIT
# How this project builds things: warnings, images, unit tests, target tests, simulator tests.

# Warnings are errors, in both worlds. Handlers of a table and stubs of a feature need not use all that they are given.
set(M512_WARNINGS -Wall -Wextra -Wno-unused-parameter -Werror -Wvla -Wshadow -Wconversion -Wundef -Wstrict-prototypes -Wmissing-prototypes
    -Wold-style-definition -Wwrite-strings -Wpointer-arith)
if(M512_AVR)
    list(APPEND M512_WARNINGS -Wno-sign-conversion)   # macros of avr-libc
    if(CMAKE_C_COMPILER_VERSION VERSION_LESS 10)
        list(REMOVE_ITEM M512_WARNINGS -Wconversion)  # gcc 5.4 warns of every `u8 += u8`; gcc 14, on Debian 13, does not
    endif()
endif()
set(M512_SANITIZE -fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)

# m512_needs(<test> WORLD:TARGET...): what must be built before the test runs, so that `tools/test NAME` builds no more than
# that. WORLD is host or avr. `web`: the page in the browser; `node`: Node alone. A test of which nothing is noted needs everything.
# m512_write_needs() writes build/host/test_needs.txt, a line a test.
set(M512_NEEDS_BOARD host:cm5sim_shared host:target_runner host:motion_image avr:images avr:sim_programs)
function(m512_needs test)
    string(REPLACE ";" " " needs "${ARGN}")
    set_property(GLOBAL APPEND PROPERTY M512_NEEDS "${test} ${needs}\n")
endfunction()
function(m512_write_needs)
    get_property(needs GLOBAL PROPERTY M512_NEEDS)
    string(REPLACE ";" "" needs "${needs}")
    file(WRITE ${CMAKE_BINARY_DIR}/test_needs.txt "${needs}")
endfunction()

# m512_linker_script(<source.ld.in>)
# Preprocesses a linker script into the file that M512_LINKER_SCRIPTS/<source.ld> names; again when anything that it includes has changed.
set(M512_LINKER_SCRIPTS ${CMAKE_BINARY_DIR}/linker)
function(m512_linker_script source)
    get_filename_component(name ${source} NAME_WLE)
    set(script ${M512_LINKER_SCRIPTS}/${name})
    add_custom_command(OUTPUT ${script}
        COMMAND ${CMAKE_C_COMPILER} -E -P -x c -I${CMAKE_SOURCE_DIR}/linker -MD -MF ${script}.d -MT ${script}
                ${CMAKE_CURRENT_SOURCE_DIR}/${source} -o ${script}
        DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source} DEPFILE ${script}.d VERBATIM)
    add_custom_target(linker-${name} DEPENDS ${script})
endfunction()

# m512_image(<target> BOARD cm5|cm2 KIND app|boot|test SOURCES ... [DIR sub] [SCRIPT name] [DEFINES ...] [OPTIONS ...])
# OPTIONS: compiler options of this image alone, given to the link-time compiler as well.
# Links one AVR image and writes <target>.elf and <target>.hex below build/firmware[/sub].
# app, boot: at the addresses of linker/memory_map.h; test: a program of its own from address 0.
# SCRIPT: the linker script, if it is not that of the kind (m512_linker_script makes it).
# The targets `images` and `sim_programs` build all of the former, and all of the latter but for unit tests.
function(m512_image target)
    cmake_parse_arguments(ARG "" "BOARD;KIND;DIR;SCRIPT" "SOURCES;DEFINES;OPTIONS" ${ARGN})
    set(out ${M512_FIRMWARE_DIR}/${ARG_DIR})
    add_executable(${target} ${ARG_SOURCES})
    set(group images)
    if(ARG_KIND STREQUAL "test")
        set(group sim_programs)
    endif()
    if(NOT target MATCHES "^test_")
        if(NOT TARGET ${group})
            add_custom_target(${group})
        endif()
        add_dependencies(${group} ${target})
    endif()
    target_include_directories(${target} PRIVATE ${CMAKE_SOURCE_DIR}
        ${CMAKE_SOURCE_DIR}/hal/avr ${CMAKE_SOURCE_DIR}/hal ${CMAKE_SOURCE_DIR}/motion ${CMAKE_SOURCE_DIR}/linker)
    target_compile_definitions(${target} PRIVATE F_CPU=16000000UL ${ARG_DEFINES})
    if(ARG_BOARD STREQUAL "cm2")
        target_compile_definitions(${target} PRIVATE BOARD_PINS_H="pins_cm2.h")
    else()
        target_compile_definitions(${target} PRIVATE BOARD_PINS_H="pins_cm5.h")
    endif()
    target_compile_options(${target} PRIVATE ${M512_WARNINGS} ${ARG_OPTIONS})
    if(ARG_KIND STREQUAL "test")
        target_compile_options(${target} PRIVATE -Wno-conversion)   # the numbers of a test are small
    endif()
    target_link_options(${target} PRIVATE ${ARG_OPTIONS})
    set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${out} SUFFIX .elf)
    if(NOT ARG_SCRIPT)
        set(ARG_SCRIPT ${ARG_KIND})
    endif()
    set(script ${M512_LINKER_SCRIPTS}/${ARG_SCRIPT}.ld)
    target_link_options(${target} PRIVATE -T ${script})
    set_target_properties(${target} PROPERTIES LINK_DEPENDS "${script};${CMAKE_SOURCE_DIR}/tools/dev/app_record")
    target_link_options(${target} PRIVATE -Wl,-Map=${out}/${target}.map)
    # The last step of linking: what an image says of itself (tools/dev/app_record).
    string(REGEX MATCH "^(play|edit)" kind ${target})
    if(NOT kind)
        set(kind other)
    endif()
    if(ARG_KIND STREQUAL "app")
        add_custom_command(TARGET ${target} POST_BUILD COMMAND ${CMAKE_SOURCE_DIR}/tools/dev/app_record app
            ${out}/${target}.elf --board ${ARG_BOARD} --kind ${kind} --version ${PROJECT_VERSION})
    elseif(target MATCHES "^boot-")
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
        target_include_directories(unity PUBLIC ${CMAKE_SOURCE_DIR}/tests/unit/target)
        target_compile_definitions(unity PUBLIC UNITY_INCLUDE_CONFIG_H F_CPU=16000000UL)
    else()
        target_compile_options(unity PRIVATE ${M512_SANITIZE})
    endif()
endfunction()

# m512_checked(<variable> SOURCE...)
# Production and fake sources (paths from the top) for programs of the PC, with all warnings, ASan and UBSan. Each is
# compiled once, whoever links it: <variable> becomes the list of their objects.
set(M512_CHECKED_INCLUDES . tests/fake hal/host tests/unit hal motion linker firmware/common)
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

# m512_test_main(<test_name>): makes <test_name>_main.c from <test_name>.c in the current folder, the program that runs its tests.
set(M512_TEST_MAIN ${CMAKE_CURRENT_LIST_DIR}/run_tests.awk)
function(m512_test_main name)
    set(test ${CMAKE_CURRENT_SOURCE_DIR}/${name}.c)
    add_custom_command(OUTPUT ${name}_main.c COMMAND awk -v test=${test} -f ${M512_TEST_MAIN} ${test} > ${name}_main.c
        DEPENDS ${test} ${M512_TEST_MAIN} VERBATIM)
endfunction()

# m512_unit_test(<test_name> SOURCES ... [INCLUDES ...] [TARGET_TOO])
# One Unity program from the tests of <test_name>.c in the current folder and the production sources it links.
# Host world: a ctest under ASan and UBSan. With TARGET_TOO: the AVR world builds the same file as
# build/firmware/tests/<test_name>.hex, and the host world runs that on the simulated ATmega128 as ctest target.<name>.
# INCLUDES: folders of headers that the test itself needs beyond M512_CHECKED_INCLUDES.
# TEST_STRIDE: a test that begins at every tick takes every one on the PC, every seventh on the chip.
function(m512_unit_test name)
    cmake_parse_arguments(ARG "TARGET_TOO" "" "SOURCES;INCLUDES" ${ARGN})
    list(TRANSFORM ARG_INCLUDES PREPEND ${CMAKE_SOURCE_DIR}/)
    string(REGEX REPLACE "^test_" "" short ${name})
    m512_unity()
    set(main ${CMAKE_CURRENT_BINARY_DIR}/${name}_main.c)
    if(M512_AVR)
        if(ARG_TARGET_TOO)
            m512_test_main(${name})
            list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_SOURCE_DIR}/)
            m512_image(${name} BOARD cm5 KIND test DIR tests SOURCES ${main} ${ARG_SOURCES}
                ${CMAKE_SOURCE_DIR}/tests/unit/target/target_main.c ${CMAKE_SOURCE_DIR}/hal/avr/trap.c)
            target_include_directories(${name} PRIVATE ${ARG_INCLUDES})
            target_compile_definitions(${name} PRIVATE TEST_STRIDE=7)
            target_link_libraries(${name} PRIVATE unity)
        endif()
        return()
    endif()
    m512_checked(objects ${ARG_SOURCES})
    m512_test_main(${name})
    add_executable(${name} ${main} ${objects})
    target_include_directories(${name} PRIVATE ${M512_CHECKED_INCLUDES} ${ARG_INCLUDES})
    target_compile_definitions(${name} PRIVATE TEST_STRIDE=1)
    target_compile_options(${name} PRIVATE ${M512_WARNINGS} ${M512_SANITIZE})
    target_link_options(${name} PRIVATE ${M512_SANITIZE})
    target_link_libraries(${name} PRIVATE unity)
    add_test(NAME unit.${short} COMMAND ${name})
    m512_needs(unit.${short} host:${name})
    if(ARG_TARGET_TOO)
        add_test(NAME target.${short} COMMAND target_runner ${M512_FIRMWARE_DIR}/tests/${name}.hex)
        m512_needs(target.${short} host:target_runner avr:${name})
    endif()
endfunction()

# m512_pytest(<ctest name> <file, files or folder> [TIMEOUT s] [COST s] [NEEDS ...]): a pytest file, run with the interpreter of build/venv, where
# the packages of this tree are installed (tools/dev/setup). NEEDS: as for m512_needs, or `nothing`. COST: see tests/CMakeLists.txt.
# A file that leaves cases out is shown as skipped (tests/seen_skips.py). No other plugins: no test needs one.
function(m512_pytest name path)
    cmake_parse_arguments(ARG "" "TIMEOUT;COST" "NEEDS" ${ARGN})
    if(ARG_NEEDS)
        m512_needs(${name} ${ARG_NEEDS})
    endif()
    if(NOT ARG_TIMEOUT)
        set(ARG_TIMEOUT 600)
    endif()
    if(NOT ARG_COST)
        set(ARG_COST 3)
    endif()
    list(TRANSFORM path PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    add_test(NAME ${name} COMMAND ${M512_PYTHON} -m pytest -q -rs -p no:cacheprovider -p tests.seen_skips ${path})
    set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} COST ${ARG_COST} SKIP_RETURN_CODE 77
        ENVIRONMENT "PYTEST_DISABLE_PLUGIN_AUTOLOAD=1;M512_BUILD=${CMAKE_SOURCE_DIR}/build")
endfunction()

if(NOT M512_AVR)
    if(M512_TESTS AND NOT M512_WASM AND (IS_SYMLINK ${CMAKE_SOURCE_DIR}/build/venv OR NOT EXISTS ${CMAKE_SOURCE_DIR}/build/venv/.installed-test))
        message(FATAL_ERROR "The packages of this tree are not in build/venv; run: tools/dev/setup --python test physics")
    endif()
    if(EXISTS ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
        set(M512_PYTHON ${CMAKE_SOURCE_DIR}/build/venv/bin/python)
    else()
        find_package(Python3 REQUIRED COMPONENTS Interpreter)
        set(M512_PYTHON ${Python3_EXECUTABLE})
    endif()
endif()
