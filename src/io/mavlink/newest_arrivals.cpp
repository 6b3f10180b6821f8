// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mavlink/newest_arrivals.hpp"

#include <algorithm>

namespace geoloc::io {

void NewestArrivals::add(Duration offset, HostTime received_at) {
  const auto is_old = [received_at](const Message& message) {
    return std::chrono::abs(received_at - message.received_at) > kWindow;
  };
  const auto end = std::remove_if(messages_.begin(), messages_.begin() + count_, is_old);
  count_ = static_cast<std::size_t>(end - messages_.begin());
  if (count_ == messages_.size()) {
    std::move(messages_.begin() + 1, messages_.end(), messages_.begin());
    --count_;
  }
  messages_[count_++] = {offset, received_at};
  largest_offset_ = offset;
  for (std::size_t i = 0; i < count_; ++i) largest_offset_ = std::max(*largest_offset_, messages_[i].offset);
}

void NewestArrivals::compare(Duration largest_offset_before, HostTime received_at) {
  if (!largest_offset_) return;
  const Duration late = largest_offset_before - *largest_offset_;
  if (late <= kLeastLateness) {
    lateness_.reset();
    return;
  }
  if (!lateness_) lateness_ = Lateness{received_at, 0, late, late};
  ++lateness_->messages;
  lateness_->least = std::min(lateness_->least, late);
  lateness_->most = std::max(lateness_->most, late);
}

}  // namespace geoloc::io
