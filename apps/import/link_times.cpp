// SPDX-License-Identifier: Apache-2.0
#include "import/link_times.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <variant>

#include "geoloc/io/mavlink/camera_news.hpp"
#include "geoloc/io/mavlink/frame_parser.hpp"
#include "geoloc/io/mavlink/messages.hpp"

namespace geoloc::apps {
namespace {

using Kind = io::CameraNewsKind;

/// Collects what a log's messages tell of cameras.
class NewsCollector {
 public:
  explicit NewsCollector(HostTime begin) : begin_(begin) {}

  void take(const io::CameraNews& news, HostTime at) {
    if (news.kind == Kind::kVideoWanted) {
      add_start(times_.video_starts, at - begin_);
    } else if (news.kind == Kind::kVideoRecorded) {
      add_start(times_.recordings, at - begin_ - news.ago);
    } else {
      add_picture(news, at);
    }
  }

  /// A later kind is nearer to the exposure: the last kind that tells of any counts.
  LogTimes finished() {
    for (const Pictures& pictures : pictures_) {
      if (!pictures.at.empty()) times_.exposures = pictures.at;
    }
    return times_;
  }

 private:
  struct Pictures {
    std::vector<Duration> at;
    std::optional<std::int32_t> last;
  };

  /// A message that is sent again counts once.
  void add_picture(const io::CameraNews& news, HostTime at) {
    Pictures& pictures = pictures_[static_cast<std::size_t>(news.kind)];
    if (pictures.last != news.picture) pictures.at.push_back(at - begin_);
    pictures.last = news.picture;
  }

  HostTime begin_;
  LogTimes times_;
  std::array<Pictures, 3> pictures_;  // by kind
};

}  // namespace

LogTimes times_of(const io::Tlog& telemetry) {
  const auto& records = telemetry.records();
  const auto [first, last] =
      std::minmax_element(records.begin(), records.end(),
                          [](const auto& a, const auto& b) { return a.received_at < b.received_at; });
  NewsCollector collector(first->received_at);
  io::FrameParser parser;
  for (const io::TlogRecord& record : records) {
    parser.append(record.frame, record.size);
    while (const auto frame = parser.next()) {
      if (const auto news = io::decode_camera_news(*frame)) collector.take(*news, record.received_at);
    }
  }
  LogTimes times = collector.finished();
  times.begins_at = first->received_at;
  times.length = last->received_at - first->received_at;
  return times;
}

bool tells_gimbal(const io::Tlog& telemetry) {
  io::FrameParser parser;
  for (const io::TlogRecord& record : telemetry.records()) {
    parser.append(record.frame, record.size);
    while (const auto frame = parser.next()) {
      if (std::holds_alternative<io::GimbalMessage>(io::decode(*frame))) return true;
    }
  }
  return false;
}

}  // namespace geoloc::apps
