// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/heat/conduction.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "libsheet/base/each.h"
#include "libsheet/base/error.h"
#include "libsheet/geometry/metric.h"
#include "libsheet/linear/elimination_order.h"
#include "libsheet/linear/sparse_lower.h"
#include "libsheet/linear/supernodal_factor.h"

namespace sheet::heat {

namespace {

constexpr double least_area = 1e-4; // of the sum of the squared edge lengths

// The edges in the order of elimination: each goes with the first of its vertices.
std::vector<std::uint32_t> edge_order(const Connectivity& mesh) {
  const std::vector<std::uint32_t> vertices = elimination_order(mesh.vertices, mesh.edges);
  std::vector<std::uint32_t> rank(mesh.vertices), order(mesh.edges.size());
  for (std::uint32_t k = 0; k < vertices.size(); ++k)
    rank[vertices[k]] = k;
  const auto key = [&](std::uint32_t e) { return std::minmax(rank[mesh.edges[e][0]], rank[mesh.edges[e][1]]); };
  for (std::uint32_t e = 0; e < order.size(); ++e)
    order[e] = e;
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    return std::pair<std::uint32_t, std::uint32_t>(key(a)) < std::pair<std::uint32_t, std::uint32_t>(key(b));
  });
  return order;
}

} // namespace

double conducting_area(const Vector3& q) {
  return std::max(0.5 * std::sqrt(std::max(0.0, form_determinant(q))), least_area * q.sum());
}

Conductances::Conductances(const Vector3& q, double volume, double conductivity) {
  const double sum = q.sum();
  if (sum <= 0)
    return;
  const double area = conducting_area(q);
  const double per_square = conductivity * volume / area; // k h
  for (std::size_t i = 0; i < 3; ++i)                     // e_j·e_k = (|e_i|² - |e_j|² - |e_k|²)/2
    off[i] = per_square * (2 * q[static_cast<Eigen::Index>(i)] - sum) / (2 * area);
  exchange = 144 * per_square * area / sum;
}

Vector3 Conductances::fluxes(double exchanged, const Vector3& edges) const {
  const double d01 = edges[0] - edges[1], d12 = edges[1] - edges[2], d20 = edges[2] - edges[0];
  const Vector3 along(off[2] * d01 - off[1] * d20, off[0] * d12 - off[2] * d01, off[1] * d20 - off[0] * d12);
  return along.array() + exchanged / 3;
}

struct EdgeSystem::Impl {
  // Where an entry of the matrix comes from: the triangle and its edge (of the diagonal) or the edge opposite the pair.
  struct Source {
    std::uint32_t triangle;
    std::uint32_t edge;
  };

  std::vector<std::uint32_t> order; // edges, in the order of elimination
  std::vector<std::uint32_t> first_source;
  std::vector<Source> sources; // of entry p: first_source[p] to first_source[p + 1]
  SparseLower matrix;
  Eigen::VectorXd scale, load;
  SupernodalFactor<double> factor;

  explicit Impl(const Connectivity& mesh);
  void fill(std::span<const Conductances> conductances, std::span<const double> weights);
};

EdgeSystem::Impl::Impl(const Connectivity& mesh) : order(edge_order(mesh)) {
  struct Entry {
    std::uint32_t row;
    Source source;
  };
  const auto size = static_cast<std::uint32_t>(order.size());
  std::vector<std::uint32_t> rank(size);
  for (std::uint32_t c = 0; c < size; ++c)
    rank[order[c]] = c;
  matrix.size = static_cast<int>(size);
  matrix.starts.push_back(0);
  first_source.push_back(0);
  NodeGraph graph{{0}, {0}, {}};
  std::vector<Entry> column;
  for (std::uint32_t c = 0; c < size; ++c) {
    column.clear();
    for (const std::uint32_t t : mesh.edge_triangles[order[c]]) {
      if (t == no_index)
        continue;
      const auto& edges = mesh.triangle_edges[t];
      const auto own = static_cast<std::uint32_t>(std::ranges::find(edges, order[c]) - edges.begin());
      column.push_back({c, {t, own}});
      for (std::uint32_t by = 1; by <= 2; ++by)
        if (const std::uint32_t other = rank[edges[(own + by) % 3]]; other > c)
          column.push_back({other, {t, (own + 3 - by) % 3}});
    }
    std::ranges::stable_sort(column, {}, &Entry::row);
    for (std::size_t k = 0; k < column.size(); ++k) {
      if (k == 0 || column[k].row != column[k - 1].row) {
        if (k > 0)
          first_source.push_back(static_cast<std::uint32_t>(sources.size()));
        matrix.rows.push_back(static_cast<int>(column[k].row));
        if (column[k].row != c)
          graph.later.push_back(static_cast<int>(column[k].row));
      }
      sources.push_back(column[k].source);
    }
    first_source.push_back(static_cast<std::uint32_t>(sources.size()));
    matrix.starts.push_back(static_cast<int>(matrix.rows.size()));
    graph.first.push_back(static_cast<int>(c + 1));
    graph.start.push_back(static_cast<int>(graph.later.size()));
  }
  matrix.values.resize(matrix.rows.size());
  scale.resize(matrix.size);
  load.resize(matrix.size);
  factor.analyze(graph);
}

void EdgeSystem::Impl::fill(std::span<const Conductances> conductances, std::span<const double> weights) {
  each_in_parallel(order.size(), [&](std::size_t c) {
    const auto first = static_cast<std::size_t>(matrix.starts[c]), end = static_cast<std::size_t>(matrix.starts[c + 1]);
    double diagonal = 0;
    for (std::uint32_t s = first_source[first]; s < first_source[first + 1]; ++s) {
      const auto [t, i] = sources[s];
      diagonal += weights[t] - conductances[t].off[(i + 1) % 3] - conductances[t].off[(i + 2) % 3];
    }
    matrix.values[first] = diagonal > 0 ? diagonal : 1; // edges of points conduct nothing
    scale[static_cast<Eigen::Index>(c)] = 1 / std::sqrt(matrix.values[first]);
    for (std::size_t p = first + 1; p < end; ++p) {
      double value = 0;
      for (std::uint32_t s = first_source[p]; s < first_source[p + 1]; ++s)
        value += conductances[sources[s].triangle].off[sources[s].edge] + weights[sources[s].triangle];
      matrix.values[p] = value;
    }
  });
}

EdgeSystem::EdgeSystem(const Connectivity& mesh) : impl_(std::make_unique<Impl>(mesh)) {}
EdgeSystem::~EdgeSystem() = default;
EdgeSystem::EdgeSystem(EdgeSystem&&) noexcept = default;
EdgeSystem& EdgeSystem::operator=(EdgeSystem&&) noexcept = default;

void EdgeSystem::factorize(std::span<const Conductances> conductances, std::span<const double> weights) {
  impl_->fill(conductances, weights);
  if (!impl_->factor.factorize(impl_->matrix, impl_->scale, 0))
    fail(ExitCode::not_converged, "conduction of heat: the matrix is not positive definite; are temperatures, volumes "
                                  "and positions finite?");
}

std::vector<double> EdgeSystem::solve(std::span<const Vector3> loads) {
  Impl& own = *impl_;
  each_in_parallel(own.order.size(), [&](std::size_t c) {
    const auto diagonal = static_cast<std::size_t>(own.matrix.starts[c]);
    double sum = 0;
    for (std::uint32_t s = own.first_source[diagonal]; s < own.first_source[diagonal + 1]; ++s)
      sum += loads[own.sources[s].triangle][own.sources[s].edge];
    own.load[static_cast<Eigen::Index>(c)] = own.scale[static_cast<Eigen::Index>(c)] * sum;
  });
  const Eigen::VectorXd solved = own.factor.solve(own.load);
  std::vector<double> x(own.order.size());
  for (std::size_t c = 0; c < x.size(); ++c)
    x[own.order[c]] = own.scale[static_cast<Eigen::Index>(c)] * solved[static_cast<Eigen::Index>(c)];
  return x;
}

} // namespace sheet::heat
