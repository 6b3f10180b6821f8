// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "geoloc/geometry/time.hpp"

namespace geoloc::apps {

/// A text whose figures change from second to second: it stays as it is for a while, so that it is not told
/// anew each time.
class SteadyText {
 public:
  explicit SteadyText(Duration lasts) : lasts_(lasts) {}

  /// `text`: as it would be now; an empty one ends it at once.
  const std::string& show(HostTime now, const std::string& text) {
    if (text.empty()) {
      shown_.clear();
    } else if (shown_.empty() || now - shown_since_ > lasts_) {
      shown_ = text;
      shown_since_ = now;
    }
    return shown_;
  }

 private:
  Duration lasts_;
  std::string shown_;
  HostTime shown_since_{};
};

}  // namespace geoloc::apps
