# SPDX-License-Identifier: MIT
# The WebAssembly world: Debian's clang, lld, wasi-libc and compiler-rt for wasm32 (tools/dev/needs/web.apt).
# A module is a reactor: no main(), its functions are called from outside.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_SYSROOT /usr)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# assert() names its file from the top of the tree: a released page must not differ by the folder in which it was built.
get_filename_component(top ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set(CMAKE_C_FLAGS_INIT "-ffile-prefix-map=${top}/= -O3 -fvisibility=hidden -ffunction-sections -fdata-sections")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-mexec-model=reactor -Wl,--gc-sections -Wl,--strip-all -Wl,--export-dynamic")
set(M512_WASM TRUE)
