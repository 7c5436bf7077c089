# SPDX-License-Identifier: Apache-2.0
# Adds the program refocus to a consumer project. LANGUAGE is the only language of the project. The target `run` runs
# the program, in the emulator of the toolchain file, if any, and writes the output to the file sums.
if(LANGUAGE STREQUAL "CXX")
  set(CMAKE_CXX_STANDARD 17)
  add_executable(refocus ${CMAKE_CURRENT_LIST_DIR}/refocus.cc)
else()
  set(CMAKE_C_STANDARD 99)
  set(CMAKE_C_EXTENSIONS OFF)
  add_executable(refocus ${CMAKE_CURRENT_LIST_DIR}/refocus.c)
endif()
target_compile_options(refocus PRIVATE -Wall -Wextra -pedantic -Werror)
target_link_libraries(refocus PRIVATE starfocus::starfocus)
if(WITH_POOL)
  target_compile_definitions(refocus PRIVATE WITH_POOL)
  target_link_libraries(refocus PRIVATE starfocus::pool)
endif()
add_custom_target(run ALL COMMAND refocus > ${CMAKE_BINARY_DIR}/sums)
