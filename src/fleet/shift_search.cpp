// SPDX-License-Identifier: Apache-2.0
#include "fleet/shift_search.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fleet/class_odds.hpp"
#include "geoloc/geometry/angles.hpp"
#include "tracking/gaussian.hpp"

namespace geoloc {
namespace {

/// An object of the flight and a place of the map that may be it.
struct Pair {
  std::size_t object;
  std::uint32_t key;
  Eigen::Vector2d shift;  // from the object to the place
};
using Pairs = std::vector<Pair>;

constexpr double kSigmasToSearch = 3.5;
/// Objects that a shift is sought with, about; of more every second, third, ... is taken.
constexpr std::size_t kObjectsTried = 200;
/// Shifts that are tried, of those that most pairs agree with.
constexpr std::size_t kShiftsTried = 12;
constexpr int kShiftRefinements = 3;
/// A flight is somewhere by chance unless it is so much likelier.
constexpr double kLeastScore = 3.0;
/// An object that stands beside places of the map, and at none of them: the other flight would have seen it,
/// too, for the most part.
constexpr double kMissed = 1.0;
constexpr double kBeside_m = 3.0;
/// A flight may be farther off than it says, but for that more must speak than a few objects.
constexpr double kMostPenalty = 12.0;
constexpr std::size_t kObjectsAgainstSigma = 5;
constexpr double kShareAgainstSigma = 0.5;

std::map<std::uint32_t, Pairs> pairs_by_sheet(const RelativeObjects& flight, const MapPlaces& places,
                                              double reach_m) {
  std::map<std::uint32_t, Pairs> pairs;
  const std::size_t step = flight.positions.size() / kObjectsTried + 1;
  for (std::size_t i = 0; i < flight.positions.size(); i += step) {
    places.for_each_near(flight.positions[i], reach_m, [&](std::uint32_t key) {
      const Eigen::Vector2d shift = places[key].position - flight.positions[i];
      if (shift.squaredNorm() <= reach_m * reach_m) pairs[places[key].sheet].push_back({i, key, shift});
    });
  }
  return pairs;
}

/// The shifts that most pairs agree with, most first.
std::vector<Eigen::Vector2d> likely_shifts(const Pairs& pairs, double cell_m) {
  using Cell = std::pair<std::int64_t, std::int64_t>;
  struct Votes {
    int count = 0;
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  };
  std::map<Cell, Votes> cells;
  const auto cell_of = [&](const Eigen::Vector2d& shift) {
    return Cell{std::llround(shift.x() / cell_m), std::llround(shift.y() / cell_m)};
  };
  for (const Pair& pair : pairs) {
    Votes& votes = cells[cell_of(pair.shift)];
    ++votes.count;
    votes.sum += pair.shift;
  }
  std::vector<std::pair<int, Eigen::Vector2d>> found;
  for (const auto& [cell, votes] : cells) {
    int around = 0;
    for (std::int64_t east = -1; east <= 1; ++east) {
      for (std::int64_t north = -1; north <= 1; ++north) {
        const auto other = cells.find({cell.first + east, cell.second + north});
        if (other != cells.end()) around += other->second.count;
      }
    }
    found.emplace_back(around, votes.sum / votes.count);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Eigen::Vector2d> shifts;
  for (std::size_t i = 0; i < std::min(kShiftsTried, found.size()); ++i) shifts.push_back(found[i].second);
  return shifts;
}

/// Objects that have a pair; those of one object follow each other.
std::size_t objects_in(const Pairs& pairs) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) count += i == 0 || pairs[i].object != pairs[i - 1].object;
  return count;
}

/// How a shift explains the pairs: each object by the place that fits it best, each place once.
struct Fit {
  double gain = 0.0;
  std::size_t matched = 0;
  std::size_t missed = 0;                                 ///< objects beside places of the map, but at none
  Eigen::Matrix2d information = Eigen::Matrix2d::Zero();  ///< of the shift [1/m^2]
  Eigen::Vector2d correction = Eigen::Vector2d::Zero();
};

class ShiftSearch {
 public:
  ShiftSearch(const RelativeObjects& flight, const std::vector<int>& classes, const MapPlaces& places,
              const FusionConfig& config, double reach_m)
      : flight_(flight), classes_(classes), places_(places), config_(config), reach_m_(reach_m) {}

  LaidFlight best(std::uint32_t sheet, const Pairs& pairs) {
    LaidFlight found{sheet};
    density_ = static_cast<double>(pairs.size()) /
               (kPi * reach_m_ * reach_m_ * static_cast<double>(objects_in(pairs)));
    const Eigen::Matrix2d uncertainty = flight_.shift_covariance + places_.shift_covariance(sheet);
    prepare(pairs);
    for (Eigen::Vector2d shift : likely_shifts(pairs, cell_m_)) {
      for (int i = 0; i < kShiftRefinements; ++i) shift += fit(pairs, shift).correction;
      const Fit final_fit = fit(pairs, shift);
      const double chi2 = mahalanobis_squared(shift, uncertainty);
      if (chi2 > config_.gate && !outweighs_sigma(final_fit, pairs)) continue;
      if (final_fit.matched == 0) continue;
      const double score = final_fit.gain - kMissed * static_cast<double>(final_fit.missed) -
                           std::min(0.5 * chi2, kMostPenalty) -
                           room_to_fit(uncertainty, final_fit.information.inverse());
      if (score > found.score) found = {sheet, shift, score};
    }
    return found;
  }

 private:
  /// What a shift that was sought gains by chance: the logarithm of how many could be told apart.
  static double room_to_fit(const Eigen::Matrix2d& uncertainty, const Eigen::Matrix2d& found) {
    return 0.5 * std::log((uncertainty + found).determinant() / found.determinant());
  }

  /// Half of the objects near the map, and enough of them.
  static bool outweighs_sigma(const Fit& fit, const Pairs& pairs) {
    return fit.matched >= kObjectsAgainstSigma &&
           static_cast<double>(fit.matched) >= kShareAgainstSigma * static_cast<double>(objects_in(pairs));
  }

  void prepare(const Pairs& pairs) {
    informations_.clear();
    log_peaks_.clear();
    double variance = 0.0;
    for (const Pair& pair : pairs) {
      const Eigen::Matrix2d covariance = flight_.covariances[pair.object] + places_[pair.key].covariance();
      informations_.push_back(covariance.inverse());
      log_peaks_.push_back(-std::log(2.0 * kPi * std::sqrt(covariance.determinant())) - std::log(density_) -
                           class_penalty(classes_[pair.object], places_[pair.key].class_id));
      variance += 0.5 * covariance.trace();
    }
    cell_m_ = std::clamp(std::sqrt(variance / static_cast<double>(std::max<std::size_t>(pairs.size(), 1))),
                         0.1, 1.0);
    taken_.resize(places_.size(), 0);
  }

  Fit fit(const Pairs& pairs, const Eigen::Vector2d& shift) {
    ++round_;
    Fit result;
    Eigen::Vector2d vector = Eigen::Vector2d::Zero();
    for (std::size_t begin = 0, end = 0; begin < pairs.size(); begin = end) {
      double best = 0.0;
      std::size_t chosen = pairs.size();
      bool is_beside = false;
      for (end = begin; end < pairs.size() && pairs[end].object == pairs[begin].object; ++end) {
        const Eigen::Vector2d off = pairs[end].shift - shift;
        const double chi2 = off.dot(informations_[end] * off);
        is_beside = is_beside || off.squaredNorm() < kBeside_m * kBeside_m;
        const double gain = log_peaks_[end] - 0.5 * chi2;
        if (chi2 > config_.gate || gain <= best || taken_[pairs[end].key] == round_) continue;
        best = gain;
        chosen = end;
      }
      result.missed += chosen == pairs.size() && is_beside;
      if (chosen == pairs.size()) continue;
      taken_[pairs[chosen].key] = round_;
      result.gain += best;
      ++result.matched;
      result.information += informations_[chosen];
      vector += informations_[chosen] * (pairs[chosen].shift - shift);
    }
    if (result.matched > 0) result.correction = result.information.inverse() * vector;
    return result;
  }

  const RelativeObjects& flight_;
  const std::vector<int>& classes_;
  const MapPlaces& places_;
  const FusionConfig& config_;
  double reach_m_;
  double density_ = 0.0;  // of places near the flight's objects [1/m^2]
  double cell_m_ = 1.0;
  std::vector<Eigen::Matrix2d> informations_;  // of the pairs
  std::vector<double> log_peaks_;              // the gain of a pair without a residual
  std::vector<int> taken_;                     // in which round a place was
  int round_ = 0;
};

}  // namespace

std::vector<LaidFlight> find_shifts(const RelativeObjects& flight, const std::vector<int>& classes,
                                    const MapPlaces& places, const FusionConfig& config) {
  const double sigma_m = std::sqrt(flight.shift_covariance.trace());
  const double reach_m = std::max(config.most_shift_m, kSigmasToSearch * sigma_m);
  std::vector<LaidFlight> found;
  ShiftSearch search(flight, classes, places, config, reach_m);
  for (const auto& [sheet, pairs] : pairs_by_sheet(flight, places, reach_m)) {
    const LaidFlight best = search.best(sheet, pairs);
    if (best.score > kLeastScore) found.push_back(best);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const LaidFlight& a, const LaidFlight& b) { return a.score > b.score; });
  return found;
}

}  // namespace geoloc
