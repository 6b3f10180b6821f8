// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/replay_control.hpp"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

#include "form_fields.hpp"
#include "page_json.hpp"

namespace geoloc::io {
namespace {

constexpr double kSlowest = 0.1;
constexpr double kFastest = 100.0;
constexpr std::int64_t kLatest_ms = 7'258'118'400'000;  // year 2200

template <typename Number>
std::optional<Number> number_of(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [stopped_at, error] = std::from_chars(text.data(), end, number);
  return error == std::errc{} && stopped_at == end ? std::optional(number) : std::nullopt;
}

}  // namespace

std::optional<ReplayWish> parse_replay_wish(const std::string& query) {
  ReplayWish wish;
  if (const auto text = form_field(query, "paused")) {
    if (*text != "0" && *text != "1") return std::nullopt;
    wish.is_paused = *text == "1";
  }
  if (const auto text = form_field(query, "speed")) {
    wish.speed = number_of<double>(*text);
    if (!wish.speed || !(*wish.speed >= kSlowest && *wish.speed <= kFastest)) return std::nullopt;
  }
  if (const auto text = form_field(query, "at")) {
    const auto at_ms = number_of<std::int64_t>(*text);
    if (!at_ms || *at_ms < 0 || *at_ms > kLatest_ms) return std::nullopt;
    wish.at = HostTime{std::chrono::milliseconds{*at_ms}};
  }
  if (!wish.is_paused && !wish.speed && !wish.at) return std::nullopt;
  return wish;
}

ReplayControl::ReplayControl(HostTime begin, HostTime end, double speed) : begin_(begin), end_(end) {
  state_.speed = speed;
}

void ReplayControl::wish(const ReplayWish& wish) {
  const std::lock_guard lock(mutex_);
  if (wish.is_paused) state_.is_paused = *wish.is_paused;
  if (wish.speed) state_.speed = *wish.speed;
  if (wish.at) state_.seek = std::clamp(*wish.at, begin_, end_);
}

ReplayControl::State ReplayControl::state() const {
  const std::lock_guard lock(mutex_);
  return state_;
}

std::optional<HostTime> ReplayControl::take_seek() {
  const std::lock_guard lock(mutex_);
  return std::exchange(state_.seek, std::nullopt);
}

std::string ReplayControl::json(HostTime at, bool is_seeking) const {
  const State now = state();
  const nlohmann::ordered_json json{{"begin", page_json::milliseconds(begin_)},
                                    {"end", page_json::milliseconds(end_)},
                                    {"at", page_json::milliseconds(at)},
                                    {"speed", now.speed},
                                    {"paused", now.is_paused},
                                    {"seeking", is_seeking}};
  return json.dump();
}

}  // namespace geoloc::io
