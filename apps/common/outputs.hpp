// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/message_box.hpp"
#include "common/session.hpp"
#include "geoloc/io/output/geoid.hpp"
#include "geoloc/io/output/note_book.hpp"
#include "geoloc/io/output/output_frame.hpp"
#include "geoloc/io/output/sink_runner.hpp"

namespace geoloc::apps {

/// The sinks of a run, each in a thread of its own. Nothing that they do reaches the estimator: it is only
/// ever read, by the thread that owns it, and what they get are copies.
class Outputs {
 public:
  Outputs(std::vector<std::string> class_names, const io::SinkRunnerConfig& config);

  void add(std::unique_ptr<io::Sink> sink);

  /// After each frame that was given to the session; `is_located` is what it answered.
  void post_frame(const Session& session, const PendingFrame& frame, bool is_located);

  /// Now and then; a live run only.
  void post_status(const io::LiveStatus& status);
  void post_run(io::RunRecord run);

  /// After the last frame: gives them the final run and waits for all, for a bounded time.
  void finish(io::RunRecord run);

  /// An output could not be written, or was left unfinished. Final after finish().
  bool has_failed() const;

  /// For sinks that have something to tell a user themselves.
  io::SinkRunner::Tell teller() const;

  /// Whether heights above the ellipsoid can be told.
  bool has_geoid() const { return geoid_.is_installed(); }

  /// What people say of the objects, which all sinks are told.
  const std::shared_ptr<io::NoteBook>& notes() const { return notes_; }

  /// What the estimator does not know of its objects: notes and heights above the ellipsoid.
  void complete(std::vector<io::ObjectReport>& objects) const;

  /// What the sinks have to tell a user, since the last call.
  std::vector<std::string> take_messages() { return messages_->take(); }

 private:
  void complete(io::ViewReport& view) const;

  io::FrameReporter reporter_;
  io::SinkRunnerConfig config_;
  io::Geoid geoid_;
  std::shared_ptr<io::NoteBook> notes_ = std::make_shared<io::NoteBook>();
  std::shared_ptr<MessageBox> messages_ = std::make_shared<MessageBox>();  // stuck sinks outlive this object
  std::vector<std::unique_ptr<io::SinkRunner>> sinks_;
  std::vector<io::SinkRunner*> streams_;  // of the sinks, those that want frames
};

}  // namespace geoloc::apps
