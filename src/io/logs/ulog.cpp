// SPDX-License-Identifier: Apache-2.0
#include "io/logs/ulog.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "io/logs/little_endian.hpp"

namespace geoloc::io {
namespace {

constexpr std::string_view kMagic{"ULog\x01\x12\x35", 7};
constexpr std::size_t kHeaderSize = 16;      // magic, version, time stamp
constexpr std::size_t kMessageHeadSize = 3;  // size without this head, type
constexpr std::string_view kMessageTypes = "BFIMPQARDLCSO";
constexpr std::size_t kMostFormats = 4096;

/// What stands at a place of the file, if anything does.
struct Message {
  char type = 0;
  std::string_view body;
};

std::optional<Message> message_at(std::string_view bytes, std::size_t at) {
  if (at + kMessageHeadSize > bytes.size()) return std::nullopt;
  const std::size_t size = read_number<std::uint16_t>(bytes.data() + at);
  const char type = bytes[at + 2];
  if (size == 0 || kMessageTypes.find(type) == std::string_view::npos) return std::nullopt;
  if (at + kMessageHeadSize + size > bytes.size()) return std::nullopt;
  return Message{type, bytes.substr(at + kMessageHeadSize, size)};
}

/// After damage: whether several messages follow each other from there.
bool is_chain(std::string_view bytes, std::size_t at) {
  constexpr int kLinks = 3;
  for (int i = 0; i < kLinks && at < bytes.size(); ++i) {
    const auto message = message_at(bytes, at);
    if (!message) return false;
    at += kMessageHeadSize + message->body.size();
  }
  return at <= bytes.size();
}

class Reader {
 public:
  Reader(const UlogTopics& topics, const std::function<void(const UlogSample&)>& take)
      : topics_(topics), take_(take) {}

  /// A part of the file that was written in one piece.
  void read(std::string_view bytes) {
    bool is_damaged = false;
    for (std::size_t at = 0; at < bytes.size();) {
      const auto message = message_at(bytes, at);
      if (!message || (is_damaged && !is_chain(bytes, at))) {
        is_damaged = true;
        ++at;
        ++damage_.skipped_bytes;
        continue;
      }
      is_damaged = false;
      take(*message);
      at += kMessageHeadSize + message->body.size();
    }
  }

  UlogDamage damage() const { return damage_; }

 private:
  void take(const Message& message) {
    if (message.type == 'F') {
      define(message.body);
    } else if (message.type == 'A') {
      subscribe(message.body);
    } else if (message.type == 'R' && message.body.size() >= 2) {
      subscriptions_.erase(read_number<std::uint16_t>(message.body.data()));
    } else if (message.type == 'D' && message.body.size() >= 2) {
      const auto found = subscriptions_.find(read_number<std::uint16_t>(message.body.data()));
      if (found != subscriptions_.end())
        take_({found->second->first, *found->second->second, message.body.substr(2)});
    } else if (message.type == 'O') {
      ++damage_.dropouts;
    }
  }

  void define(std::string_view text) {
    const std::size_t colon = text.find(':');
    if (colon != std::string_view::npos && definitions_.size() < kMostFormats)
      definitions_.emplace(text.substr(0, colon), text.substr(colon + 1));
  }

  /// Of several instances of a topic, the first.
  void subscribe(std::string_view body) {
    if (body.size() < 4 || body[0] != 0) return;
    const std::string topic(body.substr(3));
    if (std::find(topics_.begin(), topics_.end(), topic) == topics_.end()) return;
    auto layout = layouts_.find(topic);
    if (layout == layouts_.end()) layout = layouts_.emplace(topic, ulog_layout(definitions_, topic)).first;
    if (layout->second) subscriptions_[read_number<std::uint16_t>(body.data() + 1)] = &*layout;
  }

  using Layouts = std::map<std::string, std::optional<UlogLayout>>;

  const UlogTopics& topics_;
  const std::function<void(const UlogSample&)>& take_;
  std::map<std::string, std::string, std::less<>> definitions_;
  Layouts layouts_;
  std::map<std::uint16_t, const Layouts::value_type*> subscriptions_;
  UlogDamage damage_;
};

/// Where parts of the file begin that were appended later: the message before each may be cut off there.
std::vector<std::size_t> appended_offsets(std::string_view bytes) {
  constexpr std::size_t kFlags = 8, kOffsets = 3;
  std::vector<std::size_t> offsets;
  const auto first = message_at(bytes, kHeaderSize);
  if (!first || first->type != 'B' || first->body.size() < 2 * kFlags + kOffsets * 8) return offsets;
  const std::string_view incompatible = first->body.substr(kFlags, kFlags);
  const bool is_appended = (incompatible[0] & 1) != 0;
  if ((incompatible[0] & ~1) != 0 ||
      std::any_of(incompatible.begin() + 1, incompatible.end(), [](char flags) { return flags != 0; }))
    throw std::runtime_error("is a ULog of a later kind than is read here");
  for (std::size_t i = 0; is_appended && i < kOffsets; ++i) {
    const auto offset = read_number<std::uint64_t>(first->body.data() + 2 * kFlags + 8 * i);
    if (offset > kHeaderSize && offset < bytes.size()) offsets.push_back(static_cast<std::size_t>(offset));
  }
  std::sort(offsets.begin(), offsets.end());
  return offsets;
}

}  // namespace

UlogDamage for_each_ulog_sample(std::string_view bytes, const UlogTopics& topics,
                                const std::function<void(const UlogSample&)>& take) {
  if (bytes.size() < kHeaderSize || bytes.substr(0, kMagic.size()) != kMagic)
    throw std::runtime_error("is no ULog: it does not begin with `ULog`");
  std::vector<std::size_t> begins = appended_offsets(bytes);
  begins.insert(begins.begin(), kHeaderSize);
  begins.push_back(bytes.size());
  Reader reader(topics, take);
  for (std::size_t i = 0; i + 1 < begins.size(); ++i)
    reader.read(bytes.substr(begins[i], begins[i + 1] - begins[i]));
  return reader.damage();
}

}  // namespace geoloc::io
