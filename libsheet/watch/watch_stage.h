// SPDX-License-Identifier: GPL-3.0-or-later
// A run that goes on, shown by a page: the stage hands over a copy of each frame; measuring it and answering browsers
// are done by threads of their own, which pass over frames that come faster than they work. The run waits for neither.
#pragma once
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "formats/cpp/stream_frame.h"
#include "libsheet/watch/http_server.h"
#include "libsheet/watch/run_history.h"

namespace sheet::watch {

struct WatchOptions {
  std::string address = "127.0.0.1";
  std::optional<std::int64_t> port; // 0: any that is free; absent: the first that is, of 20 from 8000 on
  std::optional<double> until;      // the run's end [s], for the time that is left
};

class WatchStage {
public:
  // Throws Error: usage (address, port), io (the port cannot be had).
  explicit WatchStage(const WatchOptions& options);
  ~WatchStage();
  WatchStage(const WatchStage&) = delete;
  WatchStage& operator=(const WatchStage&) = delete;

  void show(const formats::Frame& frame);
  [[nodiscard]] const std::string& url() const noexcept { return server_->url(); }

private:
  void measure_frames(const std::stop_token& stop);
  [[nodiscard]] Answer answer(std::string_view path);
  [[nodiscard]] Answer frame_page();
  [[nodiscard]] std::string state();

  std::optional<double> until_;
  const std::shared_ptr<const std::string> page_;
  std::shared_ptr<const formats::Frame> packed_; // the server's thread alone has these two
  std::shared_ptr<const std::string> packed_page_;
  const Clock::time_point start_ = Clock::now();
  std::mutex mutex_; // of what follows
  std::condition_variable_any news_;
  std::shared_ptr<const formats::Frame> newest_;
  bool measured_ = true;
  RunHistory history_;
  std::jthread measurer_;
  std::unique_ptr<HttpServer> server_; // the last, as its thread uses all of the above
};

} // namespace sheet::watch
