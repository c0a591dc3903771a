// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/run_history.h"

#include <algorithm>
#include <array>

namespace sheet::watch {

const std::vector<Curve>& curves() {
  static const std::vector<Curve> all = [] {
    std::vector<Curve> made;
    for (const Figure& figure : figures()) {
      if (figure.panel.empty())
        continue;
      const std::vector<std::string> columns = figure.columns();
      for (std::size_t i = 0; i < columns.size(); ++i)
        made.push_back({columns[i],
                        figure.form == Figure::Form::range ? std::array{"least", "mean", "greatest"}[i]
                        : figure.caption == figure.panel   ? ""
                                                           : figure.caption,
                        &figure});
    }
    return made;
  }();
  return all;
}

StepFigures figures_of(const formats::Frame& frame, Measurements measured, const Scene* scene) {
  if (scene != nullptr)
    measure_energies(frame, *scene, measured);
  StepFigures step{frame.time, frame.step, frame.vertices, frame.triangles};
  for (const Figure& figure : figures())
    if (!figure.panel.empty())
      for (const double value : figure.values(measured))
        step.values.push_back(value);
  return step;
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
