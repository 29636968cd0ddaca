# SPDX-License-Identifier: LGPL-2.1-or-later
# Warnings for our own code, no debug information in Release, a faster linker and a compiler cache where they are installed.

add_library(signorini_options INTERFACE)
target_compile_options(signorini_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wfloat-conversion -Wnon-virtual-dtor
  -Woverloaded-virtual
  # Later versions of GCC follow null pointers into deal.II's and the standard templates, to where none can be.
  $<$<VERSION_LESS:$<CXX_COMPILER_VERSION>,13>:-Wnull-dereference>
  -Wno-unused-local-typedefs -Wno-missing-braces -Werror
  # Debian's deal.II hands on the -g of its own package, which nearly doubles the time of a build.
  $<$<CONFIG:Release>:-g0>)

if(SIGNORINI_SANITIZE)
  # -O0 takes a hundred times as long. What is left out more than halves the time to compile and to run: the address
  # sanitizer stops at null pointers and outside of objects too, Eigen asserts its alignment itself, and wrong dynamic
  # types go unseen, of which contact has hardly any.
  add_compile_options(-O1 -fsanitize=address,undefined -fno-sanitize=null,alignment,object-size,vptr
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# Debian 13's deal.II hands on the linker of its own package too, which need not be there.
string(REGEX REPLACE "-fuse-ld=[^ ]*" "" DEAL_II_LINKER_FLAGS "${DEAL_II_LINKER_FLAGS}")
find_program(LLD_LINKER ld.lld)
if(LLD_LINKER)
  add_link_options(-fuse-ld=lld)
endif()

find_program(CCACHE ccache)
if(CCACHE)
  # A precompiled header needs these two, or every lookup misses.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime ${CCACHE})
  add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:-fpch-preprocess>)
endif()
