# SPDX-License-Identifier: Apache-2.0
# cmake -DNM=… -DPROGRAM=… -DWITH=… -DIMAGES=… -DLAB=… -P engine_alone_test.cmake
# A static program that only refocuses R, G, B, in memory of its own, holds nothing of lib/depth,
# nothing of what converts images and nothing of sf_create's; one that makes maps has the first,
# one that refocuses images the second. The program WITH, for users, holds nothing of lib/analysis, of the
# ray tracer and of tests, as the program LAB does.
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

foreach(name "sf_refocus_images" "ImageKernels" "ReadCodes" "YuvToRgb" "ReadDepthRow")
  execute_process(COMMAND "${NM}" -C "${PROGRAM}" OUTPUT_VARIABLE listing)
  if(listing MATCHES "${name}")
    message(SEND_ERROR "${PROGRAM} only refocuses R, G, B, but holds ${name}")
  endif()
  execute_process(COMMAND "${NM}" -C "${IMAGES}" OUTPUT_VARIABLE listing)
  if(NOT listing MATCHES "${name}")
    message(SEND_ERROR "${IMAGES} refocuses images, but has no ${name}: wrong names here")
  endif()
endforeach()

foreach(name "analysis::" "RayTracer" "stress::")
  execute_process(COMMAND "${NM}" -C "${WITH}" OUTPUT_VARIABLE listing)
  if(listing MATCHES "${name}")
    message(SEND_ERROR "${WITH} is for users, but holds ${name}")
  endif()
  execute_process(COMMAND "${NM}" -C "${LAB}" OUTPUT_VARIABLE listing)
  if(NOT listing MATCHES "${name}")
    message(SEND_ERROR "${LAB} is for developers, but has no ${name}: wrong names here")
  endif()
endforeach()

has_depth("${PROGRAM}" alone)
has_depth("${WITH}" with)
execute_process(COMMAND "${NM}" "${PROGRAM}" OUTPUT_VARIABLE listing)
if(listing MATCHES "sf_create" OR NOT listing MATCHES "sf_init")
  message(SEND_ERROR "${PROGRAM} gives its memory to sf_init, but holds sf_create")
endif()
if(alone)
  message(SEND_ERROR "${PROGRAM} only refocuses, but holds what makes disparity maps")
endif()
if(NOT with)
  message(SEND_ERROR "${WITH} makes disparity maps, but nothing of that was found: wrong names here")
endif()
