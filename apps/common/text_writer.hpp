// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>

namespace geoloc::apps {

/// Writes texts to a descriptor that may block for ever, such as a stopped terminal or a pipe that nobody
/// reads. A thread of its own writes, and post() never waits for it. While too many texts wait, the oldest
/// are left out, and how many is said in their place. After an error (the terminal is gone, the pipe has no
/// reader) nothing more is written.
class TextWriter {
 public:
  explicit TextWriter(int descriptor, std::size_t most_waiting = 256);
  /// finish(), for a second.
  ~TextWriter();
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  void post(std::string text);

  /// Waits until all is written, so long at most, and ends. False where something could not be written: then
  /// the thread is abandoned if it is stuck in a write, and shares nothing with the rest of the program.
  bool finish(std::chrono::milliseconds patience);

 private:
  struct State;

  std::shared_ptr<State> state_;  // the thread's too: it may outlive this object
  std::thread thread_;
};

}  // namespace geoloc::apps
