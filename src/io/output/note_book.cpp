// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/note_book.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geoloc/geometry/angles.hpp"
#include "geoloc/io/output/text.hpp"

namespace geoloc::io {
namespace {

constexpr std::size_t kMostNotes = 2000;
constexpr std::size_t kMostAdded = 10000;  // that nobody takes
constexpr double kSameObject_m = 10.0;     // an estimate moves in its first seconds
constexpr double kSamePlace_m = 2.0;
constexpr double kMeanRadius_m = 6371008.8;

/// Good to a percent over the few metres that are compared.
double distance_m(const Geodetic& a, const Geodetic& b) {
  const double north_m = (a.latitude_deg - b.latitude_deg) * kRadPerDeg * kMeanRadius_m;
  const double turn_deg = std::remainder(a.longitude_deg - b.longitude_deg, 360.0);
  const double east_m = turn_deg * kRadPerDeg * kMeanRadius_m * std::cos(a.latitude_deg * kRadPerDeg);
  return std::hypot(north_m, east_m);
}

ObjectReport* same_object(std::vector<ObjectReport>& objects, const NotedObject& noted) {
  const auto found = std::find_if(objects.begin(), objects.end(), [&](const ObjectReport& object) {
    return object.id == noted.object_id && distance_m(object.position, noted.position) < kSameObject_m;
  });
  return found == objects.end() ? nullptr : &*found;
}

/// The nearest object without a note; nullptr where none is near.
ObjectReport* nearest_object(std::vector<ObjectReport>& objects, const Geodetic& place) {
  ObjectReport* nearest = nullptr;
  double least_m = kSamePlace_m;
  for (ObjectReport& object : objects) {
    const double away_m = distance_m(object.position, place);
    if (!object.note.is_empty() || !(away_m < least_m)) continue;
    nearest = &object;
    least_m = away_m;
  }
  return nearest;
}

}  // namespace

bool NoteBook::keep(NotedObject noted) {
  noted.note.name = clean_text(noted.note.name, kLongestNoteName);
  if (noted.note.is_empty()) {
    notes_.erase(noted.object_id);
    return true;
  }
  if (notes_.size() >= kMostNotes && notes_.count(noted.object_id) == 0) return false;
  notes_[noted.object_id] = std::move(noted);
  return true;
}

bool NoteBook::add(const NotedObject& noted) {
  const std::lock_guard lock(mutex_);
  if (!keep(noted)) return false;
  if (added_.size() < kMostAdded) added_.push_back(noted);
  return true;
}

void NoteBook::load(const std::vector<NotedObject>& notes) {
  const std::lock_guard lock(mutex_);
  for (const NotedObject& noted : notes) keep(noted);
}

void NoteBook::apply(std::vector<ObjectReport>& objects) const {
  const std::lock_guard lock(mutex_);
  std::vector<const NotedObject*> homeless;
  for (const auto& [id, noted] : notes_) {
    if (ObjectReport* const object = same_object(objects, noted)) {
      object->note = noted.note;
    } else {
      homeless.push_back(&noted);
    }
  }
  for (const NotedObject* noted : homeless) {
    if (ObjectReport* const object = nearest_object(objects, noted->position)) object->note = noted->note;
  }
}

std::vector<NotedObject> NoteBook::take_added() {
  const std::lock_guard lock(mutex_);
  return std::exchange(added_, {});
}

}  // namespace geoloc::io
