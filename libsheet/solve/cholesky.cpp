// SPDX-License-Identifier: GPL-3.0-or-later
// The only source that knows CHOLMOD, METIS (through it), OpenBLAS and OpenMP.
#include "libsheet/solve/cholesky.h"

#include <cstdlib>

#include <cholmod.h>
#include <dlfcn.h>

#include "libsheet/base/error.h"

namespace sheet {

namespace {

// The functions used, looked up by name after the environment is set.
struct Library {
  decltype(&cholmod_start) start;
  decltype(&cholmod_finish) finish;
  decltype(&cholmod_analyze) analyze;
  decltype(&cholmod_factorize_p) factorize_p;
  decltype(&cholmod_rcond) rcond;
  decltype(&cholmod_solve2) solve2;
  decltype(&cholmod_nested_dissection) nested_dissection;
  decltype(&cholmod_free_factor) free_factor;
  decltype(&cholmod_free_dense) free_dense;
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
    void* cholmod = dlopen("libcholmod.so.3", RTLD_NOW | RTLD_LOCAL);
    if (!cholmod)
      fail(ExitCode::internal, "the linear solver cannot be loaded: {} (install libcholmod3)", dlerror());
    const auto find = [&](auto& f, const char* name) {
      f = reinterpret_cast<std::remove_reference_t<decltype(f)>>(dlsym(cholmod, name));
      if (!f)
        fail(ExitCode::internal, "libcholmod.so.3 has no function {}", name);
    };
    find(start, "cholmod_start");
    find(finish, "cholmod_finish");
    find(analyze, "cholmod_analyze");
    find(factorize_p, "cholmod_factorize_p");
    find(rcond, "cholmod_rcond");
    find(solve2, "cholmod_solve2");
    find(nested_dissection, "cholmod_nested_dissection");
    find(free_factor, "cholmod_free_factor");
    find(free_dense, "cholmod_free_dense");
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

constexpr int by_csymamd = 2;

void quiet(int, const char*, int, const char*) {}

cholmod_common started() {
  cholmod_common common;
  library().start(&common);
  common.error_handler = quiet;
  common.print = 0;
  common.supernodal = CHOLMOD_SUPERNODAL;
  common.final_ll = 1;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_NATURAL;
  common.postorder = 1;
  return common;
}

cholmod_sparse view(const SparseLower& a, int* starts, int* rows, double* values) {
  cholmod_sparse s{};
  s.nrow = s.ncol = static_cast<std::size_t>(a.size);
  s.nzmax = a.rows.size();
  s.p = starts;
  s.i = rows;
  s.x = values;
  s.stype = -1;
  s.itype = CHOLMOD_INT;
  s.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = 1;
  s.packed = 1;
  return s;
}

// CHOLMOD takes matrices by pointers to what it does not change.
cholmod_sparse view(const SparseLower& a, bool values) {
  return view(a, const_cast<int*>(a.starts.data()), const_cast<int*>(a.rows.data()),
              values ? const_cast<double*>(a.values.data()) : nullptr);
}

} // namespace

std::string blas_core_name() { return library().core; }

void nested_dissection(const SparseLower& structure, std::size_t least, std::vector<int>& order) {
  cholmod_common common = started();
  common.current = 0;
  common.method[0].nd_small = least;
  common.method[0].nd_camd = by_csymamd;
  common.method[0].nd_compress = 0; // no two vertices of a sheet have the same neighbours
  cholmod_sparse s = view(structure, false);
  std::vector<int> parents(s.nrow), parts(s.nrow);
  const auto found = library().nested_dissection(&s, nullptr, 0, order.data(), parents.data(), parts.data(), &common);
  library().finish(&common);
  if (found < 0)
    fail(ExitCode::internal, "no order found for {} vertices (status {})", s.nrow, common.status);
}

struct Cholesky::Impl {
  cholmod_common common = started();
  cholmod_factor* factor = nullptr;
  cholmod_dense *x = nullptr, *y = nullptr, *e = nullptr;

  void release() {
    if (factor)
      library().free_factor(&factor, &common);
    for (cholmod_dense** d : {&x, &y, &e})
      if (*d)
        library().free_dense(d, &common);
  }
  ~Impl() {
    release();
    library().finish(&common);
  }
};

Cholesky::Cholesky() : impl_(std::make_unique<Impl>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;
Cholesky& Cholesky::operator=(Cholesky&&) noexcept = default;

void Cholesky::analyze(const SparseLower& structure) {
  impl_->release();
  cholmod_sparse s = view(structure, false);
  impl_->factor = library().analyze(&s, &impl_->common);
  if (!impl_->factor)
    fail(ExitCode::internal, "CHOLMOD could not analyse a matrix of {} rows (status {})", structure.size,
         impl_->common.status);
}

bool Cholesky::factorize(const SparseLower& a, double shift) {
  cholmod_sparse s = view(a, true);
  double beta[2] = {shift, 0};
  library().factorize_p(&s, beta, nullptr, 0, impl_->factor, &impl_->common);
  if (impl_->common.status == CHOLMOD_OUT_OF_MEMORY)
    fail(ExitCode::io, "out of memory while factorising {} unknowns", a.size);
  return impl_->common.status == CHOLMOD_OK && impl_->factor->minor == impl_->factor->n;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const {
  cholmod_dense rhs{};
  rhs.nrow = rhs.d = rhs.nzmax = static_cast<std::size_t>(b.size());
  rhs.ncol = 1;
  rhs.x = const_cast<double*>(b.data());
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  library().solve2(CHOLMOD_A, impl_->factor, &rhs, nullptr, &impl_->x, nullptr, &impl_->y, &impl_->e, &impl_->common);
  return Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(impl_->x->x), b.size());
}

double Cholesky::flops() const { return impl_->common.fl; }
double Cholesky::factor_entries() const { return impl_->common.lnz; }

} // namespace sheet
