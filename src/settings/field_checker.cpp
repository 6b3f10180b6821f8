// SPDX-License-Identifier: Apache-2.0
#include "settings/field_checker.hpp"

namespace geoloc {

void FieldChecker::refuse(const std::string& path, const std::string& demand, const std::string& value) {
  problems_.push_back(path + " " + demand + ", but is " + value);
}

void FieldChecker::check(const std::string& path, double value, const Range& range) {
  if (!range.contains(value)) refuse(path, "must lie in " + to_text(range), to_text(value));
}

void FieldChecker::check(const std::string& path, const std::vector<int>& values, const ListRange& list) {
  if (values.size() > list.longest) {
    problems_.push_back(path + " must hold at most " + std::to_string(list.longest) + " numbers, but holds " +
                        std::to_string(values.size()));
  }
  for (std::size_t i = 0; i < values.size(); ++i) check(at(path, i), values[i], list.each);
}

void FieldChecker::check(const std::string& path, const std::string& text, const Form& form) {
  constexpr std::size_t kShown = 60;  // a hostile text may be long
  if (!form.holds(text))
    refuse(path, "must be " + std::string(form.wanted),
           '"' + text.substr(0, kShown) + (text.size() > kShown ? "…\"" : "\""));
}

void FieldChecker::check(const std::string& path, const std::map<std::string, std::string>& texts,
                         const Form& form) {
  for (const auto& [key, text] : texts) check(path + "." + key, text, form);
}

}  // namespace geoloc
