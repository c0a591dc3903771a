// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/linear/cholmod_library.h"

#include <cstdlib>

#include <dlfcn.h>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

struct Library {
  void* cholmod = nullptr;
  std::string core = "unknown";

  Library() {
    // OpenBLAS 0.3.21 falls back to a plain SSE3 kernel on processors younger than itself.
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512cd"))
      setenv("OPENBLAS_CORETYPE", "SkylakeX", 0);
    else if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
      setenv("OPENBLAS_CORETYPE", "Haswell", 0);
    setenv("OPENBLAS_NUM_THREADS", "1", 1); // else its threads wait by spinning while the program starts
    void* blas = dlopen("libopenblas.so.0", RTLD_NOW | RTLD_GLOBAL);
    cholmod = dlopen("libcholmod.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!cholmod)
      fail(ExitCode::internal, "the linear solver cannot be loaded: {} (install libcholmod3)", dlerror());
    // Neither BLAS threads nor OpenMP threads inside CHOLMOD gain anything on these sizes (docs/design.md).
    if (blas) {
      if (auto* threads = reinterpret_cast<void (*)(int)>(dlsym(blas, "openblas_set_num_threads")))
        threads(1);
      if (auto* name = reinterpret_cast<char* (*)()>(dlsym(blas, "openblas_get_corename")))
        core = name();
    }
    if (void* omp = dlopen("libgomp.so.1", RTLD_NOW | RTLD_LOCAL))
      if (auto* levels = reinterpret_cast<void (*)(int)>(dlsym(omp, "omp_set_max_active_levels")))
        levels(0);
  }
};

const Library& library() {
  static const Library instance;
  return instance;
}

} // namespace

void* find_in_cholmod(const char* name) {
  void* function = dlsym(library().cholmod, name);
  if (!function)
    fail(ExitCode::internal, "libcholmod.so.3 has no function {}", name);
  return function;
}

std::string blas_core_name() { return library().core; }

} // namespace sheet
