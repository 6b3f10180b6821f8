// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/page_token.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "geoloc/io/sync.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kShortestToken = 16;
constexpr std::size_t kLongestToken = 256;
constexpr std::size_t kRandomBytes = 16;

/// Closes it at the end of its life.
struct Descriptor {
  int number;
  explicit Descriptor(int opened) : number(opened) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
};

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error(file.string() + ": " + reason);
}

std::string random_token() {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::array<std::uint8_t, kRandomBytes> bytes{};
  if (getentropy(bytes.data(), bytes.size()) != 0)
    throw std::runtime_error("the system has no random numbers for a token");
  std::string token;
  for (const std::uint8_t byte : bytes) {
    token += kDigits[byte >> 4U];
    token += kDigits[byte & 15U];
  }
  return token;
}

/// The file appears whole: a power cut must not leave an empty one, which would keep the next run from
/// starting. One that another program makes at the same time stays.
void make_token_file(const std::filesystem::path& file) {
  const std::string draft = file.string() + ".partial-" + std::to_string(::getpid());
  const std::string line = random_token() + "\n";
  ::unlink(draft.c_str());
  const Descriptor opened(::open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (opened.number < 0) fail_to_write(file, errno);
  int error =
      ::write(opened.number, line.data(), line.size()) == static_cast<ssize_t>(line.size()) ? 0 : errno;
  const bool is_written = error == 0 && (error = sync(opened.number)) == 0;
  const bool is_there = is_written && (::link(draft.c_str(), file.c_str()) == 0 || errno == EEXIST);
  if (is_written && !is_there) error = errno;
  ::unlink(draft.c_str());
  if (!is_there) fail_to_write(file, error);
  sync_name(file);
}

/// nullopt where there is no such file.
std::optional<std::string> read_token_file(const std::filesystem::path& file) {
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
  if (opened.number < 0 && errno == ENOENT) return std::nullopt;
  struct stat found {};
  if (opened.number < 0 || ::fstat(opened.number, &found) != 0)
    refuse(file, "cannot be read: " + std::generic_category().message(errno));
  if ((found.st_mode & (S_IROTH | S_IWOTH)) != 0)
    refuse(file, "every user of this computer can read or change the token; chmod 600 " + file.string());
  std::string text(kLongestToken + 2, '\0');
  const ssize_t size = ::read(opened.number, text.data(), text.size());
  if (size < 0) refuse(file, "cannot be read: " + std::generic_category().message(errno));
  text.resize(static_cast<std::size_t>(size));
  text.erase(text.find_last_not_of(" \t\r\n") + 1);
  return text;
}

}  // namespace

bool is_page_token(const std::string& text) {
  constexpr std::string_view kMarks = "-._~";
  return text.size() >= kShortestToken && text.size() <= kLongestToken &&
         std::all_of(text.begin(), text.end(), [kMarks](char c) {
           return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                  kMarks.find(c) != std::string_view::npos;
         });
}

std::string read_or_make_page_token(const std::filesystem::path& file) {
  std::optional<std::string> token = read_token_file(file);
  if (!token) {
    make_token_file(file);
    token = read_token_file(file);
  }
  if (!token || !is_page_token(*token))
    refuse(file,
           "holds no token: it must be one line of 16 to 256 letters, digits, '-', '.', '_' or '~'; "
           "without the file, one is made");
  return *token;
}

}  // namespace geoloc::io
