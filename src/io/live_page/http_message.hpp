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

/// The status that a request which is no request gets: 400, or 414 where its target is too long.
struct Refusal {
  int status;
};

/// Reads the head of an HTTP/1 request as it comes; the bytes are anybody's.
class RequestHead {
 public:
  /// A head of more bytes is refused.
  explicit RequestHead(std::size_t most_bytes);
  ~RequestHead();
  RequestHead(const RequestHead&) = delete;
  RequestHead& operator=(const RequestHead&) = delete;

  /// Takes the bytes that came next. nullopt while the head is not whole; to be called no more afterwards.
  std::optional<std::variant<PageRequest, Refusal>> add(std::string_view bytes);

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

/// The head of an answer whose connection is closed after it: "HTTP/1.1 200 OK", the headers and an empty
/// line. Without a length the body lasts until the connection's end.
std::string answer_head(const PageAnswer& answer, const Headers& headers,
                        std::optional<std::size_t> body_size);

}  // namespace geoloc::io
