# SPDX-License-Identifier: Apache-2.0
# Files of `cmake --install`: headers, both libraries, their CMake package, the pkg-config files, and the program with
# its manual page and completion.
include(CMakePackageConfigHelpers)
set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/starfocus")

install(DIRECTORY lib/include/starfocus TYPE INCLUDE FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
if(TARGET starfocus_pool)
  install(DIRECTORY platform/pool/include/starfocus TYPE INCLUDE)
endif()
# Exports each library separately, since each can be used without the others.
foreach(kind static shared pool)
  if(TARGET starfocus_${kind})
    install(TARGETS starfocus_${kind} EXPORT starfocus_${kind})
    install(EXPORT starfocus_${kind} FILE starfocus-${kind}-targets.cmake NAMESPACE starfocus::
      DESTINATION "${package_dir}")
  endif()
endforeach()

configure_file(cmake/starfocus-config.cmake.in package/starfocus-config.cmake @ONLY)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/package/starfocus-config-version.cmake"
  COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/package/starfocus-config.cmake"
              "${PROJECT_BINARY_DIR}/package/starfocus-config-version.cmake"
  DESTINATION "${package_dir}")

# The pkg-config file computes the prefix from its own location, so that the installed tree can be moved.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  set(pc_prefix "${CMAKE_INSTALL_PREFIX}")
  set(pc_libdir "${CMAKE_INSTALL_FULL_LIBDIR}")
  set(pc_includedir "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
  file(RELATIVE_PATH up "/prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/prefix")
  set(pc_prefix "\${pcfiledir}/${up}")
  set(pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
  set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
set(pc_private "-lm")
if(NOT STARFOCUS_STATIC_DISPATCH)
  set(pc_private "-lhwy -lm")
endif()
configure_file(cmake/starfocus.pc.in package/starfocus.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/package/starfocus.pc"
  DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
if(TARGET starfocus_pool)
  configure_file(cmake/starfocus-pool.pc.in package/starfocus-pool.pc @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/package/starfocus-pool.pc"
    DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endif()

if(TARGET starfocus)
  install(TARGETS starfocus)
  # The build runs the program to write the manual page and the completion.
  install(FILES "${PROJECT_BINARY_DIR}/starfocus.1" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" OPTIONAL)
  install(FILES "${PROJECT_BINARY_DIR}/starfocus.bash" OPTIONAL RENAME starfocus
    DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions")
endif()

if(STARFOCUS_IS_TOP_LEVEL)
  add_custom_target(uninstall
    COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
            -P ${PROJECT_SOURCE_DIR}/cmake/uninstall.cmake
    COMMENT "Removing what was installed last from this build")
endif()
