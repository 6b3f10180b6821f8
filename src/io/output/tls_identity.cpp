// SPDX-License-Identifier: Apache-2.0
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/provider.h>

#include <fstream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "tls_parts.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kLargestFile = 1U << 20U;  // bytes

using Bytes = std::unique_ptr<BIO, FreeBy<&BIO_free_all>>;
using Key = std::unique_ptr<EVP_PKEY, FreeBy<&EVP_PKEY_free>>;
using Certificate = std::unique_ptr<X509, FreeBy<&X509_free>>;
using Provider = std::unique_ptr<OSSL_PROVIDER, FreeBy<&OSSL_PROVIDER_unload>>;

void free_certificates(STACK_OF(X509) * certificates) {
  sk_X509_pop_free(certificates, X509_free);
}
using Certificates = std::unique_ptr<STACK_OF(X509), FreeBy<&free_certificates>>;

struct Pkcs12 {
  Key key;
  Certificate certificate;
  Certificates others;
};

/// A setting that names a file, and the file.
struct Named {
  const char* setting;
  const std::string& file;
};

[[noreturn]] void refuse(const Named& named, const std::string& reason) {
  throw std::runtime_error(std::string("cot.") + named.setting + " " + named.file + ": " + reason);
}

/// What OpenSSL has said last; it forgets it.
std::string last_words() {
  const char* const reason = ERR_reason_error_string(ERR_peek_last_error());
  ERR_clear_error();
  return reason == nullptr ? "not understood" : reason;
}

std::string read(const Named& named) {
  std::ifstream file(named.file, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file.is_open() || file.bad() || file.gcount() == 0) refuse(named, "cannot be read");
  text.resize(static_cast<std::size_t>(file.gcount()));
  if (text.size() > kLargestFile) refuse(named, "is larger than 1 MiB: no certificate, nor a key");
  return text;
}

Bytes bytes_of(const std::string& text) {
  return Bytes(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())));
}

bool is_pem(const std::string& text) {
  return text.find("-----BEGIN ") != std::string::npos;
}

/// For encrypted PEM keys. Without a password OpenSSL would ask the terminal.
int give_password(char* buffer, int size, int /*is_for_writing*/, void* password) {
  const auto& text = *static_cast<const std::string*>(password);
  if (text.empty() || text.size() > static_cast<std::size_t>(size)) return -1;
  text.copy(buffer, text.size());
  return static_cast<int>(text.size());
}

std::optional<Pkcs12> parse(PKCS12* file, const std::string& password) {
  EVP_PKEY* key = nullptr;
  X509* certificate = nullptr;
  STACK_OF(X509)* others = nullptr;
  const bool is_read = PKCS12_parse(file, password.c_str(), &key, &certificate, &others) == 1;
  Pkcs12 parts{Key(key), Certificate(certificate), Certificates(others)};
  if (!is_read) return std::nullopt;
  return parts;
}

Pkcs12 read_pkcs12(const Named& named, const std::string& text, const std::string& password) {
  const Bytes bytes = bytes_of(text);
  const std::unique_ptr<PKCS12, FreeBy<&PKCS12_free>> file(d2i_PKCS12_bio(bytes.get(), nullptr));
  if (!file) refuse(named, "is neither PEM nor PKCS#12");
  if (auto parts = parse(file.get(), password)) return *std::move(parts);
  // TAK servers write files with the ciphers of the nineties, which OpenSSL has in a part of its own.
  const Provider legacy(OSSL_PROVIDER_try_load(nullptr, "legacy", 1));
  if (auto parts = parse(file.get(), password)) return *std::move(parts);
  if (ERR_GET_REASON(ERR_peek_last_error()) == PKCS12_R_MAC_VERIFY_FAILURE)
    refuse(named, "the password is wrong; cot.tls_password_file names the file that holds it");
  refuse(named, last_words() + "; write it anew: openssl pkcs12 -legacy -in " + named.file +
                    " -nodes -out FILE.pem (Debian 13: with the package openssl-provider-legacy)");
}

std::string password_of(const CotConfig& config) {
  if (config.tls_password_file.empty()) return {};
  const std::string text = read({"tls_password_file", config.tls_password_file});
  return text.substr(0, text.find_first_of("\r\n"));
}

void trust(SSL_CTX* context, const CotConfig& config, const std::string& password) {
  const Named named{"tls_ca_file", config.tls_ca_file};
  if (named.file.empty()) {
    SSL_CTX_set_default_verify_paths(context);
    return;
  }
  const std::string text = read(named);
  X509_STORE* const store = SSL_CTX_get_cert_store(context);
  X509_STORE_set_flags(store, X509_V_FLAG_PARTIAL_CHAIN);  // TAK's trust stores may lack the root
  int count = 0;
  if (is_pem(text)) {
    const Bytes bytes = bytes_of(text);
    while (const Certificate one{PEM_read_bio_X509_AUX(bytes.get(), nullptr, nullptr, nullptr)})
      count += X509_STORE_add_cert(store, one.get());
  } else {
    const Pkcs12 parts = read_pkcs12(named, text, password);
    for (int i = 0; parts.others && i < sk_X509_num(parts.others.get()); ++i)
      count += X509_STORE_add_cert(store, sk_X509_value(parts.others.get(), i));
  }
  ERR_clear_error();  // the end of the file was one
  if (count == 0) refuse(named, "holds no certificate");
}

void prove_by_pem(SSL_CTX* context, const Named& certificate, const Named& key) {
  if (SSL_CTX_use_certificate_chain_file(context, certificate.file.c_str()) != 1)
    refuse(certificate, "holds no certificate: " + last_words());
  if (SSL_CTX_use_PrivateKey_file(context, key.file.c_str(), SSL_FILETYPE_PEM) != 1)
    refuse(key, "holds no key for the certificate that can be read: " + last_words() +
                    "; cot.tls_key_file names a key in another file, cot.tls_password_file the file of its "
                    "password");
}

void prove(SSL_CTX* context, const CotConfig& config, std::string& password) {
  const Named certificate{"tls_client_file", config.tls_client_file};
  const bool has_key_file = !config.tls_key_file.empty();
  const Named key = has_key_file ? Named{"tls_key_file", config.tls_key_file} : certificate;
  const std::string text = read(certificate);
  if (has_key_file) read(key);
  if (is_pem(text)) {
    SSL_CTX_set_default_passwd_cb_userdata(context, &password);
    SSL_CTX_set_default_passwd_cb(context, &give_password);
    prove_by_pem(context, certificate, key);
    SSL_CTX_set_default_passwd_cb_userdata(context, nullptr);
    return;
  }
  const Pkcs12 parts = read_pkcs12(certificate, text, password);
  if (!parts.key || !parts.certificate) refuse(certificate, "holds no certificate with its key");
  if (SSL_CTX_use_cert_and_key(context, parts.certificate.get(), parts.key.get(), parts.others.get(), 1) != 1)
    refuse(certificate, last_words());
}

}  // namespace

TlsIdentity::TlsIdentity(const CotConfig& config) {
  auto parts = std::make_unique<Parts>();
  parts->context.reset(SSL_CTX_new(TLS_client_method()));
  SSL_CTX* const context = parts->context.get();
  if (context == nullptr) throw std::runtime_error("OpenSSL cannot be used: " + last_words());
  SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  SSL_CTX_set_options(context, SSL_OP_NO_RENEGOTIATION);
  SSL_CTX_set_verify(context, SSL_VERIFY_PEER, nullptr);
  std::string password = password_of(config);
  trust(context, config, password);
  parts->has_client_certificate = !config.tls_client_file.empty();
  if (!parts->has_client_certificate && !config.tls_key_file.empty())
    refuse({"tls_key_file", config.tls_key_file},
           "is the key of no certificate; name one as cot.tls_client_file");
  if (parts->has_client_certificate) prove(context, config, password);
  parts_ = std::move(parts);
}

TlsIdentity::~TlsIdentity() = default;

}  // namespace geoloc::io
