// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <stdexcept>
#include <thread>

namespace geoloc::io {

/// Within its life, OpenCV makes no matrix of more pixels in this thread, and throws TooManyPixels instead:
/// of the decoders of a dozen formats, each knows the size of a picture before the memory for it is taken,
/// but none tells.
class PixelLimit final : private cv::MatAllocator {
 public:
  struct TooManyPixels : std::length_error {
    using std::length_error::length_error;
  };

  explicit PixelLimit(std::int64_t most_pixels);
  ~PixelLimit() override;
  PixelLimit(const PixelLimit&) = delete;
  PixelLimit& operator=(const PixelLimit&) = delete;

 private:
  cv::UMatData* allocate(int dimensions, const int* sizes, int type, void* data, std::size_t* steps,
                         cv::AccessFlag access, cv::UMatUsageFlags usage) const override;
  bool allocate(cv::UMatData* data, cv::AccessFlag access, cv::UMatUsageFlags usage) const override;
  void deallocate(cv::UMatData* data) const override;

  cv::MatAllocator* before_;
  std::thread::id thread_;
  std::int64_t most_pixels_;
};

}  // namespace geoloc::io
