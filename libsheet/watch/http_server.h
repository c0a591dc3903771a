// SPDX-License-Identifier: GPL-3.0-or-later
// A small HTTP server that answers GET on a thread of its own: one request a connection, up to 256 connections at a
// time, none of which waits for another, each bounded in size and time. [RFC 9110, 9112]
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <thread>

#include "libsheet/watch/http_connection.h"

namespace sheet::watch {

class HttpServer {
public:
  // `address`: of IPv4, in digits; port 0: any that is free. `answer` is called with the path, without a query, on the
  // server's thread. On loopback only requests to a name of loopback are answered, so that no page of elsewhere can
  // read through a name that leads here. Throws Error: usage (the address), io (it cannot be had).
  HttpServer(const std::string& address, std::uint16_t port, std::function<Answer(std::string_view path)> answer);
  ~HttpServer(); // ends connections that are open
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  // "http://127.0.0.1:8000/"
  [[nodiscard]] const std::string& url() const noexcept { return url_; }

private:
  void serve();
  [[nodiscard]] Answer answer_to(std::string_view request) const;

  std::function<Answer(std::string_view)> answer_;
  std::string url_;
  int listener_ = -1, end_ = -1; // end_: an eventfd that becomes readable when the server shall end
  bool loopback_ = false;
  std::jthread thread_;
};

} // namespace sheet::watch
