// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/fleet/fused_report.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "fleet/divided_flight.hpp"
#include "fleet/synthetic_fleet.hpp"

namespace geoloc::io {
namespace {

Fleet fleet_with_a_poisoned_flight() {
  std::mt19937 random(9);
  Fleet fleet = testing::draw_fleet(6, testing::clustered_targets(30, random), {}, random);
  testing::move_east(6.0, fleet.at(testing::flight_name(2)));
  return fleet;
}

TEST(FusedReport, ObjectsAreWhereTheMapHasThem) {
  const FusedMap map = fuse(fleet_with_a_poisoned_flight());
  const auto reports = report_objects(map, {"car"});
  ASSERT_EQ(reports.size(), map.objects.size());
  for (std::size_t i = 0; i < reports.size(); ++i) {
    EXPECT_EQ(reports[i].class_name, "car");
    const Eigen::Vector2d back = map.frame->to_local(reports[i].position).position_in_enu;
    EXPECT_LT((back - map.objects[i].position_in_enu.head<2>()).norm(), 1e-6);
    EXPECT_NEAR(std::pow(reports[i].ellipse.sigma_major_m, 2) + std::pow(reports[i].ellipse.sigma_minor_m, 2),
                (map.objects[i].covariance.topLeftCorner<2, 2>().trace()), 1e-9);
    EXPECT_NEAR(*reports[i].height.msl_m - reports[i].height.above_home_m, 12.0, 1e-9);
  }
}

TEST(FusedReport, GeoJsonTellsOfFlightsAndWhoSawWhat) {
  const FusedMap map = fuse(fleet_with_a_poisoned_flight());
  const auto json = nlohmann::json::parse(fused_to_geojson(map, report_objects(map, {})));
  ASSERT_EQ(json["flights"].size(), 6U);
  EXPECT_EQ(json["flights"][2]["verdict"], "quarantined");
  EXPECT_NEAR(json["flights"][2]["common_error_enu_m"][0].get<double>(), 5.0, 2.5);
  EXPECT_EQ(json["flights"][3]["verdict"], "fused");
  ASSERT_EQ(json["features"].size(), 30U);
  for (const auto& feature : json["features"]) {
    EXPECT_EQ(feature["properties"]["flights"].size(), 5U);
    for (const auto& flight : feature["properties"]["flights"]) EXPECT_NE(flight, testing::flight_name(2));
  }
}

TEST(FusedReport, TheTableNamesTheQuarantinedFlightAndWhy) {
  const std::string table = flights_to_table(fuse(fleet_with_a_poisoned_flight()));
  const auto line = table.find("flight-02  quarantined");
  ASSERT_NE(line, std::string::npos) << table;
  EXPECT_NE(table.find("its objects lie", line), std::string::npos) << table;
}

TEST(FusedReport, PartsOfAFlightNameEachOther) {
  std::mt19937 random(4);
  const testing::DividedFlight flight(testing::clustered_targets(30, random), random);
  Fleet fleet;
  for (const FlightSummary& part : {flight.summary("a", 12), flight.summary("b", 0, 12)}) take(part, fleet);
  const FusedMap map = fuse(fleet);
  const auto json = nlohmann::json::parse(fused_to_geojson(map, report_objects(map, {})));
  for (const auto& told : json["flights"]) EXPECT_EQ(told["parts"], (nlohmann::json{"b", "a"}));
  EXPECT_NE(flights_to_table(map).find("one flight with its other parts: b, a"), std::string::npos);
  const FusedMap other = fuse(fleet_with_a_poisoned_flight());
  EXPECT_EQ(fused_to_geojson(other, report_objects(other, {})).find("parts"), std::string::npos);
}

TEST(FusedReport, FlightsAreReportedWithTheirObjectsWhereTheyHaveThem) {
  const Fleet fleet = fleet_with_a_poisoned_flight();
  const FusedMap map = fuse(fleet);
  const auto reports = report_flights(map, fleet);
  ASSERT_EQ(reports.size(), 6U);
  EXPECT_EQ(reports[2].verdict, "quarantined");
  EXPECT_NE(reports[2].reason, "");
  for (const FlightReport& report : reports) {
    const auto& objects = fleet.at(report.flight).objects;
    ASSERT_EQ(report.places_in_enu.size(), objects.size());
    for (std::size_t i = 0; i < objects.size(); ++i)
      EXPECT_LT((report.places_in_enu[i] - objects[i].position_in_enu.head<2>()).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace geoloc::io
