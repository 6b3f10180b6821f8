// SPDX-License-Identifier: Apache-2.0
#include "tracking/sleeping_objects.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/room.hpp"

namespace geoloc {
namespace {

/// About what an image shows from usual heights.
constexpr double kCell_m = 20.0;
/// All are visited before so many nodes were made: a quarter of what the drift remembers.
constexpr double kNodesPerTurn = NodeHistory::kRemembered / 4.0;
/// Room for the terms of so many objects, where some have more than one pass gives them.
std::size_t room_for_terms(std::size_t objects) {
  return objects + objects / 2;
}

}  // namespace

SleepingObjects::SleepingObjects(const DriftConfig& drift, std::size_t at_first)
    : settled_(drift), index_(kCell_m, at_first) {
  take_room(this, drift, at_first);
}

std::size_t SleepingObjects::take_room(SleepingObjects* self, const DriftConfig& drift,
                                       std::size_t at_first) {
  return SettledSums::take_room(nullptr, drift) + PlaceIndex::take_room(nullptr, at_first) +
         decltype(sleepers_)::take_room(room::part(self, &SleepingObjects::sleepers_), at_first) +
         decltype(terms_)::take_room(room::part(self, &SleepingObjects::terms_), room_for_terms(at_first)) +
         room::reserve(self, &SleepingObjects::near_, at_first + at_first / 2);
}

void SleepingObjects::reserve(std::size_t count) {
  sleepers_.reserve(count);
  terms_.reserve(room_for_terms(count));
  index_.reserve(count);
  if (near_.capacity() < count) near_.reserve(count + count / 2);
}

void SleepingObjects::drop_terms(Sleeper& sleeper) {
  for (Key terms = sleeper.first_terms; terms != kNone; terms = terms_[terms].next) terms_.give_back(terms);
  sleeper.first_terms = kNone;
}

void SleepingObjects::keep_terms(Sleeper& sleeper, const Landmark& landmark, const DriftTimeline& drift) {
  Key* end = &sleeper.first_terms;
  Terms* last = nullptr;
  const auto keep = [&](std::uint32_t number, bool is_spell, const Landmark::NodeRows& B) {
    if (last == nullptr || last->count == Terms::kMost) {
      *end = terms_.take();
      last = &terms_[*end];
      last->count = 0;
      last->next = kNone;
      end = &last->next;
    }
    last->terms[last->count++] = {number, is_spell, B};
  };
  for (const Landmark::NodeTerms& terms : landmark) keep(drift.node(terms.number).serial, false, terms.B);
  for (const Landmark::SpellTerms& terms : landmark.spells()) keep(terms.number, true, terms.B);
}

void SleepingObjects::put(const RestingObject& object, const DriftTimeline& drift) {
  const Landmark& landmark = *object.landmark;
  settled_.settle(landmark);
  const Key key = sleepers_.take();
  Sleeper& sleeper = sleepers_[key];
  sleeper = {object.track.id,
             object.published_at,
             object.existence,
             object.neighbours,
             object.last_look,
             object.sums_since,
             object.size_m,
             object.was_confirmed,
             object.mixture,
             object.ground,
             object.pixel_information,
             landmark.A(),
             landmark.b(),
             landmark.B(),
             object.position_in_enu.head<2>(),
             kNone};
  keep_terms(sleeper, landmark, drift);
  index_.insert(key, object.position_in_enu.head<2>());
}

const std::vector<SleepingObjects::Key>& SleepingObjects::near(const Eigen::AlignedBox2d& area) {
  near_.clear();
  if (size() > 0) index_.for_each_near(area, [this](Key key) { near_.push_back(key); });
  return near_;
}

/// Nodes and spells that are gone are what became of them.
void SleepingObjects::restore(const Sleeper& sleeper, DriftTimeline& drift, Landmark& landmark) const {
  landmark.restore(sleeper.A, sleeper.b, sleeper.B);
  const SwayTimeline& sway = drift.sway();
  PointInformation known;  // of which only the vector changes
  const auto restore_term = [&](const Term& term) {
    if (!term.is_spell) {
      const NodeHistory::Blend blend = drift.resolve(term.number);
      for (const NodeHistory::Share& share : blend.shares) {
        if (share.weight != 0.0)
          landmark.restore_node(drift.number_of(share.serial), share.weight * term.B, drift);
      }
      known.vector += term.B * blend.constant;
    } else if (sway.is_frozen(term.number)) {
      const Spell& spell = sway.spell(term.number);
      known.vector += term.B * spell.constant();
      landmark.depend_on_focal(term.B * spell.per_focal);
    } else {
      landmark.restore_spell(term.number, sway.spell(term.number).node, term.B, drift);
    }
  };
  for (Key key = sleeper.first_terms; key != kNone; key = terms_[key].next) {
    const Terms& terms = terms_[key];
    std::for_each_n(terms.terms.begin(), terms.count, restore_term);
  }
  landmark.add_prior(known);
}

void SleepingObjects::wake(Key key, DriftTimeline& drift, RestingObject& object) {
  Sleeper& sleeper = sleepers_[key];
  restore(sleeper, drift, *object.landmark);
  settled_.restore(*object.landmark);
  object.published_at = sleeper.published_at;
  object.existence = sleeper.existence;
  object.neighbours = sleeper.neighbours;
  object.last_look = sleeper.last_look;
  object.sums_since = sleeper.sums_since;
  object.size_m = sleeper.size_m;
  object.was_confirmed = sleeper.was_confirmed;
  object.mixture = sleeper.mixture;
  object.prior = object.ground = sleeper.ground;
  object.pixel_information = sleeper.pixel_information;
  object.is_compared = true;
  object.is_settled = true;
  forget(key);
}

void SleepingObjects::forget(Key key) {
  drop_terms(sleepers_[key]);
  sleepers_[key].id = 0;
  index_.erase(key);
  sleepers_.give_back(key);
}

/// By the nodes and spells that are left, so that none is asked for that is long forgotten.
Point SleepingObjects::bring_up_to_date(Key key, SharedErrorEstimate& errors) {
  Sleeper& sleeper = sleepers_[key];
  restore(sleeper, errors.drift, scratch_);
  drop_terms(sleeper);
  sleeper.b = scratch_.b();
  sleeper.B = scratch_.B();
  keep_terms(sleeper, scratch_, errors.drift);
  const Point position =
      sleeper.A.inverse() * scratch_.weighted_position(errors.calibration.mean, errors.drift);
  sleeper.position_in_enu = position.head<2>();
  index_.move(key, sleeper.position_in_enu);
  return position;
}

/// Only where there is one.
SleepingObjects::Key SleepingObjects::next_in_turn() {
  do {
    turn_ = turn_ + 1 < sleepers_.end() ? turn_ + 1 : 0;
  } while (sleepers_[turn_].id == 0);
  return turn_;
}

/// Visits that were made ahead count, but for no more than one node.
std::size_t SleepingObjects::due(std::size_t least, std::uint32_t nodes_made) {
  const double per_node = static_cast<double>(size()) / kNodesPerTurn;
  owed_ += per_node * (nodes_made - std::exchange(nodes_made_, nodes_made));
  const auto owed = static_cast<std::size_t>(std::ceil(std::max(0.0, owed_)));
  const std::size_t count = std::min(size(), std::max(least, owed));
  owed_ = std::max(-per_node, owed_ - static_cast<double>(count));
  return count;
}

void SleepingObjects::freeze_latency(double latency_s) {
  constexpr int kLatency = CalibrationIndex::kLatency;
  settled_.freeze_latency(latency_s);
  for (Key key = 0; key < sleepers_.end(); ++key) {
    Sleeper& sleeper = sleepers_[key];
    sleeper.b += sleeper.B.col(kLatency) * latency_s;
    sleeper.B.col(kLatency).setZero();
  }
}

void SleepingObjects::clear() {
  settled_.clear();
  for (Key key = 0; key < sleepers_.end(); ++key) {
    if (sleepers_[key].id != 0) forget(key);
  }
}

}  // namespace geoloc
