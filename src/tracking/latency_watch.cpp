// SPDX-License-Identifier: Apache-2.0
#include "tracking/latency_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace geoloc {
namespace {

/// Frames that are compared lie so far apart: long enough to turn, short enough to show the same.
constexpr double kLeastApart_s = 0.5, kMostApart_s = 1.2;
/// A box farther from where it should be is another object's, or missed.
constexpr double kMostApart_px = 15.0, kUsualWidth_px = 1280.0;
/// Latencies that are tried.
constexpr int kLatencies = 34, kFineSteps = 5;
constexpr double kStep_s = 0.1;
/// One that is nearer is what the solver finds by itself.
constexpr double kLeastChange_s = 0.15;
/// As many pairs of frames are judged by at most, and so many boxes at least.
constexpr int kMostPairs = 15, kLeastLooks = 12, kLeastKnown = 6;
/// Boxes that lie this near where they should need no other latency [px^2].
constexpr double kGoodFit_px2 = 16.0;
/// Known objects are not where they should be: most of them are farther than that [px^2].
constexpr double kMostFromKnown_px2 = 110.0;
/// Chance alone, by boxes that are missed, makes some latency better than another; not by so much in all.
constexpr double kLeastGain_px2 = 1000.0;
/// Another latency must explain the boxes so much better.
constexpr double kFarBetter = 0.35;
/// At a flight's start nothing is known to compare with: the present one must explain next to nothing, and
/// the other one nearly all.
constexpr double kHopeless_px2 = 80.0, kFarBetterAtStart = 0.25;
/// A pair of frames does not fit where boxes lie so much farther off than usual.
constexpr double kMisfit = 3.0;
constexpr int kMisfitsToSearch = 4, kMostSearches = 60;
/// Known objects lie where they should; so many looks at them in a row end a doubt.
constexpr double kInPlace_px2 = 60.0;
constexpr int kLooksToBelieve = 8;
constexpr Duration kLongestDoubt = std::chrono::seconds{60};

/// A flight's first pairs of frames after which a search is due.
constexpr std::array<int, 12> kAtTheStart{12, 20, 30, 40, 50, 60, 80, 100, 120, 150, 180, 220};

/// Pixels of a larger image, or of a vehicle whose attitude is noisier, count for as much less.
double scale_of(const CalibratedViewer& viewer, const CameraIntrinsics& image) {
  constexpr double kSigmas = 5.0;
  const double size = image.width_px / kUsualWidth_px;
  if (viewer.calibration_is_void) return size;
  const double noise_px = std::sqrt(viewer.errors.noise.attitude_variance_rad2()) * image.fx_px / size;
  return size * std::max(1.0, kSigmas * noise_px / kMostApart_px);
}

}  // namespace

LatencyWatch::LatencyWatch() : frames_(kFrames) {}

bool LatencyWatch::is_at_start() const {
  return pairs_ <= kAtTheStart.back();
}

void LatencyWatch::begin_anew() {
  forget();
  pairs_ = 0;
  usual_px2_ = 0.0;
}

void LatencyWatch::forget() {
  size_ = 0;
  misfits_ = 0;
  pairs_since_misfit_ = 0;
  doubtful_since_.reset();
  looks_in_place_ = 0;
}

std::optional<LatencyWatch::Change> LatencyWatch::observe(FrameStamp stamp,
                                                          const std::vector<LocatedDetection>& detections,
                                                          const CalibratedViewer& viewer,
                                                          const KnownPlaces& known) {
  if (detections.empty()) return std::nullopt;
  Frame& newest = frames_[next_];
  next_ = (next_ + 1) % kFrames;
  size_ = std::min(size_ + 1, kFrames);
  newest.stamp = stamp;
  newest.count = std::min(detections.size(), kMostPixels);
  for (std::size_t i = 0; i < newest.count; ++i) newest.pixels[i] = detections[i].detection.box.centre();
  const Scene scene{viewer, known};
  const Fit pair = fit_of_pair(0, viewer.errors.calibration.latency_s(), scene);
  if (pair.from_before.looks == 0 || !is_due(pair)) return std::nullopt;
  const auto latency_s = search(scene);
  if (!latency_s) return std::nullopt;
  HostTime since = time_of_change(viewer.errors.calibration.latency_s(), *latency_s, scene);
  if (doubtful_since_) since = std::min(since, *doubtful_since_);
  return Change{*latency_s, since};
}

/// Whether the newest pair of frames gives reason to search.
bool LatencyWatch::is_due(const Fit& newest) {
  constexpr double kForgetting = 0.02;
  ++pairs_;
  const double from_before_px2 = newest.from_before.mean_px2();
  const bool is_misfit = from_before_px2 > kGoodFit_px2 + kMisfit * usual_px2_ ||
                         newest.from_known.mean_px2() > kMostFromKnown_px2;
  if (is_at_start()) {
    usual_px2_ += (from_before_px2 - usual_px2_) / pairs_;
    return std::find(kAtTheStart.begin(), kAtTheStart.end(), pairs_) != kAtTheStart.end();
  }
  const double rate = kForgetting;
  if (!is_misfit) usual_px2_ += rate * (from_before_px2 - usual_px2_);
  weigh_doubt(newest);
  if (is_misfit) {
    if (misfits_++ == 0) misfit_since_ = frame(0).stamp.captured_at_host;
    if (misfits_ == kMisfitsToSearch && !doubtful_since_) doubtful_since_ = misfit_since_;
    had_fit_between_ = false;
  } else if (misfits_ > 0 && !had_fit_between_) {
    had_fit_between_ = true;
  } else {
    misfits_ = 0;
  }
  pairs_since_misfit_ = misfits_ == 0 ? 0 : pairs_since_misfit_ + 1;
  return misfits_ >= kMisfitsToSearch && pairs_since_misfit_ <= kMostSearches;
}

/// Objects known from before that lie where they should end a doubt; so does time.
void LatencyWatch::weigh_doubt(const Fit& newest) {
  if (!doubtful_since_) return;
  const Distance& known = newest.from_known;
  if (known.looks > 0) looks_in_place_ = known.mean_px2() < kInPlace_px2 ? looks_in_place_ + known.looks : 0;
  const Duration lasts = frame(0).stamp.captured_at_host - *doubtful_since_;
  if (looks_in_place_ < kLooksToBelieve && lasts < kLongestDoubt && lasts >= Duration::zero()) return;
  doubtful_since_.reset();
  looks_in_place_ = 0;
}

/// The frame that a frame is compared with, by ages.
std::optional<std::size_t> LatencyWatch::partner(std::size_t age) const {
  const HostTime stamp = frame(age).stamp.captured_at_host;
  for (std::size_t other = age + 1; other < size_; ++other) {
    const double apart_s = seconds(stamp - frame(other).stamp.captured_at_host);
    if (apart_s > kMostApart_s) return std::nullopt;
    if (apart_s >= kLeastApart_s) return other;
  }
  return std::nullopt;
}

LatencyWatch::Fit LatencyWatch::fit_of_pair(std::size_t age, double latency_s, const Scene& scene) const {
  const auto before_age = partner(age);
  if (!before_age) return {};
  const Frame& now = frame(age);
  const Frame& before = frame(*before_age);
  const Projector& projector = scene.viewer.projector;
  const auto view_before = scene.viewer.at(before.stamp, latency_s);
  const auto view_now = scene.viewer.at(now.stamp, latency_s);
  if (!view_before || !view_now) return {};
  const CameraIntrinsics& image = projector.camera().intrinsics();
  const double scale = scale_of(scene.viewer, image);
  const double most_px = kMostApart_px * scale;
  const auto measure = [&](const Eigen::Vector3d& place_in_enu, Distance& distance) {
    const auto shown = projector.reproject(place_in_enu, view_now->enu_from_camera);
    const double margin_px = 2.0 * most_px;
    const bool is_inside = shown && shown->x() > margin_px && shown->x() < image.width_px - margin_px &&
                           shown->y() > margin_px && shown->y() < image.height_px - margin_px;
    if (!is_inside) return;
    double nearest_px2 = most_px * most_px;
    for (std::size_t k = 0; k < now.count; ++k)
      nearest_px2 = std::min(nearest_px2, (now.pixels[k] - *shown).squaredNorm());
    distance.add(nearest_px2 / (scale * scale));
  };
  Fit fit;
  const double ground_m = projector.config().ground_height_above_home_m;
  for (std::size_t i = 0; i < before.count; ++i) {
    const auto place = projector.project(before.pixels[i], view_before->enu_from_camera);
    if (!place) continue;
    const Eigen::Vector2d& on_ground = place->position_in_enu;
    measure({on_ground.x(), on_ground.y(), ground_m}, fit.from_before);
  }
  for (std::size_t i = 0; i < scene.known.count; ++i) measure(scene.known.shown_in_enu[i], fit.from_known);
  return fit;
}

/// Over the newest pairs whose vehicle states are known at that latency.
LatencyWatch::Fit LatencyWatch::fit(double latency_s, const Scene& scene) const {
  Fit sum;
  int pairs = 0;
  const bool is_misfit = misfits_ > 0;
  const int stride = is_misfit ? 1 + pairs_since_misfit_ / kMostPairs : 1;
  for (std::size_t age = 0; age < size_ && pairs < kMostPairs; age += stride) {
    if (is_misfit && frame(age).stamp.captured_at_host < misfit_since_) break;
    const Fit pair = fit_of_pair(age, latency_s, scene);
    if (pair.from_before.looks + pair.from_known.looks == 0) continue;
    sum.from_before.add(pair.from_before);
    sum.from_known.add(pair.from_known);
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

bool LatencyWatch::is_certain(const Distance& other, const Distance& present) {
  constexpr double kBeyondDoubt = 0.25, kGainBeyondDoubt_px2 = 1200.0;
  return other.mean_px2() < kBeyondDoubt * present.mean_px2() &&
         gain_px2(other, present) > kGainBeyondDoubt_px2;
}

/// By how much boxes lie better, in all.
double LatencyWatch::gain_px2(const Distance& other, const Distance& present) {
  return (present.mean_px2() - other.mean_px2()) * std::min(other.looks, present.looks);
}

/// A position that wanders shifts known objects, too; not so far.
double LatencyWatch::least_change_by_known(const Scene& scene) const {
  constexpr double kSigmas = 6.0, kLeastSpeed_m_s = 0.1;
  const SharedErrorEstimate& errors = scene.viewer.errors;
  const auto view = scene.viewer.at(frame(0).stamp, errors.calibration.latency_s());
  if (!view) return std::numeric_limits<double>::infinity();
  const double wandering_m = errors.drift.position_scale() * errors.accuracy.wandering_sigma_m();
  const double tilting_m = std::sqrt(errors.noise.attitude_variance_rad2()) *
                           std::abs(view->enu_from_camera.translation.z() -
                                    scene.viewer.projector.config().ground_height_above_home_m);
  return kSigmas * std::hypot(wandering_m, tilting_m) /
         std::max(kLeastSpeed_m_s, view->vehicle.velocity_in_enu.norm());
}

/// The latency by which boxes lie best where earlier frames tell, where that is far better than at present
/// and as good as usual; else by which they lie best where known objects are.
std::optional<double> LatencyWatch::search(const Scene& scene) const {
  const double present_s = scene.viewer.errors.calibration.latency_s();
  const Fit present = fit(present_s, scene);
  const double usual_px2 = misfits_ > 0 ? kGoodFit_px2 + usual_px2_ : std::numeric_limits<double>::infinity();
  const double before_px2 = present.from_before.mean_px2();
  const bool tells_before = present.from_before.looks >= kLeastLooks &&
                            before_px2 >= (is_at_start() ? kHopeless_px2 : kGoodFit_px2);
  const bool tells_known = present.from_known.looks >= kLeastKnown;
  if (!tells_before && !tells_known) return std::nullopt;
  const double least_change_by_known_s = least_change_by_known(scene);
  Grid by_before(std::min(usual_px2, (is_at_start() ? kFarBetterAtStart : kFarBetter) * before_px2));
  Grid by_known(std::min(kMostFromKnown_px2, kFarBetter * present.from_known.mean_px2()));
  for (int number = 0; number < Grid::kSize; ++number) {
    if (std::abs(Grid::latency_s(number) - present_s) < kLeastChange_s) continue;
    const Fit other = fit(Grid::latency_s(number), scene);
    if (tells_before && other.from_before.looks >= kLeastLooks &&
        gain_px2(other.from_before, present.from_before) > kLeastGain_px2)
      by_before.set(number, other.from_before.mean_px2());
    if (std::abs(Grid::latency_s(number) - present_s) < least_change_by_known_s) continue;
    const bool contradicts = other.from_before.mean_px2() > before_px2 + kGoodFit_px2;
    if (tells_known && other.from_known.looks >= kLeastKnown && !contradicts &&
        gain_px2(other.from_known, present.from_known) > kLeastGain_px2)
      by_known.set(number, other.from_known.mean_px2());
  }
  const auto coarse_before_s = by_before.only_best_s(), coarse_known_s = by_known.only_best_s();
  if (!coarse_before_s && !coarse_known_s) return std::nullopt;
  // While the vehicle's states of the earliest candidates are still to come, one of two witnesses must be
  // beyond doubt, or both agree.
  const bool is_complete = fit(Grid::latency_s(0), scene).from_before.looks >= kLeastLooks;
  const Fit found = fit(coarse_before_s ? *coarse_before_s : *coarse_known_s, scene);
  const bool is_beyond_doubt = coarse_before_s ? is_certain(found.from_before, present.from_before)
                                               : is_certain(found.from_known, present.from_known);
  const bool agree =
      coarse_before_s && coarse_known_s && std::abs(*coarse_before_s - *coarse_known_s) < kLeastChange_s;
  if (!is_complete && !is_at_start() && !agree && !is_beyond_doubt) return std::nullopt;
  const Distance Fit::*const judged = coarse_before_s ? &Fit::from_before : &Fit::from_known;
  double best_s = coarse_before_s ? *coarse_before_s : *coarse_known_s;
  double best_px2 = std::numeric_limits<double>::infinity();
  const double coarse_s = best_s;
  for (int fine = -kFineSteps; fine <= kFineSteps; ++fine) {
    const double latency_s = coarse_s + fine * kStep_s / kFineSteps;
    const double px2 = (fit(latency_s, scene).*judged).mean_px2();
    if (px2 >= best_px2) continue;
    best_px2 = px2;
    best_s = latency_s;
  }
  return best_s;
}

/// The frame from which on the frames speak for the new latency, all together: of those that do about as
/// well, the earliest, since the others speak for neither.
HostTime LatencyWatch::time_of_change(double latency_before_s, double latency_s, const Scene& scene) const {
  double sum_px2 = 0.0, best_px2 = 0.0;
  HostTime since = frame(0).stamp.captured_at_host;
  for (std::size_t age = 0; age < size_; ++age) {
    const Fit before = fit_of_pair(age, latency_before_s, scene), after = fit_of_pair(age, latency_s, scene);
    if (before.from_before.looks == 0 || after.from_before.looks == 0) continue;
    sum_px2 += before.from_before.sum_px2 - after.from_before.sum_px2 + before.from_known.sum_px2 -
               after.from_known.sum_px2;
    best_px2 = std::max(best_px2, sum_px2);
    if (sum_px2 > best_px2 - kGoodFit_px2) since = frame(age).stamp.captured_at_host;
  }
  return since;
}

}  // namespace geoloc
