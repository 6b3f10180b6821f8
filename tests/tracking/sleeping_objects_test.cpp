// SPDX-License-Identifier: Apache-2.0
#include "tracking/sleeping_objects.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <random>
#include <vector>

#include "tracking/resting_objects.hpp"

namespace geoloc {
namespace {

constexpr FlightPrior kFlight{0.7, 1.3, 0.3};

/// The head by all objects' own sums, and by the total of those that sleep: whatever happens to nodes, spells
/// and latency meanwhile, and however often objects sleep and wake, both must be the same, and so must be
/// where objects are.
class SleepingObject : public ::testing::Test {
 protected:
  static constexpr std::size_t kObjects = 12;

  struct Object {
    Landmark whole;  // all its sums
    Landmark rest;   // what is not in the total
    RestingObject resting;
    bool is_asleep = false;
  };

  SleepingObject() {
    for (std::size_t i = 0; i < kObjects; ++i) {
      objects_[i].resting.track.id = i + 1;
      objects_[i].resting.landmark = &objects_[i].rest;
    }
  }

  static bool is_seen(const Object& object) { return object.whole.A()(0, 0) > 0.0; }

  double draw() { return normal_(random_); }

  template <typename Matrix>
  void draw_into(Matrix&& matrix) {
    for (Eigen::Index i = 0; i < matrix.size(); ++i) matrix(i % matrix.rows(), i / matrix.rows()) = draw();
  }

  static DriftConfig config() {
    DriftConfig config;
    config.max_nodes = 8;
    config.max_spells = 4;
    return config;
  }

  static CalibrationPrior prior() {
    CalibrationPrior prior;
    prior.sigma_focal_percent = 50.0;
    return prior;
  }

  LandmarkObservation look(double time_s) {
    LandmarkObservation look;
    look.span = drift_.cover(VehicleTime{from_seconds(time_s)}, 0.4);
    draw_into(look.calibration_jacobian);
    draw_into(look.node_jacobian);
    look.slope = {draw(), draw()};
    look.value = {draw(), draw()};
    Eigen::Matrix2d root;
    draw_into(root);
    look.information = root * root.transpose() + Eigen::Matrix2d::Identity();
    return look;
  }

  void bound_spells() {
    while (drift_.sway().is_full()) {
      for (Object& object : objects_) {
        object.whole.freeze_spell(drift_.sway().begin(), drift_);
        if (!object.is_asleep) object.rest.freeze_spell(drift_.sway().begin(), drift_);
      }
      sleeping_.settled().freeze_oldest_spell(drift_);
      drift_.sway().freeze_oldest();
    }
  }

  void thin(const ThinnedNode& node) {
    const SwayTimeline& sway = drift_.sway();
    while (sway.size() > 1 && sway.spell(sway.begin()).node <= node.number) {
      for (Object& object : objects_) {
        object.whole.freeze_spell(sway.begin(), drift_);
        if (!object.is_asleep) object.rest.freeze_spell(sway.begin(), drift_);
      }
      sleeping_.settled().freeze_oldest_spell(drift_);
      drift_.sway().freeze_oldest();
    }
    for (Object& object : objects_) {
      object.whole.thin(node, drift_);
      if (!object.is_asleep) object.rest.thin(node, drift_);
    }
    sleeping_.settled().thin(node);
    drift_.thin(node);
  }

  void freeze_node() {
    for (Object& object : objects_) {
      object.whole.freeze(drift_.begin(), drift_);
      if (!object.is_asleep) object.rest.freeze(drift_.begin(), drift_);
    }
    sleeping_.settled().freeze_oldest_node(drift_);
    drift_.freeze_oldest();
  }

  void bound(bool thins) {
    bound_spells();
    while (drift_.size() > config().max_nodes) {
      const auto node = drift_.next_to_thin();
      if (node && thins) {
        thin(*node);
      } else {
        freeze_node();
      }
    }
  }

  void put(Object& object) {
    sleeping_.put(object.resting, drift_);
    object.is_asleep = true;
  }

  void wake(Object& object) {
    const Eigen::Vector2d far(1e6, 1e6);
    for (const auto key : sleeping_.near({-far, far})) {
      if (sleeping_.id_of(key) != object.resting.track.id) continue;
      sleeping_.wake(key, drift_, object.resting);
      object.is_asleep = false;
      EXPECT_TRUE(object.resting.is_settled);
      return;
    }
    ADD_FAILURE() << object.resting.track.id;
  }

  void expect_the_same_head() {
    std::vector<const Landmark*> all, awake;
    for (const Object& object : objects_) {
      if (!is_seen(object)) continue;
      all.push_back(&object.whole);
      if (!object.is_asleep) awake.push_back(&object.rest);
    }
    ArrowheadSolver one(prior(), config()), other(prior(), config());
    const auto expected = one.solve(all, kFlight, drift_);
    const auto found = other.solve(awake, kFlight, drift_, HeightLog(), &sleeping_.settled());
    ASSERT_TRUE(expected && found);
    EXPECT_LT((found->calibration().mean - expected->calibration().mean).norm(), 1e-8);
    EXPECT_LT((found->calibration().covariance - expected->calibration().covariance).norm(), 1e-8);
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      EXPECT_LT((found->node(number) - expected->node(number)).norm(), 1e-8) << number;
    for (std::uint32_t spell = drift_.sway().begin(); spell != drift_.sway().end(); ++spell)
      EXPECT_LT((found->spell(spell) - expected->spell(spell)).norm(), 1e-8) << spell;
    for (const Object& object : objects_) {
      if (!is_seen(object)) continue;
      if (object.is_asleep) continue;
      EXPECT_LT((found->covariance(object.rest) - expected->covariance(object.whole)).norm(), 1e-8);
    }
    // What is frozen later is what was found.
    for (std::uint32_t number = drift_.begin(); number != drift_.end(); ++number)
      drift_.node(number).mean = expected->node(number);
    for (std::uint32_t number = drift_.sway().begin(); number != drift_.sway().end(); ++number) {
      Spell& spell = drift_.sway().spell(number);
      spell.mean = expected->spell(number);
      spell.per_focal = expected->spell_per_focal(number);
      spell.focal = expected->calibration().mean[CalibrationIndex::kFocal];
    }
    latency_s_ = expected->calibration().latency_s();
    errors_.calibration = expected->calibration();
    errors_.drift = drift_;
    std::size_t visited = 0;
    sleeping_.visit_some(
        kObjects, errors_,
        [&](std::uint64_t id, std::size_t, const Point& position, const Landmark& landmark) {
          const Landmark& whole = objects_[id - 1].whole;
          const Point expected_position =
              whole.A().inverse() * whole.weighted_position(errors_.calibration.mean, drift_);
          EXPECT_LT((position - expected_position).norm(), 1e-8) << id;
          EXPECT_LT((found->covariance(landmark) - expected->covariance(whole)).norm(), 1e-8) << id;
          ++visited;
        });
    EXPECT_EQ(visited, sleeping_.size());
    drift_ = errors_.drift;
  }

  void fly(bool thins) {
    drift_.sway().set_variance(0.5, 0.3);
    PointInformation ground;
    ground.matrix(2, 2) = 0.25;
    for (Object& object : objects_) {
      object.whole.add_prior(ground);
      object.rest.add_prior(ground);
    }
    for (int step = 0; step < 400; ++step) {
      Object& seen = objects_[static_cast<std::size_t>(step / 5 + step % 3) % kObjects];
      const LandmarkObservation observation = look(0.31 * step);
      bound(thins);
      if (seen.is_asleep) wake(seen);
      seen.whole.add(observation, drift_);
      seen.rest.add(observation, drift_);
      Object& idle = objects_[random_() % kObjects];
      if (&idle != &seen && !idle.is_asleep && is_seen(idle)) put(idle);
      if (step == 200) freeze_latency();
      if (step % 20 == 19) expect_the_same_head();
    }
  }

  void freeze_latency() {
    for (Object& object : objects_) {
      object.whole.freeze_latency(latency_s_);
      if (!object.is_asleep) object.rest.freeze_latency(latency_s_);
    }
    sleeping_.freeze_latency(latency_s_);
  }

  std::mt19937 random_{11};
  std::normal_distribution<double> normal_;
  DriftTimeline drift_{config()};
  SleepingObjects sleeping_{config()};
  std::vector<Object> objects_{kObjects};
  double latency_s_ = 0.0;
  ArrowheadSolver solver_{prior(), config()};
  SharedErrorEstimate errors_{PositionAccuracy{0.8, 0.2, 0.02, 0.02}, testing::kHeightPrior,
                              NoiseEstimate(0.01), config(), solver_};
};

TEST_F(SleepingObject, AreAsGoodAsAwakeWhereNodesAreThinned) {
  fly(true);
}

TEST_F(SleepingObject, AreAsGoodAsAwakeWhereNodesAreFrozen) {
  fly(false);
}

}  // namespace
}  // namespace geoloc
