# SPDX-License-Identifier: Apache-2.0
# Options for the folders that are added after this file: the programs and the readers of files. The programs read
# files from strangers, so an error in a reader should end the program instead of letting a file control the program.
# The engine is not compiled with these options, because it has its own checks and the options take time in its loops.
# The options apply to release builds: sanitizers have their own checks.
# Static programs are linked with -static-pie, which the linker flag -pie of check_pie_supported would override.
if(NOT STARFOCUS_STATIC_PROGRAMS)
  include(CheckPIESupported)
  check_pie_supported()
endif()
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
add_compile_options($<$<CONFIG:Release>:-fstack-protector-strong>
  $<$<CONFIG:Release>:-U_FORTIFY_SOURCE> $<$<CONFIG:Release>:-D_FORTIFY_SOURCE=3>)
add_link_options(-Wl,-z,relro,-z,now)
