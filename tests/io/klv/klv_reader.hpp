// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>

// A reader of local sets by the words of MISB ST 0601 and SMPTE ST 336, apart from the writer under test.
namespace geoloc::testing {

inline std::uint64_t big_endian_number(std::string_view bytes) {
  std::uint64_t number = 0;
  for (const char byte : bytes) number = 256 * number + static_cast<unsigned char>(byte);
  return number;
}

/// Two's complement.
inline std::int64_t signed_number(std::string_view bytes) {
  const std::uint64_t number = big_endian_number(bytes), half = std::uint64_t{1} << (8 * bytes.size() - 1);
  return number < half ? static_cast<std::int64_t>(number)
                       : static_cast<std::int64_t>(number - half) - static_cast<std::int64_t>(half);
}

/// The items of the set by their tags. Throws std::runtime_error where the set is not as it must be.
class KlvReader {
 public:
  explicit KlvReader(std::string_view set) : bytes_(set) {
    constexpr std::size_t kKey = 16;
    at_ = kKey;
    const std::size_t length = read_length();
    require(at_ + length == set.size(), "its length");
    while (at_ < set.size()) read_item();
    require(last_tag_ == 1 && items_[1].size() == 2, "a checksum at its end");
    require(first_tag_ == 2 && items_[2].size() == 8, "its time at its beginning");
    require(big_endian_number(items_[1]) == sum_of_words(set.substr(0, set.size() - 2)), "its checksum");
  }

  bool has(int tag) const { return items_.count(tag) != 0; }
  std::string_view item(int tag) const { return items_.at(tag); }
  std::size_t count() const { return items_.size(); }

  double unsigned_value(int tag, double low, double high) const {
    const double steps = static_cast<double>((std::uint64_t{1} << (8 * item(tag).size())) - 1);
    return low + (high - low) / steps * static_cast<double>(big_endian_number(item(tag)));
  }
  double signed_value(int tag, double high) const {
    const double steps = static_cast<double>((std::uint64_t{1} << (8 * item(tag).size())) - 2);
    return 2.0 * high / steps * static_cast<double>(signed_number(item(tag)));
  }

 private:
  static void require(bool holds, const char* what) {
    if (!holds) throw std::runtime_error(std::string("not a local set: ") + what);
  }

  std::uint8_t next() { return static_cast<std::uint8_t>(bytes_.at(at_++)); }

  std::size_t read_length() {
    std::size_t length = next();
    if (length < 128) return length;
    const std::size_t bytes = length - 128;
    length = big_endian_number(bytes_.substr(at_, bytes));
    at_ += bytes;
    return length;
  }

  void read_item() {
    last_tag_ = next();
    if (items_.empty()) first_tag_ = last_tag_;
    const std::size_t length = read_length();
    require(at_ + length <= bytes_.size() && items_.count(last_tag_) == 0, "an item");
    items_[last_tag_] = bytes_.substr(at_, length);
    at_ += length;
  }

  static std::uint64_t sum_of_words(std::string_view bytes) {
    std::string padded(bytes);
    if (padded.size() % 2 != 0) padded += '\0';
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < padded.size(); i += 2)
      sum += big_endian_number(std::string_view(padded).substr(i, 2));
    return sum % 0x10000;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  int first_tag_ = 0, last_tag_ = 0;
  std::map<int, std::string_view> items_;
};

}  // namespace geoloc::testing
