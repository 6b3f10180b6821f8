// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/growing_output.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace geoloc::io {

GrowingOutput::GrowingOutput(std::string option, std::string target, OldFile old_file, TellUser tell)
    : option_(std::move(option)),
      target_(std::move(target)),
      old_file_(old_file),
      tell_(std::move(tell)),
      place_(output_place(target_)) {}

/// After a step that has failed there are no more.
template <typename Step>
void GrowingOutput::attempt(const Step& step) {
  if (has_failed_) return;
  try {
    step();
  } catch (const std::system_error& error) {
    has_failed_ = true;
    throw std::runtime_error(name() +
                             ": cannot be written: " + std::generic_category().message(error.code().value()));
  }
}

void GrowingOutput::open() {
  if (is_file()) return open_partial();
  stream_.emplace(target_ == "-" ? OutputStream::standard_output() : OutputStream::device(place_.path));
}

/// Under a name that nobody else uses: what a run that was cut off has left is all that there is of it.
void GrowingOutput::open_partial() {
  for (int number = 1; !stream_; ++number) {
    partial_ = place_.path.string() + ".partial" + (number == 1 ? "" : "-" + std::to_string(number));
    try {
      stream_.emplace(OutputStream::new_file(partial_));
    } catch (const std::system_error& error) {
      if (error.code().value() != EEXIST) throw;
    }
  }
}

void GrowingOutput::write(std::string_view bytes) {
  attempt([&] {
    if (!stream_) open();
    stream_->write(bytes);
  });
}

void GrowingOutput::sync() {
  if (stream_ && is_file()) attempt([this] { stream_->sync(); });
}

void GrowingOutput::finish() {
  if (!stream_) return;
  attempt([this] {
    if (is_file()) stream_->sync();
    stream_->close();
    if (!is_file()) return;
    if (old_file_ == OldFile::kKeep) keep_and_tell(place_.path, tell_);
    std::filesystem::rename(partial_, place_.path);
  });
}

}  // namespace geoloc::io
