// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/plan/drawing_up.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "libsheet/plan/first_frame.h"
#include "libsheet/scene/motion.h"
#include "libsheet/sheet/sheet.h"
#include "libsheet/solid/solids.h"

namespace sheet {

namespace {

// A vertex that lies on a solid.
struct Lying {
  Vector3 x;
  std::size_t solid;
};

class Tools {
public:
  Tools(const Scene& scene, const formats::Frame& first, double until)
      : solids_(scene), up_(*scene::up(scene.environment)), start_(first.time), until_(until),
        thickness_(*measured(first).thickness) {
    const auto x = positions(first);
    const std::size_t stride = x.size() / looked_at + 1;
    for (std::size_t v = 0; v < x.size(); v += stride)
      if (const auto solid = under(x[v]))
        lying_.push_back({x[v], *solid});
    for (std::size_t v = 0; v < x.size(); v += stride)
      if (!under(x[v]) &&
          std::ranges::any_of(lying_, [&](const Lying& what) { return (what.x - x[v]).norm() < beside * thickness_; }))
        spanning_.push_back(x[v]);
  }

  // Whether it comes from above to something that spans a gap, and leaves that place.
  [[nodiscard]] bool draws_along(std::size_t tool) const {
    return std::ranges::any_of(spanning_, [&](const Vector3& x) {
      bool touched = false;
      for (int i = 0; i <= times; ++i) {
        const solid::SolidPoint point = solids_.at(tool, x, start_ + (until_ - start_) * i / times);
        if (touched && point.distance > risen * thickness_)
          return true;
        touched = touched || (point.distance < near_enough * thickness_ && point.normal.dot(up_) < -upright);
      }
      return false;
    });
  }

  // The solid on which something lies that this one comes to, not from below, and rises from.
  [[nodiscard]] std::optional<std::size_t> draws_from(std::size_t tool) const {
    for (const Lying& what : lying_)
      if (what.solid != tool && draws(tool, what))
        return what.solid;
    return std::nullopt;
  }
  [[nodiscard]] const std::string& name(std::size_t solid) const { return solids_.name(solid); }

private:
  [[nodiscard]] std::optional<std::size_t> under(const Vector3& x) const {
    for (std::size_t i = 0; i < solids_.size(); ++i)
      if (const solid::SolidPoint there = solids_.at(i, x, start_);
          there.distance < near_enough * thickness_ && there.normal.dot(up_) > upright)
        return i;
    return std::nullopt;
  }

  [[nodiscard]] bool draws(std::size_t tool, const Lying& what) const {
    const auto moved = [&](std::size_t solid, double t0, double t1, const Vector3& x) {
      return Vector3(scene::motion_between(solids_.scene(solid).motion, t0, t1) * x);
    };
    std::optional<double> touched;
    Vector3 there = what.x; // where it touched
    for (int i = 0; i <= times; ++i) {
      const double t = start_ + (until_ - start_) * i / times;
      const Vector3 x = moved(what.solid, start_, t, what.x);
      if (!touched) {
        const solid::SolidPoint point = solids_.at(tool, x, t);
        if (point.distance < near_enough * thickness_ && point.normal.dot(up_) < upright) {
          touched = t;
          there = x;
        }
      } else if ((moved(tool, *touched, t, there) - x).dot(up_) > clear * thickness_ &&
                 solids_.at(tool, x, t).distance > clear * thickness_ && !passes(tool, there, *touched, t)) {
        return true;
      }
    }
    return false;
  }

  // Whether it has gone on sideways, as a rolling pin, as low as it was above the place where it touched, though what
  // touched there has turned up and away.
  [[nodiscard]] bool passes(std::size_t tool, const Vector3& there, double touched, double t) const {
    const Vector3 way = solids_.pose(tool, t).translation() - solids_.pose(tool, touched).translation();
    const Vector3 sideways = way - way.dot(up_) * up_;
    return room_above(tool, there + sideways, t) < room_above(tool, there, touched) + clear * thickness_;
  }

  // From x up to the solid [m]; without end where it is not above x.
  [[nodiscard]] double room_above(std::size_t solid, const Vector3& x, double t) const {
    double room = 0;
    for (int i = 0; i < marched; ++i) {
      const double distance = solids_.at(solid, x + room * up_, t).distance;
      if (distance < near_solid * thickness_)
        return room;
      room += distance;
    }
    return std::numeric_limits<double>::infinity();
  }

  static constexpr std::size_t looked_at = 200; // vertices, about
  static constexpr int times = 200;
  static constexpr double near_enough = 0.75; // thicknesses: from a solid, of what touches it
  static constexpr double clear = 1;          // thicknesses: of the layer's middle, half of one above its upper face
  static constexpr double risen = 2;          // thicknesses
  static constexpr double beside = 2;         // thicknesses: of what spans a gap, from what lies on a solid
  static constexpr int marched = 100;         // steps of sphere tracing
  static constexpr double near_solid = 1e-3;  // thicknesses
  static constexpr double upright = 0.5;      // cosine between a face that looks up, and up
  solid::Solids solids_;
  Vector3 up_;
  double start_, until_, thickness_;
  std::vector<Lying> lying_;
  std::vector<Vector3> spanning_;
};

} // namespace

std::string drawing_up_warning(const Scene& scene, const formats::Frame& first, double until) {
  if (!scene::up(scene.environment) || scene.solids.size() < 2 || first.vertices == 0)
    return {};
  const Tools tools(scene, first, until);
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (!std::holds_alternative<scene::Fixed>(scene.solids[i].motion))
      if (const auto from = tools.draws_from(i))
        return fmt::format(
            "{} comes to what lies on {} and rises from it, but draws nothing up, with [contact] adhesion "
            "or without: a sheet stays with the solid that it touched first. What is to rise with a tool "
            "lies on it from the start",
            tools.name(i), tools.name(*from));
  return {};
}

std::string drawing_along_warning(const Scene& scene, const formats::Frame& first, double until) {
  const bool comes_off = scene.contact && scene.contact->adhesion;
  if (!scene::up(scene.environment) || scene.solids.size() < 2 || first.vertices == 0 || comes_off)
    return {};
  const Tools tools(scene, first, until);
  for (std::size_t i = 0; i < scene.solids.size(); ++i)
    if (!std::holds_alternative<scene::Fixed>(scene.solids[i].motion) && tools.draws_along(i)) {
      const Liquid& liquid = scene::material_of(scene, scene.sheets.front());
      const double weight = liquid.density * scene.environment.gravity->norm() * *measured(first).thickness;
      return fmt::format("{} comes from above to what spans a gap, and goes on: a sheet stays with the solid that it "
                         "touched first, and is drawn out behind it without end. adhesion = \"{:.2g} Pa\" in [contact] "
                         "lets it come off",
                         tools.name(i), weight / 2);
    }
  return {};
}

} // namespace sheet
