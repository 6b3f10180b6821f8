// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <Eigen/LU>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fleet/map_solver.hpp"
#include "tracking/place_index.hpp"

namespace geoloc {

/// An object of the map while it is being put together.
struct MapPlace {
  Eigen::Vector2d position;     ///< in its sheet
  Eigen::Matrix2d information;  ///< of its place among its neighbours [1/m^2]
  std::uint32_t sheet = 0;
  int class_id = 0;
  Members members;  ///< empty: it has become part of another place

  Eigen::Matrix2d covariance() const { return information.inverse(); }

  void add(const Eigen::Vector2d& other, const Eigen::Matrix2d& its_information) {
    const Eigen::Matrix2d sum = information + its_information;
    position += sum.inverse() * its_information * (other - position);
    information = sum;
  }
};

/// The map on sheets: places on one sheet are known against each other, and a sheet as a whole is off by what
/// its flights are. A flight that is laid onto two sheets makes one of them.
class MapPlaces {
 public:
  MapPlaces() : index_(kCell_m) {}

  std::size_t size() const { return places_.size(); }
  MapPlace& operator[](std::uint32_t key) { return places_[key]; }
  const MapPlace& operator[](std::uint32_t key) const { return places_[key]; }

  std::uint32_t new_sheet(const Eigen::Matrix2d& shift_covariance) {
    sheets_.push_back({shift_covariance, {}});
    return static_cast<std::uint32_t>(sheets_.size() - 1);
  }
  const Eigen::Matrix2d& shift_covariance(std::uint32_t sheet) const {
    return sheets_[sheet].shift_covariance;
  }

  void add(MapPlace place) {
    const auto key = static_cast<std::uint32_t>(places_.size());
    index_.insert(key, place.position);
    sheets_[place.sheet].keys.push_back(key);
    places_.push_back(std::move(place));
  }

  /// Another look at a place.
  void update(std::uint32_t key, const Eigen::Vector2d& position, const Eigen::Matrix2d& information) {
    places_[key].add(position, information);
    index_.move(key, places_[key].position);
  }

  /// Both are one object.
  void merge(std::uint32_t kept, std::uint32_t gone) {
    update(kept, places_[gone].position, places_[gone].information);
    places_[kept].members.insert(places_[kept].members.end(), places_[gone].members.begin(),
                                 places_[gone].members.end());
    places_[gone].members.clear();
    index_.erase(gone);
  }

  /// What is on the one sheet is on the other from now on, moved by so much.
  void join(std::uint32_t gone, std::uint32_t kept, const Eigen::Vector2d& moved) {
    for (const std::uint32_t key : sheets_[gone].keys) {
      places_[key].sheet = kept;
      places_[key].position += moved;
      if (!places_[key].members.empty()) index_.move(key, places_[key].position);
      sheets_[kept].keys.push_back(key);
    }
    sheets_[gone].keys.clear();
  }

  /// Calls visit(key) for the places within a square around a point, and perhaps some more.
  template <typename Visit>
  void for_each_near(const Eigen::Vector2d& point, double reach_m, const Visit& visit) const {
    const Eigen::Vector2d reach(reach_m, reach_m);
    index_.for_each_near({point - reach, point + reach}, visit);
  }

  /// The members of all places.
  std::vector<Members> take() {
    std::vector<Members> all;
    for (MapPlace& place : places_) {
      if (!place.members.empty()) all.push_back(std::move(place.members));
    }
    return all;
  }

 private:
  static constexpr double kCell_m = 3.0;
  struct Sheet {
    Eigen::Matrix2d shift_covariance;
    std::vector<std::uint32_t> keys;
  };
  std::vector<MapPlace> places_;
  std::vector<Sheet> sheets_;
  PlaceIndex index_;
};

}  // namespace geoloc
