// SPDX-License-Identifier: GPL-3.0-or-later
// All elements of one energy behind one interface, so that a sheet's model is a list of terms. TermOf wraps an element
// class (element.h); calls are made for chunks of elements, never for single ones.
#pragma once
#include <chrono>
#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "libsheet/energy/element.h"
#include "libsheet/energy/energy_sum.h"
#include "libsheet/energy/gap_forces.h"

namespace sheet {

class Term {
public:
  virtual ~Term() = default;
  [[nodiscard]] virtual const char* name() const = 0;
  [[nodiscard]] virtual Stencil stencil() const = 0;
  [[nodiscard]] virtual bool has(Kind kind) const = 0; // whether a part of the Hessian is of that kind
  // Whether it acts from outside the sheet or on its mass, not within the sheet or along walls.
  [[nodiscard]] virtual bool external() const = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual std::array<std::uint32_t, 4> nodes(std::size_t i) const = 0; // hinge and four only
  virtual void begin(const Stage& stage) = 0;
  virtual void prepare(const Unknowns& u) = 0;
  // Newton goes from u by a step, or by a part of it: what its next Hessian needs of that.
  virtual void follow(const Unknowns&, const Unknowns&) {}
  // From now on what yields does so at these rest rates (flow_curve.h), one a liquid [1/s].
  virtual void rest_at(std::span<const double>) {}
  // Elements first to last-1; u: their unknowns, `stride` apart.
  [[nodiscard]] virtual EnergySum values(std::size_t first, std::size_t last, const double* u, int stride) const = 0;
  // Adds to gradients (`stride` apart), or sets those of its own unknowns.
  virtual EnergySum add_gradients(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                                  bool overwrite) const = 0;
  // Adds to gradients (`stride` apart) and Hessians (stride x stride, column major; at least the lower triangles), or
  // sets those of its own unknowns.
  virtual EnergySum add_derivatives(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                                    double* hessians, bool definite, bool overwrite) const = 0;
  // Sets Hessians, exact ones, to the part that is of one kind which the term has: the lower triangles at least.
  virtual void hessians_of(Kind kind, std::size_t first, std::size_t last, const double* u, int stride,
                           double* hessians) const = 0;
  // Adds to each vertex' force what walls do to it along themselves [N].
  virtual void add_wall_forces(const Unknowns&, std::span<Vector3>) const {}
  // Adds to each vertex' forces how two walls share that between them, and their pressure.
  virtual void add_gap_forces(const Unknowns&, GapForces&) const {}
  // Adds to each triangle what its viscosity has dissipated in the stage that leads to u [J].
  virtual void add_dissipated(const Unknowns&, std::span<double>) const {}
  // What else a step leaves in the state, to whose end `last` the last stage led.
  virtual void finish(const Unknowns&, State&) {}
  // A part c g gᵀ of the Hessian that couples all unknowns: returns c >= 0 and, unless that is 0, sets g, one an
  // unknown.
  [[nodiscard]] virtual double rank_one(const Unknowns&, Eigen::VectorXd&) const { return 0; }
};

template <class E> class TermOf final : public Term {
public:
  static constexpr int unknown_count = stencil_unknowns(E::stencil);
  // Some elements are evaluated many at a time.
  static constexpr bool in_batches = requires(const E& e) {
    e.evaluate(0, 0, nullptr, 0, nullptr, nullptr, false, false);
  };
  explicit TermOf(E element) : element_(std::move(element)) {}
  [[nodiscard]] const E& element() const { return element_; }

  [[nodiscard]] const char* name() const override { return element_.name(); }
  [[nodiscard]] Stencil stencil() const override { return E::stencil; }
  [[nodiscard]] bool has(Kind kind) const override {
    if constexpr (requires { element_.has(kind); })
      return element_.has(kind);
    else if constexpr (requires { E::kind; })
      return kind == E::kind;
    else
      return kind == Kind::dissipative;
  }
  [[nodiscard]] bool external() const override {
    if constexpr (requires { E::external; })
      return E::external;
    else
      return false;
  }
  [[nodiscard]] std::size_t size() const override { return element_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const override {
    if constexpr (E::stencil == Stencil::hinge || E::stencil == Stencil::four)
      return element_.nodes(i);
    else
      return {};
  }
  void begin(const Stage& stage) override { element_.begin(stage); }
  void prepare(const Unknowns& u) override {
    if constexpr (requires { element_.prepare(u); })
      element_.prepare(u);
  }

  void follow(const Unknowns& u, const Unknowns& step) override {
    if constexpr (requires { element_.follow(u, step); })
      element_.follow(u, step);
  }

  void rest_at(std::span<const double> rates) override {
    if constexpr (requires { element_.rest_at(rates); })
      element_.rest_at(rates);
  }

  void add_wall_forces(const Unknowns& u, std::span<Vector3> force) const override {
    if constexpr (requires { element_.add_wall_forces(u, force); })
      element_.add_wall_forces(u, force);
  }

  void add_gap_forces(const Unknowns& u, GapForces& forces) const override {
    if constexpr (requires { element_.add_gap_forces(u, forces); })
      element_.add_gap_forces(u, forces);
  }

  void add_dissipated(const Unknowns& u, std::span<double> energy) const override {
    if constexpr (requires { element_.add_dissipated(u, energy); })
      element_.add_dissipated(u, energy);
  }

  void finish(const Unknowns& last, State& end) override {
    if constexpr (requires { element_.finish(last, end); })
      element_.finish(last, end);
  }

  [[nodiscard]] EnergySum values(std::size_t first, std::size_t last, const double* u, int stride) const override {
    if constexpr (in_batches)
      return element_.evaluate(first, last, u, stride, nullptr, nullptr, false, false);
    EnergySum sum;
    for (std::size_t i = first; i < last; ++i, u += stride)
      sum.add(element_.value(i, Eigen::Map<const VectorN<unknown_count>>(u)));
    return sum;
  }

  EnergySum add_gradients(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                          bool overwrite) const override {
    if constexpr (in_batches)
      return element_.evaluate(first, last, u, stride, gradients, nullptr, false, overwrite);
    EnergySum sum;
    VectorN<unknown_count> g;
    for (std::size_t i = first; i < last; ++i, u += stride, gradients += stride) {
      if (!overwrite && idle(i))
        continue;
      const Eigen::Map<const VectorN<unknown_count>> local(u);
      if constexpr (requires { element_.gradient(i, local, g); }) {
        sum.add(element_.gradient(i, local, g));
      } else {
        MatrixN<unknown_count> unused;
        sum.add(element_.derivatives(i, local, g, unused, true));
      }
      Eigen::Map<VectorN<unknown_count>> gradient(gradients, unknown_count);
      if (overwrite)
        gradient = g;
      else
        gradient += g;
    }
    return sum;
  }

  EnergySum add_derivatives(std::size_t first, std::size_t last, const double* u, int stride, double* gradients,
                            double* hessians, bool definite, bool overwrite) const override {
    if constexpr (in_batches)
      return element_.evaluate(first, last, u, stride, gradients, hessians, definite, overwrite);
    if constexpr (requires { E::linear; })
      if (!overwrite)
        return add_gradients(first, last, u, stride, gradients, overwrite);
    EnergySum sum;
    VectorN<unknown_count> g;
    MatrixN<unknown_count> h;
    for (std::size_t i = first; i < last; ++i, u += stride, gradients += stride, hessians += stride * stride) {
      if (!overwrite && idle(i))
        continue;
      sum.add(element_.derivatives(i, Eigen::Map<const VectorN<unknown_count>>(u), g, h, definite));
      Eigen::Map<VectorN<unknown_count>> gradient(gradients, unknown_count);
      Eigen::Map<MatrixN<unknown_count>, 0, Eigen::OuterStride<>> hessian(hessians, unknown_count, unknown_count,
                                                                          Eigen::OuterStride<>(stride));
      if (overwrite) {
        gradient = g;
        hessian = h;
        continue;
      }
      gradient += g;
      if constexpr (!requires { E::linear; })
        hessian += h;
    }
    return sum;
  }

  void hessians_of(Kind kind, std::size_t first, std::size_t last, const double* u, int stride,
                   double* hessians) const override {
    if constexpr (requires { element_.hessians_of(kind, first, last, u, stride, hessians); }) {
      element_.hessians_of(kind, first, last, u, stride, hessians);
    } else {
      std::vector<double> unused((last - first) * static_cast<std::size_t>(stride));
      add_derivatives(first, last, u, stride, unused.data(), hessians, false, true);
    }
  }

  [[nodiscard]] double rank_one(const Unknowns& u, Eigen::VectorXd& g) const override {
    if constexpr (requires { element_.rank_one(u, g); })
      return element_.rank_one(u, g);
    else
      return 0;
  }

private:
  [[nodiscard]] bool idle([[maybe_unused]] std::size_t i) const {
    if constexpr (requires { element_.idle(i); })
      return element_.idle(i);
    else
      return false;
  }

  E element_;
};

template <class E> std::unique_ptr<Term> make_term(E element) {
  return std::make_unique<TermOf<E>>(std::move(element));
}

using Terms = std::vector<std::unique_ptr<Term>>;

} // namespace sheet
