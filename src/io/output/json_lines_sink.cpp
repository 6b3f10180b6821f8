// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/json_lines_sink.hpp"

#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace geoloc::io {

JsonLinesSink::JsonLinesSink(std::string target)
    : target_(std::move(target)), place_(output_place(target_)) {}

void JsonLinesSink::fail(int error) {
  has_failed_ = true;
  throw std::runtime_error(name() + ": cannot be written: " + std::generic_category().message(error));
}

/// Called only for the first line, because a named pipe makes its writer wait for a reader.
OutputStream JsonLinesSink::open() const {
  if (target_ == "-") return OutputStream::standard_output();
  return is_file() ? OutputStream::file(partial_name()) : OutputStream::device(place_.path);
}

void JsonLinesSink::write(const std::string& lines) {
  if (has_failed_) return;
  try {
    if (!stream_) stream_.emplace(open());
    stream_->write(lines);
  } catch (const std::system_error& error) {
    fail(error.code().value());
  }
}

void JsonLinesSink::on_end() {
  write(last_lines_);
  if (has_failed_) return;
  try {
    stream_->close();
    if (is_file()) std::filesystem::rename(partial_name(), place_.path);
  } catch (const std::system_error& error) {
    fail(error.code().value());
  }
}

}  // namespace geoloc::io
