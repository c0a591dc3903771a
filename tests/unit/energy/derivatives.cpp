// SPDX-License-Identifier: GPL-3.0-or-later
// The one derivative test for every energy: gradients and exact Hessians against central differences on random
// configurations, by the ORDER of the error over three steps; forces and torques of internal energies sum to zero;
// positive forms are positive semidefinite; equal unknowns under a rigid motion give no force.
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "libsheet/energy/area_loads.h"
#include "libsheet/energy/assembly.h"
#include "libsheet/energy/bath.h"
#include "libsheet/energy/bath_drag.h"
#include "libsheet/energy/bath_thrust.h"
#include "libsheet/energy/channel_pressure.h"
#include "libsheet/energy/contact.h"
#include "libsheet/energy/contact_damping.h"
#include "libsheet/energy/contact_shear.h"
#include "libsheet/energy/contact_squeeze.h"
#include "libsheet/energy/form_drag.h"
#include "libsheet/energy/gravity.h"
#include "libsheet/energy/hinge.h"
#include "libsheet/energy/inertia.h"
#include "libsheet/energy/membrane.h"
#include "libsheet/energy/mid_edge_shell.h"
#include "libsheet/energy/pressure.h"
#include "libsheet/energy/rim_tension.h"
#include "libsheet/energy/slope_tension.h"
#include "libsheet/energy/stage_setup.h"
#include "libsheet/energy/surface_tension.h"
#include "libsheet/energy/wall_drag.h"
#include "libsheet/energy/wall_weight.h"
#include "libsheet/geometry/area.h"
#include "tests/support/meshes.h"

namespace sheet {
namespace {

class Random {
public:
  double operator()() { return uniform_(engine_); }
  Vector3 vector(double size) { return size * Vector3((*this)(), (*this)(), (*this)()); }

private:
  std::mt19937_64 engine_{42};
  std::uniform_real_distribution<double> uniform_{-1, 1};
};

// A crumpled sphere (edges of about 0.5 m) that moves at random.
State crumpled(Random& random) {
  State s = test::at_rest(test::icosphere(1), 0.3);
  for (Vector3& x : s.positions)
    x += random.vector(0.1);
  for (Vector3& v : s.velocities)
    v = random.vector(1);
  for (double& v : s.volumes)
    v *= 1.5 + random();
  return s;
}

// A dented sphere whose faces slope steeply.
State steep(Random& random) {
  State s = test::at_rest(test::icosphere(1), 0.3);
  for (Vector3& x : s.positions)
    x += random.vector(0.03);
  for (double& v : s.volumes)
    v *= std::exp(2 * random());
  return s;
}

// A wavy sheet drawn out along one diagonal of its cells, so that every other triangle is a flat cap.
State drawn_out(Random& random) {
  test::Mesh mesh = test::rectangle(2, 2, 4, 4, 0);
  for (Vector3& x : mesh.positions) {
    const double along = x.x() + x.y(), across = x.y() - x.x();
    x = Vector3(5 * along, 0.5 * across, 0.1 * random());
  }
  State s = test::at_rest(mesh, 0.3);
  for (Vector3& v : s.velocities)
    v = random.vector(0.1);
  return s;
}

// The crumpled sphere with directors that lean by 45 degrees to beyond 90.
State leaning(Random& random) {
  State s = crumpled(random);
  for (std::size_t e = 0; e < s.mesh->edges.size(); ++e)
    s.director_angles.push_back(e % 3 == 0 ? 0.5 * random() : 1.3 * (random() > 0 ? 1 : -1) + 0.5 * random());
  return s;
}

// Of as many vertices as any of these has.
std::vector<BathReach> on_the_face(BathReach reach) { return std::vector<BathReach>(1000, reach); }

// Two of three vertices touch a bumpy wall.
void touch_walls(Stage& stage, Random& random) {
  stage.sites.clear();
  stage.site_of.assign(stage.vertices(), no_index);
  for (StageLiquid& of : stage.liquids)
    if (!of.liquid.law.newtonian())
      of.wall_flow = std::make_shared<const WallFlow>(of.liquid);
  for (std::uint32_t v = 0; v < stage.vertices(); ++v) {
    if (v % 3 == 0)
      continue;
    WallSite site;
    site.vertex = v;
    site.normal = (Vector3(0, 1, 0) + random.vector(0.5)).normalized();
    site.stuck = stage.start->positions[v];
    site.carried = site.stuck + random.vector(0.1);
    site.slip_length = 0.1 * (1 + random());
    site.wetting = 1 + random();
    stage.site_of[v] = static_cast<std::uint32_t>(stage.sites.size());
    stage.sites.push_back(std::move(site));
  }
}

// The same, and another wall faces each of them; the layer is thicker than the gap.
void touch_two_walls(Stage& stage, Random& random) {
  touch_walls(stage, random);
  stage.channels.clear();
  for (WallSite& site : stage.sites) {
    Channel channel;
    channel.vertex = site.vertex;
    channel.gap = 0.02 * (1.5 + random());
    channel.gap_before = 1; // so none is too thick at the start
    channel.filled = 0.5 * (1 + random());
    channel.depth = 0.1 * (1.5 + random());
    channel.place = stage.start->positions[site.vertex];
    channel.slope = random.vector(0.005);
    channel.carried = site.carried + random.vector(0.1);
    site.channel = static_cast<std::uint32_t>(stage.channels.size());
    stage.channels.push_back(channel);
  }
}

// Elements of any term with n unknowns each: what is checked of them is compiled once, not for every term.
template <int n> class Elements {
public:
  virtual ~Elements() = default;
  [[nodiscard]] virtual Stencil stencil() const = 0;
  [[nodiscard]] virtual std::string name() const = 0;
  [[nodiscard]] virtual std::size_t size() const = 0;
  [[nodiscard]] virtual std::array<std::uint32_t, 4> nodes(std::size_t i) const = 0; // hinge and four only
  virtual void begin(const Stage& stage) = 0;
  [[nodiscard]] virtual double value(std::size_t i, const VectorN<n>& u) const = 0;
  virtual double gradient(std::size_t i, const VectorN<n>& u, VectorN<n>& g) const = 0;
  virtual double derivatives(std::size_t i, const VectorN<n>& u, VectorN<n>& g, MatrixN<n>& h, bool definite) const = 0;
};

template <class E> class ElementsOf final : public Elements<stencil_unknowns(E::stencil)> {
public:
  static constexpr int n = stencil_unknowns(E::stencil);
  explicit ElementsOf(E element) : element_(std::move(element)) {}
  [[nodiscard]] Stencil stencil() const override { return E::stencil; }
  [[nodiscard]] std::string name() const override { return element_.name(); }
  [[nodiscard]] std::size_t size() const override { return element_.size(); }
  [[nodiscard]] std::array<std::uint32_t, 4> nodes(std::size_t i) const override {
    if constexpr (E::stencil == Stencil::hinge || E::stencil == Stencil::four)
      return element_.nodes(i);
    else
      return {};
  }
  void begin(const Stage& stage) override {
    element_.begin(stage);
    if constexpr (requires { element_.prepare(stage.begin); })
      element_.prepare(stage.begin);
  }
  [[nodiscard]] double value(std::size_t i, const VectorN<n>& u) const override { return element_.value(i, u); }
  double gradient(std::size_t i, const VectorN<n>& u, VectorN<n>& g) const override {
    if constexpr (requires { element_.gradient(i, u, g); })
      return element_.gradient(i, u, g);
    MatrixN<n> unused;
    return element_.derivatives(i, u, g, unused, true);
  }
  double derivatives(std::size_t i, const VectorN<n>& u, VectorN<n>& g, MatrixN<n>& h, bool definite) const override {
    return element_.derivatives(i, u, g, h, definite);
  }

private:
  E element_;
};

template <int n> VectorN<n> unknowns(const Elements<n>& elements, std::size_t i, const State& s, Random& random) {
  VectorN<12> u = VectorN<12>::Zero();
  if (elements.stencil() == Stencil::vertex) {
    u.head<3>() = s.positions[i] + random.vector(0.05);
  } else if (stencil_vertices(elements.stencil()) == 4) {
    const auto nodes = elements.nodes(i);
    for (std::size_t k = 0; k < 4; ++k)
      u.segment<3>(static_cast<Eigen::Index>(3 * k)) = s.positions[nodes[k]] + random.vector(0.05);
  } else {
    for (std::size_t k = 0; k < 3; ++k)
      u.segment<3>(static_cast<Eigen::Index>(3 * k)) = s.positions[s.mesh->triangles[i][k]] + random.vector(0.05);
    if (elements.stencil() == Stencil::triangle_edges)
      u.tail<3>() = random.vector(0.3);
  }
  return u.head<n>();
}

// Central differences with three steps: the error must fall at second order, or be round-off from the start.
void expect_second_order(const double (&error)[3], double size, const std::string& what) {
  const double round_off = 1e-9 * size;
  if (error[0] <= round_off)
    return;
  EXPECT_LT(error[2], 1e-3 * size) << what;
  EXPECT_NEAR(std::log2(error[0] / error[1]), 2, 0.1) << what;
  EXPECT_NEAR(std::log2(error[1] / error[2]), 2, 0.1) << what;
}

// Ascending. Of matrices of any size: Eigen's solver takes long to compile.
Eigen::VectorXd eigenvalues_of(const Eigen::MatrixXd& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(symmetric, Eigen::EigenvaluesOnly).eigenvalues();
}

struct Properties {
  bool translations = true, rotations = true; // the energy does not change with them
  double viscosity = 2;
  FlowLaw law = {};
  bool warm = false; // triangles have temperatures, each its own
  bool two = false;  // every third triangle is of another liquid
};

template <int n>
void check_all(Elements<n>& elements, Properties properties, bool second_stage_too, State (*state)(Random&),
               void (*prepare)(Stage&, Random&)) {
  const int vertices = stencil_vertices(elements.stencil());
  Random random;
  for (int round = 0; round < 5; ++round) {
    State s = state(random);
    std::vector<Liquid> liquids{
        {.viscosity = properties.viscosity, .density = 3, .surface_tension = 0.7, .law = properties.law}};
    for (std::size_t t = 0; properties.two && t < s.volumes.size(); ++t)
      s.liquids.push_back(t % 3 == 0 ? 1 : 0);
    if (properties.two)
      liquids.push_back({.viscosity = 5, .density = 4, .surface_tension = 0.2});
    Stage stage = first_stage(s, liquids, 0.05, 0.05, elements.stencil() == Stencil::triangle_edges);
    for (std::size_t t = 0; properties.warm && t < s.volumes.size(); ++t)
      stage.shift.push_back(0.5 + 0.25 * static_cast<double>(t % 5));
    Unknowns first = stage.begin;
    if (second_stage_too && round % 2) {
      for (Eigen::Index k = 0; k < first.size(); ++k)
        first[k] += 0.02 * random();
      (void)second_stage(stage, first, 1 - std::sqrt(0.5), 0.05 / (1 - std::sqrt(0.5)));
    }
    for (std::size_t t = 0; t < stage.viscosity.size(); ++t)
      stage.viscosity[t] *= 1 + 0.1 * static_cast<double>(t % 7);
    if (prepare != nullptr)
      prepare(stage, random);
    elements.begin(stage);
    stage = {}; // a begun term needs no stage
    for (std::size_t i = 0; i < elements.size(); i += 13) {
      const VectorN<n> u = unknowns(elements, i, s, random);
      VectorN<n> g, ignored;
      MatrixN<n> h, positive, scrap;
      const double w = elements.derivatives(i, u, g, h, false);
      EXPECT_NEAR(elements.gradient(i, u, ignored), w, 1e-12 * std::abs(w) + 1e-300);
      EXPECT_LE((ignored - g).norm(), 1e-12 * g.norm() + 1e-300) << elements.name();
      EXPECT_NEAR(w, elements.value(i, u), 1e-12 * std::abs(w) + 1e-300);
      double gradient_error[3], hessian_error[3];
      for (int k = 0; k < 3; ++k) {
        const double d = 4e-3 / (1 << k);
        gradient_error[k] = hessian_error[k] = 0;
        for (int c = 0; c < n; ++c) {
          VectorN<n> up = u, down = u, gu, gd;
          up[c] += d, down[c] -= d;
          gradient_error[k] =
              std::max(gradient_error[k], std::abs((elements.value(i, up) - elements.value(i, down)) / (2 * d) - g[c]));
          elements.derivatives(i, up, gu, scrap, false);
          elements.derivatives(i, down, gd, scrap, false);
          hessian_error[k] = std::max(hessian_error[k], ((gu - gd) / (2 * d) - h.col(c)).cwiseAbs().maxCoeff());
        }
      }
      expect_second_order(gradient_error, g.cwiseAbs().maxCoeff() + 1e-12, elements.name() + ": gradient");
      expect_second_order(hessian_error, h.cwiseAbs().maxCoeff() + 1e-12, elements.name() + ": Hessian");
      EXPECT_LE((h - h.transpose()).cwiseAbs().maxCoeff(), 1e-12 * (h.cwiseAbs().maxCoeff() + 1e-300));

      elements.derivatives(i, u, ignored, positive, true);
      EXPECT_TRUE(ignored.isApprox(g, 1e-12)) << elements.name();
      const Eigen::VectorXd eigenvalues = eigenvalues_of(positive);
      EXPECT_GE(eigenvalues[0], -1e-12 * (eigenvalues[n - 1] + 1e-300)) << elements.name();

      Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
      for (int v = 0; v < vertices; ++v) {
        force += g.template segment<3>(3 * v);
        torque += u.template segment<3>(3 * v).cross(g.template segment<3>(3 * v));
      }
      const double size = g.head(3 * vertices).cwiseAbs().maxCoeff() + 1e-300;
      if (properties.translations) {
        EXPECT_LE(force.norm(), 1e-12 * size) << elements.name();
      }
      if (properties.rotations) {
        EXPECT_LE(torque.norm(), 1e-12 * size) << elements.name();
      }
    }
  }
}

template <class E>
void check(E element, Properties properties, bool second_stage_too = true, State (*state)(Random&) = crumpled,
           void (*prepare)(Stage&, Random&) = nullptr) {
  ElementsOf<E> elements(std::move(element));
  check_all<ElementsOf<E>::n>(elements, properties, second_stage_too, state, prepare);
}

TEST(Derivatives, Membrane) { check(Membrane(), {}); }

// Laws that vary within the rates of strain here, some 1/s.
const std::vector<FlowLaw>& flow_laws() {
  using enum FlowLawKind;
  static const std::vector<FlowLaw> laws{
      {.kind = power, .flow_index = 1.0 / 3, .rest_rate = 2.0},
      {.kind = power, .flow_index = 1.5, .rest_rate = 2.0},
      {.kind = carreau, .flow_index = 0.2, .infinite_viscosity = 0.1, .time_constant = 0.3},
      {.kind = cross, .flow_index = 0.2, .infinite_viscosity = 0.1, .time_constant = 0.05},
      {.kind = bingham, .yield_stress = 12, .rest_rate = 3.0},
      {.kind = casson, .yield_stress = 12, .rest_rate = 3.0}};
  return laws;
}
TEST(Derivatives, MembraneOfFlowCurves) {
  for (const FlowLaw& law : flow_laws())
    for (const bool warm : {false, true})
      check(Membrane(), {.law = law, .warm = warm});
}
TEST(Derivatives, OfTwoLiquids) {
  for (const FlowLaw& law : {FlowLaw{}, flow_laws()[0], flow_laws()[5]})
    for (const bool warm : {false, true}) {
      const Properties two{.law = law, .warm = warm, .two = true};
      check(Membrane(), two);
      check(SurfaceTension(), two);
      check(WallDrag(), {false, false, 2, law, warm, true}, true, crumpled, touch_walls);
    }
  check(Inertia(), {.translations = false, .rotations = false, .two = true});
  check(Gravity({0.3, -9, 2}), {.translations = false, .rotations = false, .two = true});
}
TEST(Derivatives, SurfaceTension) { check(SurfaceTension(), {}); }
TEST(Derivatives, SurfaceTensionOfWettedFaces) { check(SurfaceTension(), {}, true, crumpled, touch_walls); }
TEST(Derivatives, FormDrag) {
  // So strong that no difference crosses where the velocity against it is 0.
  const auto wind = [](double t) { return Vector3(20, 200 * t, -30); };
  check(FormDrag({.density = 2, .drag = 1.2, .friction = 0.3, .wind = wind}), {false, false});
  const std::vector<char> afloat(test::at_rest(test::icosphere(1), 0.3).mesh->vertices, 1);
  check(FormDrag({.density = 2, .drag = 1.2, .friction = 0.3, .wind = wind, .one_face = afloat}), {false, false});
}
// The whole force on a triangle is that of its area, what nothing reaches has none, and what is reached on one face
// half the friction.
TEST(Derivatives, AirPressesAndRubs) {
  const test::Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}}, {{0, 1, 2}}};
  const State s = test::at_rest(mesh, 0.1);
  const Liquid liquid{.viscosity = 1, .density = 3};
  const double dt = 0.5;
  FormDrag all({.density = 2, .drag = 1.2, .friction = 0.1}), part({.density = 2, .drag = 1.2, .sheltered = {0, 1, 1}}),
      above({.density = 2, .drag = 1.2, .friction = 0.1, .one_face = {1, 1, 1}});
  Stage stage = first_stage(s, liquid, dt, dt, false);
  all.begin(stage);
  part.begin(stage);
  above.begin(stage);
  const Vector3 velocity(0, 3, -4);
  VectorN<9> u, gradient;
  MatrixN<9> hessian;
  for (int c = 0; c < 3; ++c)
    u.segment<3>(3 * c) = s.positions[static_cast<std::size_t>(c)] + dt * velocity;
  const auto force = [&](const FormDrag& drag) -> Vector3 {
    drag.derivatives(0, u, gradient, hessian, false);
    return -(gradient.segment<3>(0) + gradient.segment<3>(3) + gradient.segment<3>(6));
  };
  EXPECT_NEAR((force(all) - Vector3(0, -0.1 * 2 * 9.0 / 2, 1.2 * 2 * 16.0 / 2)).norm(), 0, 1e-12);
  EXPECT_NEAR((force(part) - Vector3(0, 0, 1.2 * 2 * 16.0 / 2 / 3)).norm(), 0, 1e-12);
  EXPECT_NEAR((force(above) - Vector3(0, -0.05 * 2 * 9.0 / 2, 0)).norm(), 0, 1e-12);
}
// A sphere has no rim: every third edge counts as one, in part.
TEST(Derivatives, RimTension) {
  const State sphere = test::at_rest(test::icosphere(1), 0.3);
  const Connectivity& mesh = *sphere.mesh;
  std::vector<double> rims(mesh.edges.size(), 0);
  for (std::size_t e = 0; e < rims.size(); e += 3)
    rims[e] = 0.25 * static_cast<double>(1 + e % 4);
  check(RimTension(rims, mesh), {});
}
TEST(Derivatives, SlopeTension) {
  const State sphere = test::at_rest(test::icosphere(1), 0.3);
  const Connectivity& mesh = *sphere.mesh;
  FreeFaces faces{std::vector<double>(mesh.edges.size(), 0), std::vector<double>(mesh.vertices, 0)};
  for (std::size_t v = 0; v < mesh.vertices; v += 2)
    faces.closed[v] = 0.3 * static_cast<double>(v % 7);
  Random random;
  const State s = steep(random);
  const std::vector<SlopedEdge> edges = sloped_edges(mesh, s.positions, s.volumes, faces, {0, 0});
  EXPECT_GT(edges.size(), 20U);
  check(SlopeTension(edges), {}, true, steep);
  check(SlopeTension(edges), {}, true, steep, touch_two_walls);
  std::vector<SlopedEdge> of_threads = edges;
  for (std::size_t i = 0; i < of_threads.size(); i += 2)
    of_threads[i].of_thread = 1;
  check(SlopeTension(of_threads), {}, true, steep);
}
TEST(Derivatives, WallDrag) { check(WallDrag(), {false, false}, true, crumpled, touch_walls); }
TEST(Derivatives, WallDragOfFlowCurves) {
  for (const FlowLaw& law : flow_laws())
    for (const bool warm : {false, true})
      check(WallDrag(), {false, false, 2, law, warm}, true, crumpled, touch_walls);
}
TEST(Derivatives, DragOfTwoWalls) { check(WallDrag(), {false, false}, true, crumpled, touch_two_walls); }
TEST(Derivatives, ChannelPressure) { check(ChannelPressure(), {false, false}, true, crumpled, touch_two_walls); }
TEST(Derivatives, WallWeight) { check(WallWeight({0.3, -9, 2}), {}, true, crumpled, touch_walls); }
TEST(Derivatives, SpreadingOnABath) {
  check(BathThrust({0.3, -9, 2}, 0.1), {false, false});
  check(BathThrust({0.3, -9, 2}, 0.1, on_the_face(BathReach::facing)), {false, false});
}
TEST(Derivatives, BathDrag) { check(BathDrag(3, {0.3, -9, 2}, 0.1), {false, false}); }
TEST(Derivatives, Inertia) { check(Inertia(), {false, false}); }
TEST(Derivatives, Gravity) { check(Gravity({0.3, -9, 2}), {false, false}); }
TEST(Derivatives, Bath) {
  check(Bath(3, {0.3, -9, 2}, 0.1, true), {false, false});
  for (const BathReach reach : {BathReach::facing, BathReach::outside})
    check(Bath(3, {0.3, -9, 2}, 0.1, true, on_the_face(reach)), {false, false});
}

// With none, one, two and three vertices under the surface: continuous across it, and never a pull from above.
TEST(Derivatives, BathActsFromBelowOnly) {
  Bath bath(3, {0, 0, -1}, 0, false), clinging(3, {0, 0, -1}, 0, true);
  VectorN<9> u;
  u << 0, 0, 0.3, 1, 0, 0.2, 0, 1, 0.1;
  const State s = test::at_rest({{{0, 0, 0.3}, {1, 0, 0.2}, {0, 1, 0.1}}, {{0, 1, 2}}}, 0.1);
  const Stage stage = first_stage(s, Liquid{}, 0.1, 0.1, false);
  bath.begin(stage);
  clinging.begin(stage);
  VectorN<9> gradient;
  MatrixN<9> hessian;
  EXPECT_EQ(bath.derivatives(0, u, gradient, hessian, false), 0);
  EXPECT_EQ(gradient.norm() + hessian.norm(), 0);
  for (const double level : {0.0, 0.15, 0.25, 0.35}) {
    u[2] = 0.3 - level, u[5] = 0.2 - level, u[8] = 0.1 - level;
    static_cast<void>(bath.derivatives(0, u, gradient, hessian, false));
    for (int a = 0; a < 3; ++a)
      EXPECT_LE(gradient[3 * a + 2], 0); // the force is upwards
    for (int i = 0; i < 9; ++i) {
      VectorN<9> below = u, above = u, g_below, g_above;
      MatrixN<9> scrap;
      below[i] -= 1e-6, above[i] += 1e-6;
      EXPECT_NEAR(gradient[i], (bath.value(0, above) - bath.value(0, below)) / 2e-6, 1e-9);
      static_cast<void>(bath.derivatives(0, below, g_below, scrap, false));
      static_cast<void>(bath.derivatives(0, above, g_above, scrap, false));
      EXPECT_LE((hessian.col(i) - (g_above - g_below) / 2e-6).norm(), 1e-7);
    }
    static_cast<void>(bath.derivatives(0, u, gradient, hessian, true));
    EXPECT_GE(eigenvalues_of(hessian)[0], -1e-12);
  }
  EXPECT_NEAR(bath.value(0, u), clinging.value(0, u), 1e-15); // all of it is under the surface
}
// From upright through standing on edge to upside down: a potential with a lower bound, smooth on the way.
TEST(Derivatives, BathOfWhatStandsOnEdge) {
  const State s = test::at_rest({{{0, 0, -0.3}, {1, 0, -0.3}, {0, 1, -0.3}}, {{0, 1, 2}}}, 0.1);
  const Stage stage = first_stage(s, Liquid{}, 0.1, 0.1, false);
  for (const bool clings : {false, true}) {
    Bath bath(3, {0, 0, -1}, 0, clings);
    bath.begin(stage);
    for (const double angle : {1.0, 1.5, 1.53, 1.56, 1.58, 1.61, 1.7, 3.0}) { // from the level, about the x axis
      VectorN<9> u, gradient;
      MatrixN<9> hessian, scrap;
      u << 0, 0, -0.3, 1, 0, -0.4, 0, std::cos(angle), -0.3 - std::sin(angle);
      const double value = bath.derivatives(0, u, gradient, hessian, false);
      EXPECT_GE(value, 0);
      EXPECT_EQ(value, bath.value(0, u));
      if (angle > 1.63) {
        EXPECT_EQ(value, 0);
      }
      for (int i = 0; i < 9; ++i) {
        VectorN<9> below = u, above = u, g_below, g_above;
        below[i] -= 1e-6, above[i] += 1e-6;
        EXPECT_NEAR(gradient[i], (bath.value(0, above) - bath.value(0, below)) / 2e-6, 1e-8) << angle;
        static_cast<void>(bath.derivatives(0, below, g_below, scrap, false));
        static_cast<void>(bath.derivatives(0, above, g_above, scrap, false));
        EXPECT_LE((hessian.col(i) - (g_above - g_below) / 2e-6).norm(), 1e-6) << angle;
      }
      static_cast<void>(bath.derivatives(0, u, gradient, hessian, true));
      EXPECT_GE(eigenvalues_of(hessian)[0], -1e-12);
    }
  }
}
// What is upside down under the surface is lifted by the weight of its own volume of the bath, above it by nothing.
TEST(Derivatives, BathLiftsWhatIsOverturned) {
  for (const double depth : {0.3, -0.3}) {
    const State s = test::at_rest({{{0, 0, -depth}, {0, 1, -depth}, {1, 0, -depth}}, {{0, 1, 2}}}, 0.1);
    const Stage stage = first_stage(s, Liquid{}, 0.1, 0.1, false);
    Bath bath(3, {0, 0, -2}, 0, false);
    bath.begin(stage);
    VectorN<9> u, gradient;
    MatrixN<9> hessian;
    u << s.positions[0], s.positions[1], s.positions[2];
    static_cast<void>(bath.derivatives(0, u, gradient, hessian, false));
    const Vector3 force = -gradient.segment<3>(0) - gradient.segment<3>(3) - gradient.segment<3>(6);
    EXPECT_NEAR((force - Vector3(0, 0, depth > 0 ? 3 * 2 * 0.05 : 0)).norm(), 0, 1e-15);
  }
}
// One corner flooded, one borne by another layer, one from below alone: each has what is its own, on its own.
TEST(Derivatives, BathAtTheEdgeOfAFlood) {
  const std::vector<BathReach> reach{BathReach::around, BathReach::none, BathReach::below};
  const State s = test::at_rest({{{0, 0, -0.3}, {1, 0, -0.3}, {0, 1, -0.3}}, {{0, 1, 2}}}, 0.2);
  const Stage stage = first_stage(s, Liquid{}, 0.1, 0.1, false);
  for (const bool clings : {false, true}) {
    Bath bath(3, {0, 0, -2}, 0, clings, reach);
    bath.begin(stage);
    VectorN<9> u, gradient;
    MatrixN<9> hessian;
    u << 0, 0, -0.3, 1, 0, -0.3, 0, 1, -0.3;
    static_cast<void>(bath.derivatives(0, u, gradient, hessian, false));
    EXPECT_NEAR(gradient[2], -3 * 2 * 0.1 / 3, 1e-15); // its volume
    EXPECT_EQ(gradient.segment<3>(3).z(), 0);
    EXPECT_NEAR(gradient[8], -3 * 2 * 0.3 * 0.5 / 3, 1e-15); // of the bath over its third of the area
    for (const double z : {-0.3, -0.15, -0.05, 0.1}) {       // the flooded corner comes up, and out of the bath
      u << 0, 0, z, 1, 0.1, -0.3, 0, 1, -0.2;
      MatrixN<9> scrap;
      const double value = bath.derivatives(0, u, gradient, hessian, false);
      EXPECT_EQ(value, bath.value(0, u));
      for (int i = 0; i < 9; ++i) {
        VectorN<9> below = u, above = u, g_below, g_above;
        below[i] -= 1e-6, above[i] += 1e-6;
        EXPECT_NEAR(gradient[i], (bath.value(0, above) - bath.value(0, below)) / 2e-6, 1e-9) << z;
        static_cast<void>(bath.derivatives(0, below, g_below, scrap, false));
        static_cast<void>(bath.derivatives(0, above, g_above, scrap, false));
        EXPECT_LE((hessian.col(i) - (g_above - g_below) / 2e-6).norm(), 1e-7) << z;
      }
      static_cast<void>(bath.derivatives(0, u, gradient, hessian, true));
      EXPECT_GE(eigenvalues_of(hessian)[0], -1e-12);
    }
  }
}
// As it comes up from deeper than its thickness it is lifted as by its lower face alone: half as much half as deep.
TEST(Derivatives, BathLetsGoWhatComesUpOutOfIt) {
  const State s = test::at_rest({{{0, 0, -0.3}, {1, 0, -0.3}, {0, 1, -0.3}}, {{0, 1, 2}}}, 0.2);
  const Stage stage = first_stage(s, Liquid{}, 0.1, 0.1, false);
  Bath bath(3, {0, 0, -2}, 0, false, on_the_face(BathReach::around));
  bath.begin(stage);
  const auto lift_at = [&](double z) {
    VectorN<9> u, gradient;
    MatrixN<9> hessian;
    u << 0, 0, z, 1, 0, z, 0, 1, z;
    static_cast<void>(bath.derivatives(0, u, gradient, hessian, false));
    return -gradient[2] - gradient[5] - gradient[8];
  };
  const double whole = 3 * 2 * 0.1; // ρ g V
  EXPECT_NEAR(lift_at(-0.3), whole, 1e-15);
  EXPECT_NEAR(lift_at(-0.2), whole, 1e-15);
  EXPECT_NEAR(lift_at(-0.1), whole / 2, 1e-15);
  EXPECT_EQ(lift_at(0.01), 0);
}
TEST(Derivatives, Pressure) { check(Pressure({PressureLaw::Kind::constant, 3, 1, 1}), {false, false}); }
// On a free rim the force is p n A/3 at each corner, at rest exactly: the cap's part of the enclosed volume is taken
// away.
TEST(Pressure, ActsAlongTheNormalsOfAnOpenSheet) {
  test::Mesh mesh = test::disk(1, 4, 0.2);
  for (Vector3& x : mesh.positions)
    x += Vector3(3, -2, 1 + 0.5 * x.x() * x.x() - 0.2 * x.y());
  const State s = test::at_rest(mesh, 0.1);
  const Stage stage = first_stage(s, Liquid{}, 0.1, 0.1, false);
  Pressure pressure({PressureLaw::Kind::constant, 3, 1, 1});
  pressure.begin(stage);
  std::vector<Vector3> force(s.positions.size(), Vector3::Zero()), expected = force;
  for (std::size_t t = 0; t < s.mesh->triangles.size(); ++t) {
    const Corners& v = s.mesh->triangles[t];
    VectorN<9> u, g;
    MatrixN<9> h;
    u << s.positions[v[0]], s.positions[v[1]], s.positions[v[2]];
    pressure.derivatives(t, u, g, h, false);
    const TriangleArea a(s.positions[v[0]], s.positions[v[1]], s.positions[v[2]]);
    for (int k = 0; k < 3; ++k) {
      force[v[static_cast<std::size_t>(k)]] -= g.segment<3>(3 * k);
      expected[v[static_cast<std::size_t>(k)]] += a.area * a.normal; // p/3 = 1
    }
  }
  for (std::size_t v = 0; v < force.size(); ++v)
    EXPECT_LE((force[v] - expected[v]).norm(), 1e-13);
}

// Laws that depend on the whole volume: gradient and Hessian of the whole sheet, its rank-one part included, against
// central differences; closed and open sheets, first and second stages.
TEST(Derivatives, PressureOfTheEnclosedVolume) {
  Random random;
  test::Mesh dome = test::disk(1, 3, 0.2);
  for (Vector3& x : dome.positions)
    x.z() = 0.7 - 0.5 * x.squaredNorm();
  struct Law {
    std::string name;
    PressureLaw law;
  };
  const PressureLaw gas{.kind = PressureLaw::Kind::gas, .gas = {.amount = 6, .ambient = 2, .exponent = 1.4}};
  PressureLaw leaking = gas;
  leaking.gas.leak = 5;
  leaking.gas.more_volume = 0.5;
  for (const auto& [what, law] :
       {Law{"inverse square", {PressureLaw::Kind::inverse_square, 3, 0.8, 2}},
        Law{"draining", {PressureLaw::Kind::draining, 3, 0.8, 2}}, Law{"gas", gas}, Law{"leaking gas", leaking}})
    for (const bool closed : {true, false})
      for (const bool second : {true, false}) {
        State s = closed ? crumpled(random) : test::at_rest(dome, 0.1);
        for (Vector3& v : s.velocities)
          v = random.vector(1);
        Stage stage = first_stage(s, Liquid{}, 0.05, 0.05, false);
        Unknowns first = stage.begin;
        for (double& x : first)
          x += 0.05 * random();
        if (second)
          (void)second_stage(stage, first, 1 - std::sqrt(0.5), 0.05 / (1 - std::sqrt(0.5)));
        Terms terms;
        terms.push_back(make_term(Pressure(law)));
        terms[0]->begin(stage);
        Assembly assembly(s.mesh, terms, false);
        std::vector<std::uint32_t> order(s.mesh->vertices);
        std::iota(order.begin(), order.end(), 0U);
        assembly.set_order(order);
        SparseLower lower = assembly.pattern().structure();
        Unknowns u = stage.begin;
        for (double& x : u)
          x += 0.05 * random();
        const Eigen::Index n = u.size();
        Eigen::VectorXd g, ignored, volume;
        assembly.derivatives(terms, u, false, {}, g, lower);
        Eigen::MatrixXd h = Eigen::MatrixXd::Zero(n, n);
        for (int c = 0; c < lower.size; ++c)
          for (int p = lower.starts[static_cast<std::size_t>(c)]; p < lower.starts[static_cast<std::size_t>(c) + 1];
               ++p) {
            const int r = lower.rows[static_cast<std::size_t>(p)];
            h(r, c) = h(c, r) = lower.values[static_cast<std::size_t>(p)];
          }
        const double stiffness = terms[0]->rank_one(u, volume);
        EXPECT_GT(stiffness, 0);
        h += stiffness * volume * volume.transpose();
        double gradient_error[3], hessian_error[3];
        for (int k = 0; k < 3; ++k) {
          const double d = 0.04 / (1 << k);
          gradient_error[k] = hessian_error[k] = 0;
          for (Eigen::Index c = 0; c < n; c += 5) {
            Unknowns up = u, down = u;
            up[c] += d, down[c] -= d;
            const double slope = (assembly.value(terms, up).value - assembly.value(terms, down).value) / (2 * d);
            gradient_error[k] = std::max(gradient_error[k], std::abs(slope - g[c]));
            Eigen::VectorXd gu, gd;
            assembly.derivatives(terms, up, false, {}, gu, lower);
            assembly.derivatives(terms, down, false, {}, gd, lower);
            hessian_error[k] = std::max(hessian_error[k], ((gu - gd) / (2 * d) - h.col(c)).cwiseAbs().maxCoeff());
          }
        }
        expect_second_order(gradient_error, g.cwiseAbs().maxCoeff(), what + ": gradient");
        expect_second_order(hessian_error, h.cwiseAbs().maxCoeff(), what + ": Hessian");
      }
}

// The angles of the directors turn with the sheet, so their torque belongs to the balance: only exact at θ as a
// function of a rotation, which RigidMotion tests.
TEST(Derivatives, MidEdge) { check(MidEdgeShell(false), {true, false}); }
TEST(Derivatives, MidEdgeFlatCaps) { check(MidEdgeShell(false), {true, false}, true, drawn_out); }
TEST(Derivatives, MidEdgeLeaningDirectors) { check(MidEdgeShell(false), {true, false}, true, leaning); }
TEST(Derivatives, MidEdgeArcsAndLeaningDirectors) { check(MidEdgeShell(true), {true, false}, true, leaning); }
TEST(Derivatives, MidEdgeArcs) { check(MidEdgeShell(true), {true, false}); }

TEST(Derivatives, MidEdgeArcsOfFlowCurves) {
  for (const FlowLaw& law : flow_laws())
    for (const bool warm : {false, true})
      check(MidEdgeShell(true), {.rotations = false, .law = law, .warm = warm});
  for (const FlowLaw& law : {FlowLaw{}, flow_laws()[0], flow_laws()[5]}) // batches of two liquids
    check(MidEdgeShell(AreaLoads{.tension = SurfaceTension()}), {.rotations = false, .law = law, .two = true});
  check(MidEdgeShell(true), {.rotations = false, .law = flow_laws()[0]}, true, leaning);
  check(MidEdgeShell(AreaLoads{.tension = SurfaceTension()}), {.rotations = false, .law = flow_laws()[4]});
}

// A stress of Newton's own: where a direction ends it is that of the flow, and the Hessian the exact one, if the
// direction is nothing; of any stress the positive form is positive semidefinite.
template <class E> void check_stress() {
  constexpr int n = stencil_unknowns(E::stencil);
  Random random;
  const State s = crumpled(random);
  const Liquid liquid{.viscosity = 2, .density = 3, .law = {.kind = FlowLawKind::bingham, .yield_stress = 30}};
  const Stage stage = first_stage(s, liquid, 0.05, 0.05, n == 12);
  E element = [] {
    if constexpr (n == 12)
      return MidEdgeShell(true);
    else
      return Membrane();
  }();
  element.begin(stage);
  Unknowns u = stage.begin, step = u;
  for (double& x : u)
    x += 0.02 * random();
  for (double& x : step)
    x = 0.5 * random();
  const auto local = [&](std::size_t i) {
    VectorN<n> own;
    for (std::size_t k = 0; k < 3; ++k) {
      own.template segment<3>(static_cast<Eigen::Index>(3 * k)) = Stage::position(u, s.mesh->triangles[i][k]);
      if constexpr (n == 12)
        own[static_cast<Eigen::Index>(9 + k)] =
            u[static_cast<Eigen::Index>(3 * s.positions.size()) + s.mesh->triangle_edges[i][k]];
    }
    return own;
  };
  const auto hessian = [&](std::size_t i, bool definite) {
    VectorN<n> g;
    MatrixN<n> h;
    element.derivatives(i, local(i), g, h, definite);
    return h;
  };
  std::vector<MatrixN<n>> exact;
  for (std::size_t i = 0; i < element.size(); ++i)
    exact.push_back(hessian(i, false));
  element.follow(u, Unknowns::Zero(u.size()));
  for (std::size_t i = 0; i < element.size(); ++i)
    EXPECT_LT((hessian(i, false) - exact[i]).norm(), 1e-12 * exact[i].norm());
  element.follow(u, step);
  for (std::size_t i = 0; i < element.size(); ++i) {
    EXPECT_GT((hessian(i, false) - exact[i]).norm(), 1e-3 * exact[i].norm());
    const Eigen::VectorXd eigenvalues = eigenvalues_of(hessian(i, true));
    EXPECT_GE(eigenvalues[0], -1e-12 * eigenvalues[n - 1]);
  }
}
TEST(Derivatives, StressOfWhatYields) {
  check_stress<Membrane>();
  check_stress<MidEdgeShell>();
}

// What works on the arcs' area: viscosity small beside it, so that errors of it are seen.
AreaLoads tension() { return {.tension = SurfaceTension()}; }
TEST(Derivatives, TensionOfArcs) {
  check(MidEdgeShell(tension()), {true, false, 0.01});
  check(MidEdgeShell(tension()), {true, false, 0.01}, true, crumpled, touch_walls);
}
TEST(Derivatives, WeightOfArcs) {
  check(MidEdgeShell(AreaLoads{.weight = WallWeight({0.3, -9, 2})}), {true, false, 0.01}, true, crumpled, touch_walls);
}
// Directors that lean far: arcs that hardly close to triangles.
TEST(Derivatives, TensionOfLeaningDirectors) { check(MidEdgeShell(tension()), {true, false, 0.01}, true, leaning); }

TEST(Derivatives, Hinges) {
  const auto mesh = test::at_rest(test::icosphere(1), 1).mesh;
  check(Hinge(false, *mesh), {});
  check(Hinge(true, *mesh), {});
}

std::vector<ContactSpring> random_springs() {
  Random random;
  std::vector<ContactSpring> springs;
  for (std::uint32_t i = 0; i + 10 < 42; ++i)
    springs.push_back({{i, i + 3, i + 7, i + 10},
                       {1, -0.2, -0.5, -0.3},
                       random.vector(1).normalized(),
                       0.1,
                       random.vector(0.1),
                       {3, 2}});
  return springs;
}
const std::vector<ContactSpring> springs = random_springs();

// Vertices that stand on triangles of the sphere, some nearer than at rest, some farther; the rest distances of some
// are negative.
std::vector<ContactSpring> standing_springs() {
  Random random;
  std::vector<ContactSpring> all;
  const test::Mesh sphere = test::icosphere(1);
  const auto count = static_cast<std::uint32_t>(sphere.positions.size());
  for (const auto& [a, b, c] : sphere.triangles)
    if (const std::uint32_t v = (a + b + c) % count; v != a && v != b && v != c)
      all.push_back({{v, a, b, c},
                     {1, -0.2, -0.5, -0.3},
                     random.vector(1).normalized(),
                     all.size() % 5 == 0 ? -0.3 : 0.3,
                     random.vector(0.1),
                     {3, 0}});
  return all;
}
const std::vector<ContactSpring> standing = standing_springs();

std::shared_ptr<SpringRests> rests_of(const std::vector<ContactSpring>& all, bool flow) {
  return std::make_shared<SpringRests>(all, flow, *test::at_rest(test::icosphere(1), 1).mesh);
}

// A term that begins the rest distances itself, as Contact does.
template <class E> struct WithRests : E {
  std::shared_ptr<SpringRests> rests;
  void begin(const Stage& stage) {
    rests->begin(stage);
    E::begin(stage);
  }
};
template <class E, class... Options>
WithRests<E> with_rests(const std::shared_ptr<SpringRests>& rests, Options... options) {
  return {E(rests, options...), rests};
}

TEST(Derivatives, Contact) {
  check(Contact(rests_of(springs, false), true), {true, false});
  check(Contact(rests_of(springs, false), false), {true, false});
}

// Of layers that flow, whose springs rest at what triangles are thick.
TEST(Derivatives, ContactOfLayersThatFlow) {
  for (const bool adhesion : {false, true}) {
    check(Contact(rests_of(springs, true), adhesion), {true, false});
    check(Contact(rests_of(standing, true), adhesion), {true, false});
  }
  check(with_rests<ContactDamping>(rests_of(standing, true), true, true),
        {true, false}); // without adhesion it sets in suddenly
  check(with_rests<ContactShear>(rests_of(standing, true)), {true, false});
  check(with_rests<ContactShear>(rests_of(standing, true)), {false, false}, true, crumpled, touch_walls);
}

TEST(Derivatives, ContactDamping) {
  check(with_rests<ContactDamping>(rests_of(springs, false), true, true), {true, false});
  check(with_rests<ContactDamping>(rests_of(springs, false), true, false), {true, false});
}

TEST(Derivatives, ContactShear) {
  check(with_rests<ContactShear>(rests_of(springs, true)), {true, false});
  check(with_rests<ContactShear>(rests_of(springs, true)), {false, false}, true, crumpled,
        touch_walls); // walls take a part
}

TEST(Derivatives, ContactShearOfFlowCurves) {
  for (const std::size_t law : {0U, 1U, 2U, 4U, 5U}) // Cross' curve is not smooth at rest, which some are near
    for (const bool warm : {false, true})
      for (const bool two : {false, true})
        check(with_rests<ContactShear>(rests_of(springs, true)), {false, false, 2, flow_laws()[law], warm, two}, true,
              crumpled, touch_walls);
}

TEST(Derivatives, SqueezeOfArcs) {
  check(MidEdgeShell(AreaLoads{.squeeze = ContactSqueeze(rests_of(springs, true))}), {true, false, 0.01}, true,
        crumpled, touch_walls);
}

TEST(Derivatives, ContactSqueeze) {
  check(ContactSqueeze(rests_of(springs, true)), {});
  check(ContactSqueeze(rests_of(springs, true)), {}, true, crumpled, touch_walls);
}

} // namespace
} // namespace sheet
