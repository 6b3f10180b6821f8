// SPDX-License-Identifier: Apache-2.0
#include "import/rounding.hpp"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "geoloc/geometry/angles.hpp"

namespace geoloc::apps {
namespace {

/// Usual variance of the rate's change in a second, against which an interval's own change is weighed.
constexpr double kUsualChange = 0.1;
constexpr int kRounds = 12;
/// The cells count as Gaussian for so many rounds, until the rates' changes are known roughly.
constexpr int kGaussianRounds = 2;
constexpr double kLeastPause_s = 1e-3;

/// A Gaussian of value and rate.
struct Belief {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

/// What stands for "the value lies in this cell" in a Gaussian's place.
struct Site {
  double value = 0.0;
  double variance = 0.0;
};

struct Moments {
  double mean = 0.0;
  double variance = 0.0;
};

/// Moments of a Gaussian that is cut off outside of `middle` -+ `half`.
Moments moments_within(const Moments& gaussian, double middle, double half) {
  constexpr double kLeastProbability = 1e-6;
  const double sigma = std::sqrt(gaussian.variance);
  const double low = (middle - half - gaussian.mean) / sigma, high = (middle + half - gaussian.mean) / sigma;
  const auto below = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
  const auto density = [](double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * kPi); };
  const double probability = below(high) - below(low);
  if (!(probability > kLeastProbability))  // it lies elsewhere: near the edge
    return {std::clamp(gaussian.mean, middle - half, middle + half), half * half / 250.0};
  const double shift = (density(low) - density(high)) / probability;
  const double bend = (low * density(low) - high * density(high)) / probability;
  const double share = 1.0 + bend - shift * shift;
  return {gaussian.mean + sigma * shift, std::max(share, 1e-6) * gaussian.variance};
}

class Smoother {
 public:
  Smoother(const std::vector<double>& time_s, const std::vector<double>& rounded, double step)
      : rounded_(rounded),
        half_(0.5 * step),
        sites_(rounded.size()),
        change_(rounded.size(), kUsualChange),
        pause_s_(rounded.size(), kLeastPause_s),
        predicted_(rounded.size()),
        beliefs_(rounded.size()) {
    for (std::size_t i = 0; i < rounded.size(); ++i) {
      sites_[i] = {rounded[i], step * step / 12.0};
      if (i > 0) pause_s_[i] = std::max(time_s[i] - time_s[i - 1], kLeastPause_s);
    }
  }

  std::vector<double> smoothed() {
    for (int round = 0; round < kRounds; ++round) {
      filter();
      look_back();
      learn_changes();
      if (round >= kGaussianRounds) fit_cells();
    }
    filter();
    look_back();
    std::vector<double> values(rounded_.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = std::clamp(beliefs_[i].mean[0], rounded_[i] - half_, rounded_[i] + half_);
    return values;
  }

 private:
  static Eigen::Matrix2d transition(double pause_s) {
    return (Eigen::Matrix2d() << 1.0, pause_s, 0.0, 1.0).finished();
  }

  void filter() {
    constexpr double kAnywhere = 1e6, kAnyRate = 1e4;
    Belief belief;
    belief.mean[0] = rounded_.front();
    belief.covariance.diagonal() << kAnywhere * half_ * half_, kAnyRate;
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      if (i > 0) belief = predicted(belief, pause_s_[i], change_[i]);
      predicted_[i] = belief;
      const Eigen::Vector2d gain = belief.covariance.col(0) / (belief.covariance(0, 0) + sites_[i].variance);
      belief.mean += gain * (sites_[i].value - belief.mean[0]);
      const Eigen::RowVector2d row = belief.covariance.row(0);
      belief.covariance -= gain * row;
      beliefs_[i] = belief;
    }
  }

  static Belief predicted(const Belief& before, double s, double change) {
    const Eigen::Matrix2d step = transition(s);
    Eigen::Matrix2d noise;
    noise << s * s * s / 3.0, s * s / 2.0, s * s / 2.0, s;
    return {step * before.mean, step * before.covariance * step.transpose() + change * noise};
  }

  void look_back() {
    for (std::size_t i = sites_.size() - 1; i-- > 0;) {
      const Belief& later = beliefs_[i + 1];
      const Belief& expected = predicted_[i + 1];
      Belief& here = beliefs_[i];
      const Eigen::Matrix2d gain =
          here.covariance * transition(pause_s_[i + 1]).transpose() * expected.covariance.inverse();
      here.mean += gain * (later.mean - expected.mean);
      here.covariance += gain * (later.covariance - expected.covariance) * gain.transpose();
    }
  }

  /// Student's distribution by iteratively reweighted least squares.
  void learn_changes() {
    for (std::size_t i = 1; i < sites_.size(); ++i) {
      const double change = beliefs_[i].mean[1] - beliefs_[i - 1].mean[1];
      change_[i] = 0.5 * (change * change / pause_s_[i] + kUsualChange);
    }
  }

  /// Expectation propagation (Minka 2001), half a step at a time.
  void fit_cells() {
    for (std::size_t i = 0; i < sites_.size(); ++i) {
      Site& site = sites_[i];
      const double variance = beliefs_[i].covariance(0, 0);
      const double least = 1e-6 / (half_ * half_);
      const double without = std::max(1.0 / variance - 1.0 / site.variance, least);
      const Moments cavity{(beliefs_[i].mean[0] / variance - site.value / site.variance) / without,
                           1.0 / without};
      const Moments cut = moments_within(cavity, rounded_[i], half_);
      const double information = std::max(1.0 / cut.variance - without, least);
      const double value = (cut.mean / cut.variance - cavity.mean * without) / information;
      const double sum = 0.5 / site.variance + 0.5 * information;
      site.value = (0.5 * site.value / site.variance + 0.5 * information * value) / sum;
      site.variance = 1.0 / sum;
    }
  }

  const std::vector<double>& rounded_;
  double half_;
  std::vector<Site> sites_;
  std::vector<double> change_;   // of the rate, variance in a second, since the time before
  std::vector<double> pause_s_;  // since the time before
  std::vector<Belief> predicted_;
  std::vector<Belief> beliefs_;
};

}  // namespace

double rounding_step(const std::vector<double>& values, double finest) {
  for (double step = 1.0; step >= 0.99 * finest; step /= 10.0) {
    const bool fits = std::all_of(values.begin(), values.end(), [&](double value) {
      return std::abs(value / step - std::round(value / step)) < 1e-3;
    });
    if (fits) return step;
  }
  return 0.0;
}

std::vector<double> unrounded(const std::vector<double>& time_s, const std::vector<double>& rounded,
                              double step) {
  if (rounded.size() < 3) return rounded;
  return Smoother(time_s, rounded, step).smoothed();
}

}  // namespace geoloc::apps
