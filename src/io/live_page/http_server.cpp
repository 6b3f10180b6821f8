// SPDX-License-Identifier: Apache-2.0
#include "http_server.hpp"

#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <exception>
#include <string_view>
#include <thread>
#include <utility>

#include "client_address.hpp"
#include "client_socket.hpp"
#include "http_message.hpp"
#include "listening_socket.hpp"
#include "open_heads.hpp"
#include "worker_pool.hpp"

namespace geoloc::io {
namespace {

constexpr int kSendBuffer = 131072;  // how far a slow page can be behind, besides the event being sent
constexpr std::size_t kReadBuffer = 4096;
constexpr std::string_view kBusy =
    "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 5\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

PageAnswer too_many_pages() {
  return {503, "text/plain", "Too many pages are open.\n", false};
}

/// nullopt if the client leaves or takes too long before its request is complete.
std::optional<std::variant<PageRequest, Refusal>> read_request(ClientSocket& socket, std::size_t most_bytes) {
  RequestHead head(most_bytes);
  std::array<char, kReadBuffer> bytes{};
  while (true) {
    const std::ptrdiff_t count = socket.read(bytes.data(), bytes.size());
    if (count < 0) return std::nullopt;
    if (auto request = head.add({bytes.data(), static_cast<std::size_t>(count)})) return request;
  }
}

/// Holds one of a bounded number of places for its lifetime.
class Place {
 public:
  Place(std::atomic<std::size_t>& taken, std::size_t most)
      : taken_(taken), is_held_(taken.fetch_add(1) < most) {}
  ~Place() { taken_.fetch_sub(1); }
  Place(const Place&) = delete;
  Place& operator=(const Place&) = delete;
  bool is_held() const { return is_held_; }

 private:
  std::atomic<std::size_t>& taken_;
  bool is_held_;
};

}  // namespace

class HttpServer::Implementation {
 public:
  Implementation(const HttpEndpoint& endpoint, const HttpLimits& limits, const Headers& headers,
                 Answer answer, std::function<Events()> open_events);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  std::uint16_t port() const { return listening_.port(); }

 private:
  void accept_clients();
  void serve(int descriptor);
  bool run(const std::function<void()>& job);
  void talk(ClientSocket& socket, int descriptor);
  void answer(ClientSocket& socket, const PageRequest& request);
  void send(ClientSocket& socket, const PageAnswer& answer, bool with_body) const;
  void stream_events(ClientSocket& socket, const PageAnswer& answer);

  HttpLimits limits_;
  Headers headers_;
  Answer answer_;
  std::function<Events()> open_events_;
  ListeningSocket listening_;
  OpenHeads open_heads_;
  WorkerPool pool_;
  std::atomic<std::size_t> open_streams_{0};
  int stop_descriptor_;
  std::thread acceptor_;
};

HttpServer::Implementation::Implementation(const HttpEndpoint& endpoint, const HttpLimits& limits,
                                           const Headers& headers, Answer answer,
                                           std::function<Events()> open_events)
    : limits_(limits),
      headers_(headers),
      answer_(std::move(answer)),
      open_events_(std::move(open_events)),
      listening_(endpoint, kSendBuffer),
      pool_(limits.connections),
      stop_descriptor_(eventfd(0, EFD_CLOEXEC)),
      acceptor_([this] { accept_clients(); }) {}

HttpServer::Implementation::~Implementation() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t woken = ::write(stop_descriptor_, &one, sizeof one);
  acceptor_.join();
  pool_.finish();
  close(stop_descriptor_);
}

void HttpServer::Implementation::accept_clients() {
  for (int client = 0; (client = listening_.accept(stop_descriptor_)) >= 0;) {
    if (run([this, client] { serve(client); })) continue;
    ::send(client, kBusy.data(), kBusy.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    close(client);
  }
}

/// Runs it in a free thread, or in that of a client that has to go.
bool HttpServer::Implementation::run(const std::function<void()>& job) {
  constexpr int kAttempts = 50;
  constexpr std::chrono::milliseconds kPause{4};
  if (pool_.try_run(job)) return true;
  if (!open_heads_.end_oldest()) return false;
  for (int attempt = 0; attempt < kAttempts; ++attempt) {
    std::this_thread::sleep_for(kPause);
    if (pool_.try_run(job)) return true;
  }
  return false;
}

void HttpServer::Implementation::serve(int descriptor) {
  try {
    ClientSocket socket(descriptor, stop_descriptor_, limits_);
    talk(socket, descriptor);
    socket.end();
  } catch (const std::exception&) {  // out of memory, at worst: drops this client, not the program
  }
  close(descriptor);
}

void HttpServer::Implementation::talk(ClientSocket& socket, int descriptor) {
  auto request = [&] {
    const OpenHeads::Reading reading(open_heads_, descriptor);
    return read_request(socket, limits_.head_bytes);
  }();
  if (!request) return;
  if (const Refusal* const refusal = std::get_if<Refusal>(&*request)) {
    return send(socket, {refusal->status, "", "", false}, true);
  }
  const ClientAddress client = client_address(descriptor);
  auto& parts = std::get<PageRequest>(*request);
  parts.client_network = behind_proxy(client, parts.forwarded_for).network;
  parts.is_from_this_computer = client.is_this_computer;
  answer(socket, parts);
}

void HttpServer::Implementation::answer(ClientSocket& socket, const PageRequest& request) {
  const PageAnswer answer = answer_(request);
  const bool is_get = request.method == "GET";
  if (!answer.is_event_stream || !is_get) return send(socket, answer, request.method != "HEAD");
  const Place place(open_streams_, limits_.event_streams);
  if (!place.is_held()) return send(socket, too_many_pages(), true);
  stream_events(socket, answer);
}

void HttpServer::Implementation::send(ClientSocket& socket, const PageAnswer& answer, bool with_body) const {
  const std::string head = answer_head(answer, headers_, answer.body.size());
  if (socket.write(head) && with_body) socket.write(answer.body);
}

void HttpServer::Implementation::stream_events(ClientSocket& socket, const PageAnswer& answer) {
  if (!socket.write(answer_head(answer, headers_, std::nullopt))) return;
  const Events next = open_events_();
  while (socket.is_open()) {
    const std::optional<std::string> text = next();
    if (!text || !socket.write(*text)) return;
  }
}

HttpServer::HttpServer(const HttpEndpoint& endpoint, const HttpLimits& limits, const Headers& headers,
                       Answer answer, std::function<Events()> open_events)
    : implementation_(std::make_unique<Implementation>(endpoint, limits, headers, std::move(answer),
                                                       std::move(open_events))) {}

HttpServer::~HttpServer() = default;

std::uint16_t HttpServer::port() const {
  return implementation_->port();
}

}  // namespace geoloc::io
