// SPDX-License-Identifier: Apache-2.0
#include "io/output/mcap_file.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "io/output/cdr.hpp"

namespace geoloc::io {
namespace {

constexpr char kMagic[] = "\x89MCAP0\r\n";
constexpr std::size_t kMagicSize = 8;
constexpr std::size_t kChunkSize = 1 << 18;

/// The kinds of records that are written.
enum Kind : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kStatistics = 0x0B,
  kDataEnd = 0x0F
};

/// The fields of a record.
class Fields {
 public:
  template <typename Number>
  Fields& add(Number value) {
    append_little_endian(value, bytes_);
    return *this;
  }
  Fields& add_text(const std::string& text) {
    add(static_cast<std::uint32_t>(text.size()));
    bytes_ += text;
    return *this;
  }
  Fields& add_bytes(const std::string& bytes) {
    bytes_ += bytes;
    return *this;
  }
  Fields& add_counts(const std::map<std::uint16_t, std::uint64_t>& counts) {
    add(static_cast<std::uint32_t>(counts.size() * (sizeof(std::uint16_t) + sizeof(std::uint64_t))));
    for (const auto& [number, count] : counts) add(number).add(count);
    return *this;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

void append(Kind kind, const Fields& fields, std::string& to) {
  to += static_cast<char>(kind);
  append_little_endian(static_cast<std::uint64_t>(fields.bytes().size()), to);
  to += fields.bytes();
}

}  // namespace

McapFile::McapFile() : bytes_(kMagic, kMagicSize) {
  append(kHeader, Fields().add_text("ros2").add_text("geoloc"), bytes_);
}

std::uint16_t McapFile::add_topic(const std::string& topic, const std::string& type,
                                  const std::string& definition) {
  const auto number = static_cast<std::uint16_t>(messages_of_topic_.size() + 1);  // 0 stands for no schema
  messages_of_topic_[number] = 0;
  std::string records;
  append(kSchema, Fields().add(number).add_text(type).add_text("ros2msg").add_text(definition), records);
  append(kChannel, Fields().add(number).add(number).add_text(topic).add_text("cdr").add(std::uint32_t{0}),
         records);
  topics_ += records;
  bytes_ += records;
  return number;
}

void McapFile::add(std::uint16_t topic, std::int64_t time_ns, const std::string& cdr) {
  last_ns_ = static_cast<std::uint64_t>(std::max<std::int64_t>(time_ns, 0));
  if (chunk_.empty()) chunk_begin_ns_ = last_ns_;
  index_[topic].push_back({last_ns_, chunk_.size()});
  const auto sequence = static_cast<std::uint32_t>(messages_of_topic_[topic]++);
  append(kMessage, Fields().add(topic).add(sequence).add(last_ns_).add(last_ns_).add_bytes(cdr), chunk_);
  if (chunk_.size() >= kChunkSize) end_chunk();
}

void McapFile::end_chunk() {
  if (chunk_.empty()) return;
  Chunk chunk{chunk_begin_ns_, last_ns_, bytes_.size(), 0, {}, 0, chunk_.size()};
  append(kChunk,
         Fields()
             .add(chunk.begin_ns)
             .add(chunk.end_ns)
             .add(chunk.size)
             .add(std::uint32_t{0})  // no checksum
             .add_text("")           // no compression
             .add(chunk.size)
             .add_bytes(chunk_),
         bytes_);
  chunk.length = bytes_.size() - chunk.offset;
  for (const auto& [topic, messages] : index_) {
    chunk.offset_of_index[topic] = bytes_.size();
    Fields index;
    index.add(topic).add(static_cast<std::uint32_t>(messages.size() * sizeof(Index)));
    for (const Index& message : messages) index.add(message.time_ns).add(message.offset);
    append(kMessageIndex, index, bytes_);
  }
  chunk.length_of_indices = bytes_.size() - chunk.offset - chunk.length;
  chunks_.push_back(chunk);
  chunk_.clear();
  index_.clear();
}

std::string McapFile::statistics() const {
  std::uint64_t messages = 0;
  for (const auto& [topic, count] : messages_of_topic_) messages += count;
  const auto topics = messages_of_topic_.size();
  std::string record;
  append(kStatistics,
         Fields()
             .add(messages)
             .add(static_cast<std::uint16_t>(topics))
             .add(static_cast<std::uint32_t>(topics))
             .add(std::uint32_t{0})  // attachments
             .add(std::uint32_t{0})  // metadata
             .add(static_cast<std::uint32_t>(chunks_.size()))
             .add(chunks_.empty() ? std::uint64_t{0} : chunks_.front().begin_ns)
             .add(chunks_.empty() ? std::uint64_t{0} : chunks_.back().end_ns)
             .add_counts(messages_of_topic_),
         record);
  return record;
}

std::string McapFile::finish() {
  end_chunk();
  append(kDataEnd, Fields().add(std::uint32_t{0}), bytes_);
  const std::uint64_t summary = bytes_.size();
  bytes_ += topics_ + statistics();
  for (const Chunk& chunk : chunks_) {
    append(kChunkIndex,
           Fields()
               .add(chunk.begin_ns)
               .add(chunk.end_ns)
               .add(chunk.offset)
               .add(chunk.length)
               .add_counts(chunk.offset_of_index)
               .add(chunk.length_of_indices)
               .add_text("")
               .add(chunk.size)
               .add(chunk.size),
           bytes_);
  }
  append(kFooter, Fields().add(summary).add(std::uint64_t{0}).add(std::uint32_t{0}), bytes_);
  bytes_.append(kMagic, kMagicSize);
  return std::move(bytes_);
}

}  // namespace geoloc::io
