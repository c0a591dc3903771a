// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/http_server.h"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <poll.h>
#include <strings.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include "libsheet/base/error.h"

namespace sheet::watch {

namespace {

constexpr std::size_t most_of_request = 8192; // [bytes]
constexpr int patience = 5000;                // [ms] for a request, and for each piece of an answer

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

std::string message(const Answer& answer) {
  return fmt::format("HTTP/1.1 {} {}\r\nContent-Type: {}\r\nContent-Length: {}\r\nCache-Control: no-store\r\n"
                     "X-Content-Type-Options: nosniff\r\nX-Frame-Options: SAMEORIGIN\r\nConnection: close\r\n\r\n",
                     answer.status, reason(answer.status), answer.type, answer.body.size()) +
         answer.body;
}

// The value of the field, without blanks; empty if it is not there.
std::string_view field(std::string_view request, std::string_view name) {
  for (std::size_t at = request.find("\r\n"); at != std::string_view::npos; at = request.find("\r\n", at)) {
    at += 2;
    const std::string_view line = request.substr(at, request.find("\r\n", at) - at);
    if (line.size() <= name.size() || line[name.size()] != ':' ||
        ::strncasecmp(line.data(), name.data(), name.size()) != 0)
      continue;
    const std::size_t start = line.find_first_not_of(" \t", name.size() + 1);
    return start == std::string_view::npos ? "" : line.substr(start, line.find_last_not_of(" \t") + 1 - start);
  }
  return "";
}

bool names_loopback(std::string_view host) {
  const std::string_view name = host.substr(0, host.find(':'));
  return name == "localhost" || name.starts_with("127.");
}

} // namespace

HttpServer::HttpServer(const std::string& address, std::uint16_t port, std::function<Answer(std::string_view)> answer)
    : answer_(std::move(answer)) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  if (::inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
    fail(ExitCode::usage, "\"{}\" is no IPv4 address in digits, such as 127.0.0.1", address);
  loopback_ = ntohl(place.sin_addr.s_addr) >> 24 == 127;
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  if (listener_ < 0 || ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(listener_, generic, size) != 0 || ::listen(listener_, 16) != 0 ||
      ::getsockname(listener_, generic, &size) != 0 || (end_ = ::eventfd(0, EFD_CLOEXEC)) < 0) {
    const std::string why = std::strerror(errno);
    if (listener_ >= 0)
      ::close(listener_);
    fail(ExitCode::io, "no page at {} port {}: {}; choose another one with --port, 0 for any that is free", address,
         port, why);
  }
  url_ = fmt::format("http://{}:{}/", address, ntohs(place.sin_port));
  thread_ = std::jthread([this] { serve(); });
}

HttpServer::~HttpServer() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(end_, &one, sizeof one);
  thread_.join();
  ::close(listener_);
  ::close(end_);
}

bool HttpServer::is_ready(int descriptor, short events, int milliseconds) const {
  std::array<pollfd, 2> both{{{descriptor, events, 0}, {end_, POLLIN, 0}}};
  return ::poll(both.data(), both.size(), milliseconds) > 0 && both[1].revents == 0;
}

void HttpServer::serve() {
  for (;;) {
    std::array<pollfd, 2> both{{{listener_, POLLIN, 0}, {end_, POLLIN, 0}}};
    if (::poll(both.data(), both.size(), -1) < 0 && errno != EINTR)
      return;
    if (both[1].revents != 0)
      return;
    const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (client < 0)
      continue;
    converse(client);
    ::close(client);
  }
}

void HttpServer::converse(int client) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience);
  std::string request;
  std::array<char, 2048> piece{};
  while (request.find("\r\n\r\n") == std::string::npos) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    if (request.size() > most_of_request || left.count() <= 0 ||
        !is_ready(client, POLLIN, static_cast<int>(left.count())))
      return;
    const ssize_t got = ::recv(client, piece.data(), piece.size(), 0);
    if (got <= 0)
      return;
    request.append(piece.data(), static_cast<std::size_t>(got));
  }
  const std::string text = message(answer_to(request));
  for (std::size_t sent = 0; sent < text.size();) {
    if (!is_ready(client, POLLOUT, patience))
      return;
    const ssize_t more = ::send(client, text.data() + sent, text.size() - sent, MSG_NOSIGNAL);
    if (more <= 0 && errno != EAGAIN)
      return;
    sent += more > 0 ? static_cast<std::size_t>(more) : 0;
  }
}

Answer HttpServer::answer_to(std::string_view request) const {
  const std::string_view line = request.substr(0, request.find("\r\n"));
  const std::size_t first = line.find(' '), second = line.find(' ', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos ||
      !line.substr(second + 1).starts_with("HTTP/1."))
    return {400, "text/plain", "this is no request of HTTP\n"};
  if (line.substr(0, first) != "GET")
    return {405, "text/plain", "nothing can be changed here: GET only\n"};
  if (loopback_ && !names_loopback(field(request, "Host")))
    return {403, "text/plain", "ask for localhost or 127.0.0.1\n"};
  const std::string_view target = line.substr(first + 1, second - first - 1);
  return answer_(target.substr(0, target.find('?')));
}

} // namespace sheet::watch
