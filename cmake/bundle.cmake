# SPDX-License-Identifier: Apache-2.0
# starfocus_add_bundle(TARGET [SOURCE...]): adds a shared object that contains the engine and the thread pool, for
# language bindings that load a single file. The shared object is not part of the default build and does not depend on
# the C++ run time.
function(starfocus_add_bundle target)
  add_library(${target} MODULE EXCLUDE_FROM_ALL ${ARGN}
              $<TARGET_OBJECTS:starfocus_objects> $<TARGET_OBJECTS:starfocus_simd>)
  target_link_libraries(${target} PRIVATE starfocus_highway starfocus_pool m)
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE C LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lib)
endfunction()
