// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace geoloc::apps {

/// The mean of the values that there are.
class Mean {
 public:
  void add(const std::optional<double>& value) {
    if (!value) return;
    sum_ += *value;
    ++count_;
  }

  /// nullopt without any.
  std::optional<double> value() const { return count_ > 0 ? std::optional(sum_ / count_) : std::nullopt; }

 private:
  double sum_ = 0.0;
  int count_ = 0;
};

}  // namespace geoloc::apps
