// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "geoloc/sim/flight/flight.hpp"

namespace geoloc::sim {

// A recorded flight as it would have been under other circumstances. Truth and telemetry change together, so
// that the autopilot's errors stay those that were recorded. Names stay, too: equal seeds draw equal errors.

/// So much higher above the ground [m].
Flight raised(const Flight& flight, double metres);

/// What an attitude filter is off by, besides what was recorded: first-order Gauss-Markov in each angle.
struct AttitudeNoise {
  double sigma_deg = 0.0;
  double time_constant_s = 0.0;  ///< 0: white, from message to message
  std::uint64_t seed = 1;
};

/// ATTITUDE with noise added to each angle; the truth stays.
Flight with_attitude_noise(const Flight& flight, const AttitudeNoise& noise);

/// The same path `factor` times as fast, with the tilts as recorded: a real vehicle would tilt more.
/// Telemetry comes `factor` times as often. factor must be > 0.
Flight at_speed(const Flight& flight, double factor);

/// Attitude and position told rate_hz times a second. Where that is less often than recorded, the messages
/// nearest to each due time are kept as they are. Where it is more often, they are made: the truth of the
/// moment plus the recorded error, interpolated between messages. rate_hz must be > 0.
Flight at_telemetry_rate(const Flight& flight, double rate_hz);

/// The vehicle's clock stops in the middle of the survey for so long [s], in which nothing is sent; all
/// stamps after it are as much behind. Truth and cameras go on.
Flight with_stopped_clock(const Flight& flight, double pause_s);

/// So many pictures at equal times over a survey, and of so many of them, at equal distances, the yaw turned
/// round.
struct Stills {
  int count = 18;
  int turned = 0;
};

/// From one picture to the next.
Duration period_of(const Stills& stills, const Flight& flight);

/// Attitude and position told at the pictures of the survey and at no other time, as stills tell them.
Flight as_stills(const Flight& flight, const Stills& stills);

}  // namespace geoloc::sim
