// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdlib>
#include <stdexcept>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/live_site.hpp"

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
  static const LiveSite site{document, board, {}, {"localhost"}, actions};
  PageRequest request{word(bytes, 0), word(bytes, 1), word(bytes, 2), word(bytes, 3), word(bytes, 4)};
  request.query = word(bytes, 6);
  request.origin = word(bytes, 7);
  request.is_from_this_computer = word(bytes, 8) == "near";
  const int before = changes;
  const PageAnswer answer = site.answer(request);
  const bool is_ours = is_own_host(request.host, {"localhost"});
  if (answer.status == 200 && !is_ours) std::abort();
  if (changes != before && !(is_ours && request.method == "POST" && may_change(request))) std::abort();
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
