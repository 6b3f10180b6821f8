// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "geoloc/io/mqtt/mqtt_connection.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// How a flight's summaries get on, for the thread that shows it.
struct SummaryDelivery {
  std::atomic<std::uint64_t> delivered{0};
  std::atomic<std::uint64_t> replaced{0};  ///< by a newer one before they could be sent
  std::atomic<bool> is_connected{false};

  /// "fleet: 12 summaries delivered".
  std::string words() const;
};

/// Publishes the flight's latest summary to its fleet, retained: who joins later has it, too.
class SummaryPublisher final : public Sink {
 public:
  SummaryPublisher(const MqttAccess& access, const MqttConnection::Tell& tell,
                   std::shared_ptr<SummaryDelivery> delivery);

  std::string name() const override { return "--mqtt " + address_.url(); }
  bool wants_frames() const override { return false; }
  void on_run(const RunRecord& run) override;
  /// Throws std::runtime_error where the last summary was not delivered.
  void on_end() override;

 private:
  void note();

  MqttAddress address_;
  MqttConnection connection_;
  std::shared_ptr<SummaryDelivery> delivery_;
  std::uint64_t published_ = 0;  // sequence number
};

}  // namespace geoloc::io
