// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/flight_camera.hpp"

#include "geoloc/sim/flight/random_stream.hpp"
#include "geoloc/sim/flight/scenario.hpp"

namespace geoloc::sim {
namespace {

constexpr double kExposure_s = 0.004;

}  // namespace

Scene make_run_scene(const std::vector<Eigen::Vector2d>& targets_in_enu, int distractors,
                     std::uint64_t seed) {
  Random random(stream_seed(seed, RandomStream::kScene));
  Scene scene;
  scene.ground = static_cast<GroundStyle>(random.index(kFlightGroundStyleCount));
  scene.ground_seed = seed;
  std::vector<PlacedObject> targets;
  for (const Eigen::Vector2d& position_in_enu : targets_in_enu) {
    PlacedObject target;
    target.position_in_enu = position_in_enu;
    target.heading_rad = random.uniform(-kPi, kPi);
    target.look = static_cast<std::uint32_t>(random.index(1 << 30));
    targets.push_back(target);
  }
  const Eigen::Vector2d half_extent{kAreaHalfEast_m, kAreaHalfNorth_m};
  scene.objects = make_distractors(distractors, {-half_extent, half_extent}, targets, seed);
  scene.objects.insert(scene.objects.end(), targets.begin(), targets.end());
  return scene;
}

FlightCamera::FlightCamera(const Flight& flight, const RunSettings& settings, const FlightClock& clock,
                           const Scene& scene)
    : flight_(flight),
      clock_(clock),
      errors_(settings.errors),
      true_camera_(make_true_camera(settings, run_seed(settings, flight))),
      model_(true_camera_.intrinsics),
      renderer_(true_camera_.intrinsics, scene),
      timing_(stream_seed(run_seed(settings, flight), RandomStream::kTiming)) {}

FlightCamera::View FlightCamera::draw_view(HostTime stamp) {
  const double delay_s = errors_.latency_s + errors_.latency_jitter_s * timing_.normal();
  const HostTime exposed_at = stamp - from_seconds(delay_s / clock_.speed());
  const Duration half_exposure = from_seconds(0.5 * kExposure_s / clock_.speed());
  const double zoom = flight_.zoom_at(clock_.flight_time(exposed_at));
  const Eigen::Vector2d blur_px =
      image_motion_px(zoomed(model_, zoom), enu_from_camera(exposed_at - half_exposure),
                      enu_from_camera(exposed_at + half_exposure));
  return {exposed_at, enu_from_camera(exposed_at), blur_px, zoom};
}

void FlightCamera::render(const View& view, cv::Mat& bgr) {
  if (flight_.zoom) renderer_.look_through(zoomed(model_, view.zoom));
  renderer_.render(view.enu_from_camera, view.blur_px, bgr);
}

Rigid3d FlightCamera::enu_from_camera(HostTime time) const {
  return flight_.enu_from_camera(clock_.flight_time(time), true_camera_.carrier_from_camera).value();
}

}  // namespace geoloc::sim
