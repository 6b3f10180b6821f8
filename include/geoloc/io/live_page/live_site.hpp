// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_document.hpp"
#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/picture_board.hpp"

namespace geoloc::io {

/// What matters of a request; all of it is as it arrived.
struct PageRequest {
  std::string method;
  std::string path;        ///< without the query
  std::string host;        ///< header Host
  std::string fetch_site;  ///< headers Sec-Fetch-Site and -Mode: browsers say on whose behalf they ask
  std::string fetch_mode;
};

struct PageAnswer {
  int status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  bool is_event_stream = false;  ///< in place of the body
};

using Headers = std::vector<std::pair<std::string, std::string>>;

/// Whether a Host header names this computer. A page elsewhere can make a browser connect here by a name of
/// its own that resolves to our address (DNS rebinding); it cannot do so by an address, nor by our own names.
bool is_own_host(const std::string& host_header, const std::vector<std::string>& own_names);

/// "localhost", this computer's name, and the host that was asked for.
std::vector<std::string> names_of_this_computer(const std::string& given_host);

/// "17" of "/objects/17".
std::optional<std::uint64_t> object_of_path(const std::string& path);

/// The page's addresses. No input or output: a request in, an answer out; any thread may ask.
class LiveSite {
 public:
  /// Document and board must outlive it.
  LiveSite(const LiveDocument& document, PictureBoard& board, const LivePageConfig& config,
           std::vector<std::string> own_names);

  PageAnswer answer(const PageRequest& request) const;

  /// Of every answer: what a browser may do with it.
  const Headers& headers() const { return headers_; }

 private:
  PageAnswer dispatch(const PageRequest& request) const;

  const LiveDocument& document_;
  PictureBoard& board_;
  std::vector<std::string> own_names_;
  std::string settings_json_;
  Headers headers_;
};

}  // namespace geoloc::io
