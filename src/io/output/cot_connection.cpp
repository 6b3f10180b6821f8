// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_connection.hpp"

#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>
#include <system_error>
#include <thread>
#include <utility>

#include "geoloc/io/address_lookup.hpp"
#include "tls_session.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostPending = 256 * 1024;  // bytes
constexpr auto kStallLimit = std::chrono::seconds{10};
constexpr auto kFirstBackoff = std::chrono::seconds{1};
constexpr auto kLongestBackoff = std::chrono::seconds{30};
/// A connection that lasts so long is said to hold: many a server hangs up on those whom it does not want.
constexpr auto kProof = std::chrono::seconds{2};
/// A TLS server that refuses us would have said so by then. Events sent before could make the system discard
/// its words.
constexpr auto kConsent = std::chrono::milliseconds{500};
constexpr auto kPause = std::chrono::milliseconds{10};

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

bool is_multicast(const sockaddr& address) {
  if (address.sa_family == AF_INET6)
    return IN6_IS_ADDR_MULTICAST(&reinterpret_cast<const sockaddr_in6&>(address).sin6_addr) != 0;
  return IN_MULTICAST(ntohl(reinterpret_cast<const sockaddr_in&>(address).sin_addr.s_addr));
}

bool would_block(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR;
}

}  // namespace

CotConnection::CotConnection(CotEndpoint endpoint, const CotConfig& config, Tell tell)
    : endpoint_(std::move(endpoint)), config_(config), tell_(std::move(tell)) {
  if (endpoint_.transport == CotTransport::kTls) identity_ = std::make_unique<TlsIdentity>(config_);
}

CotConnection::~CotConnection() {
  if (descriptor_ >= 0) close(descriptor_);
}

std::string CotConnection::name() const {
  const char* const scheme = endpoint_.transport == CotTransport::kUdp
                                 ? "udp"
                                 : (endpoint_.transport == CotTransport::kTcp ? "tcp" : "tls");
  return std::string("--cot ") + scheme + "://" + endpoint_.host + ":" + endpoint_.port;
}

void CotConnection::fail(Clock::time_point now, const std::string& reason) {
  const std::string message = name() + ": " + reason + "; trying again";  // first: it may be the session's
  if (is_open_ && now - connected_at_ > kLongestBackoff) backoff_ = kFirstBackoff;
  if (descriptor_ >= 0) close(std::exchange(descriptor_, -1));
  is_connecting_ = false;
  is_open_ = false;
  session_.reset();
  pending_.clear();  // a new connection must not begin in the middle of an event
  next_attempt_ = now + backoff_;
  backoff_ = std::min(2 * backoff_, kLongestBackoff);
  if (!std::exchange(has_told_, true)) tell_(message);
}

void CotConnection::set_multicast(int family) const {
  const int ttl = config_.multicast_ttl;
  const unsigned index =
      config_.multicast_interface.empty() ? 0 : if_nametoindex(config_.multicast_interface.c_str());
  if (family == AF_INET6) {
    setsockopt(descriptor_, IPPROTO_IPV6, IPV6_MULTICAST_HOPS, &ttl, sizeof ttl);
    setsockopt(descriptor_, IPPROTO_IPV6, IPV6_MULTICAST_IF, &index, sizeof index);
    return;
  }
  ip_mreqn multicast{};
  multicast.imr_ifindex = static_cast<int>(index);
  setsockopt(descriptor_, IPPROTO_IP, IP_MULTICAST_TTL, &ttl, sizeof ttl);
  if (index != 0) setsockopt(descriptor_, IPPROTO_IP, IP_MULTICAST_IF, &multicast, sizeof multicast);
}

void CotConnection::open(Clock::time_point now) {
  const int socket_type = is_stream() ? SOCK_STREAM : SOCK_DGRAM;
  const auto [address, fault] = look_up(endpoint_.host, endpoint_.port, socket_type);
  if (!address) return fail(now, fault);
  if (is_multicast(*address->ai_addr) && !config_.multicast_interface.empty() &&
      if_nametoindex(config_.multicast_interface.c_str()) == 0)
    return fail(now, "there is no interface " + config_.multicast_interface);
  descriptor_ = socket(address->ai_family, socket_type | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (descriptor_ < 0) return fail(now, reason_of(errno));
  if (is_multicast(*address->ai_addr)) set_multicast(address->ai_family);
  moved_at_ = now;
  is_connecting_ = true;
  if (connect(descriptor_, address->ai_addr, address->ai_addrlen) == 0) return finish_connecting(now);
  if (errno != EINPROGRESS) fail(now, reason_of(errno));
}

void CotConnection::finish_connecting(Clock::time_point now) {
  int error = 0;
  socklen_t size = sizeof error;
  getsockopt(descriptor_, SOL_SOCKET, SO_ERROR, &error, &size);
  if (error != 0) return fail(now, reason_of(error));
  is_connecting_ = false;
  moved_at_ = now;
  if (!identity_) return note_open(now);
  const std::string& name = config_.tls_server_name;
  session_ = std::make_unique<TlsSession>(*identity_, name.empty() ? endpoint_.host : name);
  pending_ = session_->take_outgoing();
}

void CotConnection::note_open(Clock::time_point now) {
  is_open_ = true;
  moved_at_ = now;
  connected_at_ = now;
  ++counts_.connections;
}

/// False where the connection has failed. What servers say, such as other clients' events, is discarded.
bool CotConnection::receive(std::string_view bytes, Clock::time_point now) {
  if (!session_) return true;
  const bool was_established = session_->is_established();
  const bool goes_on = session_->receive(bytes);
  pending_ += session_->take_outgoing();
  if (!was_established && session_->is_established()) moved_at_ = now;
  if (goes_on) return true;
  // The server is told why, for its log, if there is room for it.
  ::send(descriptor_, pending_.data(), pending_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  fail(now, session_->fault());
  return false;
}

/// Unread, it would fill the server's buffers.
void CotConnection::receive(Clock::time_point now) {
  std::array<char, 4096> bytes;
  for (int i = 0; i < 64; ++i) {
    const ssize_t size = recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size == 0 && is_stream())
      return fail(now, session_ ? session_->fault_of_silent_end() : "the server closed the connection");
    if (size < 0 && would_block(errno)) return;
    if (size < 0 && is_stream()) return fail(now, reason_of(errno));
    if (size < 0) ++counts_.failed;  // UDP: nobody is listening
    if (size > 0 && !receive({bytes.data(), static_cast<std::size_t>(size)}, now)) return;
  }
}

void CotConnection::write_pending(Clock::time_point now) {
  while (!pending_.empty()) {
    const ssize_t size = ::send(descriptor_, pending_.data(), pending_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (size < 0 && would_block(errno)) break;
    if (size < 0) return fail(now, reason_of(errno));
    pending_.erase(0, static_cast<std::size_t>(size));
    moved_at_ = now;
  }
  if (pending_.empty() && is_open_) moved_at_ = now;
}

void CotConnection::poll(Clock::time_point now) {
  if (descriptor_ < 0) {
    if (now >= next_attempt_) open(now);
  }
  if (descriptor_ >= 0 && is_connecting_) {
    pollfd waiting{descriptor_, POLLOUT, 0};
    if (::poll(&waiting, 1, 0) > 0) finish_connecting(now);
  }
  if (descriptor_ >= 0 && !is_connecting_) receive(now);
  if (descriptor_ >= 0 && !is_connecting_) write_pending(now);
  const bool is_waiting = session_ && session_->is_established() && !is_open_;
  if (is_waiting && (session_->is_accepted() || now - moved_at_ > kConsent)) note_open(now);
  if (is_open_ && now - connected_at_ > kProof && std::exchange(has_told_, false))
    tell_(name() + ": connected");
  if (descriptor_ >= 0 && now - moved_at_ > kStallLimit) fail(now, "no answer");
}

bool CotConnection::is_ready() const {
  return is_open_ && pending_.size() < kMostPending;
}

void CotConnection::send(const std::string& event) {
  if (!is_ready()) return;
  if (is_stream()) {
    if (session_) session_->send(event);
    pending_ += session_ ? session_->take_outgoing() : event;
    ++counts_.sent;
    return write_pending(Clock::now());
  }
  const ssize_t size = ::send(descriptor_, event.data(), event.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  ++(size == static_cast<ssize_t>(event.size()) ? counts_.sent : counts_.failed);
}

bool CotConnection::flush(std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (true) {
    poll(Clock::now());
    if (is_open_ && pending_.empty()) return true;
    if (Clock::now() >= deadline) break;
    std::this_thread::sleep_for(kPause);
  }
  if (!std::exchange(has_told_, true)) tell_(name() + ": no answer");
  return false;
}

void CotConnection::end(std::chrono::milliseconds timeout) {
  if (!is_open_ || !is_stream()) return;
  if (session_) {
    session_->end();
    pending_ += session_->take_outgoing();
    write_pending(Clock::now());
  }
  if (descriptor_ < 0) return;
  shutdown(descriptor_, SHUT_WR);
  const auto deadline = Clock::now() + timeout;
  std::array<char, 4096> bytes;
  while (Clock::now() < deadline) {
    const ssize_t size = recv(descriptor_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (size == 0 || (size < 0 && !would_block(errno))) return;
    if (size < 0) std::this_thread::sleep_for(kPause);
    const bool is_fault = size > 0 && session_ &&
                          !session_->receive({bytes.data(), static_cast<std::size_t>(size)}) &&
                          !session_->is_ended();
    if (is_fault) return fail(Clock::now(), session_->fault());
  }
}

}  // namespace geoloc::io
