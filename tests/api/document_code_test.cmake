# SPDX-License-Identifier: Apache-2.0
# Usage: cmake -DSOURCE=… -DBUILD=… -DCC=… -DCXX=… -P document_code_test.cmake
# Compiles the C and C++ code of README.md and docs/library.md, and the examples in the comments of the public headers,
# as C11 and C++17; README.md, and with it starfocus.h, also as C99. Each code block of a document becomes the body of a
# function, after declarations of the variables that the documents do not declare.
set(of_readme [[
static uint8_t view[320 * 200 * 3], out[320 * 200 * 3];
static float disparity[320 * 200];
]])
set(of_library [[
#include <starfocus/depth.h>
#include <starfocus/experimental.h>
#include <starfocus/matte.h>
#include <starfocus/pool.h>
#include <starfocus/video.h>
#include <stdatomic.h>
#include <stdlib.h>
static starfocus_config config;
static starfocus_engine* engine;
static starfocus_params params;
static starfocus_light_field field, light_field, next_rows;
static starfocus_image out, small, next_out;
static starfocus_prepared* prepared;
static starfocus_status status;
static int32_t width, height, x, y, written, rows_at_hand, rows_wanted;
static size_t stride, luma_stride, chroma_stride;
static float* better;
static uint8_t *luma, *chroma, *alpha, *coverage;
static uint16_t* millimetres;
static double focal_length, baseline;
static void* my_arena;
void* take(void* arena, size_t bytes, size_t alignment);
void give_back(void* arena, void* memory, size_t bytes);
int next_frame(starfocus_light_field* frame);
struct task { float share; atomic_int cancelled; };
]])
set(of_library_cpp [[
#include <starfocus/starfocus.hpp>
static starfocus_light_field light_field;
static uint8_t out[1024 * 768 * 3];
static const size_t out_stride = 3 * 1024;
]])

# Writes the code blocks of a document in a language to a file. Sets `count` to the number of blocks.
function(write_code document language declarations file)
  file(READ "${SOURCE}/${document}" text)
  file(WRITE "${file}" "#include <starfocus/starfocus.h>\n#include <stdio.h>\n${declarations}")
  set(blocks 0)
  string(FIND "${text}" "\n```${language}\n" begin)
  while(NOT begin EQUAL -1)
    string(SUBSTRING "${text}" ${begin} -1 text)
    string(FIND "${text}" "\n```\n" end)
    string(LENGTH "\n```${language}\n" skipped)
    math(EXPR length "${end} - ${skipped}")
    string(SUBSTRING "${text}" ${skipped} ${length} code)
    string(REPLACE "\n...\n" "\n" code "${code}")
    math(EXPR blocks "${blocks} + 1")
    if(code MATCHES "^[^\n]*[)] {")  # a function
      file(APPEND "${file}" "${code}\n")
    else()
      file(APPEND "${file}" "void block_${blocks}(void);\nvoid block_${blocks}(void) {\n${code}\n}\n")
    endif()
    string(SUBSTRING "${text}" ${end} -1 text)
    string(FIND "${text}" "\n```${language}\n" begin)
  endwhile()
  set(count ${blocks} PARENT_SCOPE)
endfunction()

# Compiles a file with a compiler and its options, with warnings as errors. The file contains the code of `name`.
function(compile_file name file compiler)
  # clang's -Wall would undo options that precede it.
  execute_process(COMMAND ${compiler} -pedantic -Wall -Wextra -Werror ${ARGN} -fsyntax-only "-I${SOURCE}/lib/include"
    "-I${SOURCE}/platform/pool/include" "${file}" RESULT_VARIABLE result ERROR_VARIABLE output)
  if(result)
    message(FATAL_ERROR "the code of ${name} does not compile:\n${output}")
  endif()
endfunction()

# Compiles the code of a document with a compiler. The document must have `least` blocks or more.
function(compile document language declarations least compiler)
  string(MAKE_C_IDENTIFIER "${document}" name)
  set(file "${BUILD}/tests/${name}.${language}")
  write_code("${document}" ${language} "${declarations}" "${file}")
  compile_file(${document} "${file}" ${compiler} ${ARGN} -Wno-unused -Wno-uninitialized)
  if(count LESS least)
    message(FATAL_ERROR "${document}: expected ${least} or more blocks of ${language}, found ${count}")
  endif()
endfunction()

compile(README.md c "${of_readme}" 1 ${CC} -std=c99 -Wstrict-prototypes)
compile(README.md c "${of_readme}" 1 ${CC} -std=c11)
compile(docs/library.md c "${of_library}" 10 ${CC} -std=c11)
compile(docs/library.md cpp "${of_library_cpp}" 1 ${CXX} -std=c++17)
foreach(header starfocus depth matte)
  file(READ ${SOURCE}/lib/include/starfocus/${header}.h text)
  if(NOT text MATCHES "@code\n(.*)@endcode")
    message(FATAL_ERROR "${header}.h: expected an example between @code and @endcode, found none")
  endif()
  string(REGEX REPLACE "\n \\* ?" "\n" example "\n${CMAKE_MATCH_1}")
  set(file ${BUILD}/tests/${header}_example.c)
  file(WRITE ${file} "${example}\n")
  compile_file(${header}.h ${file} ${CC} -std=c11)
endforeach()
