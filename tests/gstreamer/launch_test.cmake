# SPDX-License-Identifier: Apache-2.0
# cmake -DBUILD=… -P launch_test.cmake: checks that GStreamer's tools find and describe the element without warnings, and
# that a pipeline with 16-bit depth of a lower rate and size passes all frames.
find_program(INSPECT gst-inspect-1.0)
find_program(LAUNCH gst-launch-1.0)
if(NOT INSPECT OR NOT LAUNCH)
  message("SKIPPED: gst-inspect-1.0 and gst-launch-1.0 not found (Debian: gstreamer1.0-tools)")
  return()
endif()
set(ENV{GST_PLUGIN_PATH} "${BUILD}/lib/gstreamer-1.0")
set(ENV{GST_REGISTRY} "${BUILD}/tests/gstreamer_registry.bin")
set(ENV{GST_DEBUG} "2")  # prints warnings
set(ENV{G_DEBUG} fatal-warnings)
foreach(name videotestsrc starfocus)
  execute_process(COMMAND ${INSPECT} ${name} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE warnings)
  if(name STREQUAL "videotestsrc" AND NOT result EQUAL 0)
    message("SKIPPED: videotestsrc not found (Debian: gstreamer1.0-plugins-base)")
    return()
  endif()
endforeach()
if(NOT result EQUAL 0 OR NOT warnings STREQUAL "" OR NOT text MATCHES "disparity-white +: .*controllable")
  message(FATAL_ERROR "gst-inspect-1.0 starfocus: expected a description without warnings, found ${text}${warnings}")
endif()

set(out "${BUILD}/tests/gstreamer.nv12")
set(video videotestsrc num-buffers=30 ! video/x-raw,format=NV12,width=64,height=48,framerate=30/1)
set(depth videotestsrc num-buffers=5 pattern=gradient ! video/x-raw,format=GRAY16_LE,width=16,height=12,framerate=5/1)
file(REMOVE "${out}")
execute_process(COMMAND ${LAUNCH} -q ${video} ! refocus.video ${depth} ! refocus.depth
  starfocus name=refocus focus=8 shape=disc stabilise=true ! filesink location=${out}
  RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said TIMEOUT 60)
file(SIZE "${out}" bytes)
file(REMOVE "${out}")
math(EXPR expected "30 * 64 * 48 * 3 / 2")
if(NOT result EQUAL 0 OR NOT bytes EQUAL expected)
  message(FATAL_ERROR "gst-launch-1.0: expected ${expected} bytes, found ${bytes}, result ${result}: ${said}")
endif()
