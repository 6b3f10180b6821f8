// SPDX-License-Identifier: Apache-2.0
#include "fleet/map_solver.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>

#include "fleet/flight_groups.hpp"
#include "fleet/lower_inverse.hpp"
#include "geometry/symmetric.hpp"

namespace geoloc {
namespace {

/// Objects that are taken into the system together where most flights have them.
constexpr Eigen::Index kObjectsAtOnce = 128;

/// An object of the map, where its flights' shared errors are zero.
struct Mean {
  Eigen::Matrix3d covariance;  // D^-1
  Eigen::Vector3d position;
};

Mean mean_of(const std::vector<FlightModel>& flights, const Members& members) {
  Eigen::Matrix3d information = Eigen::Matrix3d::Zero();
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = flights[members[0].flight].objects[members[0].object].position;
  for (const Contribution& member : members) {
    const ModelObject& object = flights[member.flight].objects[member.object];
    information += object.own_information;
    vector += object.own_information * (object.position - origin);
  }
  const Eigen::Matrix3d covariance = information.inverse();
  return {symmetric(covariance), origin + covariance * vector};
}

/// The shared errors of one group of flights: S s = h, with S = sum of (I + G' W G) - (W G)' D^-1 (W G).
class GroupSystem {
 public:
  GroupSystem(const std::vector<FlightModel>& flights, const std::vector<Members>& objects,
              const FlightGroup& group)
      : flights_(flights), objects_(objects), group_(group), first_(flights.size(), 0) {
    for (const std::size_t flight : group.flights) {
      first_[flight] = size_;
      size_ += flights[flight].unknowns();
    }
    matrix_.setIdentity(size_, size_);
    vector_.setZero(size_);
    batch_.setZero(size_, 3 * kObjectsAtOnce);
    for (const std::size_t object : group.objects) add(objects[object]);
    flush();
  }

  void solve() {
    Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> root(matrix_);  // positive definite: I and more
    root.solveInPlace(vector_);
    inverse_root_ = inverse_of_lower(matrix_);
    if (is_inverse_cheaper()) {
      covariance_.setZero(size_, size_);
      covariance_.selfadjointView<Eigen::Lower>().rankUpdate(inverse_root_.transpose());
      covariance_.triangularView<Eigen::StrictlyUpper>() = covariance_.transpose();
    }
  }

  void report(MapEstimate& estimate) {
    for (const std::size_t flight : group_.flights) {
      const Eigen::Index first = first_[flight], count = flights_[flight].unknowns();
      const auto root = inverse_root_.block(first, first, size_ - first, count);
      estimate.flights[flight] = {vector_.segment(first, count), root.transpose() * root};
    }
    for (std::size_t begin = 0; begin < group_.objects.size(); begin += kObjectsAtOnce)
      report_objects(begin, std::min(begin + kObjectsAtOnce, group_.objects.size()), estimate);
  }

 private:
  Eigen::Index unknowns_of(const Members& members) const {
    Eigen::Index sum = 0;
    for (const Contribution& member : members) sum += flights_[member.flight].unknowns();
    return sum;
  }
  bool is_dense(const Members& members) const { return 3 * unknowns_of(members) > size_; }

  /// All of S^-1, against L^-1 times the rows of every object.
  bool is_inverse_cheaper() const {
    double by_object = 0.0;
    for (const std::size_t object : group_.objects) {
      const auto unknowns = static_cast<double>(unknowns_of(objects_[object]));
      by_object += unknowns * unknowns;
    }
    const auto size = static_cast<double>(size_), count = static_cast<double>(group_.objects.size());
    return 0.5 * size * size * size + 3.0 * by_object < 1.5 * count * size * size;
  }

  void add(const Members& members) {
    const Mean mean = mean_of(flights_, members);
    for (const Contribution& member : members) {
      const FlightModel& flight = flights_[member.flight];
      const ModelObject& object = flight.objects[member.object];
      const Eigen::Index first = first_[member.flight], count = flight.unknowns();
      const auto shared = flight.shared_of(member.object);
      const Eigen::Matrix<double, 3, Eigen::Dynamic> weighted = object.own_information * shared;
      matrix_.block(first, first, count, count) += shared.transpose() * weighted;
      vector_.segment(first, count) += weighted.transpose() * (mean.position - object.position);
    }
    if (is_dense(members)) {
      add_to_batch(members, mean);
    } else {
      subtract_pairs(members, mean);
    }
  }

  void subtract_pairs(const Members& members, const Mean& mean) {
    for (std::size_t a = 0; a < members.size(); ++a) {
      const Eigen::Matrix<double, 3, Eigen::Dynamic> rows = mean.covariance * weighted_of(members[a]);
      for (std::size_t b = 0; b <= a; ++b) {
        const Eigen::Matrix<double, 3, Eigen::Dynamic> others = weighted_of(members[b]);
        auto block =
            matrix_.block(first_[members[a].flight], first_[members[b].flight], rows.cols(), others.cols());
        block -= rows.transpose() * others;
        if (a != b && members[a].flight == members[b].flight) block -= others.transpose() * rows;
      }
    }
  }

  Eigen::Matrix<double, 3, Eigen::Dynamic> weighted_of(const Contribution& member) const {
    const FlightModel& flight = flights_[member.flight];
    return flight.objects[member.object].own_information * flight.shared_of(member.object);
  }

  void add_to_batch(const Members& members, const Mean& mean) {
    const Eigen::Matrix3d root = mean.covariance.llt().matrixL();
    auto columns = batch_.middleCols<3>(3 * batched_);
    for (const Contribution& member : members) {
      const auto weighted = weighted_of(member);
      columns.middleRows(first_[member.flight], weighted.cols()) += weighted.transpose() * root;
    }
    if (++batched_ == kObjectsAtOnce) flush();
  }

  void flush() {
    auto used = batch_.leftCols(3 * batched_);
    matrix_.selfadjointView<Eigen::Lower>().rankUpdate(used, -1.0);
    used.setZero();
    batched_ = 0;
  }

  /// Position, and D^-1 + E S^-1 E' with E = D^-1 [W G ...].
  void report_objects(std::size_t begin, std::size_t end, MapEstimate& estimate) {
    const bool is_by_inverse = covariance_.size() > 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Members& members = objects_[group_.objects[i]];
      const Mean mean = mean_of(flights_, members);
      MapEstimate::Place& place = estimate.objects[group_.objects[i]];
      place = {mean.position, mean.covariance};
      for (const Contribution& member : members) {
        const auto weighted = weighted_of(member);
        const Eigen::Index first = first_[member.flight];
        const Eigen::Matrix<double, 3, Eigen::Dynamic> rows = mean.covariance * weighted;
        place.position += rows * vector_.segment(first, rows.cols());
        if (is_by_inverse) {
          place.covariance += covariance_with(members, mean, first, rows);
        } else {
          batch_.block(first, 3 * static_cast<Eigen::Index>(i - begin), rows.cols(), 3) += rows.transpose();
        }
      }
    }
    if (!is_by_inverse) add_batch_covariances(begin, end, estimate);
  }

  Eigen::Matrix3d covariance_with(const Members& members, const Mean& mean, Eigen::Index first,
                                  const Eigen::Matrix<double, 3, Eigen::Dynamic>& rows) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const Contribution& other : members) {
      const Eigen::Matrix<double, 3, Eigen::Dynamic> others = mean.covariance * weighted_of(other);
      sum += rows * covariance_.block(first, first_[other.flight], rows.cols(), others.cols()) *
             others.transpose();
    }
    return sum;
  }

  void add_batch_covariances(std::size_t begin, std::size_t end, MapEstimate& estimate) {
    auto used = batch_.leftCols(3 * static_cast<Eigen::Index>(end - begin));
    const Eigen::MatrixXd rooted = inverse_root_.triangularView<Eigen::Lower>() * used;
    for (std::size_t i = begin; i < end; ++i) {
      const auto columns = rooted.middleCols<3>(3 * static_cast<Eigen::Index>(i - begin));
      estimate.objects[group_.objects[i]].covariance += columns.transpose() * columns;
    }
    used.setZero();
  }

  const std::vector<FlightModel>& flights_;
  const std::vector<Members>& objects_;
  const FlightGroup& group_;
  std::vector<Eigen::Index> first_;  // of each flight's shared errors
  Eigen::Index size_ = 0;
  Eigen::MatrixXd matrix_;        // S in the lower triangle, then L
  Eigen::VectorXd vector_;        // h, then s
  Eigen::MatrixXd inverse_root_;  // L^-1
  Eigen::MatrixXd covariance_;    // S^-1, where it pays
  Eigen::MatrixXd batch_;         // three columns per object
  Eigen::Index batched_ = 0;
};

/// The place of an object that one flight alone has.
MapEstimate::Place place_by(const FlightModel& flight, std::size_t object,
                            const MapEstimate::Shared& shared) {
  const auto rows = flight.shared_of(object);
  const Eigen::Matrix3d covariance =
      flight.objects[object].own_covariance + rows * shared.covariance * rows.transpose();
  return {flight.objects[object].position + rows * shared.mean, symmetric(covariance)};
}

}  // namespace

MapEstimate solve_map(const std::vector<FlightModel>& flights, const std::vector<Members>& objects) {
  MapEstimate estimate;
  for (const FlightModel& flight : flights) {
    const Eigen::Index count = flight.unknowns();
    estimate.flights.push_back({Eigen::VectorXd::Zero(count), Eigen::MatrixXd::Identity(count, count)});
  }
  estimate.objects.resize(objects.size());
  for (const FlightGroup& group : connected_flights(flights.size(), objects)) {
    GroupSystem system(flights, objects, group);
    system.solve();
    system.report(estimate);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (objects[i].size() != 1) continue;
    const Contribution& only = objects[i].front();
    estimate.objects[i] = place_by(flights[only.flight], only.object, estimate.flights[only.flight]);
  }
  return estimate;
}

}  // namespace geoloc
