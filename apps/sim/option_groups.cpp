// SPDX-License-Identifier: Apache-2.0
#include "sim/option_groups.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace geoloc::sim {
namespace {

/// Groups that stand in none, such as that of --seed, have an effect in every mode.
bool has_effect(const std::string& group, Mode mode) {
  static const std::array<std::pair<const char*, std::vector<Mode>>, 8> kModes{{
      {kFlightGroup, {Mode::kLive, Mode::kRecord}},
      {kCameraGroup, {Mode::kLive, Mode::kRecord}},
      {kHiddenGroup, {Mode::kLive, Mode::kRecord}},
      {kHiddenInRecordingsGroup, {Mode::kRecord}},
      {kRecordGroup, {Mode::kRecord}},
      {kLiveGroup, {Mode::kLive}},
      {kLinkGroup, {Mode::kLive}},
      {kImagesGroup, {Mode::kImages}},
  }};
  for (const auto& [name, modes] : kModes) {
    if (group == name) return std::find(modes.begin(), modes.end(), mode) != modes.end();
  }
  return true;
}

const char* name_of(Mode mode) {
  switch (mode) {
    case Mode::kLive:
      return "in a live run (without --record and --images)";
    case Mode::kRecord:
      return "with --record";
    case Mode::kImages:
      return "with --images";
  }
  return "";
}

}  // namespace

std::string options_without_effect(const CLI::App& program, Mode mode) {
  std::string names;
  for (const CLI::Option* option : program.get_options()) {
    if (option->count() > 0 && !has_effect(option->get_group(), mode))
      names += (names.empty() ? "" : ", ") + option->get_name();
  }
  return names.empty() ? "" : names + ": without effect " + name_of(mode) + "; leave it out";
}

}  // namespace geoloc::sim
