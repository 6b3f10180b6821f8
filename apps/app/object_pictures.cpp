// SPDX-License-Identifier: Apache-2.0
#include "app/object_pictures.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace geoloc::apps {
namespace {

constexpr std::size_t kMostPieces = 16;  // of a frame
constexpr std::size_t kMostWaiting_bytes = 32 << 20;
constexpr std::size_t kMostJobs = 8;
constexpr std::size_t kMostObjects = 2000;
constexpr double kAround = 2.0;  // of the box's longer side
constexpr double kLeastSide_px = 48.0;
constexpr double kMostSide_px = 1024.0;
constexpr int kPictureSide_px = 256;
constexpr int kPieceQuality = 85;
constexpr double kBetter = 1.2;      // times the worth of the last one
constexpr double kEdgeShare = 0.25;  // of the worth is left where the object is cut off by the image's edge
constexpr double kReach_m = 2.0;     // from an object to a detection of it, besides 3 sigma

/// A square around the box, within the image.
cv::Rect square_around(const Box& box, const cv::Mat& image) {
  const double side = std::clamp(kAround * std::max(box.width, box.height), kLeastSide_px, kMostSide_px);
  const double left = box.x + 0.5 * (box.width - side), top = box.y + 0.5 * (box.height - side);
  const cv::Rect square(static_cast<int>(left), static_cast<int>(top), static_cast<int>(side),
                        static_cast<int>(side));
  return square & cv::Rect(0, 0, image.cols, image.rows);
}

std::string encoded(const cv::Mat& piece) {
  cv::Mat small = piece;
  const double scale = static_cast<double>(kPictureSide_px) / std::max(piece.cols, piece.rows);
  if (scale < 1.0) cv::resize(piece, small, {}, scale, scale, cv::INTER_AREA);
  std::vector<unsigned char> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, kPieceQuality});
  return {bytes.begin(), bytes.end()};
}

/// The object that a located detection is of; nullptr where none is near.
const Track* object_at(const Geolocator& geolocator, const LocatedDetection& located) {
  const Track* nearest = nullptr;
  double least_m = kReach_m;
  for (const Track& track : geolocator.tracks()) {
    const double away_m = (track.position_in_enu.mean - located.fix.position_in_enu).norm();
    if (!(away_m < least_m)) continue;
    nearest = &track;
    least_m = away_m;
  }
  return nearest;
}

bool is_same_box(const Box& a, const Box& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

}  // namespace

double picture_worth(const Detection& detection, int width_px, int height_px) {
  const Box& box = detection.box;
  const bool is_whole = box.x > 1.0 && box.y > 1.0 && box.x + box.width < width_px - 1.0 &&
                        box.y + box.height < height_px - 1.0;
  return detection.confidence * std::sqrt(box.width * box.height) * (is_whole ? 1.0 : kEdgeShare);
}

ObjectPictures::ObjectPictures(OnBetter on_better, OnGone on_gone)
    : on_better_(std::move(on_better)), on_gone_(std::move(on_gone)), thread_([this] { run(); }) {}

ObjectPictures::~ObjectPictures() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
    has_job_.notify_one();
  }
  thread_.join();
}

void ObjectPictures::offer(const io::VideoFrame& frame, const std::vector<Detection>& detections) {
  std::vector<Piece> pieces;
  for (const Detection& detection : detections) {
    if (pieces.size() >= kMostPieces) break;
    const cv::Rect square = square_around(detection.box, frame.bgr);
    if (square.area() <= 0) continue;
    pieces.push_back(
        {detection.box, picture_worth(detection, frame.bgr.cols, frame.bgr.rows), frame.bgr(square).clone()});
  }
  if (pieces.empty()) return;
  const std::lock_guard lock(mutex_);
  waiting_.push_back({frame.captured_at, std::move(pieces)});
  waiting_bytes_ += size_bytes(waiting_.back());
  while (waiting_bytes_ > kMostWaiting_bytes) drop_oldest();
}

/// The pieces of that frame; those of earlier ones are dropped.
std::vector<ObjectPictures::Piece> ObjectPictures::take(HostTime captured_at) {
  const std::lock_guard lock(mutex_);
  while (!waiting_.empty() && waiting_.front().captured_at < captured_at) drop_oldest();
  if (waiting_.empty() || waiting_.front().captured_at != captured_at) return {};
  std::vector<Piece> pieces = waiting_.front().pieces;  // a cv::Mat's copy shares its pixels
  drop_oldest();
  return pieces;
}

std::size_t ObjectPictures::size_bytes(const Frame& frame) {
  std::size_t bytes = sizeof frame;
  for (const Piece& piece : frame.pieces) bytes += sizeof piece + piece.bgr.total() * piece.bgr.elemSize();
  return bytes;
}

void ObjectPictures::drop_oldest() {
  waiting_bytes_ -= size_bytes(waiting_.front());
  waiting_.pop_front();
}

void ObjectPictures::assign(const Geolocator& geolocator, HostTime captured_at) {
  forget_gone(geolocator.tracks());
  for (Piece& piece : take(captured_at)) {
    const auto& all = geolocator.located();
    const auto located = std::find_if(all.begin(), all.end(), [&](const LocatedDetection& one) {
      return is_same_box(one.detection.box, piece.box);
    });
    const Track* const object = located == all.end() ? nullptr : object_at(geolocator, *located);
    if (object == nullptr) continue;
    if (worth_.size() >= kMostObjects && worth_.count(object->id) == 0) continue;
    double& best = worth_[object->id];
    if (piece.worth < kBetter * best) continue;
    const std::lock_guard lock(mutex_);
    if (jobs_.size() >= kMostJobs) continue;
    best = piece.worth;
    jobs_.push_back({object->id, std::move(piece.bgr)});
    has_job_.notify_one();
  }
}

/// Many an object is seen twice and never again: their pictures would add up over hours, and take the places
/// of others. `objects`: all that there are, in order of their ids, as pictures are.
void ObjectPictures::forget_gone(const std::vector<Track>& objects) {
  auto object = objects.begin();
  for (auto pictured = worth_.begin(); pictured != worth_.end();) {
    while (object != objects.end() && object->id < pictured->first) ++object;
    if (object != objects.end() && object->id == pictured->first) {
      ++pictured;
      continue;
    }
    const std::lock_guard lock(mutex_);
    jobs_.push_back({pictured->first, std::nullopt});
    has_job_.notify_one();
    pictured = worth_.erase(pictured);
  }
}

std::size_t ObjectPictures::waiting_bytes() const {
  const std::lock_guard lock(mutex_);
  return waiting_bytes_;
}

void ObjectPictures::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    has_job_.wait(lock, [this] { return !jobs_.empty() || stop_; });
    if (jobs_.empty()) return;
    const Job job = std::move(jobs_.front());
    jobs_.pop_front();
    lock.unlock();
    perform(job);
    lock.lock();
  }
}

void ObjectPictures::perform(const Job& job) const {
  if (job.bgr) {
    on_better_(job.object_id, encoded(*job.bgr));
  } else {
    on_gone_(job.object_id);
  }
}

}  // namespace geoloc::apps
