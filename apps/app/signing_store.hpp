// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "geoloc/io/mavlink/mavlink_config.hpp"
#include "geoloc/io/mavlink/signing.hpp"

namespace geoloc::apps {

/// Keeps the stamps of a signed link over restarts, in a file that a thread of its own writes: a slow disk
/// delays nothing. The file is seconds old where the power fails; LinkSigning allows for that.
class SigningStore {
 public:
  /// Reads the file, if there is one, and shows that it can be written. Throws std::runtime_error naming it,
  /// the reason and the remedy.
  explicit SigningStore(std::filesystem::path file);
  ~SigningStore();
  SigningStore(const SigningStore&) = delete;
  SigningStore& operator=(const SigningStore&) = delete;

  /// As the file had them.
  const io::SigningStamps& known() const { return known_; }

  /// What a person should know of the file; empty where all is well.
  const std::string& remark() const { return remark_; }

  /// To be called now and then; does not wait.
  void keep(const io::SigningStamps& stamps);

 private:
  void read();
  void run();

  std::filesystem::path file_;
  io::SigningStamps known_;
  std::string remark_;
  std::mutex mutex_;
  std::condition_variable is_over_;
  bool is_asked_to_end_ = false;
  io::SigningStamps newest_;
  std::thread writer_;
};

/// Where the configuration says, or beside the key.
std::filesystem::path signing_state_file(const io::MavlinkConfig& config);

/// Throws std::runtime_error naming the file and the remedy.
io::SigningKey read_signing_key(const std::filesystem::path& file);

}  // namespace geoloc::apps
