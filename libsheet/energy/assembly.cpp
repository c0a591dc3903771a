// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluates chunks of elements in parallel; sums in the order of the chunks.
#include "libsheet/energy/assembly.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include <tbb/parallel_for.h>

#include "libsheet/base/each.h"
#include "libsheet/base/stopwatch.h"

namespace sheet {

namespace {

constexpr std::size_t chunk = 16; // elements

bool on_triangles(Stencil s) { return s == Stencil::triangle || s == Stencil::triangle_edges; }

// Of all triangles, or all vertices, whose terms share the places of their elements.
bool shared(Stencil s) { return on_triangles(s) || s == Stencil::vertex; }

ElementGroup make_group(const Connectivity& mesh, const Term& term) {
  ElementGroup group;
  group.stencil = term.stencil();
  group.width = stencil_vertices(group.stencil) + stencil_edges(group.stencil);
  if (group.stencil == Stencil::vertex) {
    group.nodes.resize(mesh.vertices);
    std::iota(group.nodes.begin(), group.nodes.end(), 0U);
    return group;
  }
  const bool triangles = on_triangles(group.stencil);
  const std::size_t count = triangles ? mesh.triangles.size() : term.size();
  group.nodes.reserve(count * static_cast<std::size_t>(group.width));
  for (std::size_t i = 0; i < count; ++i)
    if (triangles) {
      for (const auto v : mesh.triangles[i])
        group.nodes.push_back(v);
      if (group.stencil == Stencil::triangle_edges)
        for (const auto e : mesh.triangle_edges[i])
          group.nodes.push_back(static_cast<std::uint32_t>(mesh.vertices) + e);
    } else {
      for (const auto v : term.nodes(i))
        group.nodes.push_back(v);
    }
  return group;
}

} // namespace

Assembly::Assembly(std::shared_ptr<const Connectivity> mesh, const Terms& terms, bool angles)
    : mesh_(std::move(mesh)), angles_(angles) {
  // Terms on triangles share one group, with the edges if any of them needs those; so do terms on vertices, and those
  // on the same four vertices, as contacts have three.
  const auto with_edges =
      std::ranges::find_if(terms, [](const auto& t) { return t->stencil() == Stencil::triangle_edges; });
  int of_triangles = -1, of_vertices = -1;
  for (const auto& term : terms) {
    int own = -1;
    int& group = on_triangles(term->stencil()) ? of_triangles : term->stencil() == Stencil::vertex ? of_vertices : own;
    if (group < 0) {
      const bool widen = on_triangles(term->stencil()) && with_edges != terms.end();
      ElementGroup made = make_group(*mesh_, widen ? **with_edges : *term);
      const auto same = std::ranges::find_if(
          groups_, [&](const ElementGroup& g) { return g.stencil == made.stencil && g.nodes == made.nodes; });
      group = static_cast<int>(same - groups_.begin());
      if (same == groups_.end())
        groups_.push_back(std::move(made));
    }
    group_of_term_.push_back(group);
  }
  for (std::size_t t = 0; t < terms.size(); ++t)
    term_order_.push_back(t);
  std::stable_partition(term_order_.begin(), term_order_.end(), [&](std::size_t t) {
    return terms[t]->stencil() == groups_[static_cast<std::size_t>(group_of_term_[t])].stencil;
  });
  std::size_t elements = 0, entries = 0;
  for (ElementGroup& group : groups_) {
    stride_ = std::max(stride_, stencil_unknowns(group.stencil));
    group.first = elements;
    group.first_hessian = entries;
    elements += group.size();
    entries += group.size() * static_cast<std::size_t>(packed_size(group.stencil));
  }
  gradient_numbers_ = elements * static_cast<std::size_t>(stride_);
  gradients_ = std::make_unique_for_overwrite<double[]>(gradient_numbers_);
  // A cache line more, as MatrixPattern asks for what follows early.
  hessians_ = std::make_unique_for_overwrite<double[]>(entries + 8);
  seconds_.assign(terms.size() + 1, 0.0);
}

std::vector<Edge> Assembly::vertex_graph() const {
  const std::size_t vertices = mesh_->vertices;
  const auto each_edge = [&](auto&& visit) {
    for (const Edge& e : mesh_->edges)
      visit(e[0], e[1]);
    for (const ElementGroup& group : groups_)
      if (!shared(group.stencil))
        for (std::size_t i = 0; i < group.nodes.size(); i += 4)
          for (std::size_t a = 0; a < 4; ++a)
            for (std::size_t b = 0; b < a; ++b)
              visit(group.nodes[i + a], group.nodes[i + b]);
  };
  std::vector<std::uint32_t> start(vertices + 1, 0), last(vertices);
  each_edge([&](std::uint32_t a, std::uint32_t b) { ++start[std::min(a, b) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  std::vector<std::uint32_t> higher(start.back());
  std::copy_n(start.begin(), vertices, last.begin());
  each_edge([&](std::uint32_t a, std::uint32_t b) { higher[last[std::min(a, b)]++] = std::max(a, b); });
  each_in_parallel(vertices, [&](std::size_t v) {
    const auto first = higher.begin() + start[v], end = higher.begin() + last[v];
    std::sort(first, end);
    last[v] = static_cast<std::uint32_t>(std::unique(first, end) - higher.begin());
  });
  std::vector<Edge> graph;
  graph.reserve(higher.size());
  for (std::uint32_t v = 0; v < vertices; ++v)
    for (std::uint32_t k = start[v]; k < last[v]; ++k)
      graph.push_back({v, higher[k]});
  return graph;
}

void Assembly::set_order(std::span<const std::uint32_t> vertex_order) {
  std::vector<std::uint32_t> order;
  order.reserve(vertex_order.size() + mesh_->edges.size());
  if (angles_) {
    std::vector<std::uint32_t> rank(mesh_->vertices), start(mesh_->vertices + 1, 0), edges(mesh_->edges.size());
    for (std::uint32_t k = 0; k < vertex_order.size(); ++k)
      rank[vertex_order[k]] = k;
    const auto first = [&](std::size_t e) { return std::min(rank[mesh_->edges[e][0]], rank[mesh_->edges[e][1]]); };
    for (std::size_t e = 0; e < edges.size(); ++e)
      ++start[first(e) + 1];
    for (std::size_t k = 0; k < vertex_order.size(); ++k)
      start[k + 1] += start[k];
    std::vector<std::uint32_t> next(start.begin(), start.end() - 1);
    for (std::uint32_t e = 0; e < edges.size(); ++e)
      edges[next[first(e)]++] = e;
    for (std::size_t k = 0; k < vertex_order.size(); ++k) {
      for (std::uint32_t s = start[k]; s < start[k + 1]; ++s)
        order.push_back(static_cast<std::uint32_t>(mesh_->vertices) + edges[s]);
      order.push_back(vertex_order[k]);
    }
  } else {
    order.assign(vertex_order.begin(), vertex_order.end());
  }
  pattern_.emplace(mesh_->vertices, angles_ ? mesh_->edges.size() : 0, groups_, stride_, order);
}

template <class Visit> void Assembly::each_chunk(Visit&& visit) const {
  struct Chunk {
    int group;
    std::size_t first, last;
  };
  std::vector<Chunk> chunks;
  for (int g = 0; g < static_cast<int>(groups_.size()); ++g)
    for (std::size_t i = 0; i < groups_[g].size(); i += chunk)
      chunks.push_back({g, i, std::min(groups_[g].size(), i + chunk)});
  tbb::parallel_for(std::size_t{0}, chunks.size(),
                    [&](std::size_t c) { visit(c, chunks[c].group, chunks[c].first, chunks[c].last); });
}

void Assembly::collect(const ElementGroup& group, std::size_t first, std::size_t last, const Unknowns& u,
                       double* out) const {
  const std::uint32_t vertices = static_cast<std::uint32_t>(mesh_->vertices);
  for (std::size_t i = first; i < last; ++i, out += stride_) {
    const std::uint32_t* n = &group.nodes[i * static_cast<std::size_t>(group.width)];
    double* to = out;
    for (int a = 0; a < group.width; ++a)
      if (n[a] < vertices) {
        const double* from = u.data() + 3 * std::size_t{n[a]};
        to[0] = from[0], to[1] = from[1], to[2] = from[2];
        to += 3;
      } else {
        *to++ = u[3 * std::size_t{vertices} + (n[a] - vertices)];
      }
  }
}

std::size_t Assembly::chunks() const {
  std::size_t total = 0;
  for (const auto& group : groups_)
    total += (group.size() + chunk - 1) / chunk;
  return total;
}

void Assembly::prepare(const Terms& terms, const Unknowns& u) const {
  if (terms.size() != group_of_term_.size())
    throw std::logic_error("assembly of other terms than it was made for");
  for (const auto& term : terms)
    term->prepare(u);
}

EnergySum Assembly::value(const Terms& terms, const Unknowns& u) {
  prepare(terms, u);
  std::vector<EnergySum> sums(chunks());
  each_chunk([&](std::size_t c, int g, std::size_t first, std::size_t last) {
    double local[chunk * 12];
    collect(groups_[g], first, last, u, local);
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (group_of_term_[t] == g)
        sums[c].add(terms[t]->values(first, last, local, stride_));
  });
  EnergySum sum;
  for (const EnergySum& s : sums)
    sum.add(s);
  return sum;
}

void Assembly::gather_gradient(const Constraints& constraints, Eigen::VectorXd& gradient) {
  pattern_->gather_gradient(gradients_.get(), gradient);
  constraints.project(gradient);
}

EnergySum Assembly::gradient(const Terms& terms, const Unknowns& u, const Constraints& constraints,
                             Eigen::VectorXd& gradient) {
  prepare(terms, u);
  std::vector<EnergySum> sums(chunks());
  each_chunk([&](std::size_t c, int g, std::size_t first, std::size_t last) {
    double local[chunk * 12];
    collect(groups_[g], first, last, u, local);
    double* gradients = &gradients_[(groups_[g].first + first) * static_cast<std::size_t>(stride_)];
    bool overwrite = true;
    for (const std::size_t t : term_order_)
      if (group_of_term_[t] == g) {
        sums[c].add(terms[t]->add_gradients(first, last, local, stride_, gradients, overwrite));
        overwrite = false;
      }
  });
  gather_gradient(constraints, gradient);
  EnergySum sum;
  for (const EnergySum& s : sums)
    sum.add(s);
  return sum;
}

Eigen::VectorXd Assembly::external_gradient(const Terms& terms, const Unknowns& u) {
  prepare(terms, u);
  std::fill_n(gradients_.get(), gradient_numbers_, 0.0);
  each_chunk([&](std::size_t, int g, std::size_t first, std::size_t last) {
    double local[chunk * 12];
    collect(groups_[g], first, last, u, local);
    double* gradients = &gradients_[(groups_[g].first + first) * static_cast<std::size_t>(stride_)];
    for (std::size_t t = 0; t < terms.size(); ++t)
      if (group_of_term_[t] == g && terms[t]->external())
        (void)terms[t]->add_gradients(first, last, local, stride_, gradients, false);
  });
  Eigen::VectorXd gradient;
  gather_gradient({}, gradient);
  return gradient;
}

EnergySum Assembly::derivatives(const Terms& terms, const Unknowns& u, bool definite, const Constraints& constraints,
                                Eigen::VectorXd& gradient, SparseLower& matrix) {
  prepare(terms, u);
  const std::size_t total = chunks();
  std::vector<EnergySum> sums(total);
  std::vector<double> seconds(total * terms.size(), 0.0);
  each_chunk([&](std::size_t c, int g, std::size_t first, std::size_t last) {
    double local[chunk * 12];
    collect(groups_[g], first, last, u, local);
    const std::size_t place = groups_[g].first + first;
    double* gradients = &gradients_[place * static_cast<std::size_t>(stride_)];
    double hessians[chunk * 144];
    Stopwatch watch;
    bool overwrite = true;
    for (const std::size_t t : term_order_)
      if (group_of_term_[t] == g) {
        sums[c].add(terms[t]->add_derivatives(first, last, local, stride_, gradients, hessians, definite, overwrite));
        overwrite = false;
        seconds[c * terms.size() + t] = watch.lap();
      }
    const std::size_t packed = static_cast<std::size_t>(packed_size(groups_[g].stencil));
    for (std::size_t i = first; i < last; ++i)
      pattern_->pack(groups_[g], i, hessians + (i - first) * static_cast<std::size_t>(stride_ * stride_),
                     &hessians_[groups_[g].first_hessian + i * packed]);
  });
  Stopwatch watch;
  gather_gradient(constraints, gradient);
  pattern_->gather_matrix(hessians_.get(), constraints, matrix);
  seconds_.back() += watch.lap();
  EnergySum sum;
  for (std::size_t c = 0; c < total; ++c) {
    sum.add(sums[c]);
    for (std::size_t t = 0; t < terms.size(); ++t)
      seconds_[t] += seconds[c * terms.size() + t];
  }
  return sum;
}

Eigen::VectorXd Assembly::multiply(const Terms& terms, Kind kind, const Unknowns& u, const Eigen::VectorXd& x) {
  prepare(terms, u);
  std::fill_n(gradients_.get(), gradient_numbers_, 0.0);
  each_chunk([&](std::size_t, int g, std::size_t first, std::size_t last) {
    double at[chunk * 12], along[chunk * 12], hessians[chunk * 144];
    const auto stride = static_cast<std::size_t>(stride_);
    for (std::size_t t = 0; t < terms.size(); ++t) {
      if (group_of_term_[t] != g || !terms[t]->has(kind))
        continue;
      collect(groups_[g], first, last, u, at);
      collect(groups_[g], first, last, x, along);
      terms[t]->hessians_of(kind, first, last, at, stride_, hessians);
      const std::size_t size = static_cast<std::size_t>(stencil_unknowns(terms[t]->stencil()));
      for (std::size_t i = 0; i < last - first; ++i) {
        double* product = &gradients_[(groups_[g].first + first + i) * stride];
        for (std::size_t c = 0; c < size; ++c)
          for (std::size_t r = c; r < size; ++r) { // of the lower triangle alone, which all terms give
            const double h = hessians[i * stride * stride + c * stride + r];
            product[r] += h * along[i * stride + c];
            if (r != c)
              product[c] += h * along[i * stride + r];
          }
      }
    }
  });
  Eigen::VectorXd product;
  gather_gradient({}, product);
  return product;
}

} // namespace sheet
