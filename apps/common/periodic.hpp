// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "geoloc/geometry/time.hpp"

namespace geoloc::apps {

/// Something that a loop does now and then.
class Periodic {
 public:
  Periodic(Duration period, HostTime start) : period_(period), last_(start) {}

  /// At most once a period.
  bool is_due(HostTime now) {
    if (now - last_ < period_) return false;
    last_ = now;
    return true;
  }

 private:
  Duration period_;
  HostTime last_;
};

}  // namespace geoloc::apps
