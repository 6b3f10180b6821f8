// SPDX-License-Identifier: Apache-2.0
#include "tracking/look_matcher.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "geometry/room.hpp"
#include "tracking/sleep_cycle.hpp"

namespace geoloc {
namespace {

/// What the looks of one frame may differ in where the camera stands: by the drift of the yaw, a little.
constexpr double kReachMargin = 1.1;
/// Objects not known yet that an image shows.
constexpr double kNewPerImage = 1.0;
/// A shaken frame: how much farther its noise reaches, what that costs as an explanation (one frame in
/// twenty, in units of a squared distance), and what each object costs that is missed without it (-2 ln 0.1).
constexpr double kShake = 4.0, kCostOfShake = 6.0, kCostMissed = 4.6;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

using HeightRow = Eigen::Matrix<double, 1, SharedError::kSize>;

/// What the shared errors do to the heights of all tracks.
HeightRow mean_height_sensitivity(const TrackTable& tracks) {
  HeightRow mean = HeightRow::Zero();
  for (const RestingObject& track : tracks) mean += track.sensitivity.row(2);
  if (tracks.size() > 0) mean /= static_cast<double>(tracks.size());
  return mean;
}

/// A look's Jacobian against a track whose height follows the shared errors as the tracks' do in the mean.
SharedError::Row jacobian_at(const Look& look, const HeightRow& height_sensitivity) {
  return look.jacobian + look.observation.slope * height_sensitivity;
}

SharedError::Row mean_jacobian(const std::vector<Look>& looks, const HeightRow& height_sensitivity) {
  SharedError::Row mean = SharedError::Row::Zero();
  for (const Look& look : looks) mean += jacobian_at(look, height_sensitivity);
  mean /= static_cast<double>(looks.size());
  return mean;
}

/// H M, with H the Jacobian of a look by the object (LandmarkObservation): what is up moves along the ray.
template <int Columns>
Eigen::Matrix<double, 2, Columns> along_ray(const Eigen::Matrix<double, kPointSize, Columns>& M,
                                            const Eigen::Vector2d& slope) {
  return M.template topRows<2>() - slope * M.row(2);
}

bool is_older(const RestingObject& object, const RestingObject& other) {
  const Track &a = object.track, &b = other.track;
  return std::make_tuple(a.status == TrackStatus::kConfirmed, a.hits, b.id) >
         std::make_tuple(b.status == TrackStatus::kConfirmed, b.hits, a.id);
}

}  // namespace

LookMatcher::LookMatcher(const JointTrackerConfig& config, int max_detections)
    : config_(config), association_(max_detections, most_awake(config)) {
  take_room(this, config, max_detections);
}

std::size_t LookMatcher::take_room(LookMatcher* self, const JointTrackerConfig& config, int max_detections) {
  Explanation* const explanation = room::part(self, &LookMatcher::explanation_);
  return JointAssociation::take_room(nullptr, max_detections, most_awake(config)) +
         room::reserve(explanation, &Explanation::match_of_look, max_detections) +
         room::reserve(self, &LookMatcher::reach_of_track_, most_awake(config)) +
         room::reserve(self, &LookMatcher::median_scratch_, max_detections);
}

const Explanation& LookMatcher::explain(const std::vector<Look>& looks, const FrameNoise& noise,
                                        TrackTable& tracks) {
  find_explanation(looks, noise, tracks);
  prefer_older_twins(tracks);
  explanation_.common_shift = common_shift(looks, tracks);
  note_evidence(tracks);
  return explanation_;
}

const Explanation& LookMatcher::try_to_explain(const std::vector<Look>& looks, const FrameNoise& noise,
                                               const TrackTable& tracks) {
  find_explanation(looks, noise, tracks);
  explanation_.common_shift = common_shift(looks, tracks);
  explanation_.cost = association_.cost();
  return explanation_;
}

void LookMatcher::find_explanation(const std::vector<Look>& looks, const FrameNoise& noise,
                                   const TrackTable& tracks) {
  associate(looks, noise, 1.0, tracks);
  if (tracks.size() > 0 && looks_alone() > 0) consider_shake(looks, noise, tracks);
}

void LookMatcher::associate(const std::vector<Look>& looks, const FrameNoise& noise, double shake,
                            const TrackTable& tracks) {
  association_.begin(looks.size(), config_.gate, config_.ambiguity);
  for (std::size_t i = 0; i < looks.size(); ++i)
    association_.expect_new(i, kNewPerImage * looks[i].one_per_image);
  add_pairings(looks, noise, shake, tracks);
  explanation_.match_of_look = association_.solve();
}

int LookMatcher::looks_alone() const {
  const auto& matches = explanation_.match_of_look;
  return static_cast<int>(
      std::count_if(matches.begin(), matches.end(), [](const auto& match) { return !match.track; }));
}

/// A frame that is off by more than the noise known so far shows none of the objects where it should. That it
/// was shaken is the better explanation then than new objects beside all of the old ones, which it misses;
/// the noise learns from it.
void LookMatcher::consider_shake(const std::vector<Look>& looks, const FrameNoise& noise,
                                 const TrackTable& tracks) {
  const int calm_alone = looks_alone();
  const double calm_cost = association_.cost();
  associate(looks, noise, kShake, tracks);
  const int more_seen = calm_alone - looks_alone();
  const double shaken_cost = association_.cost() + kCostOfShake - kCostMissed * more_seen;
  if (more_seen <= 0 || !(shaken_cost < calm_cost)) associate(looks, noise, 1.0, tracks);
}

/// The looks of a frame share the camera's place: where it shows a track, and along what slope, any of them
/// tells. Returns what no track exceeds.
LookMatcher::Reach LookMatcher::list_reaches(const Look& any_look, const TrackTable& tracks,
                                             const SharedError::Row& mean_of_looks,
                                             const HeightRow& mean_of_heights) {
  reach_of_track_.clear();
  Reach most{Eigen::Vector2d::Zero(), 0.0, 0.0};
  for (const RestingObject& track : tracks) {
    const Eigen::Vector2d shown = any_look.shown(track.position_in_enu);
    const double slope = any_look.slope_at(shown).norm();
    const double own_m = std::sqrt(track.own_covariance.topLeftCorner<2, 2>().trace()) +
                         slope * std::sqrt(track.own_covariance(2, 2));
    const double shared_m = (track.sensitivity.topRows<2>() - mean_of_looks).norm() +
                            slope * (track.sensitivity.row(2) - mean_of_heights).norm();
    reach_of_track_.push_back({shown, own_m * own_m, shared_m});
    most.own_variance = std::max(most.own_variance, own_m * own_m);
    most.shared_m = std::max(most.shared_m, shared_m);
  }
  return most;
}

/// All tracks that a look may show; those that are farther than the trace of the covariance allows are not
/// looked at closely. What moves the mean height moves a track along its ray, by a share of its distance
/// from the look: (s + a d)^2 <= 2 s^2 + 2 a^2 d^2.
void LookMatcher::add_pairings(const std::vector<Look>& looks, const FrameNoise& noise, double shake,
                               const TrackTable& tracks) {
  if (looks.empty()) return;
  const HeightRow mean_of_heights = mean_height_sensitivity(tracks);
  const SharedError::Row mean_of_looks = mean_jacobian(looks, mean_of_heights);
  const Reach most = list_reaches(looks.front(), tracks, mean_of_looks, mean_of_heights);
  const double frame_variance = (1.0 + shake * shake) * noise.covariance.trace();
  for (std::size_t i = 0; i < looks.size(); ++i) {
    const Look& look = looks[i];
    const double shared_by_look_m = (jacobian_at(look, mean_of_heights) - mean_of_looks).norm();
    const double variance_of_look = look.pixel_noise.trace() + frame_variance;
    const double by_distance = mean_of_heights.norm() / look.camera_height_m;
    const double share = 1.0 - 2.0 * config_.gate * by_distance * by_distance;
    const auto reach_m2 = [&](const Reach& track) {
      const double shared_m = shared_by_look_m + track.shared_m;
      return kReachMargin * config_.gate *
             (variance_of_look + track.own_variance + 2.0 * shared_m * shared_m);
    };
    const double most_m2 = reach_m2(most);
    for (std::size_t k = 0; k < tracks.size(); ++k) {
      const Reach& track = reach_of_track_[k];
      const double distance_m2 = share * (look.position - track.shown).squaredNorm();
      if (!(distance_m2 < most_m2 && distance_m2 < reach_m2(track))) continue;
      Pairing pair = pairing(look, tracks[k], noise, shake);
      pair.look = i;
      pair.track = k;
      association_.add(pair);
    }
  }
}

/// A track seen for a short time only has the noise of its frames whole.
Pairing LookMatcher::pairing(const Look& look, const RestingObject& track, const FrameNoise& noise,
                             double shake) const {
  const double share = noise.share_in_track(track.track.hits);
  Pairing pairing;
  const Eigen::Vector2d shown = look.shown(track.position_in_enu);
  const Eigen::Vector2d slope = look.slope_at(shown);
  pairing.residual = look.position - shown;
  pairing.jacobian = look.jacobian - along_ray(track.sensitivity, slope);
  pairing.jacobian.middleCols<2>(SharedError::kFrame) *= shake;
  const Eigen::Matrix<double, kPointSize, 2> covariance =
      along_ray(track.pixel_covariance, slope).transpose();
  pairing.own_covariance = look.pixel_noise + along_ray(covariance, slope) + share * noise.covariance;
  pairing.penalty = look.detection.class_id == track.track.class_id() ? 0.0 : config_.class_mismatch_cost;
  return pairing;
}

/// A look that may show either of two tracks, which no other look of the frame can show and no frame has
/// shown side by side, shows one object that was begun twice: the look is the older one's, and the younger
/// one dies of being missed. Otherwise both would be in doubt for ever, and learn nothing.
void LookMatcher::prefer_older_twins(const TrackTable& tracks) {
  std::vector<JointAssociation::Match>& matches = explanation_.match_of_look;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i].is_ambiguous) continue;
    if (const Pairing* const oldest = oldest_twin(i, tracks)) matches[i] = association_.match_of(*oldest);
  }
}

/// Among the pairs of this look; none where they are not twins.
const Pairing* LookMatcher::oldest_twin(std::size_t look, const TrackTable& tracks) const {
  const Pairing* oldest = nullptr;
  for (const Pairing& pairing : association_.pairings()) {
    if (pairing.look != look) continue;
    if (association_.looks_at(pairing.track) > 1) return nullptr;
    if (oldest == nullptr || is_older(tracks[pairing.track], tracks[oldest->track])) oldest = &pairing;
  }
  if (oldest == nullptr) return nullptr;
  int twins = 0;
  const Neighbours& neighbours = tracks[oldest->track].neighbours;
  for (const Pairing& pairing : association_.pairings()) {
    if (pairing.look != look || pairing.track == oldest->track) continue;
    const Track& twin = tracks[pairing.track].track;
    if (twin.hits >= kHitsToCompare || neighbours.are_apart(twin.id)) return nullptr;
    ++twins;
  }
  return twins > 0 ? oldest : nullptr;
}

/// Median of the residuals: what all looks of this frame share.
Eigen::Vector2d LookMatcher::common_shift(const std::vector<Look>& looks, const TrackTable& tracks) {
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  for (int axis = 0; axis < 2; ++axis) {
    median_scratch_.clear();
    for (std::size_t i = 0; i < looks.size(); ++i) {
      const auto track = explanation_.match_of_look[i].track;
      if (!track) continue;
      const Eigen::Vector2d shown = looks[i].shown(tracks[*track].position_in_enu);
      median_scratch_.push_back(looks[i].position[axis] - shown[axis]);
    }
    if (median_scratch_.size() >= 2) shift[axis] = median(median_scratch_);
  }
  return shift;
}

void LookMatcher::note_evidence(TrackTable& tracks) const {
  const std::vector<JointAssociation::Match>& matches = explanation_.match_of_look;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i].is_certain()) continue;
    tracks[*matches[i].track].look = i;
    tracks[*matches[i].track].is_seen = true;
  }
  for (const Pairing& pairing : association_.pairings()) {
    if (matches[pairing.look].is_ambiguous) tracks[pairing.track].is_in_doubt = true;
  }
}

}  // namespace geoloc
