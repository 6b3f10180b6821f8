// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "geoloc/io/output/json_lines.hpp"
#include "geoloc/io/output/result_file.hpp"
#include "geoloc/io/output/sink.hpp"
#include "geoloc/io/output_place.hpp"
#include "geoloc/io/output_stream.hpp"

namespace geoloc::io {

/// Writes JSON Lines to standard output ("-"), to a pipe, device or socket, or to a file, which is called
/// FILE.partial until it is complete (FILE.partial-2, … where an earlier run has left one). In a live run, a
/// power cut costs the last second of a file. After a failed write nothing more is written, because half a
/// line would spoil the next one.
class JsonLinesSink final : public Sink {
 public:
  JsonLinesSink(std::string target, OldFile old_file, TellUser tell);

  std::string name() const override { return "--jsonl " + target_; }
  void on_frame(const OutputFrame& frame) override { write(lines_.frame(frame)); }
  void on_status(const LiveStatus& status) override;
  void on_run(const RunRecord& run) override { last_lines_ = JsonLines::end(run); }
  void on_end() override;

 private:
  void open();
  void open_partial();
  void write(const std::string& lines);
  template <typename Step>
  void attempt(const Step& step);

  bool is_file() const { return target_ != "-" && place_.is_file; }

  std::string target_;
  OldFile old_file_;
  TellUser tell_;
  OutputPlace place_;
  std::filesystem::path partial_;  // the file's name while it is written
  std::optional<OutputStream> stream_;
  bool has_failed_ = false;
  JsonLines lines_;
  std::string last_lines_;
};

}  // namespace geoloc::io
