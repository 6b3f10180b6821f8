// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "geoloc/io/live_page/live_site.hpp"

namespace geoloc::io {

/// The status for an invalid request: 400, or 414 if its target is too long.
struct Refusal {
  int status;
};

/// Reads the head of an HTTP/1 request as it arrives. The bytes are not trusted.
class RequestHead {
 public:
  /// A longer head is rejected.
  explicit RequestHead(std::size_t most_bytes);
  ~RequestHead();
  RequestHead(const RequestHead&) = delete;
  RequestHead& operator=(const RequestHead&) = delete;

  /// Takes the next bytes received. nullopt while the head is incomplete; must not be called after it is
  /// complete.
  std::optional<std::variant<PageRequest, Refusal>> add(std::string_view bytes);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// The head of an answer after which the connection is closed: "HTTP/1.1 200 OK", the headers and an empty
/// line. Without a length the body lasts until the connection's end.
std::string answer_head(const PageAnswer& answer, const Headers& headers,
                        std::optional<std::size_t> body_size);

}  // namespace geoloc::io
