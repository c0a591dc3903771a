# SPDX-License-Identifier: GPL-3.0-or-later
# use_precompiled(TARGET...): what nearly all sources include takes half of their time to read, so it is read once. That
# each still names what it uses is held by tests/layers/direct_includes, and by the preset debug, which does without this.
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)

# -fpch-preprocess: for ccache. -pthread: OpenEXR asks for it, and what is precompiled has to be compiled alike.
set(as_precompiled -pthread $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13
   AND NOT CMAKE_DISABLE_PRECOMPILE_HEADERS)
  # What GCC 12 gets wrong about strings (PR105651) is seen in system headers too where they are precompiled.
  list(APPEND as_precompiled -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread)
endif()
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp CONTENT "// Only what is precompiled.\n")
add_library(precompiled OBJECT ${PROJECT_BINARY_DIR}/generated/precompiled.cpp)
target_link_libraries(precompiled PRIVATE sheet_flags Eigen3::Eigen TBB::tbb fmt::fmt)
target_compile_options(precompiled PRIVATE ${as_precompiled})
target_precompile_headers(precompiled PRIVATE <Eigen/Geometry> <algorithm> <filesystem> <fmt/format.h> <functional> <map>
                          <optional> <tbb/parallel_for.h> <variant>)

function(use_precompiled)
  foreach(target ${ARGN})
    target_link_libraries(${target} PRIVATE Eigen3::Eigen TBB::tbb fmt::fmt)
    target_compile_options(${target} PRIVATE ${as_precompiled})
    target_precompile_headers(${target} REUSE_FROM precompiled)
  endforeach()
endfunction()
