// SPDX-License-Identifier: Apache-2.0
#include "pixel_limit.hpp"

#include <string>

namespace geoloc::io {

PixelLimit::PixelLimit(std::int64_t most_pixels)
    : before_(cv::Mat::getDefaultAllocator()),
      thread_(std::this_thread::get_id()),
      most_pixels_(most_pixels) {
  cv::Mat::setDefaultAllocator(this);
}

PixelLimit::~PixelLimit() {
  cv::Mat::setDefaultAllocator(before_);
}

cv::UMatData* PixelLimit::allocate(int dimensions, const int* sizes, int type, void* data, std::size_t* steps,
                                   cv::AccessFlag access, cv::UMatUsageFlags usage) const {
  const bool is_picture = dimensions == 2 && thread_ == std::this_thread::get_id();
  if (is_picture && std::int64_t{sizes[0]} * sizes[1] > most_pixels_)
    throw TooManyPixels(std::to_string(sizes[1]) + " x " + std::to_string(sizes[0]));
  return before_->allocate(dimensions, sizes, type, data, steps, access, usage);
}

bool PixelLimit::allocate(cv::UMatData* data, cv::AccessFlag access, cv::UMatUsageFlags usage) const {
  return before_->allocate(data, access, usage);
}

void PixelLimit::deallocate(cv::UMatData* data) const {
  before_->deallocate(data);
}

}  // namespace geoloc::io
