// SPDX-License-Identifier: Apache-2.0
#include "replay/late_notes.hpp"

#include <cstdio>
#include <exception>
#include <utility>

#include "geoloc/io/recording/notes_file.hpp"

namespace geoloc::apps {

bool keep_notes(const std::string& recording, const Outputs& outputs) {
  const auto notes = outputs.notes()->take_added();
  if (notes.empty()) return false;
  try {
    io::append_notes(recording, notes);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "geoloc_replay: notes are in the results, but not in the recording: %s\n",
                 error.what());
  }
  return true;
}

bool write_noted_objects(const OutputOptions& options, const EstimationConfig& config,
                         const std::vector<std::string>& class_names, const Outputs& outputs,
                         io::RunRecord record) {
  OutputOptions files;
  files.objects = options.objects;
  files.csv = options.csv;
  files.kml = options.kml;
  Outputs again(class_names, {});
  add_sinks(files, config, io::OldFile::kReplace, again);
  outputs.notes()->apply(record.objects);
  again.finish(std::move(record));
  for (const std::string& message : again.take_messages())
    std::fprintf(stderr, "geoloc_replay: %s\n", message.c_str());
  return !again.has_failed();
}

}  // namespace geoloc::apps
