# SPDX-License-Identifier: Apache-2.0
# cmake -DNM=… -DPROGRAM=… -DWITH=… -P engine_alone_test.cmake
# A static program that only refocuses holds nothing of lib/depth; one that makes maps does.
cmake_minimum_required(VERSION 3.20)

function(has_depth program found)
  execute_process(COMMAND "${NM}" -C "${program}" OUTPUT_VARIABLE listing RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "nm failed on ${program}")
  endif()
  if(listing MATCHES "sf_(estimate|repair)_|DepthKernels|AddPaths")
    set(${found} TRUE PARENT_SCOPE)
  else()
    set(${found} FALSE PARENT_SCOPE)
  endif()
endfunction()

has_depth("${PROGRAM}" alone)
has_depth("${WITH}" with)
if(alone)
  message(SEND_ERROR "${PROGRAM} only refocuses, but holds what makes disparity maps")
endif()
if(NOT with)
  message(SEND_ERROR "${WITH} makes disparity maps, but nothing of that was found: wrong names here")
endif()
