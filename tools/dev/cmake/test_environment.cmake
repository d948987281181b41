# SPDX-License-Identifier: MIT
# ctest reads this before it runs a test. What Python compiles is kept in build/pycache, for the programs that a test starts as well,
# also where the user's environment says that Python keeps nothing: to compile pytest again takes 0.6 s a file.
set(ENV{PYTHONDONTWRITEBYTECODE} "")
cmake_path(SET build NORMALIZE "${CMAKE_CURRENT_LIST_DIR}/../../../build")
set(ENV{PYTHONPYCACHEPREFIX} "${build}/pycache")
