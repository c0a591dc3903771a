// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/scene/write.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "scenes.h"

namespace sheet::scene {
namespace {

TEST(Write, CanonicalText) {
  EXPECT_EQ(to_toml(parse_scene(everything, "s", {}, "scenes")), R"([sheet]
shape = "annulus"
inner_radius = 0.1
outer_radius = 0.25
edge_length = 0.01
pattern = "irregular"
seed = 3
thickness = 0.002
perturbation = [{of = "position", amplitude = 0.0001, wavelength = 0.075, direction = "radial", phase = 0}, {of = "thickness", amplitude = 0.0001, seed = 7}]
plane = "xz"
center = [0, 1, 0]
rotation = {axis = [0, 0, 1], angle = 0.7853981633974483}
velocity = [0, -1, 0]
angular_velocity = [0, 2, -3]
radial_velocity = 0.5

[material]
viscosity = 100
density = 978
surface_tension = 0.0728

[environment]
gravity = [0, -9.81, 0]
pressure = {law = "constant", value = 10}
bath = {density = 1200, level = 0.5, clings = false, spreads = true}
air = {density = 1.2, drag_coefficient = 1.2, friction_coefficient = 0.01, wind = [[0, 0, 0, 0], [1, 3, 0, 0]]}

[model]
inertia = true
bending = true
faces = true

[[hold]]
region = "inner_rim"
kind = "clamped"
motion = {kind = "rotating", axis = [0, 1, 0], center = [0, 1, 0], rate = [[0, 0], [5, 0.3]]}

[[hold]]
region = {box = [[-1, -1, -1], [0, 1, 1]]}
kind = "pinned"
axes = "xz"
motion = {kind = "translating", velocity = [[0, 0, 0, 0], [1, 0, 0, 0.4]]}
until = 2

[[hold]]
region = {sphere = {center = [0, 0, 0], radius = 0.01}}
kind = "pinned"

[[solid]]
shape = "mesh"
file = "scenes/meshes/b.off"
scale = 0.01
voxel_size = 0.001
checksum = "0123456789abcdef"
center = [0, -1, 0]
motion = {kind = "rotating", axis = [0, 1, 0], center = [0, -1, 0], rate = 1}

[[solid]]
shape = "plane"
normal = [0, 1, 0]
surface_velocity = [0, 0, 0.4]
contact = "flow"
slip_length = 1e-06
contact_angle = 1.0471975511965976
receding = true

[inflow]
region = "outer_rim"
velocity = [0, -1, 0]
radial_velocity = -0.5
thickness = 0.002
until = 1

[[outflow]]
point = [0, -2, 0]
normal = [0, -1, 0]

[tear]
below = 0.0008
crumbs = "drop"
sites = 20000
at_thickness = 0.0006
exponent = 6
seed = 4
snap = 2e-05
drops = true

[merge]
after = 0.3
on = "solids"

[contact]
self = true
stiffness = 1.5
adhesion = 10
distance = 0.0015
)");
}

// Any scene that can be said reads back from its text as it was, bit for bit, and a second text equals the first.
class RandomScene {
public:
  explicit RandomScene(unsigned seed) : random_(seed) {}

  Scene make() {
    Scene s;
    SheetTable& sheet = s.sheets[0];
    sheet.plane = pick<Plane>(3);
    sheet.thickness = positive();
    const int shape = below(7);
    if (shape == 0)
      sheet.shape = Rectangle{positive(), positive()};
    if (shape == 1)
      sheet.shape = Disk{positive()};
    if (shape == 2)
      sheet.shape = Annulus{1e-40, 1e-39 + positive()};
    if (shape == 3)
      sheet.shape = Sphere{positive()};
    if (shape == 4)
      sheet.shape = Cap{positive(), 1 + unit(), unit()};
    if (shape == 5)
      sheet.shape = Tube{positive(), positive()};
    if (shape == 6) {
      sheet.shape = SheetMesh{"a \"b\"\\µ😀/c.off", positive()};
      if (below(2))
        sheet.thickness = ThicknessData{"h", below(2) == 1, positive()};
    } else if (below(2)) {
      sheet.segments = {3 + below(100), 1 + below(100)};
      sheet.pattern = Pattern::structured;
    } else {
      const auto size = *size_of(sheet.shape);
      sheet.edge_length = size.smallest * (0.5 + 0.5 * unit());
      if (size.area > 1e6 * size.smallest * size.smallest)
        return make();
      sheet.pattern = pick<Pattern>(3);
      if (sheet.pattern == Pattern::irregular)
        sheet.seed = static_cast<std::int64_t>(random_() >> 1);
    }
    if (shape > 2 && below(3) == 0)
      sheet.thickness = ThicknessProfile{pick<SheetDirection>(4), {{-1, positive()}, {positive(), positive()}}};
    for (int i = below(3); i > 0; --i) {
      Perturbation p{below(2) == 1, positive(), Noise{below(1000)}};
      if (const double* h = std::get_if<double>(&sheet.thickness); h && p.of_thickness)
        p.amplitude = 0.5 * *h;
      if (below(2))
        p.form = Wave{positive(), number(), SheetDirection::radial};
      sheet.perturbations.push_back(p);
    }
    sheet.center = maybe(vector());
    if (below(2))
      sheet.rotation = Rotation{direction(), number()};
    sheet.velocity = maybe(vector());
    sheet.angular_velocity = maybe(vector());
    sheet.radial_velocity = below(2) ? number() : 0;
    s.material = {.viscosity = positive(), .density = positive(), .surface_tension = below(2) ? positive() : 0};
    s.material.law = law();
    if (below(2))
      add_heat(s);
    if (below(3) == 0) { // another one like it, which enters
      sheet.name = "first \"one\"";
      SheetTable other = sheet;
      other.name = "other";
      if (!std::holds_alternative<SheetMesh>(sheet.shape))
        other.enters = maybe_positive();
      s.sheets.push_back(other);
    }
    if (below(2))
      s.environment.gravity = direction();
    if (below(2))
      s.environment.pressure = ConstantPressure{number()};
    if (shape > 2 && below(2))
      s.environment.pressure = InverseSquarePressure{number(), positive()};
    if (shape > 2 && below(3) == 0)
      s.environment.pressure = DrainingPressure{positive()};
    if (shape > 2 && below(3) == 0) {
      GasPressure gas{maybe_positive(), 0, positive(), 1 + std::abs(number()), std::abs(number()), std::abs(number())};
      gas.value = gas.amount ? 0 : positive();
      s.environment.pressure = gas;
    }
    if (s.environment.gravity && below(2))
      s.environment.bath = BathLiquid{positive(), number(), below(2) == 1, below(2) == 1};
    if (below(2))
      s.environment.air = Air{positive(), positive(), positive(), below(2) ? velocity() : Timed<Vector3d>{}};
    s.model = {below(2) == 1, below(2) == 1, below(2) == 1};
    for (int i = below(4); i > 0; --i)
      s.holds.push_back(hold(s));
    for (int i = below(4); i > 0; --i)
      s.solids.push_back(solid(s));
    const auto borders = borders_of(s.sheets[0]);
    if (!borders.empty() && below(2))
      for (int i = below(2); i >= 0; --i)
        s.inflows.push_back({s.sheets.size() > 1 ? s.sheets.back().name : "", borders.back(), velocity(), positive(),
                             maybe_positive(), s.heat && below(2) ? std::optional(temperature()) : std::nullopt,
                             below(2) ? Timed<double>{{{0, number()}}} : Timed<double>{}});
    for (int i = below(3); i > 0; --i)
      s.outflows.push_back({vector(), direction()});
    if (below(2))
      if (const double* h = std::get_if<double>(&s.sheets[0].thickness))
        s.tear = Tear{0.3 * *h, below(2) == 1,
                      below(2) ? std::optional(Inclusions{positive(), positive(), positive(), below(9)}) : std::nullopt,
                      maybe_positive(), below(2) == 1};
    if (below(2))
      s.contact = Contact{below(2) == 1, maybe_positive(), maybe_positive(), maybe_positive()};
    return s;
  }

private:
  void add_heat(Scene& s) {
    Heat made{.specific_heat = positive(), .conductivity = below(2) ? positive() : 0, .temperature = positive()};
    for (HeatedFace* face : {&made.upper, &made.lower})
      if (below(2))
        *face = {positive(), positive(), below(2) ? 0.5 : 0, positive()};
    made.viscous_heating = below(2) == 1;
    s.heat = made;
    s.material.temperature_law.reference_temperature = 300;
    if (below(2)) {
      s.material.temperature_law.kind = TemperatureLawKind::arrhenius;
      s.material.temperature_law.activation_energy = positive();
    } else {
      s.material.temperature_law.kind = TemperatureLawKind::table;
      s.material.temperature_law.temperatures = {250, 290, 310, 350};
      s.material.temperature_law.viscosities = {9, 5, 2, 1};
      if (s.material.law.newtonian())
        s.material.viscosity = *reference_viscosity(s.material.temperature_law);
    }
    if (s.material.surface_tension > 0)
      s.material.surface_tension_slope = maybe_positive().value_or(0);
    if (below(2))
      s.sheets[0].temperature = positive();
  }
  Timed<double> temperature() {
    if (below(2))
      return {{{0, positive()}}};
    return {{{0, positive()}, {1.5, positive()}}};
  }
  Hold hold(const Scene& s) {
    Hold h;
    const auto borders = borders_of(s.sheets[0]);
    if (!borders.empty())
      h.region = borders[static_cast<std::size_t>(below(static_cast<int>(borders.size())))];
    if (borders.empty() || below(3) == 0)
      h.region = SphereRegion{vector(), positive()};
    if (below(3) == 0) {
      const Vector3d corner = vector();
      h.region = BoxRegion{corner, corner + corner.cwiseAbs()};
    }
    if (s.sheets.size() > 1 && (below(2) || std::holds_alternative<Border>(h.region)))
      h.sheet = s.sheets[static_cast<std::size_t>(below(2))].name;
    h.motion = motion();
    if (s.model.bending && below(2))
      h.clamped = true;
    else if (!turns(h.motion))
      h.axes = static_cast<Axes>(axis_bit(0) | below(2) * axis_bit(1) | below(2) * axis_bit(2));
    h.until = maybe_positive();
    h.roll = !std::holds_alternative<Border>(h.region) && !std::holds_alternative<Fixed>(h.motion) && below(2);
    return h;
  }
  Solid solid(const Scene& of) {
    Solid s;
    const int shape = below(6);
    if (shape == 0)
      s.shape = Sphere{positive()};
    if (shape == 1)
      s.shape = SolidBox{Vector3d(positive(), positive(), positive())};
    if (shape == 2)
      s.shape = Capsule{positive(), positive()};
    if (shape == 3)
      s.shape = Cylinder{positive(), positive()};
    if (shape == 4)
      s.shape = HalfSpace{direction()};
    if (shape == 5)
      s.shape = SolidMesh{"../x.vdb", positive(), maybe_positive()};
    if (shape != 0 && shape != 4 && below(2))
      s.rotation = Rotation{direction(), number()};
    s.center = maybe(vector());
    s.motion = motion();
    if (std::holds_alternative<Keyframed>(s.motion) && turns(s.motion) && !s.rotation && shape != 0 && shape != 4)
      s.rotation = Rotation{direction(), number()}; // else the rows' own
    s.surface_velocity = maybe(vector());
    s.contact = static_cast<SolidContact>(below(3));
    if (s.contact != SolidContact::stick && below(2))
      s.contact_angle = std::abs(std::remainder(number(), 6.28));
    if (s.contact == SolidContact::flow) {
      s.slip_length = below(2) ? positive() : 0;
      s.receding = below(2);
    }
    if (of.heat && below(2)) {
      s.temperature = temperature();
      s.contact_conductance = positive();
    }
    return s;
  }
  Motion motion() {
    if (below(3) == 0)
      return Translating{velocity()};
    if (below(2) == 0)
      return Fixed{};
    if (below(2) == 0)
      return Keyframed{keyframes()};
    Rotating r{direction(), vector(), {}, below(2) ? velocity() : Timed<Vector3d>{}};
    for (double& t : times())
      r.rate.entries.push_back({t, number()});
    return r;
  }
  std::shared_ptr<const Keyframes> keyframes() {
    std::vector<double> when = times();
    when.push_back(when.back() + std::max(1.0, std::abs(when.back())));
    std::vector<Vector3d> places;
    std::vector<Eigen::Quaterniond> rotations;
    const int kind = below(3);
    Eigen::Quaterniond q(0.5, 0.5, -0.5, 0.5);
    for (std::size_t i = 0; i < when.size(); ++i) {
      if (kind != 0)
        places.push_back(vector());
      if (kind != 1)
        rotations.push_back(q);
      q = (q * Eigen::AngleAxisd(unit(), direction().normalized())).normalized();
    }
    return std::make_shared<const Keyframes>(when, places, rotations,
                                             kind == 0 ? vector() : Vector3d(Vector3d::Zero()));
  }
  Timed<Vector3d> velocity() {
    Timed<Vector3d> result;
    for (double& t : times())
      result.entries.push_back({t, direction()});
    return result;
  }
  std::vector<double>& times() {
    times_.assign(static_cast<std::size_t>(1 + below(4)), 0.0);
    double t = below(2) ? 0 : number();
    for (double& time : times_)
      time = std::exchange(t, t + std::max(1.0, std::abs(t)) * (0.1 + unit()));
    return times_;
  }

  FlowLaw law() {
    FlowLaw law;
    switch (below(4)) {
    case 0:
      law.kind = FlowLawKind::power;
      law.flow_index = positive();
      law.reference_rate = positive();
      break;
    case 1:
      law.kind = FlowLawKind::carreau;
      law.flow_index = positive();
      law.time_constant = positive();
      law.transition = 0.1 + unit(); // it has a greatest value
      break;
    case 2:
      law.kind = FlowLawKind::casson;
      law.yield_stress = positive();
      law.rest_rate = positive();
      break;
    default:
      break;
    }
    return law;
  }

  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  template <class Enum> Enum pick(int n) { return static_cast<Enum>(below(n)); }
  double unit() { return static_cast<double>(random_() >> 11) * 0x1p-53; }
  double positive() { return std::ldexp(1 + unit(), below(60) - 30); }
  double number() { return below(5) == 0 ? 0 : (below(2) ? 1 : -1) * positive(); }
  Vector3d vector() { return {number(), number(), number()}; }
  Vector3d direction() { return {number(), number(), positive()}; }
  Vector3d maybe(const Vector3d& v) { return below(2) ? v : Vector3d::Zero(); }
  std::optional<double> maybe_positive() {
    if (below(2))
      return {};
    return positive();
  }
  std::mt19937_64 random_;
  std::vector<double> times_;
};

TEST(Write, AnySceneReadsBackAsItWas) {
  for (unsigned seed = 0; seed < 2000; ++seed) {
    const Scene scene = RandomScene(seed).make();
    const std::string text = to_toml(scene);
    const auto read = [&] { return parse_scene(text, "canonical"); };
    ASSERT_NO_THROW((void)read()) << problem(text) << "\n" << text;
    ASSERT_EQ(read(), scene) << text;
    ASSERT_EQ(to_toml(read()), text);
  }
}

} // namespace
} // namespace sheet::scene
