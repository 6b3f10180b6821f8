// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "geoloc/io/output/live_status.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// A run as JSON Lines (docs/formats.md): each line is an object with a `type`. Confirmed objects are written
/// when they are new, and again after they were seen again, at most once per second of the recording's time.
/// Numbers that are not finite are null.
class JsonLines {
 public:
  /// Lines of a frame, each ended by a newline: `frame`, one `object` per object that is new or was seen
  /// again, and one `removed` per object that is gone: merged, removed, or no longer believed.
  std::string frame(const OutputFrame& frame);

  /// A `status` line.
  static std::string status(const LiveStatus& status);

  /// The last lines: every `object` as it is known at the end, and `run`.
  static std::string end(const RunRecord& run);

 private:
  struct Told {
    int hits = 0;
    HostTime at;
  };
  std::map<std::uint64_t, Told> told_;  // by the object's id
};

}  // namespace geoloc::io
