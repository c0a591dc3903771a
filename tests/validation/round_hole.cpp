// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/validation/round_hole.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace sheet::validation {

namespace {

using std::numbers::pi;

// Rings between the circles of radius r, with their velocity v and the force f on them; ring i is between the circles
// i and i + 1.
class Rings {
public:
  Rings(const PiercedFilm& film, double width) : film_(film) {
    const auto rings = static_cast<std::size_t>(std::ceil((film.outer - film.first) / width));
    for (std::size_t i = 0; i <= rings; ++i)
      r_.push_back(film.first + (film.outer - film.first) * static_cast<double>(i) / static_cast<double>(rings));
    v_.assign(rings + 1, 0);
    const double hole = film.first * film.first, border = (film.first + film.border) * (film.first + film.border);
    for (std::size_t i = 0; i < rings; ++i) {
      const double inside = std::min(r_[i + 1] * r_[i + 1], border) - std::min(r_[i] * r_[i], border);
      volume_.push_back(pi * film.thickness *
                        (r_[i + 1] * r_[i + 1] - r_[i] * r_[i] + hole * inside / (border - hole)));
    }
    least_ = 0.8 * (film.outer - film.first) / static_cast<double>(rings);
  }

  [[nodiscard]] double hole() const { return r_.front(); }

  // One step, by velocities first; returns its length, a part of the period of the shortest wave of the thickness, k²
  // √(γ h/(2 ρ)), and of the time in which viscosity ends it.
  double step() {
    measure();
    f_.assign(r_.size(), 0);
    for (std::size_t i = 1; i + 1 < r_.size(); ++i)
      pull_between(i);
    pull_at_hole();
    pull_at_outer_end();
    for (std::size_t i = 0; i < volume_.size(); ++i)
      pull_within(i);
    double narrowest = film_.outer, thickest = 0;
    for (std::size_t i = 0; i < volume_.size(); ++i) {
      narrowest = std::min(narrowest, r_[i + 1] - r_[i]);
      thickest = std::max(thickest, h_[i]);
    }
    const double wave = std::sqrt(film_.surface_tension * thickest / (2 * film_.density));
    const double dt = narrowest * narrowest * std::min(0.3 / (pi * pi * wave), 0.05 * film_.density / film_.viscosity);
    for (std::size_t i = 0; i + 1 < r_.size(); ++i) {
      v_[i] += dt * f_[i] / mass(i);
      r_[i] += dt * v_[i];
    }
    merge_narrow();
    return dt;
  }

private:
  [[nodiscard]] double mass(std::size_t i) const {
    const double inner = i > 0 ? volume_[i - 1] : 0, outer = i < volume_.size() ? volume_[i] : 0;
    return film_.density * (inner + outer) / 2;
  }

  void measure() {
    middle_.resize(volume_.size());
    h_.resize(volume_.size());
    for (std::size_t i = 0; i < volume_.size(); ++i) {
      middle_[i] = 0.5 * (r_[i] + r_[i + 1]);
      h_[i] = volume_[i] / (pi * (r_[i + 1] * r_[i + 1] - r_[i] * r_[i]));
    }
  }

  // Adds to the force what an energy does that falls by `by_middle` and `by_thickness` with those of a ring.
  void push(std::size_t ring, double by_middle, double by_thickness) {
    const double thinner =
        by_thickness * h_[ring] * 2 * pi / (pi * (r_[ring + 1] * r_[ring + 1] - r_[ring] * r_[ring]));
    f_[ring] += 0.5 * by_middle + thinner * r_[ring];
    f_[ring + 1] += 0.5 * by_middle - thinner * r_[ring + 1];
  }

  // Both faces between the middles of two rings: 2 γ 2 π r √(Δc² + Δh²/4).
  void pull_between(std::size_t i) {
    const double along = middle_[i] - middle_[i - 1], across = 0.5 * (h_[i] - h_[i - 1]),
                 slant = std::hypot(along, across);
    const double unit = 4 * pi * film_.surface_tension;
    push(i, -unit * r_[i] * along / slant, -unit * r_[i] * across / (2 * slant));
    push(i - 1, unit * r_[i] * along / slant, unit * r_[i] * across / (2 * slant));
    f_[i] -= unit * slant;
  }

  // From the middle of the first ring to the point at the rim: a cone.
  void pull_at_hole() {
    const double along = middle_[0] - r_[0], across = 0.5 * h_[0], slant = std::hypot(along, across);
    const double unit = 4 * pi * film_.surface_tension, radius = 0.5 * (r_[0] + middle_[0]);
    push(0, -unit * (0.5 * slant + radius * along / slant), -unit * radius * across / (2 * slant));
    f_[0] -= unit * (0.5 * slant - radius * along / slant);
  }

  // Level from the last middle to the outer end, which does not move.
  void pull_at_outer_end() { push(volume_.size() - 1, 4 * pi * film_.surface_tension * r_.back(), 0); }

  // Viscous stress: the power 2 μ V (ε_r² + ε_θ² + (ε_r + ε_θ)²) / 2 falls by it.
  void pull_within(std::size_t i) {
    const double width = r_[i + 1] - r_[i], around = r_[i + 1] + r_[i];
    const double radial = (v_[i + 1] - v_[i]) / width, hoop = (v_[i + 1] + v_[i]) / around;
    const double unit = 2 * film_.viscosity * volume_[i];
    const double along = unit * (2 * radial + hoop) / width, round = unit * (2 * hoop + radial) / around;
    f_[i] += along - round;
    f_[i + 1] -= along + round;
  }

  // Two rings that are together narrower than four fifths of one at the start become one; volume and momentum stay.
  void merge_narrow() {
    for (std::size_t i = 1; i + 1 < r_.size(); ++i) {
      if (r_[i + 1] - r_[i - 1] >= least_)
        continue;
      const double inner = film_.density * volume_[i] / 2, outer = film_.density * volume_[i - 1] / 2;
      v_[i - 1] = (mass(i - 1) * v_[i - 1] + inner * v_[i]) / (mass(i - 1) + inner);
      if (i + 2 < r_.size())
        v_[i + 1] = (mass(i + 1) * v_[i + 1] + outer * v_[i]) / (mass(i + 1) + outer);
      volume_[i - 1] += volume_[i];
      const auto at = static_cast<std::ptrdiff_t>(i);
      volume_.erase(volume_.begin() + at);
      r_.erase(r_.begin() + at);
      v_.erase(v_.begin() + at);
    }
  }

  PiercedFilm film_;
  double least_ = 0; // width of two rings [m]
  std::vector<double> r_, v_, f_, volume_, middle_, h_;
};

} // namespace

std::vector<HoleRadius> growth_of_hole(const PiercedFilm& film, double last, double width) {
  constexpr double apart = 1e-3; // of the last radius: what is noted
  Rings rings(film, width);
  std::vector<HoleRadius> growth{{0, rings.hole()}};
  double time = 0;
  while (rings.hole() > 0 && rings.hole() < last) {
    time += rings.step();
    if (rings.hole() > growth.back().radius + apart * last)
      growth.push_back({time, rings.hole()});
  }
  growth.push_back({time, rings.hole()});
  return growth;
}

double time_at(const std::vector<HoleRadius>& growth, double radius) {
  const auto after = std::ranges::find_if(growth, [&](const HoleRadius& at) { return at.radius >= radius; });
  if (after == growth.begin())
    return after->time;
  if (after == growth.end())
    return growth.back().time;
  const HoleRadius& before = *std::prev(after);
  return before.time + (radius - before.radius) / (after->radius - before.radius) * (after->time - before.time);
}

} // namespace sheet::validation
