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

namespace geoloc::io {

JsonLinesSink::JsonLinesSink(std::string target) : target_(std::move(target)) {}

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
  const bool is_file = is_file_or_none(target_);
  if (is_file) partial_ = target_ + ".partial";
  descriptor_ = ::open(is_file ? partial_.c_str() : target_.c_str(),
                       O_WRONLY | O_CLOEXEC | (is_file ? O_CREAT | O_TRUNC : 0), 0666);
  if (descriptor_ < 0) fail(errno);
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

void JsonLinesSink::on_end() {
  write(last_lines_);
  if (has_failed_ || partial_.empty()) return;
  if (close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (std::rename(partial_.c_str(), target_.c_str()) != 0) fail(errno);
}

}  // namespace geoloc::io
