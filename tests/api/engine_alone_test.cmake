# SPDX-License-Identifier: Apache-2.0
# cmake -DNM=… -DBUILD=… -P engine_alone_test.cmake
# A static program that only refocuses, in memory of its own, holds nothing of lib/depth and nothing of starfocus_create's;
# one that makes maps has the first. The program for users holds nothing of lib/analysis, of the ray tracer and of
# tests, as that for developers does.
cmake_minimum_required(VERSION 3.20)

# expect(PROGRAM has|lacks NAME...): of symbols that match each name.
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
set(developers "analysis::" "RayTracer" "stress::")
expect(minimal has "starfocus_init")
expect(minimal lacks "starfocus_create" ${depth})
expect(starfocus has ${depth})
expect(starfocus lacks ${developers})
expect(starfocus-lab has ${developers})
