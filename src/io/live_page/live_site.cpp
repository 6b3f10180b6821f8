// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_site.hpp"

#include <arpa/inet.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <chrono>
#include <string_view>

#include "form_fields.hpp"
#include "geoloc/io/output/palette.hpp"
#include "geoloc/io/output/text.hpp"
#include "metrics.hpp"
#include "page_access.hpp"
#include "page_files.hpp"
#include "page_json.hpp"
#include "run_files.hpp"

namespace geoloc::io {
namespace {

constexpr std::string_view kObjects = "/objects/";
constexpr std::string_view kTiles = "/map/";
constexpr std::string_view kNote = "/note";
constexpr std::string_view kPicture = "/picture";
constexpr std::string_view kPlayback = "/playback";
constexpr std::size_t kLongestHost = 255;

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// The host without ":PORT", and an IPv6 address without its brackets; empty for what is not just that, as
/// "localhost:80@evil", whose host is "evil" for a browser.
std::string host_of_header(const std::string& header) {
  const bool has_brackets = !header.empty() && header.front() == '[';
  const std::size_t end = has_brackets ? header.find(']') : std::min(header.find(':'), header.size());
  if (end == std::string::npos) return {};
  const std::string_view rest = std::string_view(header).substr(end + (has_brackets ? 1 : 0));
  const bool is_port = rest.empty() || (rest.front() == ':' &&
                                        rest.find_first_not_of("0123456789", 1) == std::string_view::npos);
  if (!is_port) return {};
  return has_brackets ? header.substr(1, end - 1) : header.substr(0, end);
}

bool is_address(const std::string& host) {
  std::array<unsigned char, sizeof(in6_addr)> address{};
  return inet_pton(AF_INET, host.c_str(), address.data()) == 1 ||
         inet_pton(AF_INET6, host.c_str(), address.data()) == 1;
}

/// Browsers state when another site's page causes a request. Following a link from there is harmless.
bool is_on_behalf_of_another_site(const PageRequest& request) {
  const std::string& site = request.fetch_site;
  return !site.empty() && site != "same-origin" && site != "none" && request.fetch_mode != "navigate";
}

const char* type_of(std::string_view name) {
  const std::string_view ending = name.substr(name.rfind('.') + 1);
  if (ending == "html") return "text/html; charset=utf-8";
  if (ending == "js") return "text/javascript; charset=utf-8";
  if (ending == "css") return "text/css; charset=utf-8";
  if (ending == "svg") return "image/svg+xml";
  return "application/octet-stream";
}

PageAnswer refuse(int status, const char* reason) {
  PageAnswer answer;
  answer.status = status;
  answer.body = std::string(reason) + "\n";
  return answer;
}

/// The page asks for the tiles of a map of ours where it asks for all else.
LivePageConfig with_map(LivePageConfig config, const PageMap& map) {
  if (!map.tile) return config;
  config.tile_url = "map/{z}/{x}/{y}";
  config.tile_attribution = map.attribution;
  return config;
}

PageAnswer json(std::string text) {
  PageAnswer answer;
  answer.type = "application/json";
  answer.body = std::move(text);
  return answer;
}

/// The one form is that which asks for a token.
std::string content_security_policy(const LivePageConfig& config, bool has_token) {
  const std::string tiles = tile_origin(config.tile_url);
  return "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' blob:" +
         (tiles.empty() ? "" : " " + tiles) + "; base-uri 'none'; form-action " +
         (has_token ? "'self'" : "'none'") + "; frame-ancestors 'none'";
}

}  // namespace

bool is_own_host(const std::string& host_header, const std::vector<std::string>& own_names) {
  if (host_header.empty() || host_header.size() > kLongestHost) return false;
  const std::string host = lower_case(host_of_header(host_header));
  return is_address(host) || std::find(own_names.begin(), own_names.end(), host) != own_names.end();
}

std::vector<std::string> names_of_this_computer(const std::string& given_host) {
  std::vector<std::string> names{"localhost", lower_case(given_host)};
  std::array<char, kLongestHost + 1> name{};
  if (gethostname(name.data(), name.size() - 1) == 0 && name[0] != '\0') {
    names.push_back(lower_case(name.data()));
    names.push_back(names.back() + ".local");
  }
  return names;
}

std::optional<std::uint64_t> object_of_path(const std::string& path) {
  if (path.size() <= kObjects.size() || path.compare(0, kObjects.size(), kObjects) != 0) return std::nullopt;
  std::uint64_t id = 0;
  const char* const end = path.data() + path.size();
  const auto [stopped_at, error] = std::from_chars(path.data() + kObjects.size(), end, id);
  if (error != std::errc{} || stopped_at != end) return std::nullopt;
  return id;
}

std::optional<std::uint64_t> object_of_path(const std::string& path, std::string_view part) {
  if (path.size() <= part.size() || path.compare(path.size() - part.size(), part.size(), part) != 0)
    return std::nullopt;
  return object_of_path(path.substr(0, path.size() - part.size()));
}

LiveSite::LiveSite(const LiveDocument& document, PictureBoard& board, const LivePageConfig& config,
                   std::vector<std::string> own_names, const std::string& token, PageActions actions,
                   PageMap map)
    : document_(document),
      board_(board),
      own_names_(std::move(own_names)),
      config_(with_map(config, map)),
      actions_(std::move(actions)),
      map_(std::move(map)),
      access_(std::make_unique<PageAccess>(token)),
      files_(std::make_unique<RunFiles>(document)),
      headers_{{"Content-Security-Policy", content_security_policy(config_, !token.empty())},
               {"X-Content-Type-Options", "nosniff"},
               {"Referrer-Policy", "no-referrer"},
               {"Cross-Origin-Resource-Policy", "same-origin"},
               {"Cross-Origin-Opener-Policy", "same-origin"},
               {"Cache-Control", "no-store"}} {}

LiveSite::~LiveSite() = default;

PageAnswer LiveSite::answer(const PageRequest& request) const {
  if (!is_own_host(request.host, own_names_))
    return refuse(421, "Use this computer's address: the name in the request is not one of its own.");
  if (is_on_behalf_of_another_site(request)) return refuse(403, "Not available to pages of other sites.");
  if (auto instead = access_->answer_instead(request, std::chrono::steady_clock::now())) return *instead;
  if (request.method == "POST") return change(request);
  if (request.method != "GET" && request.method != "HEAD") return refuse(405, "Only GET and HEAD.");
  return dispatch(request);
}

PageAnswer LiveSite::change(const PageRequest& request) const {
  const bool is_note = object_of_path(request.path, kNote) && actions_.note;
  const bool is_wish = request.path == kPlayback && actions_.play;
  if (!is_note && !is_wish) return refuse(405, "Only GET and HEAD.");
  if (!access_->may_change(request))
    return refuse(403,
                  "Changes are accepted from this computer's own pages and programs, or with the token.");
  if (is_note) return take_note(request);
  const auto wish = parse_replay_wish(request.query);
  if (!wish) return refuse(400, "paused must be 0 or 1, speed 0.1 to 100, at milliseconds since 1970.");
  actions_.play(*wish);
  return PageAnswer{204, "", "", false};
}

PageAnswer LiveSite::take_note(const PageRequest& request) const {
  const auto verdict = parse_verdict(form_field(request.query, "verdict").value_or(""));
  if (!verdict) return refuse(400, "verdict must be confirmed, dismissed or empty.");
  const ObjectNote note{clean_text(form_field(request.query, "name").value_or(""), kLongestNoteName),
                        *verdict};
  if (!actions_.note(*object_of_path(request.path, kNote), note))
    return refuse(404, "No such confirmed object, or too many notes.");
  return PageAnswer{204, "", "", false};
}

PageAnswer LiveSite::tile(const std::string& address) const {
  auto png = map_.tile ? map_.tile(address) : std::nullopt;
  if (!png) return refuse(404, "No map there.");
  // Pages come back to places that they have shown before.
  return {200, "image/png", std::move(*png), false, {{"Cache-Control", "private, max-age=3600"}}};
}

PageAnswer LiveSite::dispatch(const PageRequest& request) const {
  const std::string& path = request.path;
  if (path == "/events") {
    return {200, "text/event-stream", "", true};
  }
  if (path == "/frame") {
    board_.note_viewer();
    const auto framed = board_.framed();
    if (!framed) return PageAnswer{204, "", "", false};
    return {200, "application/octet-stream", *framed, false};
  }
  if (path == "/settings")
    return json(page_json::settings(config_, actions_.note && access_->may_change(request)));
  if (path.compare(0, kTiles.size(), kTiles) == 0) return tile(path.substr(kTiles.size()));
  if (path == "/metrics") return {200, kMetricsType, metrics_text(document_.figures()), false};
  if (auto file = files_->find(path)) return {200, file->type, std::move(file->content), false};
  if (path.compare(0, kObjects.size(), kObjects) == 0) {
    if (const auto pictured = object_of_path(path, kPicture)) {
      const auto jpeg = document_.picture_of(*pictured);
      return jpeg ? PageAnswer{200, "image/jpeg", *jpeg, false} : refuse(404, "No picture of it.");
    }
    const auto id = object_of_path(path);
    auto text = id ? document_.object(*id) : std::nullopt;
    return text ? json(std::move(*text)) : refuse(404, "No such object.");
  }
  if (path == "/palette.css") return {200, type_of(path), std::string(palette_css()), false};
  const std::string_view name =
      path == "/" ? "index.html" : std::string_view(path).substr(path.empty() ? 0 : 1);
  for (const EmbeddedFile& file : page_files()) {
    if (file.name == name) return {200, type_of(file.name), std::string(file.content), false};
  }
  return refuse(404, "Not found.");
}

}  // namespace geoloc::io
