// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_document.hpp"
#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/page_request.hpp"
#include "geoloc/io/live_page/picture_board.hpp"

namespace geoloc::io {

class PageAccess;

/// Whether a Host header names this computer. A page of another site can make a browser connect here through
/// a name of that site that resolves to our address (DNS rebinding). It cannot do so through an address or
/// one of our own names.
bool is_own_host(const std::string& host_header, const std::vector<std::string>& own_names);

/// "localhost", this computer's name, and the host that was asked for.
std::vector<std::string> names_of_this_computer(const std::string& given_host);

/// "17" of "/objects/17".
std::optional<std::uint64_t> object_of_path(const std::string& path);

/// The page's addresses: a request in, an answer out, without any input or output of its own. Thread-safe.
class LiveSite {
 public:
  /// Document and board must outlive it. With a token, nothing is shown to those who do not have it.
  LiveSite(const LiveDocument& document, PictureBoard& board, const LivePageConfig& config,
           std::vector<std::string> own_names, const std::string& token = {});
  ~LiveSite();
  LiveSite(const LiveSite&) = delete;
  LiveSite& operator=(const LiveSite&) = delete;

  PageAnswer answer(const PageRequest& request) const;

  /// Headers of every answer: what a browser may do with it.
  const Headers& headers() const { return headers_; }

 private:
  PageAnswer dispatch(const PageRequest& request) const;

  const LiveDocument& document_;
  PictureBoard& board_;
  std::vector<std::string> own_names_;
  std::unique_ptr<const PageAccess> access_;
  std::string settings_json_;
  Headers headers_;
};

}  // namespace geoloc::io
