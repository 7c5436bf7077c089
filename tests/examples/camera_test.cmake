# SPDX-License-Identifier: Apache-2.0
# cmake -DPROGRAM=camera -DOUT=FILE -P camera_test.cmake: 12 megapixels go through examples/camera in less
# than 64 MiB, and come out as they always have.
execute_process(COMMAND ${PROGRAM} ${OUT} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "camera failed: ${said}")
endif()
string(REGEX MATCH "peak memory ([0-9.]+) MiB, checksum ([0-9a-f]+)" found "${said}")
set(mebibytes "${CMAKE_MATCH_1}")
set(checksum "${CMAKE_MATCH_2}")
if(NOT found OR mebibytes LESS 10 OR mebibytes GREATER 64)
  message(FATAL_ERROR "expected a peak memory between 10 and 64 MiB, found: ${said}")
endif()
file(SIZE "${OUT}" bytes)
file(REMOVE "${OUT}")
if(NOT bytes EQUAL 36000017)
  message(FATAL_ERROR "expected 36000017 bytes of picture, found ${bytes}")
endif()
set(expected 95d85e12)
if(NOT checksum STREQUAL expected)
  message(FATAL_ERROR "expected the checksum ${expected}, found ${checksum}; an intended change of the "
                      "engine's output belongs into this file")
endif()
message(STATUS "${said}")
