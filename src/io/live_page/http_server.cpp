// SPDX-License-Identifier: Apache-2.0
#include "http_server.hpp"

#include <httplib.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <thread>

#include "client_socket.hpp"
#include "worker_pool.hpp"

namespace geoloc::io {
namespace {

constexpr int kBacklog = 64;
constexpr int kSendBuffer = 131072;  // what a slow page is behind at most, besides the event it is being sent
constexpr const char* kBusy =
    "HTTP/1.1 503 Service Unavailable\r\nRetry-After: 5\r\nContent-Length: 0\r\nConnection: close\r\n\r\n";

/// The bounds of ClientSocket under cpp-httplib's protocol.
class BoundedStream final : public httplib::Stream {
 public:
  explicit BoundedStream(ClientSocket& socket) : socket_(socket) {}
  bool is_readable() const override { return socket_.is_open(); }
  bool is_writable() const override { return socket_.is_open(); }
  ssize_t read(char* data, std::size_t size) override { return socket_.read(data, size); }
  ssize_t write(const char* data, std::size_t size) override { return socket_.write(data, size); }
  void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
  socket_t socket() const override { return socket_.descriptor(); }

 private:
  ClientSocket& socket_;
};

/// Set while the accepting thread itself serves a client, because no other is free.
thread_local bool is_turning_away = false;

class PoolQueue final : public httplib::TaskQueue {
 public:
  explicit PoolQueue(std::size_t most_threads) : pool_(most_threads) {}
  void enqueue(std::function<void()> serve) override {
    if (pool_.try_run(serve)) return;
    is_turning_away = true;
    serve();
    is_turning_away = false;
  }
  void shutdown() override { pool_.finish(); }

 private:
  WorkerPool pool_;
};

[[noreturn]] void fail_to_listen(const HttpEndpoint& endpoint, int error) {
  std::string message = endpoint.host + ":" + std::to_string(endpoint.port) + ": " +
                        (error == 0 ? "cannot listen there" : std::generic_category().message(error));
  if (error == EADDRINUSE) message += "; another program holds the port: take another";
  if (error == EACCES) message += "; ports below 1024 are for the system, take another";
  if (error == EADDRNOTAVAIL || error == 0) message += "; the host must be an address of this computer";
  throw std::runtime_error(message);
}

}  // namespace

class HttpServer::Implementation final : public httplib::Server {
 public:
  Implementation(const HttpEndpoint& endpoint, const HttpLimits& limits, const Headers& headers,
                 Answer answer, std::function<Events()> open_events);
  ~Implementation() override;

  std::uint16_t port() const { return port_; }

 private:
  using StreamTicket = std::shared_ptr<std::atomic<std::size_t>>;

  bool process_and_close_socket(socket_t descriptor) override;
  void talk(socket_t descriptor);
  void serve(const httplib::Request& request, httplib::Response& response);
  void stream_events(httplib::Response& response);
  void listen_at(const HttpEndpoint& endpoint);

  HttpLimits limits_;
  Answer answer_;
  std::function<Events()> open_events_;
  StreamTicket open_streams_ = std::make_shared<std::atomic<std::size_t>>(0);
  int stop_descriptor_ = -1;
  std::uint16_t port_ = 0;
  std::thread acceptor_;
};

HttpServer::Implementation::Implementation(const HttpEndpoint& endpoint, const HttpLimits& limits,
                                           const Headers& headers, Answer answer,
                                           std::function<Events()> open_events)
    : limits_(limits), answer_(std::move(answer)), open_events_(std::move(open_events)) {
  httplib::Headers defaults;
  for (const auto& [name, value] : headers) defaults.emplace(name, value);
  set_default_headers(defaults);
  set_tcp_nodelay(true);
  new_task_queue = [this] { return new PoolQueue(limits_.connections); };
  // Everything is answered here: nothing is looked up on a disk, and no body is read.
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) {
    serve(request, response);
    return HandlerResponse::Handled;
  });
  listen_at(endpoint);
  stop_descriptor_ = eventfd(0, EFD_CLOEXEC);
  acceptor_ = std::thread([this] { listen_after_bind(); });
  while (!is_running()) std::this_thread::sleep_for(std::chrono::milliseconds{1});
}

void HttpServer::Implementation::listen_at(const HttpEndpoint& endpoint) {
  // In place of the library's own, which let two programs share a port. Accepted connections inherit them.
  set_socket_options([](socket_t descriptor) {
    const int yes = 1;
    setsockopt(descriptor, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
    setsockopt(descriptor, SOL_SOCKET, SO_SNDBUF, &kSendBuffer, sizeof kSendBuffer);
  });
  errno = 0;
  const int port = endpoint.port == 0 ? bind_to_any_port(endpoint.host)
                                      : (bind_to_port(endpoint.host, endpoint.port) ? endpoint.port : -1);
  if (port <= 0) fail_to_listen(endpoint, errno);
  port_ = static_cast<std::uint16_t>(port);
  ::listen(svr_sock_, kBacklog);
}

HttpServer::Implementation::~Implementation() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t woken = ::write(stop_descriptor_, &one, sizeof one);
  stop();
  acceptor_.join();
  close(stop_descriptor_);
}

void HttpServer::Implementation::talk(socket_t descriptor) {
  ClientSocket socket(descriptor, stop_descriptor_, limits_);
  BoundedStream stream(socket);
  bool is_closed = false;
  process_request(stream, true, is_closed, [](httplib::Request& request) {
    request.ranges.clear();  // a small request must not ask for a large answer
    request.headers.erase("Accept-Encoding");
  });
  socket.end();
}

bool HttpServer::Implementation::process_and_close_socket(socket_t descriptor) {
  if (is_turning_away) {
    send(descriptor, kBusy, std::char_traits<char>::length(kBusy), MSG_NOSIGNAL | MSG_DONTWAIT);
  } else {
    try {
      talk(descriptor);
    } catch (const std::exception&) {  // out of memory, at worst: this client is given up, not the program
    }
  }
  close(descriptor);
  return true;
}

void HttpServer::Implementation::serve(const httplib::Request& request, httplib::Response& response) {
  PageAnswer answer =
      answer_({request.method, request.path, request.get_header_value("Host"),
               request.get_header_value("Sec-Fetch-Site"), request.get_header_value("Sec-Fetch-Mode")});
  response.status = answer.status;
  if (answer.is_event_stream && request.method == "GET") {
    stream_events(response);
  } else {
    response.set_content(answer.body, answer.type);
  }
}

void HttpServer::Implementation::stream_events(httplib::Response& response) {
  if (open_streams_->fetch_add(1) >= limits_.event_streams) {
    open_streams_->fetch_sub(1);
    response.status = 503;
    response.set_header("Retry-After", "5");
    response.set_content("Too many pages are open.\n", "text/plain");
    return;
  }
  response.set_chunked_content_provider(
      "text/event-stream",
      [next = open_events_()](std::size_t /*offset*/, httplib::DataSink& sink) {
        const std::optional<std::string> text = next();
        if (!text) {
          sink.done();
          return true;
        }
        return sink.write(text->data(), text->size());
      },
      [streams = open_streams_](bool /*is_whole*/) { streams->fetch_sub(1); });
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
