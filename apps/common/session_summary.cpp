// SPDX-License-Identifier: Apache-2.0
#include "common/session_summary.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdint>
#include <utility>

#include "geoloc/io/output/object_report.hpp"
#include "geoloc/state/state_provider.hpp"

namespace geoloc::apps {
namespace {

/// The vehicle's number in MAVLink; 0 where there is none.
int system_of(const Session& session) {
  const auto vehicle = session.link().status(session.history().trajectory().back().at).vehicle;
  return vehicle ? vehicle->system : 0;
}

std::string name_of_flight(const Session& session) {
  const Geodetic& origin = session.geolocator().local_frame()->origin();
  return fmt::format("{}_{:.6f}_{:.6f}_{}", io::iso8601(session.history().trajectory().front().at),
                     origin.latitude_deg, origin.longitude_deg, system_of(session));
}

/// Autopilots count milliseconds from their boot in 32 bits. A clock that is beyond that counts from
/// elsewhere.
constexpr Duration kMostUptime = std::chrono::milliseconds{std::int64_t{1} << 32U};

/// nullopt where neither the vehicle's clock nor the user tells which flight it is of.
std::optional<FlightRun> run_of(const Session& session, const std::string& whole_flight) {
  const FrameView& view = session.geolocator().view();
  const Duration uptime = view.vehicle.time.time_since_epoch();
  if (uptime < Duration::zero() || uptime > kMostUptime) return std::nullopt;
  return FlightRun{whole_flight, view.captured_at_host - from_seconds(view.latency_s) - uptime,
                   view.vehicle.time};
}

}  // namespace

std::optional<FlightSummary> summarize_session(const Session& session, const std::string& flight_id,
                                               const std::string& whole_flight) {
  const Geolocator& geolocator = session.geolocator();
  if (session.history().trajectory().empty()) return std::nullopt;
  const auto estimate = geolocator.joint_estimate();
  if (!estimate) return std::nullopt;
  FlightIdentity identity;
  identity.flight = flight_id.empty() ? name_of_flight(session) : flight_id;
  identity.vehicle = fmt::format("system-{}", system_of(session));
  identity.sequence = session.frames() + (session.is_finished() ? 1 : 0);  // the end may come without a frame
  return summarize(*estimate, std::move(identity), geolocator.local_frame()->origin(),
                   geolocator.state().home_height_msl_m(), run_of(session, whole_flight));
}

}  // namespace geoloc::apps
