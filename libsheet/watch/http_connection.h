// SPDX-License-Identifier: GPL-3.0-or-later
// One connection of the HTTP server: a request comes in, an answer goes out, both as far as the other side lets them,
// and both bounded in time. Nothing here waits.
#pragma once
#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace sheet::watch {

struct Answer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::shared_ptr<const std::string> body; // shared by all that it is sent to
};

[[nodiscard]] Answer plain_answer(int status, std::string text);

class HttpConnection {
public:
  using Clock = std::chrono::steady_clock;
  using Responder = std::function<Answer(std::string_view request)>; // the request's head, all lines of it

  // Takes the descriptor of a connected socket that does not block, and closes it in the end.
  explicit HttpConnection(int descriptor);
  ~HttpConnection();
  HttpConnection(HttpConnection&& other) noexcept;
  HttpConnection& operator=(HttpConnection&& other) noexcept;

  [[nodiscard]] int descriptor() const noexcept { return descriptor_; }
  [[nodiscard]] short events() const noexcept; // of poll(2), which it waits for
  [[nodiscard]] Clock::time_point deadline() const noexcept { return deadline_; }

  // Reads or writes what can be without waiting. False: the connection is at its end.
  [[nodiscard]] bool go_on(const Responder& respond);

private:
  [[nodiscard]] bool receive(const Responder& respond);
  [[nodiscard]] bool send();

  int descriptor_ = -1;
  Clock::time_point deadline_;
  std::string request_, head_; // head_: of the answer; empty as long as the request is not whole
  std::shared_ptr<const std::string> body_;
  std::size_t sent_ = 0;
};

} // namespace sheet::watch
