// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/http_connection.h"

#include <array>
#include <cerrno>
#include <utility>

#include <fmt/format.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace sheet::watch {

namespace {

constexpr std::size_t most_of_request = 8192; // [bytes]
constexpr std::chrono::seconds for_request{5}, for_answer{60};

std::string_view reason(int status) {
  switch (status) {
  case 200:
    return "OK";
  case 403:
    return "Forbidden";
  case 404:
    return "Not Found";
  case 405:
    return "Method Not Allowed";
  case 503:
    return "Service Unavailable";
  default:
    return "Bad Request";
  }
}

std::string head_of(const Answer& answer) {
  return fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
                     "X-Content-Type-Options: nosniff\r\nX-Frame-Options: SAMEORIGIN\r\nConnection: close\r\n\r\n",
                     answer.status, reason(answer.status), answer.type, answer.body->size());
}

bool must_wait() { return errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR; }

} // namespace

Answer plain_answer(int status, std::string text) {
  return {.status = status, .body = std::make_shared<const std::string>(std::move(text))};
}

HttpConnection::HttpConnection(int descriptor) : descriptor_(descriptor), deadline_(Clock::now() + for_request) {}

HttpConnection::~HttpConnection() {
  if (descriptor_ >= 0)
    ::close(descriptor_);
}

HttpConnection::HttpConnection(HttpConnection&& other) noexcept { *this = std::move(other); }

HttpConnection& HttpConnection::operator=(HttpConnection&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  deadline_ = other.deadline_;
  request_ = std::move(other.request_);
  head_ = std::move(other.head_);
  body_ = std::move(other.body_);
  sent_ = other.sent_;
  return *this;
}

short HttpConnection::events() const noexcept { return head_.empty() ? POLLIN : POLLOUT; }

bool HttpConnection::go_on(const Responder& respond) { return head_.empty() ? receive(respond) : send(); }

bool HttpConnection::receive(const Responder& respond) {
  std::array<char, 2048> piece{};
  const ssize_t got = ::recv(descriptor_, piece.data(), piece.size(), 0);
  if (got <= 0)
    return got < 0 && must_wait();
  request_.append(piece.data(), static_cast<std::size_t>(got));
  const std::size_t end = request_.find("\r\n\r\n");
  if (end == std::string::npos)
    return request_.size() <= most_of_request;
  const Answer answer = respond(std::string_view(request_).substr(0, end + 2));
  head_ = head_of(answer);
  body_ = answer.body;
  deadline_ = Clock::now() + for_answer;
  return send();
}

bool HttpConnection::send() {
  while (sent_ < head_.size() + body_->size()) {
    const std::string& text = sent_ < head_.size() ? head_ : *body_;
    const std::size_t start = sent_ < head_.size() ? sent_ : sent_ - head_.size();
    const ssize_t more = ::send(descriptor_, text.data() + start, text.size() - start, MSG_NOSIGNAL);
    if (more < 0)
      return must_wait();
    sent_ += static_cast<std::size_t>(more);
  }
  return false;
}

} // namespace sheet::watch
