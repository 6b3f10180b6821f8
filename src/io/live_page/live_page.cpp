// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_page.hpp"

#include <chrono>
#include <cmath>

#include "geoloc/geometry/refuse.hpp"
#include "geoloc/io/endpoint.hpp"
#include "http_server.hpp"

namespace geoloc::io {
namespace {

constexpr std::chrono::milliseconds kHeartbeat{1000};
constexpr std::size_t kShortConnections = 32;  // besides the pages' streams: files and pictures

HttpLimits limits_of(const LivePageConfig& config) {
  refuse_if_any(config.problems());
  HttpLimits limits;
  limits.event_streams = static_cast<std::size_t>(config.max_pages);
  limits.connections = limits.event_streams + kShortConnections;
  limits.write_time = std::chrono::milliseconds{std::lround(1e3 * config.write_timeout_s)};
  return limits;
}

/// One page's stream: the changes since the last event, as often as the period allows. While nothing changes,
/// a heartbeat shows that the run is alive.
class PageStream {
 public:
  PageStream(const LiveDocument& document, std::chrono::milliseconds period)
      : document_(document), period_(period) {}

  std::optional<std::string> next() {
    document_.pause_until(told_at_ + period_);
    const bool is_news = document_.wait(cursor_, kHeartbeat);
    if (document_.is_closed()) return std::nullopt;
    told_at_ = std::chrono::steady_clock::now();
    return is_news ? "data: " + document_.changes(cursor_) + "\n\n" : "event: alive\ndata:\n\n";
  }

 private:
  const LiveDocument& document_;
  std::chrono::milliseconds period_;
  LiveDocument::Cursor cursor_;
  std::chrono::steady_clock::time_point told_at_{};
};

}  // namespace

LivePage::LivePage(const HttpEndpoint& endpoint, const LivePageConfig& config, const LivePageTitle& title,
                   const std::vector<std::string>& class_names, LivePageParts parts)
    : endpoint_(endpoint),
      token_(parts.token),
      notes_(std::move(parts.notes)),
      document_(title),
      board_(class_names, std::chrono::milliseconds{std::lround(1e3 * config.picture_period_s)}),
      site_(document_, board_, config, names_of_this_computer(endpoint.host), token_,
            actions(std::move(parts.playback)), std::move(parts.map)) {
  const std::chrono::milliseconds period{std::lround(1e3 * config.update_period_s)};
  server_ = std::make_unique<HttpServer>(
      endpoint, limits_of(config), site_.headers(),
      [this](const PageRequest& request) { return site_.answer(request); },
      [this, period]() -> HttpServer::Events {
        return [stream = std::make_shared<PageStream>(document_, period)] { return stream->next(); };
      });
  endpoint_.port = server_->port();
}

LivePage::~LivePage() {
  document_.close();
}

PageActions LivePage::actions(std::shared_ptr<ReplayControl> playback) {
  PageActions actions;
  actions.note = [this](std::uint64_t object_id, const ObjectNote& its_note) {
    return note(object_id, its_note);
  };
  if (playback) actions.play = [playback](const ReplayWish& wish) { playback->wish(wish); };
  return actions;
}

bool LivePage::note(std::uint64_t object_id, const ObjectNote& note) {
  const auto noted = document_.note(object_id, note);
  return noted && notes_->add(*noted);
}

bool LivePage::is_open_to_network() const {
  return !is_loopback(endpoint_.host);
}

bool LivePage::is_on_every_interface() const {
  return endpoint_.host == "0.0.0.0" || endpoint_.host == "::";
}

std::string LivePage::url_of(const std::string& host) const {
  const bool is_v6 = host.find(':') != std::string::npos;
  return "http://" + (is_v6 ? "[" + host + "]" : host) + ":" + std::to_string(endpoint_.port) + "/";
}

std::string LivePage::url() const {
  return url_of(is_on_every_interface() ? "127.0.0.1" : endpoint_.host);
}

std::string LivePage::url_for_others(const std::string& address) const {
  return url_of(is_on_every_interface() ? address : endpoint_.host);
}

}  // namespace geoloc::io
