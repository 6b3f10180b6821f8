// SPDX-License-Identifier: Apache-2.0
#include "app/recorder.hpp"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>
#include <variant>

#include "common/message_box.hpp"
#include "geoloc/io/write_failure.hpp"

namespace geoloc::apps {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr auto kWritePeriod = std::chrono::milliseconds{100};
constexpr auto kSyncPeriod = std::chrono::seconds{1};
constexpr auto kDiskPatience = std::chrono::seconds{10};

}  // namespace

struct Recorder::State {
  struct Telemetry {
    HostTime received_at;
    std::vector<std::uint8_t> frame;
  };
  struct Picture {
    std::uint64_t object_id;
    std::optional<std::string> jpeg;  ///< nullopt: there is none any more
  };
  using Entry = std::variant<Telemetry, io::RecordedFrame, io::NotedObject, Picture>;

  explicit State(std::size_t its_bound_bytes) : most_waiting_bytes(its_bound_bytes) {}

  bool begin(const std::string& folder, const Write& write_settings);
  void run();
  bool add(Entry entry);
  void close(Write its_last);
  bool wait_until_done();
  void give_up(const std::string& reason);

  const std::size_t most_waiting_bytes;
  std::optional<io::RecordingWriter> writer;  // the thread's, once that runs
  MessageBox messages;

  std::mutex mutex;  // guards what follows
  std::condition_variable has_closed;
  std::condition_variable has_moved;
  std::vector<Entry> waiting;
  std::size_t waiting_bytes = 0;
  std::uint64_t moves = 0;  // entries written, syncs
  std::uint64_t telemetry_left_out = 0;
  std::uint64_t frames_left_out = 0;
  Write write_last;  // once closed
  bool is_closed = false;
  bool is_done = false;
  bool has_failed = false;

 private:
  static std::size_t size_bytes(const Entry& entry);
  void record_until_closed();
  void write(const Entry& entry);
  void write_picture(const Picture& picture);
  bool take_waiting(std::vector<Entry>& batch);
  void note_move();
};

/// What an entry takes in memory, about.
std::size_t Recorder::State::size_bytes(const Entry& entry) {
  if (const auto* telemetry = std::get_if<Telemetry>(&entry)) return sizeof entry + telemetry->frame.size();
  if (const auto* noted = std::get_if<io::NotedObject>(&entry)) return sizeof entry + noted->note.name.size();
  if (const auto* picture = std::get_if<Picture>(&entry))
    return sizeof entry + (picture->jpeg ? picture->jpeg->size() : 0);
  return sizeof entry + std::get<io::RecordedFrame>(entry).detections.size() * sizeof(Detection);
}

void Recorder::State::write(const Entry& entry) {
  if (const auto* telemetry = std::get_if<Telemetry>(&entry)) {
    writer->add_telemetry(telemetry->received_at, telemetry->frame.data(), telemetry->frame.size());
  } else if (const auto* noted = std::get_if<io::NotedObject>(&entry)) {
    writer->add_note(*noted);
  } else if (const auto* picture = std::get_if<Picture>(&entry)) {
    write_picture(*picture);
  } else {
    writer->add_frame(std::get<io::RecordedFrame>(entry));
  }
}

void Recorder::State::write_picture(const Picture& picture) {
  if (picture.jpeg) {
    writer->write_picture(picture.object_id, *picture.jpeg);
  } else {
    writer->remove_picture(picture.object_id);
  }
}

/// False where the disk does not take it, which is no reason not to fly.
bool Recorder::State::begin(const std::string& folder, const Write& write_settings) {
  try {
    writer.emplace(folder, io::NameTaken::kNumber);
    if (writer->folder() != folder)
      messages.post("recording into " + writer->folder().string() + ": " + folder +
                    " is taken by another run, or by what is left of one");
    write_settings(*writer);
  } catch (const io::WriteFailure& failure) {
    if (!failure.is_of_disk() && !writer) throw;
    give_up(failure.what());
    return false;
  }
  return true;
}

void Recorder::State::run() {
  try {
    record_until_closed();
    if (write_last) write_last(*writer);
    writer->finish();
  } catch (const std::exception& error) {
    give_up(error.what());
  }
  const std::lock_guard lock(mutex);
  is_done = true;
  has_moved.notify_all();
}

void Recorder::State::record_until_closed() {
  auto sync_at = SteadyClock::now() + kSyncPeriod;
  std::vector<Entry> batch;
  for (bool goes_on = true; goes_on;) {
    goes_on = take_waiting(batch);
    for (const Entry& entry : batch) {
      write(entry);
      note_move();
    }
    batch.clear();
    if (SteadyClock::now() < sync_at) continue;
    sync_at = SteadyClock::now() + kSyncPeriod;
    writer->sync();
    note_move();
  }
}

/// What has come within a period. False where nothing more will.
bool Recorder::State::take_waiting(std::vector<Entry>& batch) {
  std::unique_lock lock(mutex);
  const bool is_last = has_closed.wait_for(lock, kWritePeriod, [this] { return is_closed; });
  batch.swap(waiting);
  waiting_bytes = 0;
  return !is_last;
}

void Recorder::State::note_move() {
  const std::lock_guard lock(mutex);
  ++moves;
  has_moved.notify_all();
}

void Recorder::State::give_up(const std::string& reason) {
  messages.post("recording stopped, the run goes on: " + reason +
                (writer ? "; what was written stays in " + writer->partial_folder().string() : ""));
  const std::lock_guard lock(mutex);
  has_failed = true;
  waiting.clear();
}

/// False where it is left out.
bool Recorder::State::add(Entry entry) {
  const std::lock_guard lock(mutex);
  if (has_failed) return false;
  const std::size_t size = size_bytes(entry);
  if (waiting_bytes + size > most_waiting_bytes) {
    if (telemetry_left_out + frames_left_out == 0)
      messages.post("recording: the disk does not keep up, telemetry and frames are left out of " +
                    writer->folder().string());
    ++(std::holds_alternative<Telemetry>(entry) ? telemetry_left_out : frames_left_out);
    return false;
  }
  waiting_bytes += size;
  waiting.push_back(std::move(entry));
  return true;
}

void Recorder::State::close(Write its_last) {
  const std::lock_guard lock(mutex);
  write_last = std::move(its_last);
  is_closed = true;
  has_closed.notify_all();
}

/// False where the disk has made no progress for too long.
bool Recorder::State::wait_until_done() {
  std::unique_lock lock(mutex);
  while (!is_done) {
    const std::uint64_t seen = moves;
    if (!has_moved.wait_for(lock, kDiskPatience, [&] { return is_done || moves != seen; })) return false;
  }
  return true;
}

Recorder::Recorder(const std::string& folder, const Write& write_settings, std::size_t most_waiting_bytes) {
  if (folder.empty()) return;
  state_ = std::make_shared<State>(most_waiting_bytes);
  if (state_->begin(folder, write_settings)) thread_ = std::thread([state = state_] { state->run(); });
}

Recorder::~Recorder() {
  finish();
}

void Recorder::add_telemetry(HostTime received_at, const std::uint8_t* frame, std::size_t size) {
  if (state_ && state_->add(State::Telemetry{received_at, {frame, frame + size}})) ++telemetry_records_;
}

void Recorder::add_frame(io::RecordedFrame frame) {
  if (state_) state_->add(std::move(frame));
}

void Recorder::add_note(io::NotedObject noted) {
  if (state_) state_->add(std::move(noted));
}

void Recorder::add_picture(std::uint64_t object_id, const std::string& jpeg) {
  if (state_) state_->add(State::Picture{object_id, jpeg});
}

void Recorder::remove_picture(std::uint64_t object_id) {
  if (state_) state_->add(State::Picture{object_id, std::nullopt});
}

std::vector<std::string> Recorder::take_messages() {
  return state_ ? state_->messages.take() : std::vector<std::string>{};
}

bool Recorder::has_failed() const {
  if (!state_) return false;
  const std::lock_guard lock(state_->mutex);
  return state_->has_failed || state_->telemetry_left_out + state_->frames_left_out > 0;
}

void Recorder::finish(Write write_last) {
  if (!thread_.joinable()) return;
  state_->close(std::move(write_last));
  if (state_->wait_until_done()) {
    thread_.join();
  } else {
    thread_.detach();
    state_->give_up("the disk does not answer");
  }
  const std::lock_guard lock(state_->mutex);
  if (state_->telemetry_left_out + state_->frames_left_out > 0)
    state_->messages.post("recording: " + std::to_string(state_->telemetry_left_out) +
                          " records of telemetry and " + std::to_string(state_->frames_left_out) +
                          " frames were left out");
}

}  // namespace geoloc::apps
