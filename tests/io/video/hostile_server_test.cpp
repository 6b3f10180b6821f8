// SPDX-License-Identifier: Apache-2.0
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "geoloc/io/video/rtsp_source.hpp"
#include "rtsp_test_server.hpp"

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;

constexpr Duration kPatience = std::chrono::seconds{40};

/// A TCP port on the loopback that answers every request with the same bytes, or with nothing.
class Listener {
 public:
  explicit Listener(std::string answer, int backlog = 8)
      : answer_(std::move(answer)), socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    EXPECT_EQ(::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    EXPECT_EQ(::listen(socket_, backlog), 0);
    EXPECT_EQ(::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~Listener() {
    stop_ = true;
    ::shutdown(socket_, SHUT_RDWR);
    if (thread_.joinable()) thread_.join();
    ::close(socket_);
    for (const int connection : connections_) ::close(connection);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  void serve() {
    thread_ = std::thread{[this] {
      while (!stop_) {
        const int connection = ::accept(socket_, nullptr, nullptr);
        if (connection < 0) return;
        connections_.push_back(connection);
        ++accepted_;
        if (!answer_.empty()) (void)!::send(connection, answer_.data(), answer_.size(), MSG_NOSIGNAL);
      }
    }};
  }

  int accepted() const { return accepted_; }
  std::string url() const { return "rtsp://pilot:secret@127.0.0.1:" + std::to_string(port_) + "/camera"; }

 private:
  std::string answer_;
  int socket_;
  int port_ = 0;
  std::atomic<bool> stop_{false};
  std::atomic<int> accepted_{0};
  std::vector<int> connections_;
  std::thread thread_;
};

VideoConfig impatient() {
  VideoConfig config;
  config.connect_timeout_s = 0.5;
  return config;
}

/// Waits for a few failed attempts, and checks that no thread spins and no secrets are shown.
void expect_steady_failure(const std::string& url, const HostClock& clock) {
  const HostTime begun = clock.now();
  RtspSource source{url, impatient(), clock};
  while (source.status().attempts < 4 && clock.now() - begun < kPatience)
    EXPECT_FALSE(source.next(milliseconds{50}));
  const VideoStatus status = source.status();
  const double elapsed_s = seconds(clock.now() - begun);
  EXPECT_GE(status.attempts, 4U);
  EXPECT_LE(static_cast<double>(status.attempts), 1 + elapsed_s / impatient().retry_min_s);
  EXPECT_EQ(status.state, VideoState::kRetrying);
  EXPECT_NE(status.last_error, "");
  EXPECT_EQ(status.last_error.find("secret"), std::string::npos) << status.last_error;
}

TEST(HostileServer, NobodyListens) {
  const std::string url = Listener{""}.url();  // gone again
  expect_steady_failure(url, HostClock{});
}

TEST(HostileServer, AcceptsAndSaysNothing) {
  Listener listener{""};
  listener.serve();
  expect_steady_failure(listener.url(), HostClock{});
  EXPECT_GE(listener.accepted(), 3);
}

TEST(HostileServer, NeverAcceptsTheConnection) {
  const Listener listener{"", 0};
  std::vector<int> fillers;  // once the backlog is full, further connections hang unanswered
  for (int i = 0; i < 4; ++i) {
    fillers.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const std::string url = listener.url();
    const auto colon = url.rfind(':');
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(url.substr(colon + 1))));
    (void)!::connect(fillers.back(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  }
  expect_steady_failure(listener.url(), HostClock{});
  for (const int filler : fillers) ::close(filler);
}

TEST(HostileServer, AnswersAnotherProtocol) {
  Listener listener{"HTTP/1.1 200 OK\r\nContent-Length: 5\r\n\r\nhello"};
  listener.serve();
  expect_steady_failure(listener.url(), HostClock{});
}

TEST(HostileServer, ClaimsAnEndlessBody) {
  Listener listener{"RTSP/1.0 200 OK\r\nCSeq: 1\r\nContent-Length: 4294967295\r\n\r\n"};
  listener.serve();
  expect_steady_failure(listener.url(), HostClock{});
}

TEST(HostileServer, HasNoSuchStream) {
  const HostClock clock;
  const test::RtspTestServer server{{}, clock};
  expect_steady_failure("rtsp://pilot:secret@127.0.0.1:" + std::to_string(server.port()) + "/nothing", clock);
}

/// Not a speed test: a source that waited for its server would take the connection's timeout, a minute.
TEST(HostileServer, NeverHoldsUpTheEnd) {
  const HostClock clock;
  VideoConfig patient;
  patient.connect_timeout_s = 60;
  Listener silent{""};
  silent.serve();
  for (const Duration wait : {milliseconds{0}, milliseconds{300}}) {
    const HostTime begun = clock.now();
    {
      const RtspSource source{silent.url(), patient, clock};
      std::this_thread::sleep_for(wait);
    }
    EXPECT_LT(clock.now() - begun, std::chrono::seconds{20});
  }
}

}  // namespace
}  // namespace geoloc::io
