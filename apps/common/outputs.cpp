// SPDX-License-Identifier: Apache-2.0
#include "common/outputs.hpp"

#include <algorithm>
#include <utility>

#include "common/geoid_data.hpp"

namespace geoloc::apps {

Outputs::Outputs(std::vector<std::string> class_names, const io::SinkRunnerConfig& config)
    : reporter_(std::move(class_names)), config_(config), geoid_(open_geoid()) {}

void Outputs::add(std::unique_ptr<io::Sink> sink) {
  const bool wants_frames = sink->wants_frames();
  sinks_.push_back(std::make_unique<io::SinkRunner>(std::move(sink), config_, teller()));
  if (wants_frames) streams_.push_back(sinks_.back().get());
}

io::SinkRunner::Tell Outputs::teller() const {
  return [box = messages_](const std::string& message) { box->post(message); };
}

void Outputs::complete(std::vector<io::ObjectReport>& objects) const {
  notes_->apply(objects);
  geoid_.complete(objects);
}

void Outputs::complete(io::ViewReport& view) const {
  geoid_.complete(view.camera, view.camera_height);
  geoid_.complete(view.image_centre ? view.image_centre->position : view.camera, view.ground_height);
}

void Outputs::post_frame(const Session& session, const PendingFrame& frame, bool is_located) {
  if (streams_.empty()) return;
  const auto report = std::make_shared<io::OutputFrame>(
      reporter_.report(session.geolocator(), is_located, frame.captured_at, frame.detections));
  report->number = session.frames() - 1;
  for (std::size_t i = 0; i < report->fixes.size(); ++i) report->fixes[i].look = session.looks()[i];
  complete(report->objects);
  if (report->view) complete(*report->view);
  for (io::SinkRunner* sink : streams_) sink->post(report);
}

void Outputs::post_status(const io::LiveStatus& status) {
  const auto shared = std::make_shared<const io::LiveStatus>(status);
  for (io::SinkRunner* sink : streams_) sink->post(shared);
}

void Outputs::post_run(io::RunRecord run) {
  complete(run.objects);
  const auto shared = std::make_shared<const io::RunRecord>(std::move(run));
  for (const auto& sink : sinks_) sink->post(shared);
}

void Outputs::finish(io::RunRecord final_run) {
  post_run(std::move(final_run));
  for (const auto& sink : sinks_) sink->close();
  for (const auto& sink : sinks_) {
    sink->finish();
    const auto stats = sink->stats();
    if (stats.dropped > 0)
      messages_->post(sink->name() + ": " + std::to_string(stats.dropped) + " frames were left out");
    if (stats.has_lost_run || stats.has_lost_frames) messages_->post(stats.error);
    if (stats.is_stuck) messages_->post(sink->name() + ": does not answer, left unfinished");
  }
}

bool Outputs::has_failed() const {
  return std::any_of(sinks_.begin(), sinks_.end(),
                     [](const auto& sink) { return sink->stats().has_failed(); });
}

}  // namespace geoloc::apps
