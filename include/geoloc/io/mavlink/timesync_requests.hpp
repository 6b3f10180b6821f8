// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>

namespace geoloc::io {

/// Our last TIMESYNC requests. Each system answers each of them once, if at all: another answer was made up,
/// or is a repetition.
class TimesyncRequests {
 public:
  void note_request(std::int64_t requester_ns) {
    requests_[next_] = {requester_ns, {}};
    next_ = (next_ + 1) % requests_.size();
  }

  /// Whether it is the system's first answer to a request of ours.
  bool take_answer(std::uint8_t system, std::int64_t requester_ns) {
    Request* const asked = std::find_if(requests_.begin(), requests_.end(), [&](const Request& request) {
      return request.requester_ns == requester_ns;
    });
    if (requester_ns == 0 || asked == requests_.end() || asked->has_answered[system]) return false;
    asked->has_answered.set(system);
    return true;
  }

 private:
  struct Request {
    std::int64_t requester_ns = 0;  // 0: none
    std::bitset<256> has_answered;  // by system
  };

  std::array<Request, 32> requests_{};
  std::size_t next_ = 0;
};

}  // namespace geoloc::io
