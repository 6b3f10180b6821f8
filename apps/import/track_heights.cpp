// SPDX-License-Identifier: Apache-2.0
#include "import/track_heights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "import/sea_level.hpp"

namespace geoloc::apps {
namespace {

bool tells_above_home(const io::LoggedPosition& position) {
  return position.heights.above_home_m.has_value();
}

bool tells_msl(const io::LoggedPosition& position) {
  return position.heights.msl_m.has_value();
}

std::optional<double> absolute_m(const io::LoggedPosition& position) {
  return position.heights.msl_m ? position.heights.msl_m : position.heights.ellipsoid_m;
}

/// Home's height in the datum of the absolute heights.
double home_m(const io::FlightLog& log, std::optional<double> told_m, std::vector<std::string>& assumptions) {
  if (told_m) return *told_m;
  if (log.home_height_msl_m && tells_msl(log.positions.front())) return *log.home_height_msl_m;
  const double first_m = *absolute_m(log.positions.front());
  assumptions.push_back(fmt::format(
      "the log tells no home: the take-off is taken to be as high as its first position, {:.1f} m "
      "(--take-off-height-m says another)",
      first_m));
  return first_m;
}

/// What heights above the sea are above those above home, where no position tells its own.
double sea_offset_m(const io::FlightLog& log, std::vector<std::string>& assumptions) {
  if (log.home_height_msl_m) return *log.home_height_msl_m;
  const auto& first = log.positions.front();
  if (first.heights.ellipsoid_m && first.heights.above_home_m) {
    return height_msl_m(first.position, *first.heights.ellipsoid_m,
                        "the log's absolute heights count from the ellipsoid", assumptions) -
           *first.heights.above_home_m;
  }
  assumptions.emplace_back(
      "the log tells no heights above the sea: the take-off is taken to be at sea level");
  return 0.0;
}

}  // namespace

std::vector<PositionSample> positions_above_home(const io::FlightLog& log,
                                                 std::optional<double> told_take_off_height_m,
                                                 std::vector<std::string>& assumptions) {
  const auto& logged = log.positions;
  const bool is_above_home = std::all_of(logged.begin(), logged.end(), &tells_above_home);
  const bool is_msl = std::all_of(logged.begin(), logged.end(), &tells_msl);
  const bool is_absolute = is_msl || std::all_of(logged.begin(), logged.end(), [](const auto& position) {
                             return position.heights.ellipsoid_m.has_value();
                           });
  if (!is_above_home && !is_absolute)
    throw std::runtime_error("tells some positions without a height: nothing can be located from them");
  if (is_above_home && told_take_off_height_m)
    assumptions.emplace_back("--take-off-height-m is not used: the log tells heights above the take-off");
  const double home_height_m = is_above_home ? 0.0 : home_m(log, told_take_off_height_m, assumptions);
  const double offset_m = is_msl ? 0.0 : is_above_home ? sea_offset_m(log, assumptions) : home_height_m;
  std::vector<PositionSample> positions;
  positions.reserve(logged.size());
  for (const io::LoggedPosition& sample : logged) {
    PositionSample position;
    position.time = sample.time;
    position.position = sample.position;
    position.height_above_home_m = is_above_home ? *sample.heights.above_home_m
                                   : is_msl      ? *sample.heights.msl_m - home_height_m
                                                 : *sample.heights.ellipsoid_m - home_height_m;
    position.height_msl_m = is_msl ? *sample.heights.msl_m : position.height_above_home_m + offset_m;
    positions.push_back(position);
  }
  return positions;
}

}  // namespace geoloc::apps
