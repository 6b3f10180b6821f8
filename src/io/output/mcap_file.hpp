// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace geoloc::io {

/// An MCAP file (mcap.dev/spec, version 0) of ROS 2 messages, as `ros2 bag` and Foxglove read it: chunks
/// without compression, with an index, so that a viewer reads what it shows.
class McapFile {
 public:
  McapFile();

  /// A topic, whose messages are of that type; `definition`: the type's, with those that it is made of.
  /// Returns its number.
  std::uint16_t add_topic(const std::string& topic, const std::string& type, const std::string& definition);

  /// Messages in order of their times. `cdr`: CdrMessage::bytes().
  void add(std::uint16_t topic, std::int64_t time_ns, const std::string& cdr);

  /// Ends the file, and returns its bytes.
  std::string finish();

 private:
  struct Index {
    std::uint64_t time_ns;
    std::uint64_t offset;  // in the chunk
  };
  /// What a reader is told of a chunk.
  struct Chunk {
    std::uint64_t begin_ns;
    std::uint64_t end_ns;
    std::uint64_t offset;
    std::uint64_t length;
    std::map<std::uint16_t, std::uint64_t> offset_of_index;
    std::uint64_t length_of_indices;
    std::uint64_t size;
  };

  void end_chunk();
  std::string statistics() const;

  std::string bytes_;
  std::string topics_;  // records of schemas and channels
  std::map<std::uint16_t, std::uint64_t> messages_of_topic_;
  std::string chunk_;
  std::uint64_t chunk_begin_ns_ = 0;
  std::uint64_t last_ns_ = 0;
  std::map<std::uint16_t, std::vector<Index>> index_;
  std::vector<Chunk> chunks_;
};

}  // namespace geoloc::io
