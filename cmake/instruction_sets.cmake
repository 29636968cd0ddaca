# SPDX-License-Identifier: LGPL-2.1-or-later
# Sources that are compiled once for each instruction set; the program chooses when it starts.
# Nothing of deal.II may be in them: its inline functions would be compiled for machines that are not there.

# Adds `source` to `target`, with SIGNORINI_INSTRUCTION_SET and SIGNORINI_LANES (numbers of double precision
# in a register) defined and the instruction set allowed.
function(add_for_each_instruction_set target source)
  set(sets baseline)
  set(lanes_of_baseline 2)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|amd64|AMD64")
    list(APPEND sets avx2 avx512)
    set(lanes_of_avx2 4)
    set(lanes_of_avx512 8)
    set(flags_of_avx2 -mavx2 -mfma)
    set(flags_of_avx512 -mavx512f -mavx512vl -mavx512dq -mfma)
  endif()
  foreach(set ${sets})
    set(part ${target}_${set})
    add_library(${part} OBJECT ${source})
    target_include_directories(${part} PRIVATE ${CMAKE_SOURCE_DIR}/include)
    target_compile_definitions(${part} PRIVATE SIGNORINI_INSTRUCTION_SET=${set}
                                               SIGNORINI_LANES=${lanes_of_${set}})
    # Optimised in all build types: only loops that are unrolled make arrays of lanes registers.
    target_compile_options(${part} PRIVATE -O3 -ffp-contract=fast -fno-math-errno -fno-trapping-math -Wno-psabi
      $<$<CXX_COMPILER_ID:GNU>:--param=max-completely-peeled-insns=4000>
      $<$<CXX_COMPILER_ID:GNU>:--param=max-completely-peel-times=16> ${flags_of_${set}})
    target_link_libraries(${part} PRIVATE signorini_options)
    target_sources(${target} PRIVATE $<TARGET_OBJECTS:${part}>)
  endforeach()
endfunction()
