// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "geoloc/io/detection/onnx_metadata.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostClasses = 100'000;

/// Reads the part of Python's syntax that a dictionary of names needs.
class DictionaryReader {
 public:
  explicit DictionaryReader(std::string_view text) : rest_(text) {}

  bool take(char expected) {
    skip_blanks();
    if (rest_.empty() || rest_.front() != expected) return false;
    rest_.remove_prefix(1);
    return true;
  }

  bool is_at_end() {
    skip_blanks();
    return rest_.empty();
  }

  std::optional<std::size_t> take_index() {
    skip_blanks();
    std::size_t value = 0;
    std::size_t digits = 0;
    for (; digits < rest_.size() && is_digit(rest_[digits]); ++digits) {
      value = 10 * value + static_cast<std::size_t>(rest_[digits] - '0');
      if (value >= kMostClasses) return std::nullopt;
    }
    rest_.remove_prefix(digits);
    return digits > 0 ? std::optional{value} : std::nullopt;
  }

  std::optional<std::string> take_string() {
    skip_blanks();
    if (rest_.empty() || (rest_.front() != '\'' && rest_.front() != '"')) return std::nullopt;
    const char quote = rest_.front();
    std::string text;
    for (std::size_t i = 1; i < rest_.size(); ++i) {
      if (rest_[i] == quote) {
        rest_.remove_prefix(i + 1);
        return text;
      }
      // Names need only the escapes of the quotes and of the backslash itself.
      if (rest_[i] == '\\' && i + 1 < rest_.size()) ++i;
      text += rest_[i];
    }
    return std::nullopt;
  }

 private:
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  void skip_blanks() {
    const auto blanks = rest_.find_first_not_of(" \t\r\n");
    rest_.remove_prefix(blanks == std::string_view::npos ? rest_.size() : blanks);
  }

  std::string_view rest_;
};

}  // namespace

std::optional<std::vector<std::string>> parse_class_names(std::string_view dictionary) {
  DictionaryReader reader{dictionary};
  std::map<std::size_t, std::string> names;
  if (!reader.take('{')) return std::nullopt;
  while (!reader.take('}')) {
    if (!names.empty() && !reader.take(',')) return std::nullopt;
    const auto index = reader.take_index();
    if (!index || !reader.take(':')) return std::nullopt;
    auto name = reader.take_string();
    if (!name || !names.emplace(*index, std::move(*name)).second) return std::nullopt;
  }
  if (names.empty() || !reader.is_at_end() || names.rbegin()->first != names.size() - 1) return std::nullopt;
  std::vector<std::string> in_order;
  in_order.reserve(names.size());
  for (auto& [index, name] : names) in_order.push_back(std::move(name));
  return in_order;
}

}  // namespace geoloc::io
