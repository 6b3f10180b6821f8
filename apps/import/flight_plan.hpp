// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/camera/camera.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/io/mavlink/state_messages.hpp"
#include "geoloc/state/samples.hpp"
#include "import/picture_reader.hpp"

namespace geoloc::apps {

/// What the command line says where pictures say nothing.
struct FlightFacts {
  std::optional<double> utc_offset_h;       ///< what the camera's clock is ahead of UTC
  std::optional<double> take_off_height_m;  ///< in the datum of the pictures' absolute heights
  std::optional<double> marks_height_m;    ///< mean of a survey's marks: the take-off's where nothing is told
  std::optional<double> camera_pitch_deg;  ///< of pictures that do not tell their camera's; -90 is down
  std::optional<io::Lens> lens;            ///< in place of the pictures' own
};

/// A picture as a moment of a flight.
struct Exposure {
  std::filesystem::path file;
  HostTime at;
  PositionSample position;
  AttitudeSample attitude;
  std::optional<CameraMount> mount;         ///< nullopt: the plan's
  std::optional<Eigen::Vector2d> focal_px;  ///< [fx, fy] of a picture that was zoomed; nullopt: the plan's
  std::optional<io::GnssClaim> gnss;        ///< where the receiver claims an accuracy
};

/// Pictures of one camera, which may zoom, in the order they were taken.
struct FlightPlan {
  std::vector<Exposure> exposures;
  CameraIntrinsics camera;
  double sigma_focal_percent = 0.0;         ///< of the camera's focal length; 0: it is a calibration's
  std::optional<double> take_off_height_m;  ///< in the pictures' datum, where that is known
  CameraMount mount;                        ///< of the exposures that have none of their own
  bool is_synchronised = false;             ///< the receiver knew when each picture was exposed
  double sigma_attitude_deg = 0.0;          ///< of angles that were assumed; 0: all are told
  bool is_heading_assumed = false;          ///< of some exposure
  std::vector<std::string> notes;           ///< what the pictures tell of their accuracy
  std::vector<std::string> assumptions;     ///< what was not told, and what was taken instead
  std::vector<std::string> left_out;        ///< file and reason
};

/// Throws std::runtime_error where no picture is left, or where one fact is missing that only the user knows.
FlightPlan plan_flight(std::vector<NamedStill> stills, const FlightFacts& facts);

}  // namespace geoloc::apps
