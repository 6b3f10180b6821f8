// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The container of PX4's logs (ULog, version 1), which describes itself: formats with nested types, and
// subscriptions to topics of these formats.
namespace geoloc::io {

/// Where a topic's fields lie, by names such as `q[3]` or `current.lat`.
struct UlogLayout {
  struct Field {
    std::size_t offset = 0;
    char type = 0;  ///< b B h H i I q Q f d: as Python's struct names them
  };
  std::map<std::string, Field, std::less<>> fields;
};

/// One sample of a topic; valid during the call that it is passed to.
class UlogSample {
 public:
  UlogSample(const std::string& topic, const UlogLayout& layout, std::string_view bytes)
      : topic_(topic), layout_(layout), bytes_(bytes) {}

  const std::string& topic() const { return topic_; }

  /// nullopt where the topic has no such field, or the sample is too short for it.
  std::optional<double> number(std::string_view field) const;

 private:
  const std::string& topic_;
  const UlogLayout& layout_;
  std::string_view bytes_;
};

struct UlogDamage {
  std::size_t skipped_bytes = 0;
  std::size_t dropouts = 0;  ///< that the log reports
};

using UlogTopics = std::vector<std::string_view>;

/// Calls `take` for each sample of the first instance of each of the topics, in their order. Throws
/// std::runtime_error where the bytes are no ULog, or one of a later kind.
UlogDamage for_each_ulog_sample(std::string_view bytes, const UlogTopics& topics,
                                const std::function<void(const UlogSample&)>& take);

/// The layout of a format's fields; `definitions` are the texts of the formats, by name. nullopt where a type
/// is not defined, or the format holds more than a message can.
std::optional<UlogLayout> ulog_layout(const std::map<std::string, std::string, std::less<>>& definitions,
                                      const std::string& format);

}  // namespace geoloc::io
