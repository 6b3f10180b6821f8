// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/json_lines_sink.hpp"

#include <cerrno>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "geoloc/io/sync.hpp"

namespace geoloc::io {

JsonLinesSink::JsonLinesSink(std::string target, OldFile old_file, TellUser tell)
    : target_(std::move(target)),
      old_file_(old_file),
      tell_(std::move(tell)),
      place_(output_place(target_)) {}

/// After a step that has failed there are no more.
template <typename Step>
void JsonLinesSink::attempt(const Step& step) {
  if (has_failed_) return;
  try {
    step();
  } catch (const std::system_error& error) {
    has_failed_ = true;
    throw std::runtime_error(name() +
                             ": cannot be written: " + std::generic_category().message(error.code().value()));
  }
}

/// Called only for the first line, because a named pipe makes its writer wait for a reader.
void JsonLinesSink::open() {
  if (is_file()) return open_partial();
  stream_.emplace(target_ == "-" ? OutputStream::standard_output() : OutputStream::device(place_.path));
}

/// Under a name that nobody else uses: what a run that was cut off has left is all that there is of it.
void JsonLinesSink::open_partial() {
  for (int number = 1; !stream_; ++number) {
    partial_ = place_.path.string() + ".partial" + (number == 1 ? "" : "-" + std::to_string(number));
    try {
      stream_.emplace(OutputStream::new_file(partial_));
    } catch (const std::system_error& error) {
      if (error.code().value() != EEXIST) throw;
    }
  }
}

void JsonLinesSink::write(const std::string& lines) {
  attempt([&] {
    if (!stream_) open();
    stream_->write(lines);
  });
}

void JsonLinesSink::on_status(const LiveStatus& status) {
  write(JsonLines::status(status));
  if (is_file()) attempt([this] { stream_->sync(); });
}

void JsonLinesSink::on_end() {
  if (!stream_ && last_lines_.empty()) return;  // the run did not begin
  write(last_lines_);
  attempt([this] {
    if (is_file()) stream_->sync();
    stream_->close();
    if (!is_file()) return;
    if (old_file_ == OldFile::kKeep) keep_and_tell(place_.path, tell_);
    std::filesystem::rename(partial_, place_.path);
  });
}

}  // namespace geoloc::io
