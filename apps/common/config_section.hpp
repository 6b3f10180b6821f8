// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "geoloc/io/json/fields.hpp"

namespace geoloc::apps {

/// Reads the object under `key`, if there is one, into a structure that visit_fields() describes.
template <typename Section>
void read_section(const nlohmann::json& document, const char* key, Section& section,
                  std::vector<std::string>& problems) {
  if (!document.is_object()) return;
  const auto found = document.find(key);
  if (found == document.end()) return;
  io::FieldReader reader(*found, key, problems);
  visit_fields(reader, section);
  reader.refuse_unknown();
}

template <typename Section>
nlohmann::ordered_json section_to_json(const Section& section) {
  io::FieldWriter writer;
  Section copy = section;  // one description serves reading and writing, so it takes mutable fields
  visit_fields(writer, copy);
  return writer.take();
}

/// Adds a line for each setting of a section.
template <typename Section>
void list_section(const char* key, std::vector<io::FieldLine>& lines) {
  io::FieldLister lister(lines, key);
  Section defaults;
  visit_fields(lister, defaults);
}

}  // namespace geoloc::apps
