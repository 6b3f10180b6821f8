// SPDX-License-Identifier: Apache-2.0
#include "fuse/fleet_service.hpp"

#include <unistd.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <thread>
#include <utility>

#include "common/live_page_output.hpp"
#include "fuse/fleet_run.hpp"
#include "fuse/survey.hpp"
#include "geoloc/io/config/known_points_file.hpp"
#include "geoloc/io/fleet/fused_report.hpp"
#include "geoloc/io/fleet/summary_file.hpp"
#include "geoloc/io/output/file_sink.hpp"
#include "geoloc/io/output/text.hpp"
#include "geoloc/io/postgis/fleet_database.hpp"
#include "geoloc/io/recording/recording_reader.hpp"

namespace geoloc::apps {
namespace {

constexpr auto kStep = std::chrono::milliseconds{100};
constexpr auto kStatusPeriod = std::chrono::seconds{1};
constexpr std::uint64_t kStatusesPerLine = 5;
/// A fusion takes at most this part of the time.
constexpr int kMostLoad = 2;
/// A database that is away is tried again so often.
constexpr auto kRetry = std::chrono::seconds{3};
/// The last map is posted again so long after it was posted before.
constexpr std::array<std::chrono::seconds, 2> kRepeats{{std::chrono::seconds{2}, std::chrono::seconds{60}}};

io::SinkRunnerConfig runner_of(const FuseOptions& options) {
  return {256, options.mqtt.url.empty() ? io::WhenFull::kWait : io::WhenFull::kDropOldest};
}

std::string render(const io::RunRecord& run) {
  return io::fused_to_geojson(*run.fused_map, run.objects);
}

}  // namespace

FleetService::FleetService(const FuseOptions& options)
    : options_(options),
      stderr_(STDERR_FILENO),
      started_at_(clock_.now()),
      outputs_(options.class_names, runner_of(options)),
      name_(options.fleet.empty() ? "fleet" : options.fleet) {
  check(options_);
  check_outputs(files_of(options_.outputs), inputs_of(options_));
  if (!options_.truth_file.empty()) truth_ = io::read_truth(options_.truth_file);
  if (!options_.mqtt.url.empty()) join_fleet();
  add_stores();
  take_files();
  if (!options_.known_points_file.empty()) {
    fleet_.erase(kSurvey);
    fleet_.emplace(kSurvey, summary_of_survey(io::read_known_points(options_.known_points_file)));
  }
  add_outputs();
}

void FleetService::join_fleet() {
  const io::MqttAccess access = mqtt_access(options_.mqtt);
  if (const std::string warning = warning_of(access); !warning.empty()) say(warning);
  if (options_.fleet.empty()) name_ = access.address.fleet;
  inbox_.emplace(access.address.fleet);
  connection_ =
      std::make_unique<io::MqttConnection>(access, [this](const std::string& message) { say(message); });
  connection_->subscribe(io::summary_topic(access.address.fleet, "+"),
                         [this](std::string_view topic, std::string_view payload) {
                           if (auto summary = inbox_->open(topic, payload))
                             take_new(*std::move(summary), std::string(payload));
                         });
}

void FleetService::add_outputs() {
  OutputOptions others = options_.outputs;
  others.objects.clear();  // the fleet's GeoJSON tells of the flights, too
  add_sinks(others, EstimationConfig{}, io::OldFile::kReplace, outputs_);
  if (!options_.outputs.objects.empty())
    outputs_.add(std::make_unique<io::FileSink>(
        "--out", io::ResultFile(options_.outputs.objects, io::OldFile::kReplace, outputs_.teller()), render));
  page_ = open_live_page(options_.outputs, {}, {}, {"fleet " + name_, is_live(), true}, options_.class_names,
                         outputs_);
  if (!page_) return;
  outputs_.add(std::make_unique<io::LivePageSink>(page_));
  stderr_.post(page_message(*page_, options_.outputs, isatty(STDERR_FILENO) == 1) + "\n");
}

void FleetService::say(const std::string& message) {
  stderr_.post("geoloc_fuse: " + io::clean_text(message) + "\n");  // a server's words may be in it
}

void FleetService::tell_outputs() {
  for (const std::string& message : outputs_.take_messages()) say(message);
}

/// What was kept before comes first, and is kept already.
void FleetService::add_stores() {
  if (!options_.state_folder.empty()) {
    recall(io::read_fleet_folder(options_.state_folder));
    outboxes_.push_back(std::make_shared<io::SummaryOutbox>());
    outputs_.add(std::make_unique<io::FleetFolderSink>(options_.state_folder, outboxes_.back()));
  }
  if (!options_.postgis.empty()) {
    outboxes_.push_back(std::make_shared<io::SummaryOutbox>());
    outputs_.add(
        std::make_unique<io::PostgisSink>(io::FleetDatabase(options_.postgis, name_), outboxes_.back()));
  }
}

/// All that cannot be read is named, not the first file alone.
void FleetService::take_files() {
  std::string faults;
  for (const std::string& file : options_.summaries) {
    try {
      FlightSummary summary = io::read_summary(file);
      std::string bytes = io::summary_to_bytes(summary);
      take_new(std::move(summary), std::move(bytes));
    } catch (const std::runtime_error& error) {
      faults += (faults.empty() ? "" : "\n") + std::string(error.what());
    }
  }
  if (!faults.empty()) throw std::runtime_error(faults);
}

void FleetService::take_new(FlightSummary summary, std::string bytes) {
  const std::string flight = summary.identity.flight;
  if (!take(std::move(summary), fleet_)) return;
  has_news_ = true;
  const auto shared = std::make_shared<const std::string>(std::move(bytes));
  for (const auto& outbox : outboxes_) outbox->put(flight, shared);
}

/// Where a folder and a database have kept ids, the database's, which is read last, replace the others: it
/// has the history, too.
void FleetService::recall(const io::KeptFleet& kept) {
  for (const std::string& fault : kept.faults) say(fault);
  for (const FlightSummary& summary : kept.summaries) {
    if (!take(summary, fleet_)) continue;
    has_news_ = true;
    if (inbox_) inbox_->know(summary, io::summary_to_bytes(summary).size());
  }
  if (kept.ids.next > 1) ids_ = kept.ids;
}

/// Without the ids that objects have in the database there is nothing to begin with: it is waited for. False
/// where that was given up.
bool FleetService::recall_database(const StopSignal& stop) {
  if (options_.postgis.empty()) return true;
  io::FleetDatabase database(options_.postgis, name_);
  bool has_told = false;
  while (!stop.is_requested()) {
    try {
      recall(database.read());
      if (has_told) say("--postgis " + database.name() + ": connected");
      if (database.is_exposed())
        say("WARNING: --postgis is not encrypted; ?sslmode=verify-full in its URL asks for that");
      return true;
    } catch (const std::runtime_error& error) {
      if (!is_live()) throw;
      if (!std::exchange(has_told, true)) say(std::string(error.what()) + "; trying again");
    }
    const auto until = Clock::now() + kRetry;
    while (!stop.is_requested() && Clock::now() < until) std::this_thread::sleep_for(kStep);
  }
  return false;
}

void FleetService::fuse_now() {
  const auto began_at = Clock::now();
  has_news_ = false;
  run_ = fuse_to_run(fleet_, options_, truth_, ids_);
  fusion_took_ = Clock::now() - began_at;
  if (is_live()) tell_verdicts();
}

void FleetService::tell_verdicts() {
  for (const io::FlightReport& flight : run_.flights) {
    std::string& told = verdicts_[flight.flight];
    if (std::exchange(told, flight.verdict) != flight.verdict)
      say("flight " + flight.flight + ": " + flight.verdict +
          (flight.reason.empty() ? "" : ": " + flight.reason));
  }
}

/// News is fused and posted; the same again where something has not been kept, and twice besides: files that
/// take long leave out maps until the next one.
bool FleetService::is_due(Clock::time_point now) const {
  const auto since = now - posted_at_;
  if (has_news_)
    return since >= std::max<Clock::duration>(from_seconds(options_.fuse_every_s), kMostLoad * fusion_took_);
  const bool is_behind =
      std::any_of(outboxes_.begin(), outboxes_.end(), [](const auto& outbox) { return outbox->is_behind(); });
  if (is_behind) return since >= kRetry;
  return repeats_ < kRepeats.size() && since >= kRepeats[repeats_];
}

void FleetService::tell_status() {
  const io::SummaryInbox::Counts& counts = inbox_->counts();
  io::LiveStatus status;
  status.at = clock_.now();
  status.elapsed = status.at - started_at_;
  status.link_is_good = connection_->is_connected();
  status.link = status.link_is_good ? "broker: connected"
                                    : "broker: not connected" +
                                          (connection_->fault().empty() ? "" : ": " + connection_->fault());
  status.video_is_good = true;
  status.objects = run_.objects.size();
  status.fleet = fmt::format("{} flights, {} objects; summaries: {} taken, {} repeated, {} refused",
                             fleet_.size() - fleet_.count(kSurvey), run_.objects.size(), counts.taken,
                             counts.repeated, counts.refused);
  if (!run_.targets.empty()) status.fleet += "; " + run_.summary.substr(run_.summary.find('\n') + 1);
  if (counts.refused > refusals_told_) {
    status.warning = "a summary was refused: " + inbox_->last_refusal();
    say(status.warning);
    refusals_told_ = counts.refused;
  }
  outputs_.post_status(status);
  if (++statuses_ % kStatusesPerLine == 0) say(status.fleet);
}

void FleetService::follow(const StopSignal& stop) {
  while (!stop.is_requested()) {
    connection_->poll(kStep);
    const auto now = Clock::now();
    if (!fleet_.empty() && is_due(now)) {
      repeats_ = has_news_ ? 0 : repeats_ + 1;
      if (has_news_) fuse_now();
      posted_at_ = Clock::now();
      outputs_.post_run(run_);
    }
    if (now - told_at_ >= kStatusPeriod) {
      told_at_ = now;
      tell_status();
      tell_outputs();
    }
  }
}

io::RunRecord FleetService::run(const StopSignal& stop) {
  if (!recall_database(stop)) return run_;
  fuse_now();
  if (is_live()) {
    if (!fleet_.empty()) outputs_.post_run(run_);
    follow(stop);
    fuse_now();  // what came last
  } else if (page_) {
    outputs_.post_run(run_);
    say("the page stays at " + page_->url() + "; Ctrl-C ends it");
    while (!stop.is_requested()) std::this_thread::sleep_for(kStep);
  }
  outputs_.finish(run_);
  tell_outputs();
  stderr_.finish(std::chrono::seconds{1});
  return run_;
}

}  // namespace geoloc::apps
