# SPDX-License-Identifier: MIT
# Finds Unity, the C test framework, and sets UNITY_DIR to the folder of unity.c. In this order:
# -DUNITY_DIR=..., an installed cmock package (Debian 13), the same package unpacked below build/, upstream.
set(UNITY_INSTALLED /usr/share/cmock/vendor/unity/src)
set(UNITY_PRIVATE ${CMAKE_SOURCE_DIR}/build/unity)
if(UNITY_DIR)
    if(NOT EXISTS ${UNITY_DIR}/unity.c)
        message(FATAL_ERROR "UNITY_DIR=${UNITY_DIR} holds no unity.c")
    endif()
    set(UNITY_FOUND_DIR ${UNITY_DIR})
elseif(EXISTS ${UNITY_INSTALLED}/unity.c)
    set(UNITY_FOUND_DIR ${UNITY_INSTALLED})
else()
    execute_process(COMMAND ${CMAKE_SOURCE_DIR}/tools/dev/get_unity ${UNITY_PRIVATE}
                    OUTPUT_VARIABLE UNITY_FOUND_DIR OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE UNITY_RESULT)
    if(NOT UNITY_RESULT EQUAL 0)
        include(FetchContent)
        FetchContent_Declare(unity
            URL https://github.com/ThrowTheSwitch/Unity/archive/refs/tags/v2.5.2.tar.gz
            URL_HASH SHA256=3786de6c8f389be3894feae4f7d8680a02e70ed4dbcce36109c8f8646da2671a)
        FetchContent_Populate(unity)
        set(UNITY_FOUND_DIR ${unity_SOURCE_DIR}/src)
    endif()
endif()
message(STATUS "Unity: ${UNITY_FOUND_DIR}")
set(UNITY_DIR ${UNITY_FOUND_DIR})
