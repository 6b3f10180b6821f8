// SPDX-License-Identifier: Apache-2.0
#include "geoloc/fleet/flight_summary.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>

#include "fleet/named_faults.hpp"
#include "fleet/part_checks.hpp"
#include "geometry/symmetric.hpp"

namespace geoloc {
namespace {

constexpr double kMostSigma_m = 1e5, kLeastSigma_m = 1e-6;
constexpr double kMostMsl_m = 1e4;
constexpr double kMostWeight = 1e12;  // of a class

bool is_name(std::string_view text) {
  return text.size() <= FlightSummary::kMostName && std::all_of(text.begin(), text.end(), [](char c) {
           return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' || c == '.' ||
                  c == ':';
         });
}

bool is_within(double value, double least, double most) {
  return value >= least && value <= most;  // NaN is not
}

/// Symmetric, and positive definite with sigmas that can be inverted.
bool is_covariance(const Eigen::Matrix3d& covariance) {
  if (!covariance.allFinite() || covariance != covariance.transpose()) return false;
  if (covariance.diagonal().maxCoeff() > kMostSigma_m * kMostSigma_m) return false;
  const Eigen::LLT<Eigen::Matrix3d> root(covariance);
  return root.info() == Eigen::Success && root.matrixLLT().diagonal().minCoeff() >= kLeastSigma_m;
}

void check_object(const FlightSummary::Object& object, NamedFaults& faults) {
  faults.require(object.id > 0, "id must not be 0");
  faults.require(object.position_in_enu.allFinite() &&
                     object.position_in_enu.cwiseAbs().maxCoeff() <= FlightSummary::kReach_m,
                 "position must be within 100 km of the origin");
  faults.require(is_covariance(object.own_covariance),
                 "own covariance must be symmetric and positive definite, sigmas between 1e-6 and 1e5 m");
  faults.require(object.hits > 0, "hits must be above 0");
  faults.require(is_within(object.existence, 0.0, 1.0), "existence must be between 0 and 1");
  for (const ClassVotes::Vote& vote : object.class_votes.votes())
    faults.require(is_within(vote.weight, 0.0, kMostWeight) && vote.class_id >= 0,
                   "votes must be of classes from 0, with weights from 0");
  faults.require(object.first_seen <= object.last_seen, "must not be seen last before it is seen first");
}

void check_identity(const FlightIdentity& identity, NamedFaults& faults) {
  faults.require(is_flight_name(identity.flight),
                 "the flight's id must be 1 to 64 letters, digits, or any of - _ . :");
  faults.require(is_name(identity.vehicle),
                 "the vehicle's name must be at most 64 letters, digits, or any of - _ . :");
}

void check_apart(const FlightSummary& summary, NamedFaults& faults) {
  const auto& apart = summary.apart;
  faults.require(apart.size() <= FlightSummary::kMostApart * summary.objects.size(),
                 "there are more pairs apart than twelve per object");
  faults.require(std::is_sorted(apart.begin(), apart.end()) &&
                     std::adjacent_find(apart.begin(), apart.end()) == apart.end(),
                 "pairs apart must be sorted, each once");
  const bool are_places = std::all_of(apart.begin(), apart.end(), [&](const auto& pair) {
    return pair.first < pair.second && pair.second < summary.objects.size();
  });
  faults.require(are_places, "a pair apart must be two places in the list of objects, the smaller first");
}

/// East and north of the unknowns turn as the positions do.
void turn_state(const Eigen::Matrix2d& turn, FlightState& state) {
  constexpr std::array kEasts{FlightUnknown::kOffsetEast, FlightUnknown::kFirstDriftEast,
                              FlightUnknown::kLastDriftEast};
  for (std::size_t i = 0; i + 1 < state.unknowns.size(); ++i) {
    FlightState::Unknown &east = state.unknowns[i], &north = state.unknowns[i + 1];
    const bool is_pair = std::find(kEasts.begin(), kEasts.end(), east.which) != kEasts.end() &&
                         static_cast<int>(north.which) == static_cast<int>(east.which) + 1;
    if (!is_pair) continue;
    const Eigen::Vector2d mean = turn * Eigen::Vector2d(east.mean, north.mean);
    const Eigen::Vector2d prior = turn * Eigen::Vector2d(east.prior_mean, north.prior_mean);
    east.mean = mean.x();
    north.mean = mean.y();
    east.prior_mean = prior.x();
    north.prior_mean = prior.y();
    auto rows = state.shared_error.middleRows<2>(static_cast<Eigen::Index>(i));
    rows = (turn * rows).eval();
  }
}

}  // namespace

bool is_flight_name(std::string_view name) {
  return !name.empty() && is_name(name);
}

Eigen::Matrix3d FlightSummary::covariance(std::size_t object) const {
  const Eigen::Matrix<double, 3, Eigen::Dynamic> shared = shared_error_of(object);
  return objects[object].own_covariance + shared * shared.transpose();
}

std::vector<std::string> FlightSummary::problems() const {
  NamedFaults faults;
  check_identity(identity, faults);
  faults.require(is_valid(origin), "the origin must be a latitude and a longitude");
  faults.require(!home_height_msl_m || is_within(*home_height_msl_m, -kMostMsl_m, kMostMsl_m),
                 "home's height above mean sea level must be within 10 km");
  faults.require(objects.size() <= kMostObjects, "there are more than 20000 objects");
  faults.require(shared_error.cols() <= kMostShared, "there are more than 512 shared errors");
  faults.require(shared_error.rows() == 3 * static_cast<Eigen::Index>(objects.size()),
                 "the shared errors must have three rows per object");
  faults.require(shared_error.size() == 0 ||
                     (shared_error.allFinite() && shared_error.cwiseAbs().maxCoeff() <= kMostSigma_m),
                 "the shared errors must be within 1e5 m");
  for (std::size_t i = 0; i < objects.size(); ++i) {
    faults.enter("object " + std::to_string(objects[i].id) + ": ");
    check_object(objects[i], faults);
    faults.require(i == 0 || objects[i - 1].id < objects[i].id, "ids must rise");
  }
  faults.enter("");
  check_apart(*this, faults);
  faults.enter("part of a flight: ");
  if (part) check_part(*part, shared_count(), faults);
  return faults.take();
}

Eigen::Matrix<double, 3, Eigen::Dynamic> common_shift(const FlightSummary& summary) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> sum;
  sum.setZero(3, summary.shared_count());
  double weights = 0.0;
  for (std::size_t i = 0; i < summary.objects.size(); ++i) {
    const double weight = 1.0 / summary.objects[i].own_covariance.topLeftCorner<2, 2>().trace();
    sum += weight * summary.shared_error_of(i);
    weights += weight;
  }
  if (weights > 0.0) sum /= weights;
  return sum;
}

FlightSummary transformed_to(const LocalFrame& frame, const FlightSummary& summary) {
  FlightSummary moved = summary;
  const bool is_there = frame.origin().latitude_deg == summary.origin.latitude_deg &&
                        frame.origin().longitude_deg == summary.origin.longitude_deg;
  if (is_there) return moved;
  const LocalFrame old_frame(summary.origin);
  moved.origin = frame.origin();
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  // east, north: clockwise
  turn.topLeftCorner<2, 2>() =
      Eigen::Rotation2Dd(-frame.to_local(summary.origin).convergence_rad).toRotationMatrix();
  for (std::size_t i = 0; i < moved.objects.size(); ++i) {
    FlightSummary::Object& object = moved.objects[i];
    object.position_in_enu.head<2>() =
        frame.to_local(old_frame.to_geodetic(object.position_in_enu.head<2>())).position_in_enu;
    object.own_covariance = symmetric(turn * object.own_covariance * turn.transpose());
    auto rows = moved.shared_error.middleRows<3>(3 * static_cast<Eigen::Index>(i));
    rows = (turn * rows).eval();
  }
  if (moved.part) turn_state(turn.topLeftCorner<2, 2>(), moved.part->state);
  return moved;
}

}  // namespace geoloc
