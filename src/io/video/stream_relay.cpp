// SPDX-License-Identifier: Apache-2.0
#include "stream_relay.hpp"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "geoloc/io/video/stream_url.hpp"
#include "transport_source.hpp"

namespace geoloc::io {
namespace {

constexpr char kTlsHandshake = 0x16;
constexpr std::size_t kLongestFirstLine = 8192;

int checked(int result, const char* what) {
  if (result < 0) throw std::system_error(errno, std::generic_category(), what);
  return result;
}

FileDescriptor listen_on_loopback(std::uint16_t& port) {
  constexpr int kQueue = 4;
  FileDescriptor listener(checked(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0),
                                  "no socket for the video stream"));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  socklen_t size = sizeof address;
  checked(::bind(listener.get(), any, size), "no port for the video stream");
  checked(::listen(listener.get(), kQueue), "no port for the video stream");
  checked(::getsockname(listener.get(), any, &size), "no port for the video stream");
  port = ntohs(address.sin_port);
  return listener;
}

void send_at_once(int descriptor) {
  const int on = 1;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// nullptr for an address that rtspsrc would not understand either.
GObjectPtr<GSocketConnectable> server_in(const std::string& url) {
  GstRTSPUrl* parsed = nullptr;
  if (gst_rtsp_url_parse(url.c_str(), &parsed) != GST_RTSP_OK) return nullptr;
  const RtspUrlPtr owned(parsed);
  guint16 port = 0;
  gst_rtsp_url_get_port(parsed, &port);
  return GObjectPtr<GSocketConnectable>(g_network_address_new(parsed->host, port));
}

std::string address_of_peer(GSocketConnection* connection) {
  const GObjectPtr<GSocketAddress> peer(g_socket_connection_get_remote_address(connection, nullptr));
  if (!peer || G_IS_INET_SOCKET_ADDRESS(peer.get()) == FALSE) return {};
  gchar* text =
      g_inet_address_to_string(g_inet_socket_address_get_address(G_INET_SOCKET_ADDRESS(peer.get())));
  const std::string address = text;
  g_free(text);
  return address;
}

/// What is there to be read; empty at the connection's end, nullopt where nothing is there after all.
std::optional<std::string_view> receive(int descriptor, std::vector<char>& buffer) {
  const ssize_t size = ::recv(descriptor, buffer.data(), buffer.size(), 0);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return std::nullopt;
  return std::string_view(buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
}

}  // namespace

StreamRelay::StreamRelay(const std::string& url, RtspTransport transport)
    : transport_(transport),
      server_(server_in(url)),
      listener_(listen_on_loopback(port_)),
      wake_(checked(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK), "no descriptor for the video stream")) {
  if (!server_) throw std::invalid_argument("the address has no host that can be understood");
  thread_ = std::thread([this] { run(); });
}

StreamRelay::~StreamRelay() {
  cut_within(Duration::zero());
  thread_.join();
}

std::string StreamRelay::address() const {
  return "http://127.0.0.1:" + std::to_string(port_);
}

void StreamRelay::note_frame() {
  if (transport_ == RtspTransport::kTcp) bytes_without_frame_ = 0;
}

void StreamRelay::cut_within(Duration grace) {
  cut_at_ = std::min(cut_at_.load(), Clock::now() + grace);
  g_cancellable_cancel(connecting_.get());
  const std::uint64_t once = 1;
  (void)!::write(wake_.get(), &once, sizeof once);
}

std::optional<StreamRelay::End> StreamRelay::end() const {
  const std::lock_guard lock(mutex_);
  return end_;
}

void StreamRelay::end_because(std::string why, bool is_server_at_fault) {
  const std::lock_guard lock(mutex_);
  end_ = End{std::move(why), is_server_at_fault};
}

void StreamRelay::run() {
  for (int connections = 1; !end() && wait_for(listener_.get(), POLLIN); ++connections) {
    const FileDescriptor client(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!client) return end_because("no descriptor is left for the video stream", false);
    if (connections > kMostConnections) return end_because("the server redirects without end", true);
    send_at_once(client.get());
    relay(client);
  }
}

/// Serves one connection of rtspsrc to its end.
void StreamRelay::relay(const FileDescriptor& client) {
  const auto request = first_line(client.get());
  if (!request) return;
  const auto server = server_of(*request);
  if (!server) return end_because("the server redirects to an address that cannot be understood", true);
  const GObjectPtr<GSocketClient> connector(g_socket_client_new());
  GError* error = nullptr;
  const GObjectPtr<GSocketConnection> connection(
      g_socket_client_connect(connector.get(), server.get(), connecting_.get(), &error));
  if (!connection) {
    end_because(error->message, false);
    g_error_free(error);
    return;
  }
  const int descriptor = g_socket_get_fd(g_socket_connection_get_socket(connection.get()));
  send_at_once(descriptor);
  if (send_all(descriptor, *request)) pump(client.get(), connection.get(), request->front() == kTlsHandshake);
}

/// The first bytes of rtspsrc, which name the server that it wants.
std::optional<std::string> StreamRelay::first_line(int client) const {
  std::vector<char> buffer(kLongestFirstLine);
  std::string request;
  while (request.size() < kLongestFirstLine && request.find('\n') == std::string::npos &&
         (request.empty() || request.front() != kTlsHandshake)) {
    if (!wait_for(client, POLLIN)) return std::nullopt;
    const auto bytes = receive(client, buffer);
    if (!bytes) continue;
    if (bytes->empty()) return std::nullopt;
    request += *bytes;
  }
  return request;
}

/// rtspsrc follows a redirection by asking for another server; what is encrypted says nothing of it.
GObjectPtr<GSocketConnectable> StreamRelay::server_of(std::string_view request) const {
  if (request.front() == kTlsHandshake)
    return GObjectPtr<GSocketConnectable>(G_SOCKET_CONNECTABLE(g_object_ref(server_.get())));
  const auto begin = std::min(request.find(' '), request.size() - 1) + 1;
  return server_in(std::string(request.substr(begin, request.find(' ', begin) - begin)));
}

void StreamRelay::pump(int client, GSocketConnection* connection, bool is_encrypted) {
  constexpr std::size_t kBuffer = 65536;
  const int server = g_socket_get_fd(g_socket_connection_get_socket(connection));
  const bool is_edited = transport_ == RtspTransport::kUdp && !is_encrypted;
  TransportSource source(address_of_peer(connection));
  std::vector<char> buffer(kBuffer);
  while (true) {
    std::array<pollfd, 2> ends{pollfd{client, POLLIN, 0}, pollfd{server, POLLIN, 0}};
    if (!wait_for(ends.data(), ends.size())) return;
    if (ends[0].revents != 0) {
      const auto bytes = receive(client, buffer);
      if (bytes && (bytes->empty() || !send_all(server, *bytes))) return;
    }
    if (ends[1].revents != 0) {
      const auto bytes = receive(server, buffer);
      if (!bytes) continue;
      bytes_without_frame_ += bytes->size();
      if (bytes_without_frame_ > kMostBytesWithoutFrame)
        return end_because("the server sends and sends, but no frame", true);
      const bool is_sent = is_edited ? send_all(client, source.edit(*bytes)) : send_all(client, *bytes);
      if (bytes->empty() || !is_sent) return;
    }
  }
}

/// Waits for any of the descriptors; false when the connection is to be cut.
bool StreamRelay::wait_for(pollfd* descriptors, std::size_t count) const {
  std::vector<pollfd> all(descriptors, descriptors + count);
  all.push_back({wake_.get(), POLLIN, 0});
  while (true) {
    const Clock::time_point cut_at = cut_at_;
    const bool is_closing = cut_at != Clock::time_point::max();  // the wake-up was heard
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(cut_at - Clock::now());
    if (is_closing && left.count() <= 0) return false;
    const int ready = ::poll(all.data(), is_closing ? count : count + 1,
                             is_closing ? static_cast<int>(std::min<std::int64_t>(left.count(), 1000)) : -1);
    if (ready < 0 && errno != EINTR) return false;
    std::copy_n(all.begin(), count, descriptors);
    if (ready > 0 && std::any_of(descriptors, descriptors + count,
                                 [](const pollfd& descriptor) { return descriptor.revents != 0; }))
      return true;
  }
}

bool StreamRelay::wait_for(int descriptor, short events) const {
  pollfd one{descriptor, events, 0};
  return wait_for(&one, 1);
}

bool StreamRelay::send_all(int descriptor, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(descriptor, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0) bytes.remove_prefix(static_cast<std::size_t>(sent));
    if (sent >= 0 || errno == EINTR) continue;
    if (errno != EAGAIN || !wait_for(descriptor, POLLOUT)) return false;
  }
  return true;
}

}  // namespace geoloc::io
