// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/live_site.hpp"
#include "page_access.hpp"

namespace geoloc::io::hostile {

/// A word of a text with words one space apart; missing ones are empty.
inline std::string word(const std::string& text, int number) {
  std::size_t begin = 0;
  for (; number > 0 && begin != std::string::npos; --number) {
    begin = text.find(' ', begin);
    if (begin != std::string::npos) ++begin;
  }
  return begin == std::string::npos ? "" : text.substr(begin, text.find(' ', begin) - begin);
}

/// A token shows the page only to a request that has it, and no answer gives it away but the cookie.
inline void ask_with_token(const LiveSite& guarded, const PageRequest& request, const std::string& token) {
  const bool has_token = request.query.find(token) != std::string::npos ||
                         request.cookie.find(token) != std::string::npos ||
                         request.authorization.find(token) != std::string::npos;
  const PageAnswer answer = guarded.answer(request);
  if (answer.status == 200 && !has_token) std::abort();
  if (answer.body.find(token) != std::string::npos) std::abort();
  for (const auto& [name, value] : answer.headers) {
    if (value.find_first_of("\r\n") != std::string::npos) std::abort();
    if (name == "Set-Cookie" && !has_token) std::abort();
  }
}

/// Reads bytes as a request, an endpoint and a tile URL. Aborts if an answer breaks its promises.
inline void ask_for_pages(const std::string& bytes) {
  static const LiveDocument document{{"run", true}};
  static PictureBoard board{{"target"}, std::chrono::milliseconds{100}};
  static int changes = 0;
  static const PageActions actions{[](std::uint64_t /*id*/, const ObjectNote& note) {
                                     ++changes;
                                     if (note.name.size() > 4 * kLongestNoteName + 3) std::abort();
                                     return true;
                                   },
                                   [](const ReplayWish& wish) {
                                     ++changes;
                                     if (wish.speed && !(*wish.speed > 0.0 && *wish.speed < 1e3))
                                       std::abort();
                                   }};
  static const LiveSite site{document, board, {}, {"localhost"}, {}, actions};
  static const PageAccess access{{}};
  static const std::string token = "0123456789abcdef";
  static const LiveSite guarded{document, board, {}, {"localhost"}, token};
  PageRequest request{word(bytes, 0), word(bytes, 1), word(bytes, 2), word(bytes, 3), word(bytes, 4)};
  request.query = word(bytes, 6);
  request.cookie = word(bytes, 7);
  request.authorization = word(bytes, 8);
  std::replace(request.authorization.begin(), request.authorization.end(), '_', ' ');
  request.origin = word(bytes, 9);
  request.client_network = request.origin;
  request.is_from_this_computer = word(bytes, 10) == "near";
  ask_with_token(guarded, request, token);
  const int before = changes;
  const PageAnswer answer = site.answer(request);
  const bool is_ours = is_own_host(request.host, {"localhost"});
  if (answer.status == 200 && !is_ours) std::abort();
  if (changes != before && !(is_ours && request.method == "POST" && access.may_change(request))) std::abort();
  if (answer.status < 200 || answer.status > 499) std::abort();

  const std::string origin = tile_origin(word(bytes, 5));  // is put into a header
  if (origin.find_first_of(" ;,'\r\n\"") != std::string::npos) std::abort();
  try {
    const HttpEndpoint endpoint = parse_http_endpoint(bytes);
    if (endpoint.host.empty()) std::abort();
  } catch (const std::invalid_argument&) {  // invalid ones are rejected
  }
}

}  // namespace geoloc::io::hostile
