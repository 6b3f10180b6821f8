// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/picture_board.hpp"

#include <utility>

#include "page_json.hpp"

namespace geoloc::io {
namespace {

constexpr std::chrono::seconds kInterest{3};  // of a page that was watching

}  // namespace

PictureBoard::PictureBoard(std::vector<std::string> class_names, std::chrono::milliseconds period)
    : class_names_(std::move(class_names)), period_(period) {}

bool PictureBoard::wants_picture() const {
  const auto now = Clock::now();
  const std::lock_guard lock(mutex_);
  const bool is_watched = viewed_at_ && now - *viewed_at_ < kInterest;
  return is_watched && !(shown_at_ && now - *shown_at_ < period_);
}

void PictureBoard::note_viewer() {
  const std::lock_guard lock(mutex_);
  viewed_at_ = Clock::now();
}

std::uint64_t PictureBoard::show(LivePicture picture) {
  const std::lock_guard lock(mutex_);
  shown_at_ = Clock::now();
  ++number_;
  const std::string json = page_json::picture(picture, number_, class_names_);
  std::string framed;
  framed.reserve(4 + json.size() + picture.jpeg.size());
  for (int shift = 0; shift < 32; shift += 8) framed += static_cast<char>((json.size() >> shift) & 0xFF);
  framed += json;
  framed += picture.jpeg;
  framed_ = std::make_shared<const std::string>(std::move(framed));
  return number_;
}

std::shared_ptr<const std::string> PictureBoard::framed() const {
  const std::lock_guard lock(mutex_);
  return framed_;
}

}  // namespace geoloc::io
