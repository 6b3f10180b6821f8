// SPDX-License-Identifier: Apache-2.0
#include "tls_session.hpp"

#include <arpa/inet.h>
#include <openssl/err.h>
#include <openssl/x509v3.h>

#include <array>
#include <utility>

#include "tls_parts.hpp"

namespace geoloc::io {
namespace {

constexpr const char* kIfItWantsCertificate =
    "; if it wants a client certificate, cot.tls_client_file names the file of one";

bool is_internet_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

void expect_name(SSL* ssl, const std::string& name) {
  X509_VERIFY_PARAM* const wanted = SSL_get0_param(ssl);
  if (is_internet_address(name)) {
    X509_VERIFY_PARAM_set1_ip_asc(wanted, name.c_str());
    return;
  }
  X509_VERIFY_PARAM_set_hostflags(wanted, X509_CHECK_FLAG_NO_PARTIAL_WILDCARDS);
  X509_VERIFY_PARAM_set1_host(wanted, name.c_str(), name.size());
  SSL_set_tlsext_host_name(ssl, name.c_str());
}

/// What is wrong with the server's certificate.
std::string certificate_fault(long verdict, const std::string& name) {
  switch (verdict) {
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT:
    case X509_V_ERR_UNABLE_TO_GET_ISSUER_CERT_LOCALLY:
    case X509_V_ERR_UNABLE_TO_VERIFY_LEAF_SIGNATURE:
    case X509_V_ERR_SELF_SIGNED_CERT_IN_CHAIN:
    case X509_V_ERR_DEPTH_ZERO_SELF_SIGNED_CERT:
    case X509_V_ERR_CERT_SIGNATURE_FAILURE:
      return "the server's certificate is not from a trusted authority; cot.tls_ca_file names the file of "
             "the server's";
    case X509_V_ERR_CERT_HAS_EXPIRED:
      return "the server's certificate has expired";
    case X509_V_ERR_CERT_NOT_YET_VALID:
      return "the server's certificate is not valid yet: is the clock of this computer right?";
    case X509_V_ERR_HOSTNAME_MISMATCH:
    case X509_V_ERR_IP_ADDRESS_MISMATCH:
      return "the server's certificate is not for " + name +
             "; if its name is another one that you trust, set cot.tls_server_name";
    default:
      return std::string("the server's certificate is refused: ") + X509_verify_cert_error_string(verdict);
  }
}

/// What went wrong otherwise, by OpenSSL's number of it.
std::string protocol_fault(unsigned long error, bool has_client_certificate) {
  const char* const words = ERR_reason_error_string(error);
  const std::string reason = words == nullptr ? "unknown reason" : words;
  switch (ERR_GET_REASON(error)) {
    case SSL_R_TLSV13_ALERT_CERTIFICATE_REQUIRED:
      return "the server wants a client certificate: cot.tls_client_file names the file of one";
    case SSL_R_SSLV3_ALERT_HANDSHAKE_FAILURE:
    case SSL_R_SSLV3_ALERT_BAD_CERTIFICATE:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_EXPIRED:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_REVOKED:
    case SSL_R_SSLV3_ALERT_CERTIFICATE_UNKNOWN:
    case SSL_R_TLSV1_ALERT_UNKNOWN_CA:
    case SSL_R_TLSV1_ALERT_ACCESS_DENIED:
      return has_client_certificate ? "the server refuses our certificate (cot.tls_client_file): " + reason
                                    : "the server refuses us: " + reason + kIfItWantsCertificate;
    case SSL_R_WRONG_VERSION_NUMBER:
    case SSL_R_HTTP_REQUEST:
    case SSL_R_PACKET_LENGTH_TOO_LONG:
      return "the server does not speak TLS at this port";
    default:
      return "TLS fails: " + reason;
  }
}

}  // namespace

struct TlsSession::Parts {
  std::unique_ptr<SSL, FreeBy<&SSL_free>> ssl;
  BIO* received = nullptr;  // both owned by ssl
  BIO* outgoing = nullptr;
};

TlsSession::TlsSession(const TlsIdentity& identity, const std::string& server_name)
    : parts_(std::make_unique<Parts>()),
      server_name_(server_name),
      has_client_certificate_(identity.parts_->has_client_certificate) {
  parts_->ssl.reset(SSL_new(identity.parts_->context.get()));
  parts_->received = BIO_new(BIO_s_mem());
  parts_->outgoing = BIO_new(BIO_s_mem());
  if (!parts_->ssl || parts_->received == nullptr || parts_->outgoing == nullptr) throw std::bad_alloc();
  SSL* const ssl = parts_->ssl.get();
  SSL_set_bio(ssl, parts_->received, parts_->outgoing);
  expect_name(ssl, server_name);
  SSL_set_connect_state(ssl);
  go_on();
}

TlsSession::~TlsSession() = default;

bool TlsSession::fail(std::string fault) {
  fault_ = std::move(fault);
  return false;
}

/// The handshake, then whatever comes, as far as the bytes received allow.
bool TlsSession::go_on() {
  SSL* const ssl = parts_->ssl.get();
  std::array<char, 4096> discarded;
  ERR_clear_error();
  int result = is_established_ ? 1 : SSL_do_handshake(ssl);
  is_established_ = result == 1;
  while (result > 0) result = SSL_read(ssl, discarded.data(), static_cast<int>(discarded.size()));
  const int state = SSL_get_error(ssl, result);
  if (state == SSL_ERROR_WANT_READ) return true;
  if (state == SSL_ERROR_ZERO_RETURN) {
    is_ended_ = true;
    return fail(fault_of_silent_end());
  }
  const long verdict = SSL_get_verify_result(ssl);
  if (verdict != X509_V_OK) return fail(certificate_fault(verdict, server_name_));
  return fail(protocol_fault(ERR_peek_last_error(), has_client_certificate_));
}

bool TlsSession::receive(std::string_view bytes) {
  if (!fault_.empty()) return false;
  const bool was_established = is_established_;
  BIO_write(parts_->received, bytes.data(), static_cast<int>(bytes.size()));
  if (!go_on()) return false;
  const bool is_old = SSL_version(parts_->ssl.get()) < TLS1_3_VERSION;
  is_accepted_ = is_accepted_ || was_established || (is_established_ && is_old);
  return true;
}

void TlsSession::send(std::string_view text) {
  SSL_write(parts_->ssl.get(), text.data(), static_cast<int>(text.size()));
}

void TlsSession::end() {
  if (is_established_) SSL_shutdown(parts_->ssl.get());
}

std::string TlsSession::take_outgoing() {
  std::string bytes(BIO_ctrl_pending(parts_->outgoing), '\0');
  if (!bytes.empty()) BIO_read(parts_->outgoing, bytes.data(), static_cast<int>(bytes.size()));
  return bytes;
}

std::string TlsSession::fault_of_silent_end() const {
  const std::string fault = "the server closed the connection";
  if (has_client_certificate_) return fault;
  return fault + kIfItWantsCertificate;
}

}  // namespace geoloc::io
