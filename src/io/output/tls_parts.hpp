// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <openssl/pkcs12.h>
#include <openssl/ssl.h>

#include <memory>

#include "tls_session.hpp"

namespace geoloc::io {

/// OpenSSL's objects, freed by their own functions.
template <auto kFree>
struct FreeBy {
  template <typename T>
  void operator()(T* object) const {
    kFree(object);
  }
};
using TlsContext = std::unique_ptr<SSL_CTX, FreeBy<&SSL_CTX_free>>;

struct TlsIdentity::Parts {
  TlsContext context;
  bool has_client_certificate = false;
};

}  // namespace geoloc::io
