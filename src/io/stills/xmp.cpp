// SPDX-License-Identifier: Apache-2.0
#include <cpl_minixml.h>

#include <cstring>
#include <memory>
#include <stdexcept>

#include "geoloc/io/stills/picture_tags.hpp"
#include "io/gdal_dataset.hpp"

// A property is an attribute or an element of an rdf:Description, and either may be found beside the other
// (ISO 16684-1, 7.4).
namespace geoloc::io {
namespace {

/// Several times what cameras write; a JPEG's segment has 64 kB.
constexpr std::size_t kLargestPacket = 256u << 10;
/// Packets nest four deep.
constexpr int kDeepest = 12;

struct Destroyer {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};

using Properties = std::map<std::string, std::string>;

/// The text of an attribute, or of an element that holds nothing but text; nullptr for others.
const char* text_of(const CPLXMLNode& node) {
  const CPLXMLNode* const child = node.psChild;
  return child != nullptr && child->eType == CXT_Text ? child->pszValue : nullptr;
}

bool is_structural(const char* name) {
  return std::strncmp(name, "rdf:", 4) == 0 || std::strncmp(name, "xml", 3) == 0;
}

/// The name without its prefix, since that of the structure says whose it is.
const char* local_name(const char* name) {
  const char* const colon = std::strchr(name, ':');
  return colon == nullptr ? name : colon + 1;
}

/// `owner` is empty for what a description holds itself.
void collect_properties(const CPLXMLNode* first, const std::string& owner, int depth,
                        Properties& properties) {
  if (depth > kDeepest) return;
  for (const CPLXMLNode* node = first; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Attribute && node->eType != CXT_Element) continue;
    if (is_structural(node->pszValue)) {
      if (node->eType == CXT_Element) collect_properties(node->psChild, owner, depth + 1, properties);
      continue;
    }
    const std::string name = owner.empty() ? node->pszValue : owner + "/" + local_name(node->pszValue);
    const char* const text = text_of(*node);
    if (text != nullptr) {
      properties.emplace(name, text);
    } else if (node->eType == CXT_Element) {
      collect_properties(node->psChild, name, depth + 1, properties);
    }
  }
}

void collect_descriptions(const CPLXMLNode* first, int depth, Properties& properties) {
  if (depth > kDeepest) return;
  for (const CPLXMLNode* node = first; node != nullptr; node = node->psNext) {
    if (node->eType != CXT_Element) continue;
    if (std::strcmp(node->pszValue, "rdf:Description") == 0) {
      collect_properties(node->psChild, "", depth + 1, properties);
    } else {
      collect_descriptions(node->psChild, depth + 1, properties);
    }
  }
}

}  // namespace

std::map<std::string, std::string> parse_xmp(const std::string& packet) {
  if (packet.size() > kLargestPacket)
    throw std::runtime_error("holds " + std::to_string(packet.size()) +
                             " bytes of XMP, more than any camera's");
  const GdalErrors quiet;
  const std::unique_ptr<CPLXMLNode, Destroyer> root(CPLParseXMLString(packet.c_str()));
  if (!root) throw std::runtime_error("holds XMP that is no XML");
  Properties properties;
  collect_descriptions(root.get(), 0, properties);
  return properties;
}

}  // namespace geoloc::io
