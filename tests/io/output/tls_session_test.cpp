// SPDX-License-Identifier: Apache-2.0
// OpenSSL's server is at the other end, in memory: the laws here are who is believed, and by what name a
// refusal goes.
#include "io/output/tls_session.hpp"

#include <gtest/gtest.h>
#include <openssl/ssl.h>

#include <array>
#include <optional>

#include "io/output/test_certificates.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

using testing::CertificateWish;
using testing::issue;
using testing::TemporaryFolder;
using testing::TestCertificate;

const TestCertificate& authority() {
  static const TestCertificate made = issue({"the authority", "", -3600, 3600, true});
  return made;
}

const TestCertificate& other_authority() {
  static const TestCertificate made = issue({"another authority", "", -3600, 3600, true});
  return made;
}

TestCertificate issued(const CertificateWish& wish, const TestCertificate& by = authority()) {
  return issue(wish, &by);
}

/// A server in memory that may want a certificate of the authority from its clients.
class MemoryServer {
 public:
  explicit MemoryServer(const TestCertificate& own, bool wants_certificate = false,
                        int newest_version = TLS1_3_VERSION)
      : context_(SSL_CTX_new(TLS_server_method()), &SSL_CTX_free) {
    SSL_CTX_use_certificate(context_.get(), own.certificate.get());
    SSL_CTX_use_PrivateKey(context_.get(), own.key.get());
    SSL_CTX_set_max_proto_version(context_.get(), newest_version);
    X509_STORE_add_cert(SSL_CTX_get_cert_store(context_.get()), authority().certificate.get());
    if (wants_certificate)
      SSL_CTX_set_verify(context_.get(), SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
    ssl_.reset(SSL_new(context_.get()), &SSL_free);
    SSL_set_bio(ssl_.get(), BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
    SSL_set_accept_state(ssl_.get());
  }

  /// Takes what the client sends and returns the answer.
  std::string answer(const std::string& bytes) {
    BIO_write(SSL_get_rbio(ssl_.get()), bytes.data(), static_cast<int>(bytes.size()));
    std::array<char, 4096> piece;
    for (int size = 0; (size = SSL_read(ssl_.get(), piece.data(), piece.size())) > 0;)
      received_.append(piece.data(), static_cast<std::size_t>(size));
    std::string sent(BIO_ctrl_pending(SSL_get_wbio(ssl_.get())), '\0');
    BIO_read(SSL_get_wbio(ssl_.get()), sent.data(), static_cast<int>(sent.size()));
    return sent;
  }
  void say(const std::string& text) { SSL_write(ssl_.get(), text.data(), static_cast<int>(text.size())); }
  void end() { SSL_shutdown(ssl_.get()); }

  const std::string& received() const { return received_; }

 private:
  std::shared_ptr<SSL_CTX> context_;
  std::shared_ptr<SSL> ssl_;
  std::string received_;
};

/// Carries bytes to and fro until both have no more to say; false where the session is over.
bool talk(TlsSession& session, MemoryServer& server) {
  for (int turn = 0; turn < 20; ++turn) {
    const std::string answer = server.answer(session.take_outgoing());
    if (!answer.empty() && !session.receive(answer)) return false;
  }
  return true;
}

class Tls : public ::testing::Test {
 protected:
  Tls() { config.tls_ca_file = put("ca.pem", testing::certificate_pem(authority())); }

  std::string put(const std::string& name, const std::string& content) const {
    return folder.write(name, content).string();
  }

  /// Why the server is not talked to; empty where it is.
  std::string fault_with(MemoryServer server, const std::string& name = "tak.test") const {
    const TlsIdentity identity(config);
    TlsSession session(identity, name);
    const bool is_heard = talk(session, server) && session.is_established();
    EXPECT_EQ(session.is_accepted(), is_heard);
    return is_heard ? "" : session.fault();
  }

  std::string refusal() const {
    try {
      const TlsIdentity identity(config);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  void expect_named(const std::string& text, std::initializer_list<const char*> parts) const {
    for (const char* const part : parts)
      EXPECT_NE(text.find(part), std::string::npos) << part << ": " << text;
  }

  TemporaryFolder folder;
  CotConfig config;
  TestCertificate server_certificate = issued({"tak.test", "DNS:tak.test,IP:127.0.0.1"});
  TestCertificate client_certificate = issued({"drone"});
};

TEST_F(Tls, WhatIsSentArrives) {
  MemoryServer server(server_certificate);
  const TlsIdentity identity(config);
  TlsSession session(identity, "tak.test");
  EXPECT_FALSE(session.is_established());
  ASSERT_TRUE(talk(session, server)) << session.fault();
  ASSERT_TRUE(session.is_established());
  session.send("<event/>");
  server.say("somebody else's event");  // is discarded
  ASSERT_TRUE(talk(session, server));
  EXPECT_EQ(server.received(), "<event/>");
  server.end();
  EXPECT_FALSE(talk(session, server));
  EXPECT_TRUE(session.is_ended());
  expect_named(session.fault(), {"closed the connection"});
}

TEST_F(Tls, TheServersNameIsThatOfItsCertificate) {
  EXPECT_EQ(fault_with(MemoryServer(server_certificate), "tak.test"), "");
  EXPECT_EQ(fault_with(MemoryServer(server_certificate), "127.0.0.1"), "");
  for (const char* const name : {"127.0.0.2", "other.test", "test", "x.tak.test"})
    expect_named(fault_with(MemoryServer(server_certificate), name),
                 {"is not for ", name, "tls_server_name"});
  // As the scripts of older TAK servers make them: without alternative names.
  EXPECT_EQ(fault_with(MemoryServer(issued({"takserver"})), "takserver"), "");
}

TEST_F(Tls, AServerOfNoTrustedAuthorityIsRefused) {
  expect_named(fault_with(MemoryServer(issued({"tak.test", "DNS:tak.test"}, other_authority()))),
               {"not from a trusted authority", "cot.tls_ca_file"});
  expect_named(fault_with(MemoryServer(issue({"tak.test", "DNS:tak.test"}))),
               {"not from a trusted authority"});
  config.tls_ca_file.clear();  // the system's do not know ours
  expect_named(fault_with(MemoryServer(server_certificate)), {"not from a trusted authority"});
}

TEST_F(Tls, AnAuthorityIsTrustedWithoutTheOneAboveIt) {
  const TestCertificate between = issued({"an authority below", "", -3600, 3600, true});
  const TestCertificate below = issued({"tak.test", "DNS:tak.test"}, between);
  config.tls_ca_file = put("between.pem", testing::certificate_pem(between));
  EXPECT_EQ(fault_with(MemoryServer(below)), "");
  expect_named(fault_with(MemoryServer(server_certificate)), {"not from a trusted authority"});
}

TEST_F(Tls, ACertificateOfAnotherTimeIsRefused) {
  expect_named(fault_with(MemoryServer(issued({"tak.test", "DNS:tak.test", -7200, -3600}))), {"has expired"});
  expect_named(fault_with(MemoryServer(issued({"tak.test", "DNS:tak.test", 3600, 7200}))),
               {"not valid yet", "clock of this computer"});
}

TEST_F(Tls, AServerThatWantsACertificateGetsIt) {
  for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
    config.tls_client_file.clear();
    const MemoryServer server(server_certificate, true, version);
    expect_named(fault_with(server), {"wants a client certificate", "cot.tls_client_file"});
    config.tls_client_file = put(
        "client.pem", testing::certificate_pem(client_certificate) + testing::key_pem(client_certificate));
    EXPECT_EQ(fault_with(MemoryServer(server_certificate, true, version)), "");
  }
  const TestCertificate strange = issued({"drone"}, other_authority());
  config.tls_client_file = put("strange.pem", testing::certificate_pem(strange) + testing::key_pem(strange));
  expect_named(fault_with(MemoryServer(server_certificate, true)), {"refuses our certificate"});
}

TEST_F(Tls, KeysComeInFilesOfTheirOwnEncryptedAndAsPkcs12) {
  config.tls_password_file = put("password", "atakatak\n");
  config.tls_client_file = put("client.pem", testing::certificate_pem(client_certificate));
  config.tls_key_file = put("client.key", testing::key_pem(client_certificate, "atakatak"));
  EXPECT_EQ(fault_with(MemoryServer(server_certificate, true)), "");
  config.tls_key_file.clear();
  config.tls_client_file = put("client.p12", testing::pkcs12(client_certificate, authority(), "atakatak"));
  config.tls_ca_file = put("trust.p12", testing::pkcs12(client_certificate, authority(), "atakatak"));
  EXPECT_EQ(fault_with(MemoryServer(server_certificate, true)), "");
}

TEST_F(Tls, FilesThatCannotBeUsedAreNamedBeforeAnythingStarts) {
  config.tls_ca_file = (folder.path() / "none.pem").string();
  expect_named(refusal(), {"cot.tls_ca_file", "none.pem", "cannot be read"});
  config.tls_ca_file = folder.path().string();
  expect_named(refusal(), {"cot.tls_ca_file", "cannot be read"});
  config.tls_ca_file = put("text", "no certificate");
  expect_named(refusal(), {"cot.tls_ca_file", "neither PEM nor PKCS#12"});
  config.tls_ca_file = put("key.pem", testing::key_pem(client_certificate));
  expect_named(refusal(), {"cot.tls_ca_file", "holds no certificate"});
  config.tls_ca_file = put("large", std::string(2U << 20U, 'x'));
  expect_named(refusal(), {"cot.tls_ca_file", "1 MiB"});

  config.tls_ca_file.clear();
  config.tls_client_file = put("client.pem", testing::certificate_pem(client_certificate));
  expect_named(refusal(), {"cot.tls_client_file", "holds no key", "cot.tls_key_file"});
  config.tls_key_file = put("other.key", testing::key_pem(server_certificate));
  expect_named(refusal(), {"cot.tls_key_file", "other.key"});
  config.tls_key_file = put("locked.key", testing::key_pem(client_certificate, "secret"));
  expect_named(refusal(), {"cot.tls_key_file", "cot.tls_password_file"});
  config.tls_client_file.clear();
  expect_named(refusal(), {"cot.tls_key_file", "name one as cot.tls_client_file"});
  config.tls_key_file.clear();
  config.tls_client_file = put("client.p12", testing::pkcs12(client_certificate, authority(), "secret"));
  expect_named(refusal(), {"cot.tls_client_file", "the password is wrong", "cot.tls_password_file"});
}

TEST_F(Tls, AServerThatSpeaksSomethingElseIsNamed) {
  for (const char* const words : {"HTTP/1.1 400 Bad Request\r\n\r\n", "<event version=\"2.0\"/>"}) {
    const TlsIdentity identity(config);
    TlsSession session(identity, "tak.test");
    EXPECT_FALSE(session.receive(words));
    expect_named(session.fault(), {"does not speak TLS"});
  }
}

TEST_F(Tls, DamagedAnswersEndTheSessionOrWait) {
  const TlsIdentity identity(config);
  for (unsigned i = 0; i < 400; ++i) {
    MemoryServer server(server_certificate);
    TlsSession session(identity, "tak.test");
    for (unsigned turn = 0; turn < 4; ++turn) {
      std::string answer = server.answer(session.take_outgoing());
      if (turn == i % 2 && !answer.empty()) {
        answer[(i * 7919) % answer.size()] ^= static_cast<char>(1U + i % 255);
        if (i % 3 == 0) answer.resize(answer.size() / 2);
      }
      if (!answer.empty() && !session.receive(answer)) break;
    }
    EXPECT_EQ(server.received(), "");
    if (session.fault().empty()) continue;
    EXPECT_FALSE(session.receive("more"));
  }
}

}  // namespace
}  // namespace geoloc::io
