// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/collide/collide_stage.h"

#include <algorithm>
#include <bit>
#include <ctime>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "libsheet/base/error.h"
#include "libsheet/base/log.h"
#include "libsheet/base/magnitudes.h"
#include "libsheet/collide/drop_landing.h"
#include "libsheet/collide/known_triangles.h"
#include "libsheet/collide/loose_springs.h"
#include "libsheet/collide/release.h"
#include "libsheet/collide/self_response.h"
#include "libsheet/collide/solid_contact.h"
#include "libsheet/collide/solid_sweep.h"
#include "libsheet/collide/spring_feet.h"
#include "libsheet/geometry/disjoint_sets.h"
#include "libsheet/geometry/vertex_shares.h"
#include "libsheet/health/teller.h"
#include "libsheet/scene/frame_liquids.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/scene/prescribed.h"
#include "libsheet/sheet/drops.h"
#include "libsheet/sheet/frame_mesh.h"
#include "libsheet/sheet/overshoot.h"
#include "libsheet/sheet/sheet.h"

namespace sheet::collide {

using formats::Array;
using formats::Frame;

namespace {

// The mesh cannot tell apart what is nearer than two edges along the sheet.
constexpr double edges_of_reach = 2;
// Rounds of self-response that leave alone what would go into a solid.
constexpr int rounds_with_solids = 4;

// Processor time of all threads since the last call [s]: other work on the machine disturbs it least.
class Watch {
public:
  double lap() {
    const std::clock_t now = std::clock();
    return static_cast<double>(now - std::exchange(last_, now)) / CLOCKS_PER_SEC;
  }

private:
  std::clock_t last_ = std::clock();
};

struct Totals {
  std::uint64_t steps = 0, with_hits = 0;
  SolidReport solids;
  SelfReport self;
  Landed landed;
  std::size_t most_springs = 0, released = 0;
  double with_solids = 0, check = 0, response = 0, springs = 0; // processor time [s]
};

// Of each vertex: a third of its triangles'.
struct Shares {
  std::vector<double> area, volume, edge; // [m²], [m³], mean length of the sides around it [m]
};

Shares shares(std::span<const Corners> triangles, std::span<const double> volumes, std::span<const Vector3> x) {
  const std::size_t n = x.size();
  const auto side = [&](std::uint32_t t, std::size_t from, std::size_t to) {
    return Vector3(x[triangles[t][to]] - x[triangles[t][from]]);
  };
  Shares s;
  s.area =
      vertex_shares(n, triangles, [&](std::uint32_t t) { return 0.5 * side(t, 0, 1).cross(side(t, 0, 2)).norm(); });
  s.volume = vertex_shares(n, triangles, [&](std::uint32_t t) { return volumes[t]; });
  s.edge = vertex_shares(n, triangles, [&](std::uint32_t t) {
    return side(t, 0, 1).norm() + side(t, 0, 2).norm() + (side(t, 0, 1) - side(t, 0, 2)).norm();
  });
  const std::vector<double> count = sum_around(n, triangles, [](std::uint32_t) { return 1; });
  for (std::size_t i = 0; i < n; ++i)
    s.edge[i] /= std::max(count[i], 1.0);
  return s;
}

// Volume over area at each vertex [m]. Where triangles are crushed that is beyond sense: above two edges it is not much
// more than around them.
std::vector<double> thicknesses(std::span<const Corners> triangles, const Shares& s) {
  constexpr double much_more = 1.2;
  const std::size_t n = s.volume.size();
  std::vector<double> thickness(n), volume_around(n, 0), area_around(n, 0);
  for (const Corners& c : triangles)
    for (const std::uint32_t v : c)
      for (const std::uint32_t w : c) {
        volume_around[v] += s.volume[w];
        area_around[v] += s.area[w];
      }
  for (std::size_t v = 0; v < n; ++v) {
    const double limit =
        std::max(edges_of_reach * s.edge[v], area_around[v] > 0 ? much_more * volume_around[v] / area_around[v] : 0);
    thickness[v] = s.volume[v] < limit * s.area[v] ? s.volume[v] / s.area[v] : limit;
  }
  return thickness;
}

// Of what was caught in this step, and what of earlier ones the sheet has not made up for, where solids hold it yet.
void add_overshoots(const StepPath& path, Frame& frame) {
  std::vector<Overshoot> all = overshoots(frame);
  all.resize(frame.vertices);
  for (std::size_t v = 0; v < all.size(); ++v)
    if (!path.overshoot[v].isZero(0))
      all[v] = {path.overshoot[v], time_to_make_up * path.length()};
    else if (path.touch[v] == no_solid)
      all[v] = {};
  put_overshoots(all, frame);
}

// a_T at vertices, the mean of their triangles by volume; empty where viscosity does not depend on temperature.
std::vector<double> vertex_shifts(const Frame& frame, const FrameLiquids& liquids) {
  const auto temperature = temperatures(frame), volume = volumes(frame);
  const auto constant = [](const Liquid& liquid) { return liquid.temperature_law.constant(); };
  if (temperature.empty() || std::ranges::all_of(liquids.all(), constant))
    return {};
  std::vector<ViscosityShift> by_liquid;
  for (const Liquid& liquid : liquids.all())
    by_liquid.emplace_back(liquid.temperature_law);
  const auto of = [&](auto value) { return vertex_shares(frame.vertices, triangles(frame), value); };
  std::vector<double> shifts =
      of([&](std::uint32_t t) { return volume[t] * by_liquid[liquids.number(t)].factor(temperature[t]); });
  const std::vector<double> carried = of([&](std::uint32_t t) { return volume[t]; });
  for (std::size_t v = 0; v < shifts.size(); ++v)
    shifts[v] = carried[v] > 0 ? shifts[v] / carried[v] : 1;
  return shifts;
}

} // namespace

struct CollideStage::Impl {
  FrameScene scenes;
  const Scene* scene = nullptr;        // the frame's
  std::optional<solid::Solids> solids; // if the scene has some
  FrameMesh mesh;
  std::optional<SelfSearch> search;
  std::vector<Vector3> last_end; // safe, so a step that starts there on the same mesh needs no check
  KnownTriangles known;          // those of the last end: of another mesh, pairs of them need no check
  Totals totals;
  health::Teller teller;

  void tell_of_two_solids(Frame& frame, const SolidReport& report) {
    const BetweenSolids& at = report.narrowest;
    teller.tell(
        frame,
        {.trouble = health::Trouble::two_solids,
         .value = static_cast<double>(report.between) / static_cast<double>(frame.vertices),
         .amount = static_cast<double>(report.between),
         .place = at.place},
        fmt::format("step {}: {} vertices lie between {} and {}, at the narrowest {:.2g} m apart where the sheet is "
                    "still {:.2g} m thick: what is squeezed cannot get away so fast",
                    frame.step, report.between, solids->name(at.first), solids->name(at.second), at.gap, at.thickness));
  }

  void read_scene_of(const Frame& frame) {
    scene = &scenes.of(frame);
    if (!scenes.changed())
      return;
    solids.reset();
    if (!scene->solids.empty())
      solids.emplace(*scene);
  }

  [[nodiscard]] bool self() const { return scene->contact && scene->contact->self; }

  [[nodiscard]] StepPath path_of(const Frame& frame, Shares& at_start) const {
    const Array* start = frame.find("start_position");
    const double nan = std::numeric_limits<double>::quiet_NaN();
    StepPath path;
    path.start_time = number(frame, "start_time", nan);
    path.end_time = frame.time;
    path.gravity = scene->environment.gravity.value_or(Vector3::Zero());
    if (start == nullptr || !(path.start_time < path.end_time))
      fail(ExitCode::bad_input,
           "the frame does not say where and when its step started (start_position, start_time before {} s): "
           "sheet-collide stands right behind sheet-step",
           frame.time);
    path.triangles = triangles(frame);
    path.start = start->values<Vector3>();
    path.end.assign(positions(frame).begin(), positions(frame).end());
    const auto v = velocities(frame);
    path.velocity.assign(v.begin(), v.end());
    path.velocity.resize(frame.vertices, Vector3::Zero());
    path.touch = touched_solids(frame, scene->solids.size());
    path.fixed = scene::prescribed_axes(frame, *scene, path.start_time);
    at_start = shares(path.triangles, volumes(frame), path.start);
    path.thickness = thicknesses(path.triangles, at_start);
    const FrameLiquids liquids(*scene, frame);
    const std::vector<std::uint32_t> numbers = liquids.numbers_at_vertices(frame);
    for (std::size_t i = 0; i < at_start.volume.size(); ++i) {
      const double density = liquids.all()[numbers.empty() ? 0 : numbers[i]].density;
      path.mass.push_back(at_start.volume[i] * (density > 0 ? density : 1));
    }
    if (layers_flow(*scene))
      path.end_thickness = thicknesses(path.triangles, shares(path.triangles, volumes(frame), path.end));
    return path;
  }

  // Contact distance at each vertex.
  [[nodiscard]] std::vector<double> reach_of(const StepPath& path, const Shares& shares) const {
    std::vector<double> reach = path.thickness;
    for (std::size_t v = 0; v < reach.size(); ++v)
      reach[v] = std::min(scene->contact->distance.value_or(reach[v]), edges_of_reach * shares.edge[v]);
    return reach;
  }

  // Where a step has led a vertex that is elsewhere for the sheet's contact with itself.
  struct Displaced {
    std::uint32_t vertex;
    Vector3 end;
  };

  // sheet-emit puts the borders of inlets back to where they started from, so there they must not meet what has come
  // round behind them; the triangles there cover those of the step's end.
  static std::vector<Displaced> put_borders_back(const Frame& frame, StepPath& path) {
    std::vector<Displaced> borders;
    const auto inlets = sheet::masks(frame, "inlet");
    for (std::uint32_t v = 0; v < inlets.size(); ++v)
      if (at_a_border(inlets[v])) {
        borders.push_back({v, path.end[v]});
        path.end[v] = path.start[v];
      }
    return borders;
  }

  // Whether one vertex is reached from another one along triangles.
  static bool are_connected(const StepPath& path, std::uint32_t one, std::uint32_t other) {
    DisjointSets pieces(path.start.size());
    for (const Corners& t : path.triangles) {
      pieces.join(t[0], t[1]);
      pieces.join(t[0], t[2]);
    }
    return pieces.find(one) == pieces.find(other);
  }

  void check_start(const StepPath& path) {
    if (std::equal(path.start.begin(), path.start.end(), last_end.begin(), last_end.end()))
      return;
    if (const auto pair = search->crossing(path.start, known.unknown(path.triangles, path.start))) {
      const Corners &one = path.triangles[pair->first], &other = path.triangles[pair->second];
      Vector3 place = Vector3::Zero();
      for (const Corners* corners : {&one, &other})
        for (const std::uint32_t v : *corners)
          place += path.start[v] / 6;
      fail(ExitCode::bad_input,
           "{} before the step, near ({:.4g}, {:.4g}, {:.4g}) m: triangles {} and {}, and perhaps more (sheet-check "
           "lists them); start from a sheet that does not, or let it: [contact] self = false",
           are_connected(path, one[0], other[0]) ? "the sheet passes through itself"
                                                 : "two sheets, or pieces of one, pass through each other",
           place.x(), place.y(), place.z(), pair->first, pair->second);
    }
  }

  // A vertex that a step has thrown far away sweeps over everything there is, and what is found means nothing.
  static void check_stretch(const StepPath& path) {
    check_stretch(path, path.start, path.end, "become");
    check_stretch(path, path.end, path.start, "been");
  }

  // No edge at one end of the step may be much longer than the whole sheet is at the other one.
  static void check_stretch(const StepPath& path, std::span<const Vector3> whole, std::span<const Vector3> places,
                            std::string_view when) {
    constexpr double most = 100;
    solid::Box3 box;
    for (const Vector3& x : whole)
      box.extend(x);
    const double limit = most * box.diagonal().norm();
    for (const Corners& t : path.triangles)
      for (std::size_t i = 0; i < 3 && limit > 0; ++i) {
        const std::uint32_t a = t[i], b = t[(i + 1) % 3];
        const Vector3 &x = places[a], &y = places[b];
        if (const double length = (y - x).norm(); !(length <= limit))
          fail(ExitCode::bad_input,
               "in one step, the edge from vertex {} at ({:.6g}, {:.6g}, {:.6g}) to vertex {} at ({:.6g}, {:.6g}, "
               "{:.6g}) has {} {:.3g} m long, more than {:g} times the whole sheet: it has blown up; take shorter "
               "steps, or remesh before them",
               a, x.x(), x.y(), x.z(), b, y.x(), y.y(), y.z(), when, length, most);
      }
  }

  void step(Frame& frame) {
    Shares at_start;
    StepPath path = path_of(frame, at_start);
    check_stretch(path);
    Watch watch;
    std::vector<std::uint32_t> off;
    if (solids) {
      refuse_driven_in(frame, path);
      off = coming_off(frame, path);
      const SolidReport report = resolve_solids(path, *solids);
      if (report.unresolved > 0)
        teller.tell(frame, health::Trouble::close_to_solid, report.unresolved, report.unresolved_at,
                    fmt::format("step {}: {} triangles come too close to solids; if that comes back step after step, "
                                "take shorter steps or shorter edges",
                                frame.step, report.unresolved));
      if (report.between > 0)
        tell_of_two_solids(frame, report);
      totals.solids += report;
      totals.released += off.size();
      totals.with_solids += watch.lap();
    }
    if (self()) {
      if (mesh.follow(frame)) {
        last_end.clear();
        search.emplace(*mesh.mesh());
      }
      const std::vector<double> reach = reach_of(path, at_start);
      const std::vector<Displaced> borders = put_borders_back(frame, path);
      search->gather(path.start, path.end, reach);
      check_start(path);
      totals.check += watch.lap();
      const std::vector<Axes> fixed = path.fixed;
      double taken = solids ? taken_by_solids(path, velocities(frame)) : 0;
      taken = std::max(0.0, taken + resolve_self_beside_solids(path, reach, frame));
      totals.response += watch.lap();
      set_springs(frame, path, fixed, reach, taken);
      known.remember(path.triangles, path.start, path.end);
      last_end = path.end;
      for (const Displaced& border : borders)
        path.end[border.vertex] = border.end;
      totals.springs += watch.lap();
    } else {
      known.forget();
      last_end.clear();
    }
    if (solids) { // what comes off was held in this step, and is free in the next one
      for (const std::uint32_t v : off)
        path.touch[v] = no_solid;
      put_touched_solids(frame, path.touch, scene->solids.size());
      frame.erase("touch_load"); // of this step alone
      add_overshoots(path, frame);
    }
    std::copy(path.end.begin(), path.end.end(), positions(frame).begin());
    std::copy(path.velocity.begin(), path.velocity.end(), velocities(frame).begin());
    ++totals.steps;
  }

  void land(Frame& frame) {
    const Landed landed = land_drops(frame, *scene, solids ? &*solids : nullptr);
    if (landed.on_sheet + landed.on_solids > 0)
      log::detail("step {}: {} drops land on the sheet, {:.3g} m^3, and {} on solids", frame.step, landed.on_sheet,
                  landed.volume, landed.on_solids);
    totals.landed += landed;
  }

  // Nothing can bring out what a [[hold]] drives into a solid, nor what hangs on it: impulses on what is free would
  // move it as far as the solid goes on, step by step. What is held in a solid from the start stays there.
  void refuse_driven_in(const Frame& frame, const StepPath& path) const {
    const auto held = holds(frame);
    for (std::size_t v = 0; v < held.size(); ++v) {
      if (held[v] == 0 || path.fixed[v] != all_axes)
        continue;
      const double deep = -clearance_part * path.thickness[v] / 2;
      for (std::size_t i = 0; i < solids->size(); ++i) {
        const Vector3& x = path.end[v];
        const double ends = solids->at(i, x, path.end_time).distance;
        if (ends < deep && solids->at(i, path.start[v], path.start_time).distance >= deep)
          fail(ExitCode::bad_input,
               "at t = {:.6g} s, vertex {} at ({:.6g}, {:.6g}, {:.6g}) m, which [[hold]] number {} (from 0) holds, is "
               "{:.3g} m inside {}: end that hold before (until), or lead it or the solid another way",
               path.end_time, v, x.x(), x.y(), x.z(), std::countr_zero(held[v]), -ends, solids->name(i));
      }
    }
  }

  // Vertices whose solid cannot hold them any longer.
  [[nodiscard]] std::vector<std::uint32_t> coming_off(const Frame& frame, const StepPath& path) const {
    const Array *force = frame.find("touch_force"), *load = frame.find("touch_load");
    if (force == nullptr || !scene->contact || !scene->contact->adhesion)
      return {};
    return pulled_off(path, *solids, force->values<Vector3>(),
                      load != nullptr ? load->values<Vector3>() : std::span<const Vector3>(), *scene->contact->adhesion,
                      shares(path.triangles, volumes(frame), path.end).area);
  }

  // How each solid moves in the step; none if all stand still.
  [[nodiscard]] std::vector<SolidMotion> solid_motions(const StepPath& path) const {
    std::vector<SolidMotion> motions;
    bool moving = false;
    for (std::size_t i = 0; solids && i < solids->size(); ++i) {
      const scene::Motion& motion = solids->scene(i).motion;
      const Eigen::Isometry3d step = scene::motion_between(motion, path.start_time, path.end_time);
      motions.push_back({{step.linear(), step.translation()}, velocity_of(motion, path.end_time)});
      moving = moving || !step.isApprox(Eigen::Isometry3d::Identity(), 0);
    }
    return moving ? motions : std::vector<SolidMotion>{};
  }

  [[nodiscard]] static RigidVelocity velocity_of(const scene::Motion& motion, double t) {
    RigidVelocity velocity{.shift = scene::velocity_at(motion, t, Vector3::Zero())};
    for (int k = 0; k < 3; ++k) { // Σ e_k × (ω × e_k) = 2 ω
      const Vector3 unit = Vector3::Unit(k), about = scene::velocity_at(motion, t, unit) - velocity.shift;
      velocity.turn += 0.5 * unit.cross(about);
    }
    return velocity;
  }

  // The one that holds the vertex, or else is nearest to it.
  [[nodiscard]] std::size_t solid_at(const StepPath& path, std::size_t v) const {
    if (path.touch[v] != no_solid)
      return static_cast<std::size_t>(path.touch[v]);
    std::size_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < solids->size(); ++i)
      if (const double distance = solids->at(i, path.end[v], path.end_time).distance; distance < least) {
        least = distance;
        nearest = i;
      }
    return nearest;
  }

  // The kinetic energy that solids took of each vertex [J], seen from the solid there, where its impulses do no work.
  [[nodiscard]] double taken_by_solids(const StepPath& path, std::span<const Vector3> before) const {
    double taken = 0;
    for (std::size_t v = 0; v < before.size(); ++v)
      if (const Vector3& was = before[v], &is = path.velocity[v]; was != is) {
        const Vector3 seen = (was + is) / 2 - solids->at(solid_at(path, v), path.end[v], path.end_time).velocity;
        taken += path.mass[v] * (was - is).dot(seen);
      }
    return taken;
  }

  // Whether the self-response has moved a vertex, which touched none, so deep into a solid that the next step would
  // refuse it, or have to bring it out (solid_contact.cpp).
  [[nodiscard]] bool drives_in(const StepPath& path, const StepPath& asked) const {
    for (std::size_t v = 0; v < path.end.size(); ++v)
      if (path.touch[v] == no_solid && path.end[v] != asked.end[v])
        for (std::size_t i = 0; i < solids->size(); ++i)
          if (solids->at(i, path.end[v], path.end_time).distance < -path.thickness[v] / 2)
            return true;
    return false;
  }

  // Vertices that the self-response would move into a solid stay where the solids put them, and the rest tries again.
  // Where that still drives some in, all go on as far as they can, and nothing is pushed.
  // Returns the kinetic energy that it took, less what it gave [J].
  double resolve_self_beside_solids(StepPath& path, std::span<const double> reach, Frame& frame) {
    const StepPath asked = path;
    const std::vector<SolidMotion> motions = solid_motions(path);
    std::vector<std::int32_t> kept_out_of(motions.empty() ? 0 : path.end.size(), no_solid);
    SelfReport report;
    for (int round = 1;; ++round) {
      report = resolve_self(path, *search, reach, asked.fixed, {motions, kept_out_of});
      if (!solids || report.hits == 0 || round == rounds_with_solids)
        break;
      std::vector<Axes> fixed = path.fixed;
      for (const std::uint32_t t : unsafe_triangles(path, *solids))
        for (const std::uint32_t v : path.triangles[t])
          if (path.end[v] != asked.end[v]) {
            fixed[v] = all_axes;
            if (!motions.empty() && asked.fixed[v] == 0)
              kept_out_of[v] = static_cast<std::int32_t>(solid_at(path, v));
          }
      if (fixed == path.fixed)
        break;
      path = asked;
      path.fixed = std::move(fixed);
    }
    if (solids && report.hits > 0 && drives_in(path, asked)) {
      const std::vector<Axes> fixed = std::move(path.fixed);
      path = asked;
      path.fixed = fixed;
      report = resolve_self(path, *search, reach, asked.fixed, {motions, kept_out_of}, Means::pull_back);
    }
    if (report.held_back > 0)
      teller.tell(frame, health::Trouble::held_back, report.held_back, report.held_at,
                  fmt::format("step {}: {} vertices on solids or held stay behind, or the sheet would pass through "
                              "itself; if that comes back step after step, solids or [[hold]]s leave the sheet too "
                              "little room",
                              frame.step, report.held_back));
    totals.with_hits += report.hits > 0;
    totals.self += report;
    log::detail("step {}: {} hits; {} impulses, {} vertices in rigid groups, {} pulled back", frame.step, report.hits,
                report.by_impulses, report.in_groups, report.pulled_back);
    return report.taken;
  }

  void set_springs(Frame& frame, StepPath& path, const std::vector<Axes>& fixed, std::span<const double> reach,
                   double taken) {
    const Shares at_end = shares(path.triangles, volumes(frame), path.end);
    const FrameLiquids liquids(*scene, frame);
    const std::vector<double> shift = vertex_shifts(frame, liquids);
    const std::vector<std::uint32_t> numbers = liquids.numbers_at_vertices(frame);
    const SpringSheet sheet{path.start,    path.end, reach,         path.thickness,
                            at_end.area,   fixed,    path.length(), path.end_thickness,
                            shift,         numbers,  liquids.all(), layers_flow(*scene) ? mesh.mesh().get() : nullptr,
                            volumes(frame)};
    std::vector<ContactSpring> springs = read_springs(frame);
    drop_within_layers(springs, search->layers(), sheet);
    weld_anew(springs, *mesh.mesh(), path.start);
    const LooseSprings loose = take_loose(springs, *mesh.mesh(), path.start);
    std::vector<double> had = follow(springs, *scene, sheet, positions(frame));
    std::vector<ContactSpring> left = let_feet_slide(springs, had, *mesh.mesh(), path.end);
    const std::size_t old = springs.size();
    add_springs(springs, *search, *scene, sheet);
    hand_over(loose.aside, path.end, springs);
    hand_over(left, path.end, springs);
    ease_strained(springs, had,
                  taken + energy_of(loose.aside, *scene, positions(frame)) + energy_of(left, *scene, path.end), *scene,
                  path.end);
    hand_over(loose.without_features, path.end, springs); // as they were before the mesh changed
    level_velocities(std::span(springs).subspan(old), *scene, path.mass, fixed, path.velocity);
    totals.most_springs = std::max(totals.most_springs, springs.size());
    date(springs, *scene, frame.time);
    write_springs(frame, springs);
  }
};

CollideStage::CollideStage() : impl_(std::make_unique<Impl>()) {}
CollideStage::~CollideStage() = default;

void CollideStage::step(Frame& frame) {
  check_magnitudes(frame);
  impl_->read_scene_of(frame);
  if (frame.triangles > 0 && (impl_->solids || impl_->self()))
    impl_->step(frame);
  if (knows_drops(frame))
    impl_->land(frame);
}

void CollideStage::report() const {
  const Totals& t = impl_->totals;
  impl_->teller.report();
  if (t.landed.on_sheet + t.landed.on_solids > 0)
    log::detail("{} drops have landed on the sheet, {:.3g} m^3, and {} on solids", t.landed.on_sheet, t.landed.volume,
                t.landed.on_solids);
  if (t.steps == 0)
    return;
  const double ms = 1e3 / static_cast<double>(t.steps);
  if (impl_->solids) {
    log::detail("{} steps with solids: {} vertices caught, {} released, {} brought out, at most {} touching, at "
                "most {} triangles that start across a surface, {} impulses, {} vertices carried",
                t.steps, t.solids.caught, t.released, t.solids.brought_out, t.solids.touching, t.solids.started_across,
                t.solids.pushed, t.solids.carried);
    log::detail("  processor time of a step: {:.2f} ms", ms * t.with_solids);
  }
  if (impl_->self()) {
    log::detail("{} steps with the sheet itself, {} of them with hits ({} pairs): {} impulses, {} vertices in rigid "
                "groups, {} pulled back ({} of them held), {} rounds; at most {} springs",
                t.steps, t.with_hits, t.self.hits, t.self.by_impulses, t.self.in_groups, t.self.pulled_back,
                t.self.held_back, t.self.rounds, t.most_springs);
    log::detail("  processor time of a step: candidates and check of the start {:.2f} ms, response {:.2f} ms, springs "
                "{:.2f} ms",
                ms * t.check, ms * t.response, ms * t.springs);
  }
}

} // namespace sheet::collide
