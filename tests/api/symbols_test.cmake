# SPDX-License-Identifier: Apache-2.0
# cmake -DNM=… -DLIBRARY=… -P symbols_test.cmake
# What lib/ and simd/ need of the outside: memory copies, a few functions of C's <math.h>, the
# compiler's own helpers and Highway's choice of target. Nothing of libstdc++ (exceptions, RTTI,
# streams, operator new), no heap and no I/O.
cmake_minimum_required(VERSION 3.20)
execute_process(COMMAND "${NM}" -P "${LIBRARY}" OUTPUT_VARIABLE listing RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "nm failed on ${LIBRARY}")
endif()

set(defined "")
set(needed "")
string(REPLACE "\n" ";" lines "${listing}")
foreach(line IN LISTS lines)
  if(line MATCHES "^([^ ]+) [Uw]")
    list(APPEND needed "${CMAKE_MATCH_1}")
  elseif(line MATCHES "^([^ ]+) [A-Za-z]")
    list(APPEND defined "${CMAKE_MATCH_1}")
  endif()
endforeach()
list(LENGTH defined defined_count)
if(defined_count LESS 50)
  message(FATAL_ERROR "only ${defined_count} symbols found in ${LIBRARY}")
endif()

list(REMOVE_DUPLICATES needed)
list(REMOVE_ITEM needed ${defined})
set(math "tan|sin|cos|exp|log|log2|pow|sqrt|floor|ceil|fabs|round|rint|lrint|lround|trunc|fmin|fmax")
foreach(name IN LISTS needed)
  if(name MATCHES "^_*(cxa|gxx|dynamic_cast|libc)")
    message(SEND_ERROR "needs the C++ run time: ${name}")
  elseif(NOT name MATCHES "^(mem(cpy|set|move|cmp|chr)|(${math})f?|_?_GLOBAL_OFFSET_TABLE_|__.*|_ZN3hwy.*)$")
    message(SEND_ERROR "needs more than the library may: ${name}")
  endif()
endforeach()
list(JOIN needed " " text)
message(STATUS "needed: ${text}")
