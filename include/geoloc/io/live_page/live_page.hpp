// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "geoloc/io/live_page/live_document.hpp"
#include "geoloc/io/live_page/live_page_config.hpp"
#include "geoloc/io/live_page/live_site.hpp"
#include "geoloc/io/live_page/picture_board.hpp"
#include "geoloc/io/live_page/replay_control.hpp"
#include "geoloc/io/output/note_book.hpp"
#include "geoloc/io/output/sink.hpp"

namespace geoloc::io {

class HttpServer;

/// What a page can have besides.
struct LivePageParts {
  std::string token = {};  ///< only those who have it get an answer (is_page_token()); empty: everyone
  std::shared_ptr<NoteBook> notes = std::make_shared<NoteBook>();
  std::shared_ptr<ReplayControl> playback = nullptr;  ///< of a replay
  PageMap map = {};
};

/// A page that shows a run in any browser, served over HTTP by its own threads. Adding to it costs the caller
/// the same however many pages are open: pages wait for the run, but the run never waits for a page.
class LivePage {
 public:
  /// Listens at once. Throws std::runtime_error that names the endpoint, the reason and the remedy, and
  /// std::invalid_argument naming every problem of the configuration.
  LivePage(const HttpEndpoint& endpoint, const LivePageConfig& config, const LivePageTitle& title,
           const std::vector<std::string>& class_names, LivePageParts parts = {});
  /// Ends every connection at once.
  ~LivePage();
  LivePage(const LivePage&) = delete;
  LivePage& operator=(const LivePage&) = delete;

  void add(const OutputFrame& frame) { document_.add(frame); }
  void add(const LiveStatus& status) { document_.add(status); }
  void add(const RunRecord& run) { document_.add(run); }
  void end() { document_.end(); }
  void begin_anew() { document_.begin_anew(); }
  void show_playback(const std::string& json) { document_.show_playback(json); }

  void show_object(std::uint64_t id, std::string jpeg) { document_.show_object(id, std::move(jpeg)); }
  void forget_picture(std::uint64_t id) { document_.forget_picture(id); }

  bool wants_picture() const { return board_.wants_picture(); }
  void show(LivePicture picture) { document_.announce_picture(board_.show(std::move(picture))); }

  /// Where a browser on this computer finds it: "http://127.0.0.1:8080/".
  std::string url() const;

  /// Where other devices find it that know this computer by `address`, unless a host was given: then by that.
  std::string url_for_others(const std::string& address) const;

  /// What it asks for; empty where it asks for none.
  const std::string& token() const { return token_; }

  /// Whether other computers can reach it.
  bool is_open_to_network() const;

 private:
  bool is_on_every_interface() const;
  std::string url_of(const std::string& host) const;
  bool note(std::uint64_t object_id, const ObjectNote& note);
  PageActions actions(std::shared_ptr<ReplayControl> playback);

  HttpEndpoint endpoint_;
  std::string token_;
  std::shared_ptr<NoteBook> notes_;
  LiveDocument document_;
  PictureBoard board_;
  LiveSite site_;
  std::unique_ptr<HttpServer> server_;  // last: it uses all of the above
};

/// Feeds a page that outlives the run, until its last owner releases it.
class LivePageSink final : public Sink {
 public:
  explicit LivePageSink(std::shared_ptr<LivePage> page) : page_(std::move(page)) {}

  std::string name() const override { return "--http"; }
  void on_frame(const OutputFrame& frame) override { page_->add(frame); }
  void on_status(const LiveStatus& status) override { page_->add(status); }
  void on_run(const RunRecord& run) override { page_->add(run); }
  void on_end() override { page_->end(); }

 private:
  std::shared_ptr<LivePage> page_;
};

}  // namespace geoloc::io
