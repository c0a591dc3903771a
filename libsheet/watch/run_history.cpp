// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/run_history.h"

#include <algorithm>

#include "libsheet/sheet/sheet.h"

namespace sheet::watch {

namespace {

double energy_of_gravity(const formats::Frame& frame, const Scene& scene) {
  if (!scene.environment.gravity || scene.material.density <= 0)
    return absent;
  const auto x = positions(frame);
  const auto corners = triangles(frame);
  const auto v = volumes(frame);
  Eigen::Vector3d moment = Eigen::Vector3d::Zero(); // of volume [m⁴]
  for (std::size_t t = 0; t < corners.size(); ++t)
    moment += v[t] / 3 * (x[corners[t][0]] + x[corners[t][1]] + x[corners[t][2]]);
  return -scene.material.density * scene.environment.gravity->dot(moment);
}

} // namespace

StepFigures figures_of(const formats::Frame& frame, const Measurements& measured, const Scene* scene) {
  return {.time = frame.time,
          .step = frame.step,
          .vertices = frame.vertices,
          .triangles = frame.triangles,
          .volume = measured.volume,
          .area = measured.area,
          .thickness_min = measured.thickness.least,
          .thickness_mean = measured.thickness.mean,
          .thickness_max = measured.thickness.greatest,
          .kinetic_energy = measured.kinetic_energy,
          .gravity_energy = scene != nullptr ? energy_of_gravity(frame, *scene) : absent,
          .surface_energy = scene != nullptr && scene->material.surface_tension > 0
                                ? 2 * scene->material.surface_tension * measured.area
                                : absent};
}

void RunHistory::add(const StepFigures& figures, Clock::time_point now) {
  if (!last_stays_)
    steps_.pop_back();
  last_stays_ = passed_++ % every_ == 0;
  steps_.push_back(figures);
  if (last_stays_ && steps_.size() > most_) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < steps_.size(); i += 2)
      steps_[kept++] = steps_[i];
    if (steps_.size() % 2 == 0) { // the last is not among them
      steps_[kept++] = figures;
      last_stays_ = false;
    }
    steps_.resize(kept);
    every_ *= 2;
  }
  minute_.emplace_back(now, figures.time);
  while (minute_.size() > 2 && now - minute_.front().first > std::chrono::minutes(1))
    minute_.pop_front();
}

std::optional<double> RunHistory::speed() const {
  if (minute_.size() < 2)
    return std::nullopt;
  const double passed = minute_.back().second - minute_.front().second;
  const double elapsed = std::chrono::duration<double>(minute_.back().first - minute_.front().first).count();
  return passed > 0 && elapsed > 0 ? std::optional(passed / elapsed) : std::nullopt;
}

std::optional<double> RunHistory::seconds_left(double until) const {
  const std::optional<double> rate = speed();
  return rate ? std::optional(std::max(0.0, until - minute_.back().second) / *rate) : std::nullopt;
}

} // namespace sheet::watch
