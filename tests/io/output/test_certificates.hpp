// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/evp.h>
#include <openssl/pem.h>
#include <openssl/pkcs12.h>
#include <openssl/x509v3.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace geoloc::testing {

/// A certificate with its key, made by OpenSSL's own functions.
struct TestCertificate {
  std::shared_ptr<EVP_PKEY> key;
  std::shared_ptr<X509> certificate;
};

struct CertificateWish {
  std::string name = "tak.test";
  std::string alternative_names = {};  ///< "DNS:tak.test,IP:127.0.0.1"; empty: none
  long begins_in_s = -3600;
  long ends_in_s = 3600;
  bool is_authority = false;
};

inline void extend(X509* certificate, int extension, const std::string& value) {
  X509V3_CTX context;
  X509V3_set_ctx(&context, certificate, certificate, nullptr, nullptr, 0);
  X509_EXTENSION* const made = X509V3_EXT_conf_nid(nullptr, &context, extension, value.c_str());
  X509_add_ext(certificate, made, -1);
  X509_EXTENSION_free(made);
}

/// Signed by the issuer, or by itself where there is none.
inline TestCertificate issue(const CertificateWish& wish, const TestCertificate* issuer = nullptr) {
  static long serial = 0;
  TestCertificate made;
  made.key = std::shared_ptr<EVP_PKEY>(EVP_EC_gen("P-256"), &EVP_PKEY_free);
  made.certificate = std::shared_ptr<X509>(X509_new(), &X509_free);
  X509* const certificate = made.certificate.get();
  X509_set_version(certificate, 2);
  ASN1_INTEGER_set(X509_get_serialNumber(certificate), ++serial);
  X509_gmtime_adj(X509_getm_notBefore(certificate), wish.begins_in_s);
  X509_gmtime_adj(X509_getm_notAfter(certificate), wish.ends_in_s);
  X509_set_pubkey(certificate, made.key.get());
  X509_NAME_add_entry_by_txt(X509_get_subject_name(certificate), "CN", MBSTRING_ASC,
                             reinterpret_cast<const unsigned char*>(wish.name.c_str()), -1, -1, 0);
  const X509* const by = issuer != nullptr ? issuer->certificate.get() : certificate;
  X509_set_issuer_name(certificate, X509_get_subject_name(by));
  if (wish.is_authority) extend(certificate, NID_basic_constraints, "critical,CA:TRUE");
  if (!wish.alternative_names.empty()) extend(certificate, NID_subject_alt_name, wish.alternative_names);
  X509_sign(certificate, issuer != nullptr ? issuer->key.get() : made.key.get(), EVP_sha256());
  return made;
}

inline std::string taken_from(BIO* bytes) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bytes, &data);
  std::string text(data, static_cast<std::size_t>(size));
  BIO_free(bytes);
  return text;
}

inline std::string certificate_pem(const TestCertificate& made) {
  BIO* const bytes = BIO_new(BIO_s_mem());
  PEM_write_bio_X509(bytes, made.certificate.get());
  return taken_from(bytes);
}

/// Encrypted where there is a password.
inline std::string key_pem(const TestCertificate& made, const std::string& password = {}) {
  BIO* const bytes = BIO_new(BIO_s_mem());
  PEM_write_bio_PKCS8PrivateKey(bytes, made.key.get(), password.empty() ? nullptr : EVP_aes_256_cbc(),
                                password.data(), static_cast<int>(password.size()), nullptr, nullptr);
  return taken_from(bytes);
}

/// The certificate with its key and its issuer's certificate, as TAK servers hand them out.
inline std::string pkcs12(const TestCertificate& made, const TestCertificate& issuer,
                          const std::string& password) {
  STACK_OF(X509)* const others = sk_X509_new_null();
  sk_X509_push(others, issuer.certificate.get());
  PKCS12* const file =
      PKCS12_create(password.c_str(), "test", made.key.get(), made.certificate.get(), others, 0, 0, 0, 0, 0);
  sk_X509_free(others);
  BIO* const bytes = BIO_new(BIO_s_mem());
  i2d_PKCS12_bio(bytes, file);
  PKCS12_free(file);
  return taken_from(bytes);
}

}  // namespace geoloc::testing
