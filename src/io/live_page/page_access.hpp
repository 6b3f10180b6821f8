// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "geoloc/io/live_page/page_request.hpp"
#include "token_guesses.hpp"

namespace geoloc::io {

/// Takes the same time for every text of the secret's length.
bool is_same_secret(std::string_view given, std::string_view secret);

/// What a request offers as its token: that of a link (`/?token=…`), of `Authorization: Bearer`, or of the
/// cookie that the link has set, the first of these that there is.
struct OfferedToken {
  std::string token;
  bool is_by_link = false;
};
std::optional<OfferedToken> offered_token(const PageRequest& request);

/// Who may see a page, and who may change something through it. Thread-safe.
class PageAccess {
 public:
  /// Without a token, whoever reaches the page may see it.
  explicit PageAccess(std::string token);

  /// nullopt where the request is to be answered. Otherwise what it is told instead: to give a token (401),
  /// to wait after too many wrong ones (429), or, where it came by a link, to go on to the page.
  std::optional<PageAnswer> answer_instead(const PageRequest& request, TokenGuesses::Time now) const;

  /// Whether a request may change something: it has the token or, where there is none, comes from this
  /// computer and through no proxy that says so; and it is none that the page of another site makes a browser
  /// send.
  bool may_change(const PageRequest& request) const;

 private:
  std::string token_;
  mutable TokenGuesses guesses_;
};

}  // namespace geoloc::io
