// SPDX-License-Identifier: Apache-2.0
#include "tracking/paper_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "geoloc/geometry/refuse.hpp"
#include "geometry/room.hpp"
#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

Eigen::Matrix2d isotropic(double sigma_m) {
  return sigma_m * sigma_m * Eigen::Matrix2d::Identity();
}

/// Both filters saw the same object: their estimates are combined, and it keeps its older name.
void absorb(Track& kept, const Track& gone) {
  kept.position_in_enu =
      kalman_update(kept.position_in_enu, gone.position_in_enu.mean, gone.position_in_enu.covariance);
  merge_records(kept, gone);
}

}  // namespace

PaperTracker::PaperTracker(const PaperTrackerConfig& config, int max_detections)
    : config_(config),
      measurement_covariance_(isotropic(config.measurement_sigma_m)),
      process_covariance_(isotropic(config.process_sigma_m)) {
  refuse_if_any(config.problems());
  take_room(this, config, max_detections);
}

std::size_t PaperTracker::take_room(PaperTracker* self, const PaperTrackerConfig& config,
                                    int max_detections) {
  if (self != nullptr) self->solver_.reserve(max_detections, config.max_tracks);
  return room::reserve(self, &PaperTracker::tracks_, config.max_tracks) +
         room::reserve(self, &PaperTracker::candidates_, config.max_tracks) +
         room::reserve(self, &PaperTracker::track_is_matched_, config.max_tracks) +
         room::reserve(self, &PaperTracker::track_of_detection_, max_detections) +
         room::resize(self, &PaperTracker::costs_, max_detections, config.max_tracks) +
         AssignmentSolver::bytes(max_detections, config.max_tracks);
}

void PaperTracker::update(const LocatedFrame& frame) {
  const HostTime captured_at = frame.view.captured_at_host;
  associate(frame.detections);
  update_matched(frame.detections, captured_at);
  penalise_missed(frame);
  start_tentative(frame.detections, captured_at);
  remove_unreliable();
  merge_near_confirmed();
}

Eigen::Matrix2d PaperTracker::measurement_covariance(const LocatedDetection& located) const {
  if (located.detection.sigma_px == 0.0) return measurement_covariance_;
  return measurement_covariance_ + located.fix.covariance(located.detection.sigma_px);
}

void PaperTracker::associate(const std::vector<LocatedDetection>& detections) {
  const std::size_t rows = detections.size();
  candidates_.clear();
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    const Gaussian2& track = tracks_[k].position_in_enu;
    const Eigen::Matrix2d information =
        (track.covariance + measurement_covariance_).inverse();  // S^-1 of eq. 11
    const std::size_t column = candidates_.size();
    bool within_gate = false;
    for (std::size_t i = 0; i < rows; ++i) {
      const LocatedDetection& located = detections[i];
      const Eigen::Vector2d residual = located.fix.position_in_enu - track.mean;
      const Eigen::Matrix2d& its_information =
          located.detection.sigma_px == 0.0
              ? information
              : (track.covariance + measurement_covariance(located)).inverse().eval();
      costs_(i, column) = std::sqrt(residual.dot(its_information * residual));
      within_gate = within_gate || costs_(i, column) < config_.gate;
    }
    if (within_gate) candidates_.push_back(k);  // otherwise the next track takes this column
  }

  const auto& column_of_row = solver_.solve(costs_.topLeftCorner(rows, candidates_.size()), config_.gate);
  track_is_matched_.assign(tracks_.size(), 0);
  track_of_detection_.assign(detections.size(), std::nullopt);
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (column_of_row[i] == AssignmentSolver::kUnassigned) continue;
    const std::size_t track = candidates_[column_of_row[i]];
    track_of_detection_[i] = track;
    track_is_matched_[track] = 1;
  }
}

void PaperTracker::update_matched(const std::vector<LocatedDetection>& detections, HostTime captured_at) {
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (!track_of_detection_[i]) continue;
    Track& track = tracks_[*track_of_detection_[i]];
    track.position_in_enu = kalman_update(track.position_in_enu, detections[i].fix.position_in_enu,
                                          measurement_covariance(detections[i]));
    track.position_in_enu.covariance += process_covariance_;
    track.penalty = std::max(0, track.penalty - 1);
    record_detection(track, detections[i].detection, captured_at);
    if (track.hits >= config_.confirm_hits) track.status = TrackStatus::kConfirmed;
  }
}

void PaperTracker::penalise_missed(const LocatedFrame& frame) {
  for (std::size_t k = 0; k < tracks_.size(); ++k) {
    if (track_is_matched_[k] != 0) continue;
    if (frame.projector.sees(tracks_[k].position_in_enu.mean, frame.view, config_.visible_margin_px,
                             frame.ground)) {
      ++tracks_[k].penalty;
    }
  }
}

void PaperTracker::start_tentative(const std::vector<LocatedDetection>& detections, HostTime captured_at) {
  for (std::size_t i = 0; i < detections.size(); ++i) {
    if (track_of_detection_[i]) continue;
    if (tracks_.size() >= static_cast<std::size_t>(config_.max_tracks)) {
      ++counters_.refused;
      continue;
    }
    Track track;
    track.id = next_id_++;
    track.position_in_enu = {detections[i].fix.position_in_enu, measurement_covariance(detections[i])};
    track.first_seen = captured_at;
    record_detection(track, detections[i].detection, captured_at);
    if (track.hits >= config_.confirm_hits) track.status = TrackStatus::kConfirmed;
    tracks_.push_back(track);
    ++counters_.created;
  }
}

void PaperTracker::remove_unreliable() {
  const auto unreliable = [this](const Track& track) { return track.penalty >= config_.max_penalty; };
  const auto kept_end = std::remove_if(tracks_.begin(), tracks_.end(), unreliable);
  counters_.removed += static_cast<std::uint64_t>(tracks_.end() - kept_end);
  tracks_.erase(kept_end, tracks_.end());
}

void PaperTracker::merge_near_confirmed() {
  for (std::size_t a = 0; a < tracks_.size(); ++a) {
    if (tracks_[a].status != TrackStatus::kConfirmed) continue;
    for (std::size_t b = a + 1; b < tracks_.size();) {
      const Eigen::Vector2d apart = tracks_[a].position_in_enu.mean - tracks_[b].position_in_enu.mean;
      if (tracks_[b].status == TrackStatus::kConfirmed && apart.norm() < config_.merge_distance_m) {
        absorb(tracks_[a], tracks_[b]);
        tracks_.erase(tracks_.begin() + static_cast<std::ptrdiff_t>(b));
        ++counters_.merged;
      } else {
        ++b;
      }
    }
  }
}

}  // namespace geoloc
