// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "geoloc/io/output/cot_event.hpp"
#include "geoloc/io/output/csv.hpp"
#include "geoloc/io/output/markup.hpp"
#include "geoloc/io/output/text.hpp"

namespace {

using namespace geoloc;

void require(bool holds) {
  if (!holds) std::abort();
}

bool has_control_characters(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](char character) {
    return static_cast<unsigned char>(character) < 0x20 || character == 0x7F;
  });
}

}  // namespace

/// A class name of any bytes: clean text is unchanged, and it cannot escape from its field in any format.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string name(data, data + size);
  const std::string clean = io::clean_text(name);
  require(io::clean_text(clean) == clean);
  require(!has_control_characters(clean));
  require(io::ascii_text(name, 50).size() <= 50);

  const std::string markup = io::escape_markup(name);
  require(markup.find_first_of("<>\"'") == std::string::npos);
  require(!has_control_characters(markup));

  const std::string field = io::csv_field(name);
  require(std::count(field.begin(), field.end(), '"') % 2 == 0);
  require(field.empty() || field.front() == '"' || field.find(',') == std::string::npos);

  io::ObjectReport object;
  object.class_name = name;
  object.height.ellipsoid_m = 2.0;
  require(io::to_cot(object, {"uid", HostTime{}, false}, {}).size() < 1400);
  return 0;
}
