// SPDX-License-Identifier: GPL-3.0-or-later
// CHOLMOD, METIS (through it), OpenBLAS and OpenMP: loaded on first use, so that two of their defaults can be mended
// first: OpenBLAS takes new processors for an old one (OPENBLAS_CORETYPE, unless the user set it), and CHOLMOD opens
// OpenMP threads of its own.
#pragma once
#include <string>

namespace sheet {

// The function of that name. Throws Error (internal) where the library cannot be loaded or has none.
[[nodiscard]] void* find_in_cholmod(const char* name);
template <class Function> [[nodiscard]] Function* cholmod_function(const char* name) {
  return reinterpret_cast<Function*>(find_in_cholmod(name));
}

// The processor that OpenBLAS works for, e.g. "SkylakeX"; print it with every benchmark.
[[nodiscard]] std::string blas_core_name();

} // namespace sheet
