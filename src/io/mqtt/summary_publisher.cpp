// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/mqtt/summary_publisher.hpp"

#include <stdexcept>
#include <utility>

#include "geoloc/io/fleet/summary_file.hpp"

namespace geoloc::io {
namespace {

/// Until the next run comes, and less than a sink may be silent for at the end.
constexpr auto kPatience = std::chrono::milliseconds{3000};

}  // namespace

std::string SummaryDelivery::words() const {
  std::string text = "fleet: " + std::to_string(delivered) + " summaries delivered";
  if (replaced > 0) text += ", " + std::to_string(replaced) + " replaced by newer ones";
  return is_connected ? text : text + "; the broker is not connected";
}

SummaryPublisher::SummaryPublisher(const MqttAccess& access, const MqttConnection::Tell& tell,
                                   std::shared_ptr<SummaryDelivery> delivery)
    : address_(access.address), connection_(access, tell), delivery_(std::move(delivery)) {}

void SummaryPublisher::note() {
  delivery_->delivered = connection_.counts().delivered;
  delivery_->replaced = connection_.counts().replaced;
  delivery_->is_connected = connection_.is_connected();
}

void SummaryPublisher::on_run(const RunRecord& run) {
  if (run.flight_summary && run.flight_summary->identity.sequence != published_) {
    const FlightIdentity& identity = run.flight_summary->identity;
    published_ = identity.sequence;
    connection_.publish(summary_topic(address_.fleet, identity.flight),
                        summary_to_bytes(*run.flight_summary));
  }
  connection_.poll(std::chrono::milliseconds{0});  // a connection wants to be looked after in any case
  connection_.flush(kPatience);
  note();
}

void SummaryPublisher::on_end() {
  const bool is_delivered = connection_.flush(kPatience);
  note();
  if (!is_delivered)
    throw std::runtime_error(name() + ": the last summary was not delivered" +
                             (connection_.fault().empty() ? "" : ": " + connection_.fault()));
}

}  // namespace geoloc::io
