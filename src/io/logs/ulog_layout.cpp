// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <charconv>

#include "io/logs/plain_numbers.hpp"
#include "io/logs/ulog.hpp"

namespace geoloc::io {
namespace {

using Definitions = std::map<std::string, std::string, std::less<>>;

constexpr std::size_t kLargestMessage = 65'535;
/// So that formats within formats, which may be empty, end.
constexpr int kDeepest = 8;
constexpr std::size_t kMostFields = 65'536;

struct PlainType {
  std::string_view name;
  char type;
};

constexpr std::array<PlainType, 12> kPlainTypes{{{"int8_t", 'b'},
                                                 {"uint8_t", 'B'},
                                                 {"bool", 'B'},
                                                 {"char", 'B'},
                                                 {"int16_t", 'h'},
                                                 {"uint16_t", 'H'},
                                                 {"int32_t", 'i'},
                                                 {"uint32_t", 'I'},
                                                 {"int64_t", 'q'},
                                                 {"uint64_t", 'Q'},
                                                 {"float", 'f'},
                                                 {"double", 'd'}}};

const PlainType* plain_type(std::string_view name) {
  for (const PlainType& type : kPlainTypes) {
    if (type.name == name) return &type;
  }
  return nullptr;
}

/// `float[4] q`.
struct Declaration {
  std::string_view type;
  std::string_view name;
  std::size_t count = 1;
  bool is_array = false;
};

std::optional<Declaration> declaration_in(std::string_view text) {
  Declaration declared;
  const std::size_t space = text.find(' ');
  if (space == std::string_view::npos) return std::nullopt;
  declared.type = text.substr(0, space);
  declared.name = text.substr(space + 1);
  const std::size_t bracket = declared.type.find('[');
  if (bracket == std::string_view::npos) return declared;
  const std::string_view count = declared.type.substr(bracket + 1);
  declared.type = declared.type.substr(0, bracket);
  declared.is_array = true;
  const auto parsed = std::from_chars(count.data(), count.data() + count.size(), declared.count);
  const bool is_whole =
      parsed.ec == std::errc{} && count.substr(static_cast<std::size_t>(parsed.ptr - count.data())) == "]";
  if (!is_whole || declared.count > kLargestMessage) return std::nullopt;
  return declared;
}

/// Lays the fields of formats one after the other.
class LayoutBuilder {
 public:
  explicit LayoutBuilder(const Definitions& definitions) : definitions_(definitions) {}

  bool add_format(std::string_view name, const std::string& prefix, int depth) {
    const auto found = definitions_.find(name);
    if (found == definitions_.end() || depth > kDeepest) return false;
    for (std::string_view rest = found->second; !rest.empty();) {
      const std::size_t end = rest.find(';');
      const std::string_view text = rest.substr(0, end);
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      if (text.empty()) continue;
      const auto declared = declaration_in(text);
      if (!declared || !add(*declared, prefix, depth)) return false;
    }
    return true;
  }

  UlogLayout take() { return std::move(layout_); }

 private:
  bool add(const Declaration& declared, const std::string& prefix, int depth) {
    const PlainType* const plain = plain_type(declared.type);
    for (std::size_t i = 0; i < declared.count; ++i) {
      if (++visited_ > kMostFields) return false;
      std::string name = prefix + std::string(declared.name);
      if (declared.is_array) name += "[" + std::to_string(i) + "]";
      if (plain == nullptr) {
        if (!add_format(declared.type, name + ".", depth + 1)) return false;
        continue;
      }
      layout_.fields[std::move(name)] = {size_, plain->type};
      size_ += plain_size(plain->type);
      if (size_ > kLargestMessage) return false;
    }
    return true;
  }

  const Definitions& definitions_;
  UlogLayout layout_;
  std::size_t size_ = 0;
  std::size_t visited_ = 0;
};

}  // namespace

std::optional<UlogLayout> ulog_layout(const Definitions& definitions, const std::string& format) {
  LayoutBuilder builder(definitions);
  if (!builder.add_format(format, "", 0)) return std::nullopt;
  return builder.take();
}

std::optional<double> UlogSample::number(std::string_view field) const {
  const auto found = layout_.fields.find(field);
  if (found == layout_.fields.end()) return std::nullopt;
  const auto [offset, type] = found->second;
  if (offset + plain_size(type) > bytes_.size()) return std::nullopt;
  return plain_number(type, bytes_.data() + offset);
}

}  // namespace geoloc::io
