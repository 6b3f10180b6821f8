// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_objects.hpp"
#include "geoloc/io/output/live_status.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "geoloc/io/output/run_record.hpp"

namespace geoloc::io {

/// What the page shows about a run before anything has happened.
struct LivePageTitle {
  std::string name;       ///< of the run: the stream, or the recording
  bool is_live = true;    ///< otherwise a recording is replayed
  bool is_fleet = false;  ///< many flights' map, without a video or a vehicle of its own
};

/// A run in figures, for those who watch many.
struct RunFigures {
  std::optional<LiveStatus> status;  ///< of a live run
  EstimatorReport estimator;
  std::size_t objects = 0;  ///< confirmed
};

/// The state of a run as pages see it. Thread-safe; memory is bounded.
///
/// There are no queues: every part has the revision of its last change, and a page is sent what has changed
/// since the revision it has. A slow page gets the newest state later.
class LiveDocument {
 public:
  /// The revision that a page has reached. A new page starts with the default and gets everything.
  struct Cursor {
    std::uint64_t revision = 0;
    std::uint64_t path = 0;   ///< points of the trajectory
    std::uint64_t fixes = 0;  ///< raw fixes
    std::uint64_t path_epoch = 0;
    std::uint64_t objects = 0;  ///< changes of objects
    bool has_more = false;      ///< there are more objects than were sent at once
  };

  explicit LiveDocument(const LivePageTitle& title, std::size_t most_objects = LiveObjects::kMost);

  void add(const OutputFrame& frame);
  void add(const LiveStatus& status);
  void add(const RunRecord& run);
  /// Changes an operator's note of a confirmed object. nullopt for an unknown one.
  std::optional<NotedObject> note(std::uint64_t id, const ObjectNote& note);
  /// A better picture of an object, a JPEG; the object may be unknown as yet.
  void show_object(std::uint64_t id, std::string jpeg);
  /// The object is gone, or soon will be.
  void forget_picture(std::uint64_t id);
  /// nullptr where there is none.
  std::shared_ptr<const std::string> picture_of(std::uint64_t id) const;
  /// A newer picture of the video can be fetched.
  void announce_picture(std::uint64_t number);
  /// Where a replay is (ReplayControl::json()).
  void show_playback(const std::string& json);
  /// Forgets all that frames and runs told, but not the true targets: a replay begins again.
  void begin_anew();
  /// The run is over; its last state can still be viewed.
  void end();

  /// Waits until there is something newer than the cursor; false after `timeout`, and once closed.
  bool wait(const Cursor& cursor, std::chrono::milliseconds timeout) const;

  /// Waits until then; returns early once closed.
  void pause_until(std::chrono::steady_clock::time_point time) const;

  /// The changes since the cursor as a JSON object; advances the cursor.
  std::string changes(Cursor& cursor) const;

  /// JSON of one object: its coordinates in several notations, and its history. nullopt for an unknown id.
  std::optional<std::string> object(std::uint64_t id) const;

  /// The run as files tell it, without its raw fixes. The trajectory is that of the last run added.
  RunRecord record() const;

  RunFigures figures() const;

  /// Grows with every change.
  std::uint64_t revision() const;

  /// Wakes all waiting threads, and keeps them from waiting again.
  void close();
  bool is_closed() const;

 private:
  /// A part that is sent as a whole, and only if it has changed.
  struct Part {
    std::string json;
    std::uint64_t revision = 0;  // of the last change
  };
  struct Fix {
    Eigen::Vector2d position_in_enu;
    double confidence;
    HostTime at;
  };
  void count_objects();
  void add_path(const Eigen::Vector2d& position_in_enu);
  void add_fixes(const OutputFrame& frame);
  void publish();
  void set(const std::string& name, std::string json);
  void append_removals(std::uint64_t since, std::string& json) const;
  std::string path_since(const Cursor& cursor) const;
  std::string fixes_since(std::uint64_t first) const;

  mutable std::mutex mutex_;  // guards what follows
  mutable std::condition_variable changed_;
  mutable std::condition_variable closing_;
  bool is_closed_ = false;
  std::uint64_t revision_ = 0;
  std::map<std::string, Part> parts_;  // by their names in the JSON
  LiveObjects objects_;
  RunRecord run_;  // without objects
  std::optional<LiveStatus> status_;
  HostTime newest_at_{};
  std::vector<Eigen::Vector2d> path_;
  std::uint64_t path_epoch_ = 1;
  std::deque<Fix> fixes_;
  std::uint64_t fixes_end_ = 0;  // number of the fix after the newest
};

}  // namespace geoloc::io
