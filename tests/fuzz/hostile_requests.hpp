// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "http_message.hpp"

namespace geoloc::io::hostile {

using ReadRequest = std::optional<std::variant<PageRequest, Refusal>>;

/// A request's parts, or the status of its rejection, in a comparable form.
inline std::string text_of(const ReadRequest& read) {
  if (!read) return "incomplete";
  if (const Refusal* const refusal = std::get_if<Refusal>(&*read)) return std::to_string(refusal->status);
  const auto& request = std::get<PageRequest>(*read);
  return request.method + '\n' + request.path + '\n' + request.host + '\n' + request.fetch_site + '\n' +
         request.fetch_mode + '\n' + request.query + '\n' + request.cookie + '\n' + request.authorization +
         '\n' + request.origin;
}

/// Reads bytes as an HTTP request, at once and in two pieces. Aborts if the results differ, or if a request
/// contains a line break.
inline void read_request(std::string_view bytes) {
  constexpr std::size_t kRoom = 2048;
  RequestHead at_once(kRoom);
  const std::string whole = text_of(at_once.add(bytes));
  RequestHead in_pieces(kRoom);
  const std::size_t half = bytes.size() / 2;
  ReadRequest read = in_pieces.add(bytes.substr(0, half));
  if (!read) read = in_pieces.add(bytes.substr(half));
  const bool is_request = read && std::holds_alternative<PageRequest>(*read);
  const bool is_request_at_once = whole.find('\n') != std::string::npos;
  if ((is_request || is_request_at_once) && text_of(read) != whole && bytes.size() <= kRoom) std::abort();
  if (is_request) {
    if (std::get<PageRequest>(*read).path.find_first_of("\r\n") != std::string::npos) std::abort();
    if (std::get<PageRequest>(*read).host.find_first_of("\r\n") != std::string::npos) std::abort();
    if (std::get<PageRequest>(*read).cookie.find_first_of("\r\n") != std::string::npos) std::abort();
  }
}

}  // namespace geoloc::io::hostile
