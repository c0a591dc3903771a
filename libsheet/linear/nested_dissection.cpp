// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/linear/nested_dissection.h"

#include <cholmod.h>

#include "libsheet/base/error.h"
#include "libsheet/linear/cholmod_library.h"

namespace sheet {

namespace {

constexpr int by_csymamd = 2;

void quiet(int, const char*, int, const char*) {}

// CHOLMOD takes matrices by pointers to what it does not change.
cholmod_sparse view(const SparseLower& a) {
  cholmod_sparse s{};
  s.nrow = s.ncol = static_cast<std::size_t>(a.size);
  s.nzmax = a.rows.size();
  s.p = const_cast<int*>(a.starts.data());
  s.i = const_cast<int*>(a.rows.data());
  s.stype = -1;
  s.itype = CHOLMOD_INT;
  s.xtype = CHOLMOD_PATTERN;
  s.dtype = CHOLMOD_DOUBLE;
  s.sorted = 1;
  s.packed = 1;
  return s;
}

} // namespace

void nested_dissection(const SparseLower& structure, std::size_t least, std::vector<int>& order) {
  static const auto start = cholmod_function<decltype(cholmod_start)>("cholmod_start");
  static const auto finish = cholmod_function<decltype(cholmod_finish)>("cholmod_finish");
  static const auto dissect = cholmod_function<decltype(cholmod_nested_dissection)>("cholmod_nested_dissection");
  cholmod_common common;
  start(&common);
  common.error_handler = quiet;
  common.print = 0;
  common.current = 0;
  common.method[0].nd_small = least;
  common.method[0].nd_camd = by_csymamd;
  common.method[0].nd_compress = 0; // no two vertices of a sheet have the same neighbours
  cholmod_sparse s = view(structure);
  std::vector<int> parents(s.nrow), parts(s.nrow);
  const auto found = dissect(&s, nullptr, 0, order.data(), parents.data(), parts.data(), &common);
  const int status = common.status;
  finish(&common);
  if (found < 0)
    fail(ExitCode::internal, "no order found for {} vertices (status {})", s.nrow, status);
}

} // namespace sheet
