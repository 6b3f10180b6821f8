// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/json_lines_sink.hpp"

namespace geoloc::io {

void JsonLinesSink::on_status(const LiveStatus& status) {
  output_.write(JsonLines::status(status));
  output_.sync();
}

void JsonLinesSink::on_end() {
  if (!output_.has_begun() && last_lines_.empty()) return;  // the run did not begin
  output_.write(last_lines_);
  output_.finish();
}

}  // namespace geoloc::io
