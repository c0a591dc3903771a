// SPDX-License-Identifier: GPL-3.0-or-later
#include "libsheet/watch/http_server.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <utility>
#include <vector>

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

constexpr std::size_t most_connections = 256;

// The value of the field, without blanks; empty if it is not there, or more than once.
std::string_view only_field(std::string_view request, std::string_view name) {
  std::string_view value;
  bool found = false;
  for (std::size_t at = request.find("\r\n"); at != std::string_view::npos; at = request.find("\r\n", at)) {
    at += 2;
    const std::string_view line = request.substr(at, request.find("\r\n", at) - at);
    if (line.size() <= name.size() || line[name.size()] != ':' ||
        ::strncasecmp(line.data(), name.data(), name.size()) != 0)
      continue;
    if (std::exchange(found, true))
      return "";
    const std::size_t start = line.find_first_not_of(" \t", name.size() + 1);
    if (start != std::string_view::npos)
      value = line.substr(start, line.find_last_not_of(" \t") + 1 - start);
  }
  return value;
}

bool is_loopback(const in_addr& place) { return ntohl(place.s_addr) >> 24 == 127; }

// In digits or as localhost, with a port in digits or none; 127.example.org is a name of somebody else, and so is
// localhost:80@example.org.
bool names_loopback(std::string_view host) {
  const std::string name(host.substr(0, host.find(':')));
  if (host.find_first_not_of("0123456789", name.size() + 1) != std::string_view::npos)
    return false;
  in_addr place{};
  return name == "localhost" || (::inet_pton(AF_INET, name.c_str(), &place) == 1 && is_loopback(place));
}

// The one that has waited longest for a request: it makes way for others.
std::vector<HttpConnection>::iterator idle_one(std::vector<HttpConnection>& connections) {
  return std::ranges::find(connections, POLLIN, &HttpConnection::events); // they are in the order in which they came
}

// For poll: until the first deadline [ms]; -1: there is none.
int time_left(const std::vector<HttpConnection>& connections) {
  if (connections.empty())
    return -1;
  const auto first = std::ranges::min_element(connections, {}, &HttpConnection::deadline)->deadline();
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(first - HttpConnection::Clock::now());
  return static_cast<int>(std::max<std::int64_t>(left.count(), 0));
}

} // namespace

HttpServer::HttpServer(const std::string& address, std::uint16_t port, std::function<Answer(std::string_view)> answer)
    : answer_(std::move(answer)) {
  sockaddr_in place{};
  place.sin_family = AF_INET;
  place.sin_port = htons(port);
  if (::inet_pton(AF_INET, address.c_str(), &place.sin_addr) != 1)
    fail(ExitCode::usage, "\"{}\" is no IPv4 address in digits, such as 127.0.0.1", address);
  loopback_ = is_loopback(place.sin_addr);
  listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const int yes = 1;
  socklen_t size = sizeof place;
  auto* const generic = reinterpret_cast<sockaddr*>(&place);
  if (listener_ < 0 || ::setsockopt(listener_, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes) != 0 ||
      ::bind(listener_, generic, size) != 0 || ::listen(listener_, SOMAXCONN) != 0 ||
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

void HttpServer::serve() {
  std::vector<HttpConnection> connections;
  const auto respond = [this](std::string_view request) { return answer_to(request); };
  for (;;) {
    std::vector<pollfd> watched = {{end_, POLLIN, 0}};
    for (const HttpConnection& connection : connections)
      watched.push_back({connection.descriptor(), connection.events(), 0});
    if (connections.size() < most_connections || idle_one(connections) != connections.end())
      watched.push_back({listener_, POLLIN, 0});
    if (::poll(watched.data(), watched.size(), time_left(connections)) < 0 && errno != EINTR)
      return;
    if (watched[0].revents != 0)
      return;
    const auto now = HttpConnection::Clock::now();
    std::vector<HttpConnection> open;
    for (std::size_t i = 0; i < connections.size(); ++i)
      if (now < connections[i].deadline() && (watched[i + 1].revents == 0 || connections[i].go_on(respond)))
        open.push_back(std::move(connections[i]));
    connections = std::move(open);
    if (watched.back().fd == listener_ && watched.back().revents != 0)
      if (const int client = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK); client >= 0) {
        if (connections.size() >= most_connections)
          if (const auto idle = idle_one(connections); idle != connections.end())
            connections.erase(idle);
        connections.emplace_back(client);
      }
  }
}

Answer HttpServer::answer_to(std::string_view request) const {
  const std::string_view line = request.substr(0, request.find("\r\n"));
  const std::size_t first = line.find(' '), second = line.find(' ', first + 1);
  if (first == std::string_view::npos || second == std::string_view::npos ||
      !line.substr(second + 1).starts_with("HTTP/1."))
    return plain_answer(400, "this is no request of HTTP\n");
  if (line.substr(0, first) != "GET")
    return plain_answer(405, "nothing can be changed here: GET only\n");
  if (loopback_ && !names_loopback(only_field(request, "Host")))
    return plain_answer(403, "ask for localhost or 127.0.0.1\n");
  const std::string_view target = line.substr(first + 1, second - first - 1);
  return answer_(target.substr(0, target.find('?')));
}

} // namespace sheet::watch
