// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/watch_stage.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "libsheet/base/error.h"
#include "libsheet/quantities/scaled_unit.h"
#include "libsheet/scene/frame_scene.h"
#include "libsheet/view/page.h"
#include "libsheet/watch/live_page.h"

namespace sheet::watch {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* html = "text/html; charset=utf-8";

std::uint16_t checked_port(std::int64_t port) {
  if (port < 0 || port > 65535)
    fail(ExitCode::usage, "--port {} is none: they go from 1 to 65535, 0 stands for any that is free", port);
  return static_cast<std::uint16_t>(port);
}

using Handler = std::function<Answer(std::string_view)>;

std::unique_ptr<HttpServer> open_server(const WatchOptions& options, const Handler& handler) {
  if (options.port)
    return std::make_unique<HttpServer>(options.address, checked_port(*options.port), handler);
  constexpr std::uint16_t first = 8000, last = 8019;
  for (std::uint16_t port = first; port < last; ++port)
    try {
      return std::make_unique<HttpServer>(options.address, port, handler);
    } catch (const Error& error) { // taken, as a rule by another run
      if (error.code() != ExitCode::io)
        throw;
    }
  return std::make_unique<HttpServer>(options.address, last, handler);
}

// Null if it has none that can be read.
const Scene* scene_of(const formats::Frame& frame, FrameScene& scenes) {
  try {
    return scenes.find(frame);
  } catch (const Error&) {
    return nullptr;
  }
}

Json to_json(std::optional<double> x) { return x && std::isfinite(*x) ? Json(*x) : Json(nullptr); }

// The panels in which curves are drawn: title, units from large to small with what makes them of SI units, and curves
// with their labels.
Json panels() {
  Json all = Json::array();
  for (const Curve& curve : curves()) {
    const auto same =
        std::find_if(all.begin(), all.end(), [&](const Json& panel) { return panel["title"] == curve.figure->panel; });
    Json& panel = same != all.end() ? *same : all.emplace_back(Json{{"title", curve.figure->panel}});
    if (!panel.contains("units"))
      for (const ScaledUnit& unit : scaled_units(curve.figure->unit))
        panel["units"].push_back({unit.name, 1 / unit.size});
    panel["curves"].push_back({curve.column, curve.label});
  }
  return all;
}

Json history_of_curves(const std::vector<StepFigures>& steps) {
  Json all = {{"time", Json::array()}};
  for (const StepFigures& step : steps) {
    all["time"].push_back(step.time);
    for (std::size_t i = 0; i < curves().size(); ++i)
      all[curves()[i].column].push_back(to_json(step.values[i]));
  }
  return all;
}

} // namespace

WatchStage::WatchStage(const WatchOptions& options)
    : until_(options.until), page_(std::make_shared<const std::string>(live_page())),
      measurer_([this](const std::stop_token& stop) { measure_frames(stop); }),
      server_(open_server(options, [this](std::string_view path) { return answer(path); })) {}

WatchStage::~WatchStage() = default;

void WatchStage::show(const formats::Frame& frame) {
  auto copy = std::make_shared<const formats::Frame>(frame);
  {
    const std::lock_guard lock(mutex_);
    newest_ = std::move(copy);
    measured_ = false;
  }
  news_.notify_one();
}

void WatchStage::measure_frames(const std::stop_token& stop) {
  SceneDensity density; // which tells of a scene that cannot be read
  FrameScene scenes;
  std::unique_lock lock(mutex_);
  while (news_.wait(lock, stop, [this] { return !measured_; })) {
    const std::shared_ptr<const formats::Frame> frame = newest_;
    measured_ = true;
    lock.unlock();
    const StepFigures figures = figures_of(*frame, measure(*frame, density.of(*frame)), scene_of(*frame, scenes));
    lock.lock();
    history_.add(figures, Clock::now());
  }
}

Answer WatchStage::answer(std::string_view path) {
  if (path == "/")
    return {.type = html, .body = page_};
  if (path == "/state.json")
    return {.type = "application/json", .body = std::make_shared<const std::string>(state())};
  if (path == "/frame.html")
    return frame_page();
  return plain_answer(404, "there are /, /state.json and /frame.html\n");
}

Answer WatchStage::frame_page() {
  std::shared_ptr<const formats::Frame> frame;
  {
    const std::lock_guard lock(mutex_);
    frame = newest_;
  }
  if (!frame)
    return plain_answer(503, "no frame has come yet\n");
  if (frame != packed_) {
    try {
      packed_page_ = std::make_shared<const std::string>(view::page_of(*frame, "newest frame"));
    } catch (const std::exception& error) { // a solid's file, say; the run goes on
      return plain_answer(503, std::string(error.what()) + "\n");
    }
    packed_ = frame;
  }
  return {.type = html, .body = packed_page_};
}

std::string WatchStage::state() {
  const RunHistory history = [this] { // a copy, so that the run need not wait while it is written
    const std::lock_guard lock(mutex_);
    return history_;
  }();
  const std::vector<StepFigures>& steps = history.steps();
  Json json = {{"elapsed", std::chrono::duration<double>(Clock::now() - start_).count()},
               {"until", to_json(until_)},
               {"speed", to_json(history.speed())},
               {"left", to_json(until_ ? history.seconds_left(*until_) : std::nullopt)}};
  if (!steps.empty()) {
    const StepFigures& last = steps.back();
    json["time"] = last.time;
    json["step"] = last.step;
    json["vertices"] = last.vertices;
    json["triangles"] = last.triangles;
  }
  json["panels"] = panels();
  json["curves"] = history_of_curves(steps);
  return json.dump();
}

} // namespace sheet::watch
