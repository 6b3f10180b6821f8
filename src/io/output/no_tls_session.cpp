// SPDX-License-Identifier: Apache-2.0
#include <stdexcept>

#include "tls_session.hpp"

namespace geoloc::io {

struct TlsIdentity::Parts {};
struct TlsSession::Parts {};

TlsIdentity::TlsIdentity(const CotConfig& /*config*/) {
  throw std::runtime_error("tls:// needs a program that was built with OpenSSL 3 (Debian: libssl-dev)");
}
TlsIdentity::~TlsIdentity() = default;

TlsSession::TlsSession(const TlsIdentity& /*identity*/, const std::string& /*server_name*/)
    : has_client_certificate_(false) {}
TlsSession::~TlsSession() = default;

bool TlsSession::receive(std::string_view /*bytes*/) {
  return false;
}
void TlsSession::send(std::string_view /*text*/) {}
void TlsSession::end() {}
std::string TlsSession::take_outgoing() {
  return {};
}
std::string TlsSession::fault_of_silent_end() const {
  return {};
}

}  // namespace geoloc::io
