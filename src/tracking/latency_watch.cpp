// SPDX-License-Identifier: Apache-2.0
#include "tracking/latency_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// Boxes of a frame that are compared.
constexpr std::size_t kMostBoxes = 8;
/// A box farther from where it should be is another object's, or missed.
constexpr double kMostApart_px = 15.0;
/// Latencies that are tried.
constexpr int kLatencies = 34, kFineSteps = 5;
constexpr double kStep_s = 0.1;
/// As many pairs of frames are judged by at most, and so many boxes at least.
constexpr int kMostPairs = 15, kLeastLooks = 12;
/// Chance alone, by boxes that are missed, makes some latency better than another; not by so much in all.
constexpr double kLeastGain_px2 = 1000.0;
/// Nothing is known to compare with: the present latency must explain next to nothing, and the other one
/// nearly all.
constexpr double kHopeless_px2 = 80.0, kFarBetter = 0.25;

/// A flight's first pairs of frames after which a search is due.
constexpr std::array<int, 12> kDue{12, 20, 30, 40, 50, 60, 80, 100, 120, 150, 180, 220};
/// And later on.
constexpr int kDueEvery = 30;

bool is_well_inside(const Eigen::Vector2d& pixel, double margin_px, const CameraIntrinsics& image) {
  return pixel.x() > margin_px && pixel.x() < image.width_px - margin_px && pixel.y() > margin_px &&
         pixel.y() < image.height_px - margin_px;
}

}  // namespace

LatencyWatch::LatencyWatch() {
  take_room(this);
}

std::size_t LatencyWatch::take_room(LatencyWatch* self) {
  return room::resize(self, &LatencyWatch::frames_, kFrames);
}

bool LatencyWatch::is_at_start() const {
  return pairs_ <= kDue.back() && !is_over_;
}

void LatencyWatch::end_start() {
  is_over_ = pairs_ >= kDue.front();
}

void LatencyWatch::begin_anew() {
  size_ = 0;
  pairs_ = 0;
  is_over_ = false;
}

std::optional<double> LatencyWatch::observe(FrameStamp stamp, const std::vector<LocatedDetection>& detections,
                                            const CalibratedViewer& viewer) {
  if (detections.empty()) return std::nullopt;
  frames_[next_] = FrameBoxes(stamp, detections, kMostBoxes);
  next_ = (next_ + 1) % kFrames;
  size_ = std::min(size_ + 1, kFrames);
  if (!makes_a_pair(viewer.errors.calibration.latency_s(), viewer)) return std::nullopt;
  ++pairs_;
  if (!is_due()) return std::nullopt;
  return search(viewer);
}

bool LatencyWatch::is_due() const {
  if (pairs_ > kDue.back()) return (pairs_ - kDue.back()) % kDueEvery == 0;
  return std::find(kDue.begin(), kDue.end(), pairs_) != kDue.end();
}

/// Calls visit(pixel, scale) for each box of the frame before that is to be seen in the later one, at that
/// pixel, until it returns false.
template <typename Visit>
void LatencyWatch::visit_pair(std::size_t age, double latency_s, const CalibratedViewer& viewer,
                              const Visit& visit) const {
  const FrameBoxes& now = frame(age);
  const auto earlier = frames_to_compare(now.stamp.captured_at_host, size_ - 1 - age, [&](std::size_t n) {
    return frame(age + n).stamp.captured_at_host;
  });
  if (!earlier) return;
  const FrameBoxes& before = frame(age + *earlier);
  const Projector& projector = viewer.projector;
  const auto view_before = viewer.at(before.stamp, latency_s);
  const auto view_now = viewer.at(now.stamp, latency_s);
  if (!view_before || !view_now) return;
  const double scale = viewer.image_scale();
  const double margin_px = 2.0 * kMostApart_px * scale;
  const double ground_m = projector.config().ground_height_above_home_m;
  for (std::size_t i = 0; i < before.count; ++i) {
    const auto place = projector.project(before.pixels[i], *view_before);
    if (!place) continue;
    const Eigen::Vector2d& on_ground = place->position_in_enu;
    const Eigen::Vector3d point(on_ground.x(), on_ground.y(), ground_m);
    const auto shown = projector.reproject(point, *view_now);
    if (!shown || !is_well_inside(*shown, margin_px, projector.camera().intrinsics())) continue;
    if (!visit(*shown, scale)) return;
  }
}

/// Whether the newest frame has one to be compared with.
bool LatencyWatch::makes_a_pair(double latency_s, const CalibratedViewer& viewer) const {
  bool is_pair = false;
  visit_pair(0, latency_s, viewer, [&](const Eigen::Vector2d& /*shown*/, double /*scale*/) {
    is_pair = true;
    return false;
  });
  return is_pair;
}

LatencyWatch::Distance LatencyWatch::distance_of_pair(std::size_t age, double latency_s,
                                                      const CalibratedViewer& viewer) const {
  const FrameBoxes& now = frame(age);
  Distance distance;
  visit_pair(age, latency_s, viewer, [&](const Eigen::Vector2d& shown, double scale) {
    const double most_px = kMostApart_px * scale;
    double nearest_px2 = most_px * most_px;
    for (std::size_t k = 0; k < now.count; ++k)
      nearest_px2 = std::min(nearest_px2, (now.pixels[k] - shown).squaredNorm());
    distance.add(nearest_px2 / (scale * scale));
    return true;
  });
  return distance;
}

/// Where frames show the world later than their stamps, the vehicle's states of the newest are yet to come.
std::size_t LatencyWatch::newest_known(double latency_s, const CalibratedViewer& viewer) const {
  std::size_t age = 0;
  while (age < size_ && !viewer.at(frame(age).stamp, latency_s)) ++age;
  return age;
}

/// Over the newest pairs whose vehicle states are known at that latency, from that age on.
LatencyWatch::Distance LatencyWatch::distance(double latency_s, const CalibratedViewer& viewer,
                                              std::size_t least_age) const {
  Distance sum;
  int pairs = 0;
  for (std::size_t age = least_age; age < size_ && pairs < kMostPairs; ++age) {
    const Distance pair = distance_of_pair(age, latency_s, viewer);
    if (pair.looks == 0) continue;
    sum.add(pair);
    ++pairs;
  }
  return sum;
}

/// How well boxes fit at each of many latencies, and where they do best.
class LatencyWatch::Grid {
 public:
  explicit Grid(double most_px2) : best_px2_(most_px2) { px2_.fill(most_px2); }

  static constexpr int kSize = 2 * kLatencies + 1;
  static double latency_s(int number) { return (number - kLatencies) * kStep_s; }

  void set(int number, double px2) {
    px2_[static_cast<std::size_t>(number)] = px2;
    if (px2 >= best_px2_) return;
    best_px2_ = px2;
    best_ = number;
  }

  /// nullopt where none fits well enough, or another one nearly as well that is not beside it.
  std::optional<double> only_best_s() const {
    if (!best_) return std::nullopt;
    for (int other = 0; other < kSize; ++other) {
      const bool is_beside = std::abs(other - *best_) <= kBeside;
      if (!is_beside && kClearly * px2_[static_cast<std::size_t>(other)] < best_px2_) return std::nullopt;
    }
    return latency_s(*best_);
  }

 private:
  static constexpr int kBeside = 5;
  static constexpr double kClearly = 0.9;

  std::array<double, kSize> px2_;
  double best_px2_;
  std::optional<int> best_;
};

bool LatencyWatch::is_hopeless(const Distance& distance) {
  return distance.looks >= kLeastLooks && distance.mean_px2() >= kHopeless_px2;
}

std::optional<double> LatencyWatch::search(const CalibratedViewer& viewer) const {
  const double present_s = viewer.errors.calibration.latency_s();
  const Distance present = distance(present_s, viewer);
  if (!is_hopeless(present)) return std::nullopt;
  Grid grid(kFarBetter * present.mean_px2());
  for (int number = 0; number < Grid::kSize; ++number) {
    if (std::abs(Grid::latency_s(number) - present_s) < kLeastLatencyChange_s) continue;
    const Distance other = distance(Grid::latency_s(number), viewer);
    if (other.looks >= kLeastLooks && other.gain_px2(present) > kLeastGain_px2)
      grid.set(number, other.mean_px2());
  }
  const auto coarse_s = grid.only_best_s();
  if (!coarse_s || !is_far_better(*coarse_s, present_s, viewer)) return std::nullopt;
  return refined_s(*coarse_s, viewer);
}

/// By the same pairs: those before the newest may be of a straight leg, on which any latency fits.
bool LatencyWatch::is_far_better(double latency_s, double present_s, const CalibratedViewer& viewer) const {
  const std::size_t newest = newest_known(latency_s, viewer);
  const Distance other = distance(latency_s, viewer, newest), present = distance(present_s, viewer, newest);
  return is_hopeless(present) && other.mean_px2() < kFarBetter * present.mean_px2();
}

double LatencyWatch::refined_s(double coarse_s, const CalibratedViewer& viewer) const {
  double best_s = coarse_s;
  double best_px2 = std::numeric_limits<double>::infinity();
  for (int fine = -kFineSteps; fine <= kFineSteps; ++fine) {
    const double latency_s = coarse_s + fine * kStep_s / kFineSteps;
    const double px2 = distance(latency_s, viewer).mean_px2();
    if (px2 >= best_px2) continue;
    best_px2 = px2;
    best_s = latency_s;
  }
  return best_s;
}

}  // namespace geoloc
