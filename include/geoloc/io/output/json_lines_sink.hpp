// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>

#include "geoloc/io/output/growing_output.hpp"
#include "geoloc/io/output/json_lines.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// Writes JSON Lines. In a live run, a power cut costs the last second of a file.
class JsonLinesSink final : public Sink {
 public:
  JsonLinesSink(std::string target, OldFile old_file, TellUser tell)
      : output_("--jsonl", std::move(target), old_file, std::move(tell)) {}

  std::string name() const override { return output_.name(); }
  void on_frame(const OutputFrame& frame) override { output_.write(lines_.frame(frame)); }
  void on_status(const LiveStatus& status) override;
  void on_run(const RunRecord& run) override { last_lines_ = JsonLines::end(run); }
  void on_end() override;

 private:
  GrowingOutput output_;
  JsonLines lines_;
  std::string last_lines_;
};

}  // namespace geoloc::io
