// SPDX-License-Identifier: Apache-2.0
#include "app/recorder.hpp"

#include <cstdio>

namespace geoloc::apps {

Recorder::Recorder(const std::string& folder) {
  if (!folder.empty()) writer_.emplace(folder);
}

void Recorder::finish() {
  write([](io::RecordingWriter& writer) { writer.finish(); });
  writer_.reset();
}

void Recorder::give_up(const char* reason) {
  std::fprintf(stderr, "geoloc_app: recording stopped, the run goes on: %s\n", reason);
  has_failed_ = true;
  writer_.reset();
}

}  // namespace geoloc::apps
