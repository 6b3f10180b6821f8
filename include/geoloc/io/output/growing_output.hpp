// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "geoloc/io/output/result_file.hpp"
#include "geoloc/io/output_place.hpp"
#include "geoloc/io/output_stream.hpp"

namespace geoloc::io {

/// What a run writes as it goes: to standard output ("-"), to a pipe, device or socket, or to a file, which
/// is called FILE.partial until it is complete (FILE.partial-2, … where an earlier run has left one). After a
/// failed write nothing more is written, because what came next would not fit. Each function throws
/// std::runtime_error naming the option, the target and the system's reason, the first time that it fails.
class GrowingOutput {
 public:
  GrowingOutput(std::string option, std::string target, OldFile old_file, TellUser tell);

  /// "--jsonl run.jsonl".
  std::string name() const { return option_ + " " + target_; }

  /// Whether anything was written.
  bool has_begun() const { return stream_.has_value(); }

  /// Opens it first: a named pipe makes its writer wait for a reader.
  void write(std::string_view bytes);

  /// What was written to a file survives a power cut from now on.
  void sync();

  /// Gives a file its name. Nothing can be written afterwards.
  void finish();

 private:
  void open();
  void open_partial();
  template <typename Step>
  void attempt(const Step& step);

  bool is_file() const { return target_ != "-" && place_.is_file; }

  std::string option_;
  std::string target_;
  OldFile old_file_;
  TellUser tell_;
  OutputPlace place_;
  std::filesystem::path partial_;  // the file's name while it is written
  std::optional<OutputStream> stream_;
  bool has_failed_ = false;
};

}  // namespace geoloc::io
