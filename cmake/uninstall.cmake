# SPDX-License-Identifier: Apache-2.0
# cmake -DMANIFEST=FILE -P uninstall.cmake: removes the files that `cmake --install` listed in FILE, and the folders of
# starfocus that are empty afterwards.
cmake_minimum_required(VERSION 3.20)
if(NOT EXISTS "${MANIFEST}")
  message(FATAL_ERROR "Nothing to uninstall: there is no ${MANIFEST}, which cmake --install writes.")
endif()
file(STRINGS "${MANIFEST}" files)
foreach(file IN LISTS files)
  file(REMOVE "$ENV{DESTDIR}${file}")
  message(STATUS "removed $ENV{DESTDIR}${file}")
  get_filename_component(folder "$ENV{DESTDIR}${file}" DIRECTORY)
  file(GLOB rest "${folder}/*")
  if(folder MATCHES "/starfocus$" AND NOT rest)
    file(REMOVE_RECURSE "${folder}")
  endif()
endforeach()
file(REMOVE "${MANIFEST}")
