// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

#include "io/mavlink/fixture_files.hpp"
#include "io/mavlink/test_frames.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace geoloc::io {
namespace {

using testing::Bytes;

Bytes read_file(const std::filesystem::path& file) {
  std::ifstream input(file, std::ios::binary);
  return Bytes{std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
}

/// Flips, removes, repeats and overwrites pieces.
void damage(Bytes& bytes, std::mt19937& random) {
  const auto anywhere = [&] { return random() % bytes.size(); };
  for (int left = 1 + static_cast<int>(random() % 20); left > 0; --left) {
    const std::size_t at = anywhere();
    const std::size_t length = std::min<std::size_t>(1 + random() % 64, bytes.size() - at);
    const auto first = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    switch (random() % 4) {
      case 0:
        bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 1:
        if (length < bytes.size()) bytes.erase(first, first + static_cast<std::ptrdiff_t>(length));
        break;
      case 2: {
        const Bytes copied(first, first + static_cast<std::ptrdiff_t>(length));
        bytes.insert(bytes.begin() + static_cast<std::ptrdiff_t>(anywhere()), copied.begin(), copied.end());
        break;
      }
      default:
        std::fill_n(first, length, random() % 2 == 0 ? 0xFD : 0xFE);
    }
  }
}

TEST(HostileBytes, DamagedLogsDoNoHarm) {
  std::mt19937 random(1);
  for (const char* const name : {"flight_v2.tlog", "link_v1.tlog", "wire.tlog", "faults.tlog"}) {
    const Bytes original = read_file(testing::fixture(name));
    ASSERT_FALSE(original.empty()) << name;
    LLVMFuzzerTestOneInput(original.data(), original.size());
    for (int i = 0; i < 100; ++i) {
      Bytes damaged = original;
      damage(damaged, random);
      LLVMFuzzerTestOneInput(damaged.data(), damaged.size());
    }
  }
}

TEST(HostileBytes, NoiseDoesNoHarm) {
  std::mt19937_64 random(2);
  Bytes noise(4096);
  for (int i = 0; i < 200; ++i) {
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    LLVMFuzzerTestOneInput(noise.data(), noise.size());
  }
}

TEST(HostileBytes, RandomContentOfRightChecksumDoesNoHarm) {
  // Noise hardly ever passes the checksum: these are messages that a malicious sender could send.
  std::mt19937_64 random(3);
  Bytes messages(40'000);
  for (int i = 0; i < 20; ++i) {
    for (auto& byte : messages) byte = static_cast<std::uint8_t>(random() % (1 + random() % 256));
    messages[0] = static_cast<std::uint8_t>(0x80 | random());
    LLVMFuzzerTestOneInput(messages.data(), messages.size());
  }
}

}  // namespace
}  // namespace geoloc::io
