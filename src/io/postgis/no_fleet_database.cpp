// SPDX-License-Identifier: Apache-2.0
// Builds without libpq.
#include <stdexcept>

#include "geoloc/io/postgis/fleet_database.hpp"

namespace geoloc::io {

struct FleetDatabase::State {
  std::string name;
};

FleetDatabase::FleetDatabase(const std::string& /*url*/, std::string /*fleet*/) {
  throw std::invalid_argument(
      "--postgis: this geoloc was built without PostgreSQL; build it with Debian's libpq-dev");
}
FleetDatabase::~FleetDatabase() = default;
FleetDatabase::FleetDatabase(FleetDatabase&&) noexcept = default;
const std::string& FleetDatabase::name() const {
  return state_->name;
}
bool FleetDatabase::is_exposed() const {
  return false;
}
KeptFleet FleetDatabase::read() {
  return {};
}
void FleetDatabase::write(const SummaryOutbox::Summaries& /*summaries*/, const RunRecord& /*run*/) {}

}  // namespace geoloc::io
