// SPDX-License-Identifier: Apache-2.0
#include "app/signing_store.hpp"

#include <chrono>
#include <stdexcept>
#include <utility>

#include "geoloc/io/atomic_file.hpp"
#include "geoloc/io/text_file.hpp"

namespace geoloc::apps {
namespace {

constexpr auto kPeriod = std::chrono::seconds{10};
constexpr std::size_t kLongestFile = 256;  // bytes, of a key or of stamps

}  // namespace

SigningStore::SigningStore(std::filesystem::path file) : file_(std::move(file)) {
  read();
  newest_ = known_;
  try {
    io::write_file_atomically(file_, io::to_text(known_));
  } catch (const std::exception& error) {
    throw std::runtime_error(std::string(error.what()) +
                             "; the stamps of signed messages are kept there: name another file as "
                             "mavlink.signing_state_file");
  }
  writer_ = std::thread([this] { run(); });
}

SigningStore::~SigningStore() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_asked_to_end_ = true;
  }
  is_over_.notify_all();
  writer_.join();
}

/// A file that a power cut has damaged must not keep a vehicle on the ground.
void SigningStore::read() {
  if (!std::filesystem::exists(file_)) return;
  std::optional<io::SigningStamps> stamps;
  try {
    stamps = io::parse_signing_stamps(io::read_text_file(file_, kLongestFile));
  } catch (const std::exception&) {
    stamps.reset();
  }
  if (stamps) {
    known_ = *stamps;
  } else {
    remark_ =
        file_.string() +
        ": holds no stamps of signed messages and is begun anew: until the vehicle is heard, messages of "
        "earlier flights would be taken for new ones";
  }
}

void SigningStore::keep(const io::SigningStamps& stamps) {
  const std::lock_guard<std::mutex> lock(mutex_);
  newest_ = stamps;
}

void SigningStore::run() {
  io::SigningStamps written = known_;
  std::unique_lock<std::mutex> lock(mutex_);
  for (bool is_last = false; !is_last;) {
    is_last = is_over_.wait_for(lock, kPeriod, [this] { return is_asked_to_end_; });
    const io::SigningStamps stamps = newest_;
    if (stamps == written) continue;
    lock.unlock();
    try {
      io::write_file_atomically(file_, io::to_text(stamps));
      written = stamps;
    } catch (const std::exception&) {
      // A full disk has its own message; this is tried again.
    }
    lock.lock();
  }
}

std::filesystem::path signing_state_file(const io::MavlinkConfig& config) {
  const std::string& stated = config.signing_state_file;
  return stated.empty() ? config.signing_key_file + ".stamps" : stated;
}

io::SigningKey read_signing_key(const std::filesystem::path& file) {
  const auto key = io::parse_signing_key(io::read_text_file(file, kLongestFile));
  if (!key)
    throw std::runtime_error(
        file.string() +
        ": no signing key: it must hold 32 bytes, or 64 hexadecimal digits, as in: openssl rand -hex "
        "32 > " +
        file.string());
  return *key;
}

}  // namespace geoloc::apps
