// SPDX-License-Identifier: Apache-2.0
#include "listening_socket.hpp"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <cerrno>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace geoloc::io {
namespace {

using boost::asio::ip::tcp;
using boost::system::error_code;

constexpr int kBacklog = 64;
constexpr std::chrono::milliseconds kOutOfDescriptors{50};

[[noreturn]] void fail_to_listen(const HttpEndpoint& endpoint, const error_code& error) {
  std::string message = endpoint.host + ":" + std::to_string(endpoint.port) + ": " + error.message();
  if (error == boost::asio::error::address_in_use)
    message += "; another program holds the port: take another";
  if (error == boost::asio::error::access_denied)
    message += "; ports below 1024 are for the system, take another";
  if (error == boost::asio::error::host_not_found || error.value() == EADDRNOTAVAIL)
    message += "; the host must be an address of this computer";
  throw std::runtime_error(message);
}

tcp::endpoint resolved(boost::asio::io_context& context, const HttpEndpoint& endpoint) {
  error_code error;
  tcp::resolver resolver(context);
  const auto found =
      resolver.resolve(endpoint.host, std::to_string(endpoint.port), tcp::resolver::passive, error);
  if (error) fail_to_listen(endpoint, error);
  return found.begin()->endpoint();
}

}  // namespace

struct ListeningSocket::Acceptor {
  boost::asio::io_context context;
  tcp::acceptor acceptor{context};
};

ListeningSocket::ListeningSocket(const HttpEndpoint& endpoint, int send_buffer_bytes)
    : acceptor_(std::make_unique<Acceptor>()) {
  tcp::acceptor& acceptor = acceptor_->acceptor;
  const tcp::endpoint address = resolved(acceptor_->context, endpoint);
  error_code error;
  acceptor.open(address.protocol(), error);
  // Accepted connections inherit these options. A port that another program listens on is not shared.
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor.set_option(boost::asio::socket_base::send_buffer_size(send_buffer_bytes), error);
  if (!error) acceptor.set_option(tcp::no_delay(true), error);
  if (!error) acceptor.bind(address, error);
  if (!error) acceptor.listen(kBacklog, error);
  if (error) fail_to_listen(endpoint, error);
}

ListeningSocket::~ListeningSocket() = default;

std::uint16_t ListeningSocket::port() const {
  return acceptor_->acceptor.local_endpoint().port();
}

int ListeningSocket::accept(int stop_descriptor) {
  const int descriptor = acceptor_->acceptor.native_handle();
  while (true) {
    std::array<pollfd, 2> waiting{{{descriptor, POLLIN, 0}, {stop_descriptor, POLLIN, 0}}};
    if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return -1;
    if (waiting[1].revents != 0) return -1;
    if ((waiting[0].revents & POLLIN) == 0) continue;
    const int client = accept4(descriptor, nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (client >= 0) return client;
    // The client stays in the queue and would be announced again at once.
    if (errno == EMFILE || errno == ENFILE || errno == ENOMEM || errno == ENOBUFS)
      std::this_thread::sleep_for(kOutOfDescriptors);
  }
}

}  // namespace geoloc::io
