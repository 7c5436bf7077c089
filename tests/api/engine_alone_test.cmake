# SPDX-License-Identifier: Apache-2.0
# Usage: cmake -DNM=… -DBUILD=… -P engine_alone_test.cmake
# Checks which parts of the library are linked into statically linked programs. A program that only refocuses in its
# own memory must not contain lib/depth, the renderer of the paper and starfocus_create. A program that computes
# disparity maps contains lib/depth. The program starfocus must not contain examples/lab/analysis, the ray tracer or
# tests. The program starfocus-lab contains examples/lab/analysis, the ray tracer and tests.
cmake_minimum_required(VERSION 3.20)

# expect(PROGRAM has|lacks NAME...) checks that PROGRAM has (or lacks) symbols that match each NAME.
function(expect program expected)
  execute_process(COMMAND "${NM}" -C "${BUILD}/${program}" OUTPUT_VARIABLE listing RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "nm failed on ${BUILD}/${program}")
  endif()
  foreach(name IN LISTS ARGN)
    set(found lacks)
    if(listing MATCHES "${name}")
      set(found has)
    endif()
    if(NOT found STREQUAL expected)
      message(SEND_ERROR "${program} ${found} symbols like ${name} (expected: ${expected})")
    endif()
  endforeach()
endfunction()

set(depth "starfocus_(estimate|repair)_|DepthKernels|AddPaths")
set(developers "analysis::" "RayTracer")
expect(minimal has "starfocus_init")
expect(minimal lacks "starfocus_create" "LineScan|line_scan" "FindRuns" ${depth})
expect(starfocus has "LineScan" "FindRuns" ${depth})
expect(starfocus lacks ${developers})
expect(starfocus-lab has ${developers})
