// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/postgis/fleet_database.hpp"

namespace geoloc::io {

void PostgisSink::on_run(const RunRecord& run) {
  if (run.flights.empty()) return;  // that nothing is known yet retracts no object
  const SummaryOutbox::Summaries summaries = outbox_->take();
  try {
    database_.write(summaries, run);
  } catch (...) {
    outbox_->put_back(summaries);
    throw;
  }
  outbox_->note_kept();
}

}  // namespace geoloc::io
