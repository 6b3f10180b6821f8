// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/io/output/json_lines.hpp"
#include "geoloc/io/output/sink.hpp"
#include "geoloc/io/output_place.hpp"
#include "geoloc/io/output_stream.hpp"

namespace geoloc::io {

/// Writes JSON Lines to standard output ("-"), to a pipe, device or socket, or to a file, which is called
/// FILE.partial until it is complete. After a failed write nothing more is written, because half a line would
/// spoil the next one.
class JsonLinesSink final : public Sink {
 public:
  explicit JsonLinesSink(std::string target);

  std::string name() const override { return "--jsonl " + target_; }
  void on_frame(const OutputFrame& frame) override { write(lines_.frame(frame)); }
  void on_status(const LiveStatus& status) override { write(JsonLines::status(status)); }
  void on_run(const RunRecord& run) override { last_lines_ = JsonLines::end(run); }
  void on_end() override;

 private:
  OutputStream open() const;
  void write(const std::string& lines);
  [[noreturn]] void fail(int error);

  bool is_file() const { return target_ != "-" && place_.is_file; }
  std::string partial_name() const { return place_.path.string() + ".partial"; }

  std::string target_;
  OutputPlace place_;
  std::optional<OutputStream> stream_;
  bool has_failed_ = false;
  JsonLines lines_;
  std::string last_lines_;
};

}  // namespace geoloc::io
