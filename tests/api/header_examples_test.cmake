# SPDX-License-Identifier: Apache-2.0
# Usage: cmake -DSOURCE=… -DBUILD=… -DCC=… -P header_examples_test.cmake
# Compiles the examples in the comments of the public headers as C11, with warnings as errors.
foreach(header starfocus depth matte)
  file(READ ${SOURCE}/lib/include/starfocus/${header}.h text)
  if(NOT text MATCHES "@code\n(.*)@endcode")
    message(FATAL_ERROR "${header}.h: expected an example between @code and @endcode, found none")
  endif()
  string(REGEX REPLACE "\n \\* ?" "\n" example "\n${CMAKE_MATCH_1}")
  set(file ${BUILD}/tests/${header}_example.c)
  file(WRITE ${file} "${example}\n")
  execute_process(
    COMMAND ${CC} -std=c11 -pedantic -Wall -Wextra -Werror -fsyntax-only -I${SOURCE}/lib/include ${file}
    RESULT_VARIABLE result ERROR_VARIABLE output)
  if(result)
    message(FATAL_ERROR "the example of ${header}.h does not compile:\n${output}")
  endif()
endforeach()
