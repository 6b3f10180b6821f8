// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "geoloc/io/video/frame_ledger.hpp"
#include "geoloc/io/video/rtp_clock.hpp"
#include "geoloc/io/video/rtp_payload.hpp"

namespace {

using namespace geoloc;

/// Takes numbers off the front of the input; zeros once it is used up.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint64_t take(std::size_t bytes) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes; ++i) {
      value = value << 8U | (size_ > 0 ? *data_ : 0U);
      if (size_ > 0) ++data_, --size_;
    }
    return value;
  }
  bool is_used_up() const { return size_ == 0; }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace

/// Any bytes as a payload, and as a series of packets and sender reports.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  io::begins_random_access_picture(io::VideoCodec::kH264, data, size);
  io::begins_random_access_picture(io::VideoCodec::kH265, data, size);

  io::FrameLedger ledger;
  io::RtpClock clock{std::chrono::milliseconds{30}};
  HostTime now{std::chrono::seconds{1'790'000'000}};
  for (Input input{data, size}; !input.is_used_up();) {
    now += std::chrono::milliseconds{input.take(1)};
    const auto timestamp = static_cast<std::uint32_t>(input.take(4));
    if (input.take(1) % 4 == 0) {
      clock.observe({timestamp, static_cast<std::uint32_t>(input.take(4)), io::from_ntp(input.take(8))});
    }
    ledger.observe({static_cast<std::uint16_t>(input.take(2)), timestamp, input.take(1) % 2 == 0}, now);
    if (!ledger.find(timestamp)) std::abort();
    if (clock.capture_time(timestamp, now).captured_at > now) std::abort();
  }
  return 0;
}
