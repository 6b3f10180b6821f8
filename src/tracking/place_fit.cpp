// SPDX-License-Identifier: Apache-2.0
#include "tracking/place_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geoloc/geometry/angles.hpp"

namespace geoloc {
namespace {

/// A box farther from where an object should be does not show it.
constexpr double kSigmas = 4.0, kLeastRadius_px = 10.0;
/// An object less certain than that, an eighth of the image's height, tells nothing.
constexpr double kMostRadius_px = 90.0;
/// Objects nearer to the edge may be cut.
constexpr double kEdge_px = 30.0;
/// Places are looked for within so many camera heights.
constexpr double kReach = 1.5;
/// Boxes so near to each other are of one cluster: chance finds one as often as there are others around.
constexpr double kAround_px = 150.0;
/// Another latency is told from this one where it shows objects so many radii aside, this much later.
constexpr double kRadiiToTell = 1.5, kOther_s = 0.3, kFarOther_s = 1.0;
constexpr double kLeastDistance_m = 0.5;

}  // namespace

double PlaceFit::size() const {
  return viewer_.image_scale();
}

std::optional<Eigen::Vector2d> PlaceFit::shown(const Eigen::Vector3d& place, const FrameView& view) const {
  const Eigen::Vector3d to = place - view.enu_from_camera.translation;
  if (to.head<2>().norm() > -kReach * to.z()) return std::nullopt;
  return viewer_.projector.reproject(place, view);
}

double PlaceFit::radius_px(const WatchedPlace& place, const FrameView& view, double wandering_m) const {
  const double focal_px = viewer_.projector.focal_px(view).x();
  const Eigen::Vector3d to = place.shown_in_enu - view.enu_from_camera.translation;
  const double slope = to.head<2>().norm() / std::max(kLeastDistance_m, -to.z());
  const Eigen::Vector3d sigmas_m(place.sigma_m, place.wandering * wandering_m, slope * place.sigma_up_m);
  const double px_per_m = focal_px / std::max(kLeastDistance_m, to.norm());
  const double sigma_px =
      Eigen::Vector3d(expected_.sigma_px, focal_px * expected_.sigma_attitude_rad, px_per_m * sigmas_m.norm())
          .norm();
  return std::max(kLeastRadius_px * size(), kSigmas * sigma_px);
}

bool PlaceFit::is_inside(const Eigen::Vector2d& pixel, double radius_px) const {
  return viewer_.projector.camera().contains(pixel, kEdge_px + radius_px);
}

std::optional<PlaceFit::Tally> PlaceFit::tally(const FrameBoxes& frame, double latency_s, double step_s,
                                               const std::vector<WatchedPlace>& places,
                                               const Eigen::Vector2d* shift_m, SeenPlaces* seen) const {
  const auto view = viewer_.at(frame.stamp, latency_s);
  if (!view) return std::nullopt;
  return tally(frame, *view, step_s, {places.data(), places.size()}, shift_m, seen);
}

std::optional<PlaceFit::Tally> PlaceFit::tally_of_pair(const FrameBoxes& before, const FrameBoxes& now,
                                                       const LatencyOfPair& latency, double step_s) const {
  const auto view_before = viewer_.at(before.stamp, latency.before_s);
  const auto view_now = viewer_.at(now.stamp, latency.now_s);
  if (!view_before || !view_now) return std::nullopt;
  const double ground_m = viewer_.projector.config().ground_height_above_home_m;
  std::array<WatchedPlace, FrameBoxes::kMost> places;
  std::size_t count = 0;
  for (std::size_t k = 0; k < before.count; ++k) {
    const auto fix = viewer_.projector.project(before.pixels[k], *view_before);
    if (!fix) continue;
    const Eigen::Vector2d& on_ground = fix->position_in_enu;
    places[count++] = {{on_ground.x(), on_ground.y(), ground_m}, 0.0, 0.0, 0.0, true};
  }
  return tally(now, *view_now, step_s, {places.data(), count}, nullptr, nullptr);
}

/// Where a shift is stated, the wandering is in it and no noise any more.
PlaceFit::Tally PlaceFit::tally(const FrameBoxes& frame, const FrameView& view, double step_s, Range places,
                                const Eigen::Vector2d* shift_m, SeenPlaces* seen) const {
  const Projector& projector = viewer_.projector;
  const double height_m =
      view.enu_from_camera.translation.z() - projector.config().ground_height_above_home_m;
  const double moved_m = 0.5 * step_s * view.vehicle.velocity_in_enu.norm();
  const double blur_px = moved_m * projector.focal_px(view).x() / std::max(1.0, height_m);
  const double if_missed = std::log(1.0 - found_in(frame));
  Tally tally;
  std::bitset<FrameBoxes::kMost> taken;
  for (std::size_t i = 0; i < places.count; ++i) {
    const WatchedPlace& place = places.begin[i];
    if (!place.is_known) continue;
    Eigen::Vector3d at = place.shown_in_enu;
    if (shift_m != nullptr) at.head<2>() += place.wandering * *shift_m;
    const auto pixel = shown(at, view);
    if (!pixel) continue;
    const double radius = radius_px(place, view, shift_m != nullptr ? 0.0 : expected_.wandering_m);
    if (radius > kMostRadius_px * size() || !is_inside(*pixel, radius)) continue;
    const double variance_px2 = std::pow(radius / kSigmas, 2) + blur_px * blur_px / 3.0;
    const double if_seen = likelihood_of(*pixel, variance_px2, frame, taken);
    const bool is_seen = if_seen > if_missed;
    ++(is_seen ? tally.seen : tally.missed);
    tally.likelihood += std::max(if_seen, if_missed);
    if (is_seen && seen != nullptr) seen->set(i % seen->size());
  }
  tally.unexplained = frame.count - taken.count();
  return tally;
}

/// The likelihood of the nearest box that shows no other place; the box is taken where it is likelier than a
/// miss.
double PlaceFit::likelihood_of(const Eigen::Vector2d& shown, double variance_px2, const FrameBoxes& frame,
                               std::bitset<FrameBoxes::kMost>& taken) const {
  const double around_px2 = std::pow(kAround_px * size(), 2);
  double nearest_px2 = std::numeric_limits<double>::infinity();
  std::size_t nearest = 0;
  int around = 0;
  for (std::size_t k = 0; k < frame.count; ++k) {
    const double px2 = (frame.pixels[k] - shown).squaredNorm();
    if (px2 < around_px2) ++around;
    if (taken[k] || px2 >= nearest_px2) continue;
    nearest_px2 = px2;
    nearest = k;
  }
  if (!std::isfinite(nearest_px2)) return nearest_px2 * -1.0;
  const double chance_per_px2 = std::max(1, around) / (kPi * around_px2);
  const double density_per_px2 = found_in(frame) / (2.0 * kPi * variance_px2);
  const double likelihood = std::log(density_per_px2 / chance_per_px2) - 0.5 * nearest_px2 / variance_px2;
  if (likelihood > std::log(1.0 - found_in(frame))) taken.set(nearest);
  return likelihood;
}

int PlaceFit::strange_boxes(const FrameBoxes& frame, double latency_s,
                            const std::vector<WatchedPlace>& places) const {
  const auto view = viewer_.at(frame.stamp, latency_s);
  if (!view) return 0;
  std::bitset<FrameBoxes::kMost> explained;
  for (const WatchedPlace& place : places) {
    const auto pixel = shown(place.shown_in_enu, *view);
    if (!pixel) continue;
    const double radius = radius_px(place, *view, expected_.wandering_m);
    for (std::size_t k = 0; k < frame.count; ++k)
      explained[k] = explained[k] || (frame.pixels[k] - *pixel).squaredNorm() < radius * radius;
  }
  return static_cast<int>(frame.count - explained.count());
}

bool PlaceFit::tells_latency(const FrameBoxes& frame, double latency_s,
                             const std::vector<WatchedPlace>& places) const {
  const auto is_seen_at = [&](const Eigen::Vector2d& pixel, double radius) {
    const auto end = frame.pixels.begin() + static_cast<std::ptrdiff_t>(frame.count);
    return std::any_of(frame.pixels.begin(), end,
                       [&](const auto& box) { return (box - pixel).squaredNorm() < radius * radius; });
  };
  return any_that_moves(frame, latency_s, kOther_s, places, is_seen_at);
}

bool PlaceFit::could_tell_latency(const FrameBoxes& frame, double latency_s,
                                  const std::vector<WatchedPlace>& places) const {
  return any_that_moves(frame, latency_s, kFarOther_s, places,
                        [](const Eigen::Vector2d&, double) { return true; });
}

/// Whether a place that is shown counts, and another latency would show it elsewhere.
template <typename Counts>
bool PlaceFit::any_that_moves(const FrameBoxes& frame, double latency_s, double other_by_s,
                              const std::vector<WatchedPlace>& places, const Counts& counts) const {
  const auto view = viewer_.at(frame.stamp, latency_s);
  const auto other_view = viewer_.at(frame.stamp, latency_s + other_by_s);
  if (!view || !other_view) return false;
  return std::any_of(places.begin(), places.end(), [&](const WatchedPlace& place) {
    const auto pixel = place.is_known ? shown(place.shown_in_enu, *view) : std::nullopt;
    if (!pixel) return false;
    const double radius = radius_px(place, *view, expected_.wandering_m);
    if (radius > kMostRadius_px * size() || !counts(*pixel, radius)) return false;
    const auto other = viewer_.projector.reproject(place.shown_in_enu, *other_view);
    return !other || (*other - *pixel).norm() > kRadiiToTell * radius;
  });
}

}  // namespace geoloc
