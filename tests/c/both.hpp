// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "geoloc/geoloc.h"
#include "geoloc/geoloc.hpp"

namespace geoloc {

inline std::int64_t ns(VehicleTime time) {
  return time.time_since_epoch().count();
}

inline geoloc_mount to_c(const CameraMount& mount) {
  return {mount.roll_deg,
          mount.pitch_deg,
          mount.yaw_deg,
          mount.x_m,
          mount.y_m,
          mount.z_m,
          static_cast<std::int32_t>(mount.kind)};
}

/// The estimator twice, each time told the same.
class Both {
 public:
  explicit Both(const GeolocatorConfig& config) : cpp_(config) {
    const std::unique_ptr<geoloc_config, decltype(&geoloc_config_destroy)> same(geoloc_config_create(),
                                                                                &geoloc_config_destroy);
    const CameraIntrinsics& lens = config.camera.intrinsics;
    geoloc_camera camera{lens.width_px, lens.height_px, lens.fx_px, lens.fy_px,
                         lens.cx_px,    lens.cy_px,     {},         to_c(config.camera.mount)};
    std::copy(lens.distortion.begin(), lens.distortion.end(), camera.distortion);
    EXPECT_EQ(geoloc_config_set_camera(same.get(), &camera), GEOLOC_OK);
    const char* method = config.method == Method::kPaper ? "paper" : "joint";
    EXPECT_EQ(geoloc_config_set_text(same.get(), "method", method), GEOLOC_OK);
    const std::vector<double> moving(config.joint.moving.classes.begin(), config.joint.moving.classes.end());
    EXPECT_EQ(geoloc_config_set_numbers(same.get(), "joint.moving.classes", moving.data(), moving.size()),
              GEOLOC_OK);
    EXPECT_EQ(geoloc_create(same.get(), &c_), GEOLOC_OK) << geoloc_last_error();
  }
  ~Both() { geoloc_destroy(c_); }
  Both(const Both&) = delete;
  Both& operator=(const Both&) = delete;

  void add(const AttitudeSample& sample) {
    cpp_.add(sample);
    geoloc_attitude same{
        ns(sample.time), sample.angles.roll_rad, sample.angles.pitch_rad, sample.angles.yaw_rad, {}, 0};
    if (sample.rates_in_body_radps) {
      same.has_rates = 1;
      std::copy_n(sample.rates_in_body_radps->data(), 3, same.rates_in_body_radps);
    }
    EXPECT_EQ(geoloc_add_attitude(c_, &same), GEOLOC_OK) << geoloc_last_error();
  }

  void add(const PositionSample& sample) {
    cpp_.add(sample);
    geoloc_position same{};
    same.time_ns = ns(sample.time);
    same.latitude_deg = sample.position.latitude_deg;
    same.longitude_deg = sample.position.longitude_deg;
    same.height_above_home_m = sample.height_above_home_m;
    same.sigma_horizontal_m = sample.sigma_horizontal_m.value_or(0.0);
    same.height_msl_m = sample.height_msl_m.value_or(0.0);
    same.has_height_msl = sample.height_msl_m ? 1 : 0;
    if (sample.velocity_in_enu) {
      same.has_velocity = 1;
      std::copy_n(sample.velocity_in_enu->data(), 3, same.velocity_in_enu_mps);
    }
    EXPECT_EQ(geoloc_add_position(c_, &same), GEOLOC_OK) << geoloc_last_error();
  }

  void add(const RangeSample& sample) {
    cpp_.add(sample);
    const geoloc_range same{ns(sample.time), sample.distance_m};
    EXPECT_EQ(geoloc_add_range(c_, &same), GEOLOC_OK) << geoloc_last_error();
  }

  void add(const GimbalSample& sample) {
    cpp_.add(sample);
    const Eigen::Quaterniond& q = sample.level_from_gimbal;
    const geoloc_gimbal same{ns(sample.time),
                             {q.w(), q.x(), q.y(), q.z()},
                             static_cast<std::int32_t>(sample.yaw),
                             static_cast<std::uint8_t>(sample.holds_direction ? 1 : 0),
                             static_cast<std::uint8_t>(sample.holds_direction.value_or(false) ? 1 : 0)};
    EXPECT_EQ(geoloc_add_gimbal(c_, &same), GEOLOC_OK) << geoloc_last_error();
  }

  void add(const FieldOfViewSample& sample) {
    cpp_.add(sample);
    const geoloc_field_of_view same{ns(sample.time), sample.horizontal_rad.value_or(0.0),
                                    sample.vertical_rad.value_or(0.0)};
    EXPECT_EQ(geoloc_add_field_of_view(c_, &same), GEOLOC_OK) << geoloc_last_error();
  }

  void add(const FrameDetections& frame) {
    const auto gone = cpp_.add(frame);
    std::vector<geoloc_detection> boxes;
    for (const Detection& detection : frame.detections) {
      const Box& box = detection.box;
      boxes.push_back({box.x, box.y, box.width, box.height, detection.confidence, detection.class_id,
                       detection.sigma_px});
    }
    geoloc_frame same{};
    same.captured_at_ns = ns(frame.captured_at);
    same.captured_at_utc_ns = frame.captured_at_host.time_since_epoch().count();
    same.time_sigma_s = frame.time_sigma_s;
    same.detections = boxes.data();
    same.detection_count = boxes.size();
    geoloc_outcome given_up{};
    EXPECT_EQ(geoloc_add_frame(c_, &same, &given_up), gone ? GEOLOC_FRAME_GIVEN_UP : GEOLOC_OK);
    if (gone) {
      EXPECT_EQ(given_up.captured_at_ns, ns(gone->captured_at));
      EXPECT_EQ(given_up.fate, GEOLOC_NO_ROOM);
    }
  }

  void process() {
    while (true) {
      const auto processed = cpp_.process_next();
      geoloc_outcome same{};
      ASSERT_EQ(geoloc_process_next(c_, GEOLOC_WAIT_FOR_TELEMETRY, &same),
                processed ? GEOLOC_OK : GEOLOC_NOTHING);
      if (!processed) return;
      EXPECT_EQ(same.captured_at_ns, ns(processed->captured_at));
      EXPECT_EQ(same.fate, static_cast<int>(processed->fate));
      expect_same_fixes();
    }
  }

  void finish() {
    cpp_.finish();
    EXPECT_EQ(geoloc_finish(c_), GEOLOC_OK);
  }

  void expect_same_fixes() {
    std::size_t count = 0;
    std::vector<geoloc_fix> fixes(cpp_.located().size());
    ASSERT_EQ(geoloc_fixes(c_, fixes.data(), fixes.size(), &count), GEOLOC_OK);
    ASSERT_EQ(count, fixes.size());
    for (std::size_t i = 0; i < count; ++i) {
      const LocatedDetection& located = cpp_.located()[i];
      EXPECT_EQ(fixes[i].east_m, located.fix.position_in_enu.x());
      EXPECT_EQ(fixes[i].north_m, located.fix.position_in_enu.y());
      EXPECT_EQ(fixes[i].range_m, located.fix.range_m);
      EXPECT_EQ(fixes[i].ground_from_pixel_mppx[1], located.fix.ground_from_pixel(0, 1));
      EXPECT_EQ(fixes[i].detection.x_px, located.detection.box.x);
    }
  }

  /// How many objects there are.
  std::size_t expect_same_objects() {
    std::size_t count = 0;
    std::vector<geoloc_object> objects(cpp_.tracks().size() + 1);
    EXPECT_EQ(geoloc_objects(c_, objects.data(), objects.size(), &count), GEOLOC_OK);
    EXPECT_EQ(count, cpp_.tracks().size());
    for (std::size_t i = 0; i < std::min(count, cpp_.tracks().size()); ++i)
      expect_same(objects[i], cpp_.tracks()[i]);
    return count;
  }

  void expect_same(const geoloc_object& object, const Track& track) const {
    const Geodetic place = cpp_.local_frame()->to_geodetic(track.position_in_enu.mean);
    EXPECT_EQ(object.id, track.id);
    EXPECT_EQ(object.latitude_deg, place.latitude_deg);
    EXPECT_EQ(object.longitude_deg, place.longitude_deg);
    EXPECT_EQ(object.east_m, track.position_in_enu.mean.x());
    EXPECT_EQ(object.north_m, track.position_in_enu.mean.y());
    EXPECT_EQ(object.covariance_m2[0], track.position_in_enu.covariance(0, 0));
    EXPECT_EQ(object.covariance_m2[1], track.position_in_enu.covariance(0, 1));
    EXPECT_EQ(object.covariance_m2[2], track.position_in_enu.covariance(1, 1));
    EXPECT_EQ(object.has_height != 0, track.height.has_value());
    if (track.height) {
      EXPECT_EQ(object.height_above_home_m, track.height->above_home_m);
      EXPECT_EQ(object.sigma_height_m, track.height->sigma_m);
    }
    EXPECT_EQ(object.has_velocity != 0, track.velocity_in_enu.has_value());
    if (track.velocity_in_enu) {
      EXPECT_EQ(object.velocity_in_enu_mps[0], track.velocity_in_enu->mean.x());
      EXPECT_EQ(object.velocity_covariance_m2ps2[2], track.velocity_in_enu->covariance(1, 1));
    }
    EXPECT_EQ(object.confidence, track.confidence());
    EXPECT_EQ(object.class_id, track.class_id());
    EXPECT_EQ(object.hits, track.hits);
    EXPECT_EQ(object.is_confirmed != 0, track.status == TrackStatus::kConfirmed);
    EXPECT_EQ(object.first_seen_utc_ns, track.first_seen.time_since_epoch().count());
    EXPECT_EQ(object.last_seen_utc_ns, track.last_seen.time_since_epoch().count());
  }

  void expect_same_calibration() {
    const auto learnt = cpp_.calibration();
    geoloc_calibration same{};
    ASSERT_EQ(geoloc_calibration_of(c_, &same), learnt ? GEOLOC_OK : GEOLOC_NOTHING);
    if (!learnt) return;
    EXPECT_EQ(same.latency_s, learnt->latency_s());
    EXPECT_EQ(same.sigma_latency_s, learnt->sigma(CalibrationIndex::kLatency));
    EXPECT_EQ(same.boresight_rad[2], learnt->boresight_rad().z());
    EXPECT_EQ(same.height_m, learnt->height_m());
    EXPECT_EQ(same.offset_m[1], learnt->offset_m().y());
    EXPECT_EQ(same.focal_ratio, learnt->focal_ratio());
  }

  void expect_same_counters() {
    geoloc_counters same{};
    ASSERT_EQ(geoloc_counters_of(c_, &same), GEOLOC_OK);
    EXPECT_EQ(same.frames, cpp_.counters().frames);
    EXPECT_EQ(same.frames_by_fate[0], cpp_.counters().frames_located);
    EXPECT_EQ(same.detections, cpp_.counters().detections);
    EXPECT_EQ(same.attitudes, cpp_.state().counters().attitudes);
    EXPECT_EQ(same.positions, cpp_.state().counters().positions);
    EXPECT_EQ(same.gimbals, cpp_.state().counters().gimbals);
    EXPECT_EQ(same.focal_lengths, cpp_.state().counters().focal_lengths);
    EXPECT_EQ(same.ranges, cpp_.counters().ranges);
    EXPECT_EQ(same.tracks_created, cpp_.track_counters().created);
  }

  /// The way to WGS84 and back is the local frame's.
  void expect_same_frame() {
    double latitude_deg = 0.0, longitude_deg = 0.0, east_m = 0.0, north_m = 0.0;
    ASSERT_EQ(geoloc_to_geodetic(c_, 12.0, -7.0, &latitude_deg, &longitude_deg), GEOLOC_OK);
    EXPECT_EQ(latitude_deg, cpp_.local_frame()->to_geodetic({12.0, -7.0}).latitude_deg);
    ASSERT_EQ(geoloc_to_local(c_, latitude_deg, longitude_deg, &east_m, &north_m), GEOLOC_OK);
    EXPECT_NEAR(east_m, 12.0, 1e-6);
    EXPECT_NEAR(north_m, -7.0, 1e-6);
    geoloc_pose pose{};
    ASSERT_EQ(geoloc_camera_pose(c_, &pose), GEOLOC_OK);
    EXPECT_EQ(pose.position_in_enu_m[0], cpp_.view().enu_from_camera.translation.x());
    EXPECT_EQ(pose.enu_from_camera_wxyz[0], cpp_.view().enu_from_camera.rotation.w());
    EXPECT_EQ(pose.latency_s, cpp_.view().latency_s);
  }

 private:
  Geolocator cpp_;
  geoloc_geolocator* c_ = nullptr;
};

}  // namespace geoloc
