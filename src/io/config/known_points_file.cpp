// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/config/known_points_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <nlohmann/json.hpp>

namespace geoloc::io {
namespace {

using nlohmann::json;

/// As the survey's of positions, where the file states none.
constexpr double kSigmaHeight_m = 0.05;

double number(const json& value, const char* what) {
  if (!value.is_number()) throw std::invalid_argument(std::string(what) + " must be a number");
  return value.get<double>();
}

KnownPoint parse_point(const json& feature, std::size_t place) {
  const json none;
  const auto member = [&none](const json& object, const char* key) -> const json& {
    const auto found = object.is_object() ? object.find(key) : object.end();
    return object.is_object() && found != object.end() ? *found : none;
  };
  const json& coordinates = member(member(feature, "geometry"), "coordinates");
  if (!coordinates.is_array() || coordinates.size() < 2)
    throw std::invalid_argument("must be a Point with coordinates [lon, lat]");
  KnownPoint point;
  point.position = {number(coordinates[1], "latitude"), number(coordinates[0], "longitude")};
  const json& properties = member(feature, "properties");
  if (coordinates.size() > 2) {
    point.height_m = number(coordinates[2], "height");
    point.sigma_height_m = kSigmaHeight_m;
  }
  const json& id = member(properties, "id");
  point.name = id.is_string() ? id.get<std::string>() : id.is_number() ? id.dump() : std::to_string(place);
  if (const json& sigma = member(properties, "sigma_m"); !sigma.is_null())
    point.sigma_m = number(sigma, "sigma_m");
  const json& sigma_height = member(properties, "sigma_height_m");
  if (!sigma_height.is_null() && coordinates.size() > 2)
    point.sigma_height_m = number(sigma_height, "sigma_height_m");
  if (const json& class_id = member(properties, "class_id"); !class_id.is_null()) {
    if (!class_id.is_number_unsigned() || class_id.get<std::uint64_t>() > 1'000'000)
      throw std::invalid_argument("class_id must be a whole number from 0");
    point.class_id = class_id.get<int>();
  }
  for (const std::string& problem : point.problems())
    throw std::invalid_argument(problem + " (lon, lat order?)");
  return point;
}

/// Programs that know no heights write zeros.
void forget_if_all_zero(std::vector<KnownPoint>& points) {
  const auto is_zero = [](const KnownPoint& point) { return point.height_m == 0.0; };
  if (!std::all_of(points.begin(), points.end(), is_zero)) return;
  for (KnownPoint& point : points) point.sigma_height_m = 0.0;
}

}  // namespace

std::vector<KnownPoint> parse_known_points(const std::string& text, const std::string& name) {
  const json document = json::parse(text, nullptr, false);
  if (document.is_discarded() || !document.is_object() || !document.contains("features") ||
      !document["features"].is_array()) {
    throw std::runtime_error(name + ": not a GeoJSON FeatureCollection");
  }
  std::vector<KnownPoint> points;
  for (const json& feature : document["features"]) {
    try {
      points.push_back(parse_point(feature, points.size()));
    } catch (const std::exception& error) {
      throw std::runtime_error(name + ": feature " + std::to_string(points.size()) + ": " + error.what());
    }
  }
  if (points.empty()) throw std::runtime_error(name + ": holds no point");
  forget_if_all_zero(points);
  return points;
}

std::vector<KnownPoint> read_known_points(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error(file.string() + ": cannot be opened");
  return parse_known_points({std::istreambuf_iterator<char>(stream), {}}, file.string());
}

}  // namespace geoloc::io
