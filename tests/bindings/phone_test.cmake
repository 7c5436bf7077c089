# SPDX-License-Identifier: Apache-2.0
# cmake -DSOURCE=… -DBUILD=… -P phone_test.cmake: checks that examples/phone focuses on the tapped surface, reports
# errors without writing a file, and takes at most 30 lines of C.
set(frame "${BUILD}/tests/phone_frame.nv12")
set(depth "${BUILD}/tests/phone_depth.u16")
set(out "${BUILD}/tests/phone_out.nv12")
# 128 x 64 pixels of stripes 2 pixels wide. The left half is at 8192 mm (disparity 0.98), and the right half is at
# 512 mm (disparity 15.6). The two bytes of a distance are in the order of the machine, so both bytes are equal: 8224
# (0x2020) and 514 (0x0202).
string(REPEAT "((^^" 32 row)
string(REPEAT "${row}" 64 luma)
string(REPEAT "~" 4096 chroma)
file(WRITE "${frame}" "${luma}${chroma}")
string(ASCII 2 two)
string(REPEAT "  " 16 far)
string(REPEAT "${two}${two}" 16 near)
string(REPEAT "${far}${near}" 16 values)
file(WRITE "${depth}" "${values}")

# Runs the program with the tapped pixel. Sets `result` and `said`.
function(run x y file_of_depth)
  file(REMOVE "${out}")
  execute_process(COMMAND "${BUILD}/phone" "${frame}" "${file_of_depth}" 128 64 ${x} ${y} "${out}"
    RESULT_VARIABLE result ERROR_VARIABLE said)
  set(result "${result}" PARENT_SCOPE)
  set(said "${said}" PARENT_SCOPE)
endfunction()

# Checks that the middle row of the picture has the stripes of the frame in one half, and has lost the stripes in the
# other half. `sharp` and `blurred` are the first columns of 32 pixels inside the halves.
function(expect_focus x sharp blurred)
  run(${x} 32 "${depth}")
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "phone failed at column ${x}: ${said}")
  endif()
  math(EXPR at "32 * 128 + ${sharp}")
  file(READ "${out}" found OFFSET ${at} LIMIT 32 HEX)
  math(EXPR at "32 * 128 + ${blurred}")
  file(READ "${out}" lost OFFSET ${at} LIMIT 32 HEX)
  string(REPEAT "28285e5e" 8 stripes)
  if(NOT found STREQUAL stripes)
    message(FATAL_ERROR "tap at column ${x}: expected the stripes of the frame from column ${sharp} on, found ${found}")
  endif()
  if(lost MATCHES "28|5e")
    message(FATAL_ERROR "tap at column ${x}: expected blurred stripes from column ${blurred} on, found ${lost}")
  endif()
endfunction()

function(expect_error text)
  if(result EQUAL 0 OR NOT said MATCHES "${text}" OR EXISTS "${out}")
    message(FATAL_ERROR "expected an error with '${text}' and no picture, found result ${result}: ${said}")
  endif()
endfunction()

expect_focus(10 4 92)
expect_focus(100 92 4)
run(128 32 "${depth}")
expect_error("a field or an argument is outside its range")
run(10 32 "${frame}")
expect_error("phone_frame.nv12: expected a file of 1024 bytes")
string(REPEAT "${two}" 1023 short)
file(WRITE "${depth}" "${short}")
run(10 32 "${depth}")
expect_error("phone_depth.u16: expected a file of 1024 bytes")
file(REMOVE "${frame}" "${depth}")

file(READ "${SOURCE}/examples/phone/tap_to_focus.c" code)
string(REGEX MATCHALL "\n+[^/\n]" lines "\n${code}")  # starts of lines of code
list(LENGTH lines count)
if(count GREATER 30)
  message(FATAL_ERROR "examples/phone/tap_to_focus.c: expected at most 30 lines of code, found ${count}")
endif()
