// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The container of ArduPilot's DataFlash logs, which describes itself: a record's format is told by an FMT
// record before it.
namespace geoloc::io {

struct DataflashField {
  std::string name;
  char type = 0;           ///< as in FMT: b B h H i I f d q Q c C e E L M n N Z a g
  std::size_t offset = 0;  ///< from the record's begin
};

struct DataflashFormat {
  std::string name;
  std::size_t size = 0;  ///< of a record, its header included
  std::vector<DataflashField> fields;
};

/// A record; valid during the call that it is passed to.
class DataflashRecord {
 public:
  DataflashRecord(const DataflashFormat& format, const char* bytes) : format_(format), bytes_(bytes) {}

  const std::string& name() const { return format_.name; }

  /// The field's number in the unit that its type implies (`c` and `C` are hundredths, `L` is 1e-7 degrees).
  /// nullopt where the record has no such field, or it is no number.
  std::optional<double> number(std::string_view field) const;

 private:
  const DataflashFormat& format_;
  const char* bytes_;
};

/// Calls `take` for every record but FMT, in their order. What is no record is skipped; returns how many
/// bytes that were.
std::size_t for_each_dataflash_record(std::string_view bytes,
                                      const std::function<void(const DataflashRecord&)>& take);

}  // namespace geoloc::io
