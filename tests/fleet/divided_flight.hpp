// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <vector>

#include "fleet/synthetic_fleet.hpp"

/// A flight whose looks are drawn, and what the estimator makes of all or of some of them by dense algebra:
/// constants and drift with their priors, and objects, so that parts of the flight are exactly that.
namespace geoloc::testing {

class DividedFlight {
 public:
  static constexpr int kNodes = 24;
  static constexpr double kSpacing_s = 3.0;

  /// Flown along the targets, from the first to the last, all of which must be in order.
  DividedFlight(const std::vector<Eigen::Vector3d>& targets, std::mt19937& random) : targets_(targets) {
    std::normal_distribution<double> normal;
    Eigen::VectorXd head(size_of(kNodes));
    for (int i = 0; i < kConstants; ++i) head[i] = prior_sigma(i) * normal(random);
    for (int node = 0; node < kNodes; ++node) {
      for (int i = 0; i < kDrift; ++i) {
        const double kept = node == 0 ? 0.0 : kept_of(i);
        const double before = node == 0 ? 0.0 : head[size_of(node - 1) + i];
        head[size_of(node) + i] =
            kept * before + drift_sigma(i) * std::sqrt(1.0 - kept * kept) * normal(random);
      }
    }
    for (int node = 0; node < kNodes; ++node) {
      for (std::size_t i = 0; i < targets.size(); ++i) {
        if (std::abs(node - node_above(i)) > kSeenFor) continue;
        const Eigen::Vector3d noise(kNoise_m * normal(random), kNoise_m * normal(random),
                                    kNoise_m * normal(random));
        looks_.push_back({node, i, targets[i] - jacobian(node, i, 0, kNodes) * head - noise});
      }
    }
  }

  /// The summary of a run from one node to before another.
  FlightSummary summary(const std::string& name, int begin = 0, int end = kNodes) const {
    const Eigen::Index heads = size_of(end - begin);
    Eigen::MatrixXd information = Eigen::MatrixXd::Zero(heads, heads);
    Eigen::VectorXd vector = Eigen::VectorXd::Zero(heads);
    add_prior(end - begin, information);
    std::vector<Sums> sums(targets_.size(), Sums(heads));
    const double weight = 1.0 / (kNoise_m * kNoise_m);
    for (const Look& look : looks_) {
      if (look.node < begin || look.node >= end) continue;
      const Eigen::MatrixXd J = jacobian(look.node, look.target, begin, end);
      information += weight * J.transpose() * J;
      vector -= weight * J.transpose() * look.seen;
      Sums& sum = sums[look.target];
      ++sum.looks;
      sum.seen += look.seen;
      sum.jacobian += J;
    }
    for (const Sums& sum : sums) {
      if (sum.looks == 0) continue;
      information -= weight / sum.looks * sum.jacobian.transpose() * sum.jacobian;
      vector += weight / sum.looks * sum.jacobian.transpose() * sum.seen;
    }
    const Eigen::MatrixXd covariance = information.inverse();
    return described(name, begin, end, sums, covariance * vector, covariance.llt().matrixL());
  }

 private:
  static constexpr int kConstants = 4, kDrift = 4;  // height, boresight about z, offset; as a drift node
  static constexpr int kSeenFor = 3;
  static constexpr double kNoise_m = 0.15;

  struct Look {
    int node;
    std::size_t target;
    Eigen::Vector3d seen;
  };
  struct Sums {
    explicit Sums(Eigen::Index heads) : jacobian(Eigen::MatrixXd::Zero(3, heads)) {}
    int looks = 0;
    Eigen::Vector3d seen = Eigen::Vector3d::Zero();
    Eigen::MatrixXd jacobian;
  };

  static Eigen::Index size_of(int nodes) { return kConstants + kDrift * nodes; }
  static double prior_sigma(int constant) {
    return std::array{0.01, 0.5, 0.7, 0.7}[static_cast<std::size_t>(constant)];
  }
  static double drift_sigma(int component) {
    return std::array{0.4, 0.4, 0.2, 0.01}[static_cast<std::size_t>(component)];
  }
  static double kept_of(int component) {
    return std::exp(-kSpacing_s / std::array{100.0, 100.0, 30.0, 60.0}[static_cast<std::size_t>(component)]);
  }
  static FlightUnknown unknown(int constant) {
    return std::array{FlightUnknown::kBoresightZ, FlightUnknown::kHeight, FlightUnknown::kOffsetEast,
                      FlightUnknown::kOffsetNorth}[static_cast<std::size_t>(constant)];
  }

  int node_above(std::size_t target) const { return static_cast<int>(target * kNodes / targets_.size()); }

  /// By what a target's place changes with the head of a run over those nodes.
  Eigen::MatrixXd jacobian(int node, std::size_t target, int begin, int end) const {
    Eigen::Matrix<double, 3, kDrift> by_drift = Eigen::Matrix<double, 3, kDrift>::Zero();
    const Eigen::Vector3d lever =
        targets_[target] - targets_[targets_.size() * static_cast<std::size_t>(node) / kNodes];
    by_drift.leftCols<3>().setIdentity();
    by_drift.col(3) << lever.y(), -lever.x(), 0.0;
    Eigen::MatrixXd J = Eigen::MatrixXd::Zero(3, size_of(end - begin));
    J.col(0) = by_drift.col(3);
    J.col(1) = by_drift.col(2);
    J.middleCols<2>(2) = by_drift.leftCols<2>();
    J.middleCols<kDrift>(size_of(node - begin)) = by_drift;
    return J;
  }

  static void add_prior(int nodes, Eigen::MatrixXd& information) {
    for (int i = 0; i < kConstants; ++i) information(i, i) += std::pow(prior_sigma(i), -2);
    for (int node = 0; node < nodes; ++node) {
      for (int i = 0; i < kDrift; ++i) {
        const double kept = node == 0 ? 0.0 : kept_of(i);
        const double told = std::pow(drift_sigma(i), -2) / (1.0 - kept * kept);
        const Eigen::Index here = size_of(node) + i, before = here - kDrift;
        information(here, here) += told;
        if (node == 0) continue;
        information(before, before) += kept * kept * told;
        information(here, before) -= kept * told;
        information(before, here) -= kept * told;
      }
    }
  }

  FlightSummary described(const std::string& name, int begin, int end, const std::vector<Sums>& sums,
                          const Eigen::VectorXd& head, const Eigen::MatrixXd& root) const {
    FlightSummary summary;
    set_name(name, summary);
    summary.origin = kFleetOrigin;
    summary.home_height_msl_m = 12.0;
    for (std::size_t i = 0; i < sums.size(); ++i) {
      if (sums[i].looks == 0) continue;
      const Eigen::MatrixXd rows = sums[i].jacobian / sums[i].looks;
      FlightSummary::Object object;
      object.id = i + 1;
      object.position_in_enu = sums[i].seen / sums[i].looks + rows * head;
      object.own_covariance = kNoise_m * kNoise_m / sums[i].looks * Eigen::Matrix3d::Identity();
      object.hits = sums[i].looks;
      object.existence = 0.99;
      object.class_votes.add(0, 5.0);
      summary.objects.push_back(object);
      const auto first = summary.shared_error.rows();
      summary.shared_error.conservativeResize(first + 3, root.cols());
      summary.shared_error.bottomRows<3>() = rows * root;
    }
    summary.part = FlightSummary::Part{run(end), state(begin, end, head, root)};
    return summary;
  }

  static VehicleTime time_of(int node) { return VehicleTime{from_seconds(kSpacing_s * node)}; }
  static FlightRun run(int end) { return {"", HostTime{from_seconds(1e9)}, time_of(end - 1)}; }

  static FlightState state(int begin, int end, const Eigen::VectorXd& head, const Eigen::MatrixXd& root) {
    FlightState state;
    std::vector<Eigen::Index> rows;
    const auto add = [&](FlightUnknown which, Eigen::Index row, double sigma) {
      state.unknowns.push_back({which, head[row], 0.0, sigma});
      rows.push_back(row);
    };
    for (int i = 0; i < kConstants; ++i) add(unknown(i), i, prior_sigma(i));
    for (const bool is_last : {false, true}) {
      for (int i = 0; i < kDrift; ++i)
        add(static_cast<FlightUnknown>(
                static_cast<int>(is_last ? FlightUnknown::kLastDriftEast : FlightUnknown::kFirstDriftEast) +
                i),
            size_of(is_last ? end - begin - 1 : 0) + i, drift_sigma(i));
    }
    state.shared_error = root(rows, Eigen::all);
    state.first_node_at = time_of(begin);
    state.last_node_at = time_of(end - 1);
    state.drift.ripple_share = 0.0;
    return state;
  }

  std::vector<Eigen::Vector3d> targets_;
  std::vector<Look> looks_;
};

}  // namespace geoloc::testing
