# SPDX-License-Identifier: MIT
# The AVR world: gcc-avr 5.4 (Debian 12) or newer, avr-libc. Every flag that all AVR code shares stands here.
# The switches are not recorded: gcc 5 would record the folder that a release is built in (tools/release).
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR avr)
set(CMAKE_C_COMPILER avr-gcc)
set(CMAKE_AR avr-gcc-ar)
set(CMAKE_RANLIB avr-gcc-ranlib)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_FLAGS_INIT "-mmcu=atmega128 -Os -gdwarf-4 -gno-record-gcc-switches -flto -ffunction-sections -fdata-sections -fno-common")
# A section that no linker script names is an error: the linker would choose a place for it, in RAM perhaps.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-mmcu=atmega128 -Os -flto -Wl,--gc-sections -Wl,--orphan-handling=error")
set(M512_AVR TRUE)
