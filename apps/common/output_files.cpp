// SPDX-License-Identifier: Apache-2.0
#include "common/output_files.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "geoloc/io/output_place.hpp"
#include "geoloc/io/recording/recording_files.hpp"

namespace geoloc::apps {
namespace {

namespace fs = std::filesystem;

/// What tells files apart, by whatever links they are reached: the whole name, since a file may not be there
/// yet, and the system's number of one that is.
std::vector<std::string> identities_of(const fs::path& file) {
  std::error_code ignored;
  const fs::path name = fs::absolute(io::output_place(file).path, ignored);
  std::vector<std::string> identities{fs::weakly_canonical(name, ignored).string()};
  struct stat found {};
  if (::stat(file.c_str(), &found) == 0)
    identities.push_back(std::to_string(found.st_dev) + ":" + std::to_string(found.st_ino));
  return identities;
}

/// Files, found by their identities.
class FileIndex {
 public:
  void add(const NamedFile& named) {
    for (std::string& identity : identities_of(named.file))
      options_.emplace(std::move(identity), named.option);
  }

  /// The option that names the file; nullptr where none does.
  const std::string* find(const fs::path& file) const {
    for (const std::string& identity : identities_of(file)) {
      const auto found = options_.find(identity);
      if (found != options_.end()) return &found->second;
    }
    return nullptr;
  }

 private:
  std::map<std::string, std::string> options_;
};

/// Why nothing can be written to a new file of that name, and what to do; empty where it can.
std::string folder_fault(const fs::path& file) {
  std::error_code ignored;
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    return "there is no folder " + folder.string() + "; create it, or name another";
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    return "the folder " + folder.string() +
           " cannot be written to: " + std::generic_category().message(errno);
  return {};
}

std::string fault_of(const NamedFile& output, const FileIndex& inputs, const FileIndex& other_outputs) {
  std::error_code ignored;
  const io::OutputPlace place = io::output_place(output.file);
  if (fs::is_directory(place.path, ignored)) return "is a folder; name a file";
  if (!place.is_file) return {};
  if (const std::string* option = inputs.find(output.file))
    return "is an input of this run (" + *option + "); name another file";
  if (const std::string* option = other_outputs.find(output.file))
    return "is written by " + *option + " too; name another file";
  return folder_fault(place.path);
}

}  // namespace

void add_named(NamedFiles& files, std::string option, const std::string& file) {
  if (!file.empty()) files.push_back({std::move(option), file});
}

NamedFiles joined(const std::vector<NamedFiles>& lists) {
  NamedFiles all;
  for (const NamedFiles& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

void check_outputs(const NamedFiles& outputs, const NamedFiles& inputs) {
  std::string faults;
  FileIndex input_index, output_index;
  for (const NamedFile& input : inputs) input_index.add(input);
  for (const NamedFile& output : outputs) {
    const std::string fault = fault_of(output, input_index, output_index);
    if (!fault.empty())
      faults += (faults.empty() ? "" : "\n") + output.option + " " + output.file.string() + ": " + fault;
    output_index.add(output);
  }
  if (!faults.empty()) throw std::runtime_error(faults);
}

NamedFiles files_of_recording(const fs::path& folder) {
  NamedFiles files;
  for (const char* name : io::kRecordingFiles) files.push_back({"RECORDING", folder / name});
  return files;
}

void refuse_recording(const char* option, const fs::path& folder) {
  for (const char* name : {io::kTelemetryFile, io::kFramesFile}) {
    if (fs::exists(folder / name))
      throw std::runtime_error(std::string(option) + " " + folder.string() +
                               ": is a recording; name another folder");
  }
}

}  // namespace geoloc::apps
