// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geoloc/calibration/flight_state.hpp"
#include "geoloc/geometry/geodetic.hpp"
#include "geoloc/geometry/time.hpp"
#include "geoloc/tracking/class_votes.hpp"
#include "geoloc/tracking/joint_estimate.hpp"

namespace geoloc {

/// Whether flights, and fleets, may be called so: 1 to 64 letters, digits, or any of - _ . :
bool is_flight_name(std::string_view name);

/// Which flight a summary is of, and which of its summaries it is.
struct FlightIdentity {
  std::string flight;          ///< the same for all summaries of one flight, and of no other; see kMostName
  std::string vehicle;         ///< for people; may be empty
  std::uint64_t sequence = 0;  ///< a higher one replaces a lower one
};

/// Which run of the estimator over a flight a summary is of: the app may be started again in the air, or a
/// recording be split.
struct FlightRun {
  std::string
      whole;  ///< the flight that it is part of, as a user calls it; empty: that of the vehicle's boot
  HostTime booted_at;    ///< the vehicle's clock began to count then
  VehicleTime ended_at;  ///< its last frame
};

/// All that one flight knows of its objects at rest, as a plain value: it can be sent, kept, and fused with
/// those of other flights (fuse()). Object i is truly at
///   position_in_enu + (rows 3i to 3i+2 of shared_error) s + own noise
/// with s ~ N(0, I), independent of all other flights. Any such numbers are a valid Gaussian, so that a
/// summary from elsewhere need be checked number by number only.
struct FlightSummary {
  static constexpr std::size_t kMostName = 64;         ///< characters of a flight's or vehicle's name
  static constexpr std::size_t kMostObjects = 20'000;  ///< and pairs apart per object: kMostApart
  static constexpr std::size_t kMostApart = 12;
  static constexpr Eigen::Index kMostShared = 512;  ///< columns of shared_error
  static constexpr double kReach_m = 100e3;         ///< of objects from the origin

  struct Object {
    std::uint64_t id = 0;                                          ///< in its flight
    Eigen::Vector3d position_in_enu = Eigen::Vector3d::Zero();     ///< east, north, up above home [m]
    Eigen::Matrix3d own_covariance = Eigen::Matrix3d::Identity();  ///< of the own noise [m^2]
    int hits = 0;                                                  ///< looks that made it
    double existence = 0.0;                                        ///< probability
    ClassVotes class_votes;
    HostTime first_seen;
    HostTime last_seen;
  };

  /// What makes two summaries parts of one flight, and what they share as such. Of its shared errors the
  /// first are those of the objects; the others concern no object.
  struct Part {
    FlightRun run;
    FlightState state;
  };

  FlightIdentity identity;
  Geodetic origin;                          ///< of the local frame that positions are in
  std::optional<double> home_height_msl_m;  ///< of the home that heights count from, where it is known
  std::vector<Object> objects;              ///< in order of their ids, each once
  /// Three rows (east, north, up) per object, a column per error [m]. The first three columns carry all of
  /// the shift that objects have in common, by common_shift(); the others follow with falling effect.
  Eigen::MatrixXd shared_error;
  /// Objects, as places in the list, that a frame showed side by side: never one. Sorted, the smaller place
  /// first, each pair once.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> apart;
  std::optional<Part> part;  ///< nullopt: it is known to be part of none but its own

  Eigen::Index shared_count() const { return shared_error.cols(); }
  /// Rows of object i.
  auto shared_error_of(std::size_t object) const {
    return shared_error.middleRows<3>(3 * static_cast<Eigen::Index>(object));
  }
  /// Covariance of object i's absolute position [m^2].
  Eigen::Matrix3d covariance(std::size_t object) const;

  /// What makes it unusable: sizes that do not fit, numbers that are not finite or out of their range,
  /// covariances that are not positive definite. Each is named, up to ten.
  std::vector<std::string> problems() const;
};

/// How all objects of a flight move per shared error, in the mean [m]: three rows, a column per error. Those
/// that are well known count more.
Eigen::Matrix<double, 3, Eigen::Dynamic> common_shift(const FlightSummary& summary);

/// The summary of a flight. Shared errors that change no variance by more than a thousandth are made part of
/// the objects' own noise, so that there are about as many as tell something. `run`: where other summaries
/// may be of the same flight.
FlightSummary summarize(const JointEstimate& estimate, FlightIdentity identity, const Geodetic& origin,
                        std::optional<double> home_height_msl_m, std::optional<FlightRun> run = std::nullopt);

/// The same summary with all positions in another local frame: moved, and turned by the convergence of the
/// meridians. Frames at most some 50 km apart: the earth's curvature between them is not in the covariances.
FlightSummary transformed_to(const LocalFrame& frame, const FlightSummary& summary);

}  // namespace geoloc
