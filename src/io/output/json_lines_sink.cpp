// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/json_lines_sink.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/sync.hpp"

namespace geoloc::io {

JsonLinesSink::JsonLinesSink(std::string target, OldFile old_file, TellUser tell)
    : target_(std::move(target)), old_file_(old_file), tell_(std::move(tell)) {}

JsonLinesSink::~JsonLinesSink() {
  if (descriptor_ > STDERR_FILENO) close(descriptor_);
}

void JsonLinesSink::fail(int error) {
  has_failed_ = true;
  throw std::runtime_error(name() + ": cannot be written: " + std::generic_category().message(error));
}

/// Called only for the first line, because a named pipe makes its writer wait for a reader.
void JsonLinesSink::open() {
  if (target_ == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  descriptor_ = is_file_or_none(target_) ? open_partial() : ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
  if (descriptor_ < 0) fail(errno);
}

/// Under a name that nobody else uses: what a run that was cut off has left is all that there is of it.
int JsonLinesSink::open_partial() {
  for (int number = 1;; ++number) {
    partial_ = target_ + ".partial" + (number == 1 ? "" : "-" + std::to_string(number));
    const int descriptor = ::open(partial_.c_str(), O_WRONLY | O_CLOEXEC | O_CREAT | O_EXCL, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
}

void JsonLinesSink::write(const std::string& lines) {
  if (has_failed_) return;
  if (descriptor_ < 0) open();
  for (std::size_t done = 0; done < lines.size();) {
    const ssize_t written = ::write(descriptor_, lines.data() + done, lines.size() - done);
    if (written < 0 && errno != EINTR) fail(errno);
    if (written > 0) done += static_cast<std::size_t>(written);
  }
}

void JsonLinesSink::on_status(const LiveStatus& status) {
  write(JsonLines::status(status));
  if (has_failed_ || partial_.empty()) return;
  if (const int error = sync(descriptor_); error != 0) fail(error);
}

void JsonLinesSink::on_end() {
  if (descriptor_ < 0 && last_lines_.empty()) return;  // the run did not begin
  write(last_lines_);
  if (has_failed_ || partial_.empty()) return;
  if (const int error = sync(descriptor_); error != 0) fail(error);
  if (close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (old_file_ == OldFile::kKeep) keep_and_tell(target_, tell_);
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) fail(errno);
}

}  // namespace geoloc::io
