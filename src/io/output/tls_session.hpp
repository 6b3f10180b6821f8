// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "geoloc/io/output/cot_config.hpp"

namespace geoloc::io {

/// By what TLS servers are checked, and what we prove ourselves with.
class TlsIdentity {
 public:
  /// Reads the files that cot.tls_* name. Throws std::runtime_error naming the setting, the file, the reason
  /// and the remedy.
  explicit TlsIdentity(const CotConfig& config);
  ~TlsIdentity();
  TlsIdentity(const TlsIdentity&) = delete;
  TlsIdentity& operator=(const TlsIdentity&) = delete;

 private:
  friend class TlsSession;
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

/// TLS (1.2 or newer) of one connection, as a filter of bytes: it has no socket, and nothing waits. The bytes
/// received are not trusted.
class TlsSession {
 public:
  /// The server must have a certificate for `server_name`, a host name or an address, that the identity's
  /// authorities vouch for. The identity must outlive it.
  TlsSession(const TlsIdentity& identity, const std::string& server_name);
  ~TlsSession();
  TlsSession(const TlsSession&) = delete;
  TlsSession& operator=(const TlsSession&) = delete;

  /// Takes what the server sends; what it says within TLS is discarded. False once the session is over:
  /// fault() says why.
  bool receive(std::string_view bytes);

  /// Since the handshake is complete.
  bool is_established() const { return is_established_; }

  /// The server has shown that our certificate, or none, is good enough for it. With TLS 1.3 it may do so, or
  /// refuse, after the handshake; one that says nothing then does not refuse.
  bool is_accepted() const { return is_accepted_; }

  /// The session is over because the server has said farewell.
  bool is_ended() const { return is_ended_; }

  /// Only while established and without a fault.
  void send(std::string_view text);

  /// Tells the server that no more comes.
  void end();

  /// What is to be sent to the server, since the last call.
  std::string take_outgoing();

  /// Why the session is over and what to do about it.
  const std::string& fault() const { return fault_; }

  /// The same where the server has closed the connection without a word.
  std::string fault_of_silent_end() const;

 private:
  struct Parts;

  bool go_on();
  bool fail(std::string fault);

  std::unique_ptr<Parts> parts_;
  std::string server_name_;
  bool has_client_certificate_;
  bool is_established_ = false;
  bool is_accepted_ = false;
  bool is_ended_ = false;
  std::string fault_;
};

}  // namespace geoloc::io
