// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>

#include "geoloc/io/sync.hpp"

namespace geoloc::io {

/// What bytes are written to: a file, a device, a FIFO, or a socket of the file system. Its functions throw
/// std::system_error with the system's reason; a FIFO's opening waits for a reader.
class OutputStream {
 public:
  /// A file that is created, or emptied.
  static OutputStream file(const std::filesystem::path& name) {
    return OutputStream(checked(::open(name.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)));
  }

  /// A file that is not there yet; the error is EEXIST where it is.
  static OutputStream new_file(const std::filesystem::path& name) {
    return OutputStream(checked(::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666)));
  }

  /// Something that is there already, and is no file.
  static OutputStream device(const std::filesystem::path& name) {
    std::error_code ignored;
    if (std::filesystem::is_socket(name, ignored)) return OutputStream(connected(name));
    return OutputStream(checked(::open(name.c_str(), O_WRONLY | O_TRUNC | O_NOCTTY | O_CLOEXEC)));
  }

  static OutputStream standard_output() { return OutputStream(STDOUT_FILENO); }

  OutputStream(OutputStream&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  OutputStream& operator=(OutputStream&&) = delete;
  ~OutputStream() {
    if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
  }

  void write(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno != EINTR) checked(-1);
      if (written > 0) bytes.remove_prefix(static_cast<std::size_t>(written));
    }
  }

  /// What was written survives a power cut from now on.
  void sync() {
    if (const int error = io::sync(descriptor_); error != 0)
      throw std::system_error(error, std::generic_category());
  }

  /// Nothing can be written afterwards.
  void close() {
    const int descriptor = std::exchange(descriptor_, -1);
    if (descriptor > STDERR_FILENO) checked(::close(descriptor));
  }

 private:
  explicit OutputStream(int descriptor) : descriptor_(descriptor) {}

  static int checked(int result) {
    if (result < 0) throw std::system_error(errno, std::generic_category());
    return result;
  }

  static int connected(const std::filesystem::path& name) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (name.native().size() >= sizeof address.sun_path)
      throw std::system_error(ENAMETOOLONG, std::generic_category());
    name.native().copy(address.sun_path, name.native().size());
    OutputStream socket(checked(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)));
    checked(::connect(socket.descriptor_, reinterpret_cast<const sockaddr*>(&address), sizeof address));
    return std::exchange(socket.descriptor_, -1);
  }

  int descriptor_;
};

}  // namespace geoloc::io
