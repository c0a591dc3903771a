// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/cholesky.h"

#include <cholmod.h>

#include "libsheet/base/error.h"
#include "libsheet/linear/cholmod_library.h"

namespace sheet {

namespace {

struct Functions {
  template <class Function> static Function* find(const char* name) { return cholmod_function<Function>(name); }
  decltype(&cholmod_start) start = find<decltype(cholmod_start)>("cholmod_start");
  decltype(&cholmod_finish) finish = find<decltype(cholmod_finish)>("cholmod_finish");
  decltype(&cholmod_analyze) analyze = find<decltype(cholmod_analyze)>("cholmod_analyze");
  decltype(&cholmod_factorize_p) factorize_p = find<decltype(cholmod_factorize_p)>("cholmod_factorize_p");
  decltype(&cholmod_solve2) solve2 = find<decltype(cholmod_solve2)>("cholmod_solve2");
  decltype(&cholmod_free_factor) free_factor = find<decltype(cholmod_free_factor)>("cholmod_free_factor");
  decltype(&cholmod_free_dense) free_dense = find<decltype(cholmod_free_dense)>("cholmod_free_dense");
};

const Functions& library() {
  static const Functions instance;
  return instance;
}

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

// CHOLMOD takes matrices by pointers to what it does not change.
cholmod_sparse view(const SparseLower& a, bool values) {
  cholmod_sparse s{};
  s.nrow = s.ncol = static_cast<std::size_t>(a.size);
  s.nzmax = a.rows.size();
  s.p = const_cast<int*>(a.starts.data());
  s.i = const_cast<int*>(a.rows.data());
  s.x = values ? const_cast<double*>(a.values.data()) : nullptr;
  s.stype = -1;
  s.itype = CHOLMOD_INT;
  s.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = 1;
  s.packed = 1;
  return s;
}

} // namespace

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
