// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geoloc/io/live_page/live_document.hpp"
#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/page_request.hpp"
#include "geoloc/io/live_page/picture_board.hpp"
#include "geoloc/io/live_page/replay_control.hpp"

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

/// "17" of "/objects/17/note" where `part` is "/note".
std::optional<std::uint64_t> object_of_path(const std::string& path, std::string_view part);

/// What pages may change, where they may. Functions that are missing are refused.
struct PageActions {
  /// False where there is no such object.
  std::function<bool(std::uint64_t object_id, const ObjectNote& note)> note = {};
  /// Pauses a replay, changes its speed, or goes to another place in it.
  std::function<void(const ReplayWish& wish)> play = {};
};

/// A background map for pages, in place of the one that the configuration names.
struct PageMap {
  /// The tile "17/70400/73939" (zoom, column, row of Web Mercator) as PNG; nullopt where there is none.
  std::function<std::optional<std::string>(const std::string& address)> tile = {};
  std::string attribution = {};  ///< what its maker wants to be read beside it
};

class RunFiles;

/// The page's addresses: a request in, an answer out, without any input or output of its own. Thread-safe.
class LiveSite {
 public:
  /// Document and board must outlive it. With a token, nothing is shown to those who do not have it.
  LiveSite(const LiveDocument& document, PictureBoard& board, const LivePageConfig& config,
           std::vector<std::string> own_names, const std::string& token = {}, PageActions actions = {},
           PageMap map = {});
  ~LiveSite();
  LiveSite(const LiveSite&) = delete;
  LiveSite& operator=(const LiveSite&) = delete;

  PageAnswer answer(const PageRequest& request) const;

  /// Headers of every answer: what a browser may do with it.
  const Headers& headers() const { return headers_; }

 private:
  PageAnswer dispatch(const PageRequest& request) const;
  PageAnswer change(const PageRequest& request) const;
  PageAnswer take_note(const PageRequest& request) const;
  PageAnswer tile(const std::string& address) const;

  const LiveDocument& document_;
  PictureBoard& board_;
  std::vector<std::string> own_names_;
  LivePageConfig config_;
  PageActions actions_;
  PageMap map_;
  std::unique_ptr<const PageAccess> access_;
  std::unique_ptr<RunFiles> files_;
  Headers headers_;
};

}  // namespace geoloc::io
