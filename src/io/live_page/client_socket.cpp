// SPDX-License-Identifier: Apache-2.0
#include "client_socket.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

namespace geoloc::io {
namespace {

constexpr std::chrono::milliseconds kFarewell{250};

std::chrono::milliseconds until(std::chrono::steady_clock::time_point deadline) {
  const auto left = deadline - std::chrono::steady_clock::now();
  return std::max(std::chrono::milliseconds{0}, std::chrono::duration_cast<std::chrono::milliseconds>(left));
}

}  // namespace

ClientSocket::ClientSocket(int descriptor, int stop_descriptor, const HttpLimits& limits)
    : descriptor_(descriptor),
      stop_descriptor_(stop_descriptor),
      limits_(limits),
      head_deadline_(Clock::now() + limits.head_time) {}

bool ClientSocket::wait_for(short events, std::chrono::milliseconds timeout) const {
  std::array<pollfd, 2> waiting{{{descriptor_, events, 0}, {stop_descriptor_, POLLIN, 0}}};
  const int ready = poll(waiting.data(), waiting.size(), static_cast<int>(timeout.count()));
  if (ready <= 0) return false;
  const bool is_stopping = waiting[1].revents != 0;
  return !is_stopping && (waiting[0].revents & events) != 0;
}

std::ptrdiff_t ClientSocket::read(char* data, std::size_t size) {
  if (!wait_for(POLLIN, until(head_deadline_))) return -1;
  const ssize_t count = recv(descriptor_, data, size, MSG_DONTWAIT);
  return count > 0 ? count : -1;
}

bool ClientSocket::write(std::string_view text) {
  while (!text.empty()) {
    const std::ptrdiff_t written = write_some(text);
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

std::ptrdiff_t ClientSocket::write_some(std::string_view text) {
  const double patience_s = std::chrono::duration<double>(limits_.write_time).count();
  const auto began = Clock::now();
  const auto patience = std::chrono::duration_cast<std::chrono::milliseconds>(
      std::chrono::duration<double>(std::max(0.0, patience_s - behind_s_)));
  if (!wait_for(POLLOUT, patience)) return -1;
  const ssize_t written = send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  if (written <= 0) return -1;
  const double waited_s = std::chrono::duration<double>(Clock::now() - began).count();
  behind_s_ =
      std::max(0.0, behind_s_ + waited_s - static_cast<double>(written) / limits_.slowest_bytes_per_s);
  return written;
}

bool ClientSocket::is_open() const {
  std::array<pollfd, 2> waiting{{{descriptor_, POLLRDHUP, 0}, {stop_descriptor_, POLLIN, 0}}};
  return poll(waiting.data(), waiting.size(), 0) == 0;
}

void ClientSocket::end() {
  shutdown(descriptor_, SHUT_WR);
  const auto deadline = Clock::now() + kFarewell;
  std::array<char, 4096> ignored{};
  while (wait_for(POLLIN, until(deadline)) && Clock::now() < deadline) {
    if (recv(descriptor_, ignored.data(), ignored.size(), MSG_DONTWAIT) <= 0) return;
  }
}

}  // namespace geoloc::io
