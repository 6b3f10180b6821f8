// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace geoloc::apps {

/// A file of the command line, and the option that names it.
struct NamedFile {
  std::string option;
  std::filesystem::path file;
};
using NamedFiles = std::vector<NamedFile>;

/// Adds the file unless its name is empty.
void add_named(NamedFiles& files, std::string option, const std::string& file);

/// One list of several.
NamedFiles joined(const std::vector<NamedFiles>& lists);

/// Before anything starts: throws std::runtime_error that lists each output which would take the place of an
/// input or of another output, is a folder, or lies in a folder that is not there or not writable. Devices,
/// FIFOs and sockets are written to, so only files take a place.
void check_outputs(const NamedFiles& outputs, const NamedFiles& inputs);

/// The files that a recording is made of, there or not; an output that took the place of one would spoil it.
NamedFiles files_of_recording(const std::filesystem::path& folder);

/// Throws std::runtime_error where the folder for an output is a recording.
void refuse_recording(const char* option, const std::filesystem::path& folder);

}  // namespace geoloc::apps
