// SPDX-License-Identifier: GPL-3.0-or-later
// What a run has been so far: a few figures of its steps, and how fast it goes.
#pragma once
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "formats/cpp/stream_frame.h"
#include "libsheet/measure/figures.h"
#include "libsheet/measure/measure.h"
#include "libsheet/scene/scene.h"

namespace sheet::watch {

using Clock = std::chrono::steady_clock;

struct StepFigures {
  double time = 0; // [s]
  std::uint64_t step = 0, vertices = 0, triangles = 0;
  std::vector<double> values = {}; // of curves(), in their order; NaN where there is none
};

// A curve over the run: a figure that the page draws, or one of its values.
struct Curve {
  std::string column, label; // label: what tells it from the others of its panel
  const Figure* figure;
};
[[nodiscard]] const std::vector<Curve>& curves();

// `scene` may be absent.
[[nodiscard]] StepFigures figures_of(const formats::Frame& frame, Measurements measured, const Scene* scene);

class RunHistory {
public:
  // Memory is bounded: beyond `most` steps every second one is forgotten, the last never.
  explicit RunHistory(std::size_t most = 1000) : most_(most) {}

  void add(const StepFigures& figures, Clock::time_point now);
  [[nodiscard]] const std::vector<StepFigures>& steps() const noexcept { return steps_; }

  // Seconds of the run that pass in a second, over the last minute; nothing before the time has moved.
  [[nodiscard]] std::optional<double> speed() const;
  // Seconds until the run's time is `until` at that speed.
  [[nodiscard]] std::optional<double> seconds_left(double until) const;

private:
  std::size_t most_, every_ = 1, passed_ = 0;
  bool last_stays_ = true; // or it is there only until the next one comes
  std::vector<StepFigures> steps_;
  std::deque<std::pair<Clock::time_point, double>> minute_;
};

} // namespace sheet::watch
