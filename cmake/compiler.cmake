# SPDX-License-Identifier: GPL-3.0-or-later
# Flags of every target: warnings, sanitizers, reproducible floating point.
add_library(sheet_flags INTERFACE)
target_compile_options(sheet_flags INTERFACE -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion
                                             -Wnon-virtual-dtor -Woverloaded-virtual)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  # GCC 12 is wrong about "literal" + std::string (PR105651) and about variants that may hold a std::string.
  target_compile_options(sheet_flags INTERFACE -Wno-restrict -Wno-free-nonheap-object)
endif()
if(CMAKE_UNITY_BUILD)
  # Where sources are compiled together, those with an Impl of their own are not the main file, and GCC takes it for one of
  # a header.
  target_compile_options(sheet_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
endif()
# GCC looks for what it can free whenever its memory has doubled, from 128 MB on: an eighth of its time. From 1 GB on.
target_compile_options(sheet_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:--param=ggc-min-heapsize=1000000>)
if(SHEET_WERROR)
  target_compile_options(sheet_flags INTERFACE -Werror)
endif()
# The same input gives the same bits: no contraction that depends on the compiler's mood.
target_compile_options(sheet_flags INTERFACE -ffp-contract=off)
if(SHEET_SANITIZE)
  target_compile_options(sheet_flags INTERFACE -fsanitize=address,undefined -fno-sanitize-recover=undefined
                                               -fno-omit-frame-pointer)
  # The sanitizer opens modules in a program's stead, and only the older kind of path is known to it then.
  target_link_options(sheet_flags INTERFACE -fsanitize=address,undefined -Wl,--disable-new-dtags)
endif()
if(SHEET_FUZZ)
  target_compile_options(sheet_flags INTERFACE -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
                                               -fno-omit-frame-pointer)
  target_link_options(sheet_flags INTERFACE -fsanitize=address,undefined)
endif()
