// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/energy/assembly.h"

#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "libsheet/energy/contact.h"
#include "libsheet/energy/contact_damping.h"
#include "libsheet/energy/membrane.h"
#include "libsheet/energy/stage_setup.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

// A ball whose vertices are tied together far across it, in no order.
class TiedBall {
public:
  TiedBall() {
    for (std::uint32_t i = 0; i + 10 < s_.mesh->vertices; ++i)
      springs_.push_back({{i + 7, i, i + 10, i + 3},
                          {1, -0.2, -0.5, -0.3},
                          Vector3(1, 2, i).normalized(),
                          0.1,
                          Vector3(0.1, 0, 0.05),
                          {3, 2}});
    stage_ = first_stage(s_, Liquid{.viscosity = 2, .density = 3}, 0.05, 0.05, false);
  }
  TiedBall(const TiedBall&) = delete;
  TiedBall& operator=(const TiedBall&) = delete;

  [[nodiscard]] Terms terms(bool membrane, bool contact, bool damping) const {
    const auto rests = std::make_shared<SpringRests>(springs_, true, *s_.mesh);
    rests->begin(stage_);
    Terms terms;
    if (membrane)
      terms.push_back(make_term(Membrane()));
    if (contact)
      terms.push_back(make_term(Contact(rests, true)));
    if (damping)
      terms.push_back(make_term(ContactDamping(rests, true, true)));
    for (const auto& term : terms)
      term->begin(stage_);
    return terms;
  }

  struct Sums {
    double energy;
    Eigen::VectorXd gradient;
    Eigen::MatrixXd hessian;
  };
  [[nodiscard]] Sums sums(const Terms& terms) const {
    Assembly assembly(s_.mesh, terms, false);
    std::vector<std::uint32_t> order(s_.mesh->vertices);
    std::iota(order.begin(), order.end(), 0U);
    assembly.set_order(order);
    SparseLower lower = assembly.pattern().structure();
    Unknowns u = stage_.begin;
    for (Eigen::Index i = 0; i < u.size(); ++i)
      u[i] += 0.02 * std::sin(static_cast<double>(7 * i));
    Sums sums;
    sums.energy = assembly.derivatives(terms, u, false, {}, sums.gradient, lower).value;
    sums.hessian = Eigen::MatrixXd::Zero(u.size(), u.size());
    for (int c = 0; c < lower.size; ++c)
      for (int p = lower.starts[static_cast<std::size_t>(c)]; p < lower.starts[static_cast<std::size_t>(c) + 1]; ++p)
        sums.hessian(lower.rows[static_cast<std::size_t>(p)], c) = lower.values[static_cast<std::size_t>(p)];
    return sums;
  }

  [[nodiscard]] const std::vector<ContactSpring>& springs() const { return springs_; }
  [[nodiscard]] const State& state() const { return s_; }

private:
  State s_ = test::at_rest(test::icosphere(1), 0.1);
  Stage stage_;
  std::vector<ContactSpring> springs_;
};

// Terms on the same four vertices have one place in the matrix: what stands there is the sum of what each gives.
TEST(Assembly, TermsOnTheSameVerticesAddUp) {
  const TiedBall ball;
  const auto all = ball.sums(ball.terms(true, true, true)), membrane = ball.sums(ball.terms(true, false, false)),
             contact = ball.sums(ball.terms(false, true, false)), damping = ball.sums(ball.terms(false, false, true));
  EXPECT_GT(contact.energy, 0);
  EXPECT_GT(damping.energy, 0);
  EXPECT_NEAR(all.energy, membrane.energy + contact.energy + damping.energy, 1e-12 * all.energy);
  EXPECT_TRUE(all.gradient.isApprox(membrane.gradient + contact.gradient + damping.gradient, 1e-12));
  EXPECT_TRUE(all.hessian.isApprox(membrane.hessian + contact.hessian + damping.hessian, 1e-12));
}

TEST(Assembly, TheGraphHasEachPairOfVerticesThatShareAnElementOnce) {
  const TiedBall ball;
  const Terms terms = ball.terms(true, true, true);
  std::set<Edge> pairs(ball.state().mesh->edges.begin(), ball.state().mesh->edges.end());
  for (const ContactSpring& s : ball.springs())
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b)
        pairs.insert({std::min(s.vertices[a], s.vertices[b]), std::max(s.vertices[a], s.vertices[b])});
  EXPECT_EQ(Assembly(ball.state().mesh, terms, false).vertex_graph(), std::vector<Edge>(pairs.begin(), pairs.end()));
}

} // namespace
} // namespace sheet
