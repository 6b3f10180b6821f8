// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "geoloc/io/output/result_file.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

/// Writes the whole run so far to a file, which appears complete or not at all.
class FileSink final : public Sink {
 public:
  using Render = std::function<std::string(const RunRecord&)>;

  FileSink(std::string option, ResultFile file, Render render)
      : option_(std::move(option)), file_(std::move(file)), render_(std::move(render)) {}

  std::string name() const override { return option_ + " " + file_.name().string(); }
  bool wants_frames() const override { return false; }
  void on_run(const RunRecord& run) override { file_.write(render_(run)); }

 private:
  std::string option_;
  ResultFile file_;
  Render render_;
};

}  // namespace geoloc::io
