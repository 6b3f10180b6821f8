// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/fleet/summary_file.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <utility>

#include "fleet/divided_flight.hpp"
#include "fleet/synthetic_fleet.hpp"
#include "fuzz/hostile_summaries.hpp"
#include "support/spoilt_bytes.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

FlightSummary any_flight(std::size_t objects = 7) {
  std::mt19937 random(5);
  FlightSummary summary =
      testing::draw_flight("flight-1", testing::clustered_targets(objects, random), {}, random);
  if (objects > 4) summary.apart = {{0, 1}, {2, 4}};
  return summary;
}

/// With what makes it a part of a flight.
FlightSummary any_part(std::size_t objects = 7) {
  std::mt19937 random(6);
  const testing::DividedFlight flight(testing::clustered_targets(objects, random), random);
  FlightSummary summary = flight.summary("part-1", 4, 12);
  summary.part->run.whole = "tuesday";
  return summary;
}

std::string fault_of(const std::string& content) {
  try {
    static_cast<void>(parse_summary(content, "some file"));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

/// The bytes with some at a place overwritten, and their checksum made to fit.
template <typename Number>
std::string with_number(std::string bytes, std::size_t at, Number number) {
  std::memcpy(&bytes[at], &number, sizeof(number));
  const std::uint64_t sum =
      summary_checksum(std::string_view(bytes).substr(0, bytes.size() - sizeof(std::uint64_t)));
  std::memcpy(&bytes[bytes.size() - sizeof(sum)], &sum, sizeof(sum));
  return bytes;
}

void expect_same_part(const FlightSummary::Part& a, const FlightSummary::Part& b) {
  EXPECT_EQ(a.run.whole, b.run.whole);
  EXPECT_EQ(a.run.booted_at, b.run.booted_at);
  EXPECT_EQ(a.run.ended_at, b.run.ended_at);
  EXPECT_EQ(a.state.first_node_at, b.state.first_node_at);
  EXPECT_EQ(a.state.last_node_at, b.state.last_node_at);
  EXPECT_EQ(a.state.drift.position_time_constant_s, b.state.drift.position_time_constant_s);
  EXPECT_EQ(a.state.drift.ripple_share, b.state.drift.ripple_share);
  EXPECT_EQ(a.state.drift.ripple_time_constant_s, b.state.drift.ripple_time_constant_s);
  EXPECT_EQ(a.state.drift.up_time_constant_s, b.state.drift.up_time_constant_s);
  EXPECT_EQ(a.state.drift.yaw_time_constant_s, b.state.drift.yaw_time_constant_s);
  EXPECT_EQ(a.state.shared_error, b.state.shared_error);
  ASSERT_EQ(a.state.unknowns.size(), b.state.unknowns.size());
  for (std::size_t i = 0; i < a.state.unknowns.size(); ++i) {
    EXPECT_EQ(a.state.unknowns[i].which, b.state.unknowns[i].which);
    EXPECT_EQ(a.state.unknowns[i].mean, b.state.unknowns[i].mean);
    EXPECT_EQ(a.state.unknowns[i].prior_mean, b.state.unknowns[i].prior_mean);
    EXPECT_EQ(a.state.unknowns[i].prior_sigma, b.state.unknowns[i].prior_sigma);
  }
}

void expect_same(const FlightSummary& a, const FlightSummary& b) {
  ASSERT_EQ(a.part.has_value(), b.part.has_value());
  if (a.part) expect_same_part(*a.part, *b.part);
  EXPECT_EQ(a.identity.flight, b.identity.flight);
  EXPECT_EQ(a.identity.vehicle, b.identity.vehicle);
  EXPECT_EQ(a.identity.sequence, b.identity.sequence);
  EXPECT_EQ(a.origin.latitude_deg, b.origin.latitude_deg);
  EXPECT_EQ(a.origin.longitude_deg, b.origin.longitude_deg);
  EXPECT_EQ(a.home_height_msl_m, b.home_height_msl_m);
  EXPECT_EQ(a.apart, b.apart);
  ASSERT_EQ(a.shared_error.rows(), b.shared_error.rows());
  ASSERT_EQ(a.shared_error.size(), b.shared_error.size());
  // Of a flight without objects nothing is off: JSON does not say how many errors that is none of.
  EXPECT_TRUE(a.shared_error.size() == 0 || a.shared_error == b.shared_error);
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const FlightSummary::Object &one = a.objects[i], &other = b.objects[i];
    EXPECT_EQ(one.id, other.id);
    EXPECT_EQ(one.position_in_enu, other.position_in_enu);
    EXPECT_EQ(one.own_covariance, other.own_covariance);
    EXPECT_EQ(one.hits, other.hits);
    EXPECT_EQ(one.existence, other.existence);
    EXPECT_EQ(one.first_seen, other.first_seen);
    EXPECT_EQ(one.last_seen, other.last_seen);
    EXPECT_EQ(one.class_votes.winner(), other.class_votes.winner());
  }
}

TEST(SummaryFile, EveryBitComesBackInEitherForm) {
  FlightSummary homeless = any_flight();
  homeless.home_height_msl_m.reset();
  homeless.identity.vehicle.clear();
  for (const FlightSummary& summary :
       {any_flight(), any_flight(1), any_flight(0), homeless, any_part(), any_part(3)}) {
    expect_same(summary_from_bytes(summary_to_bytes(summary), "bytes"), summary);
    expect_same(summary_from_json(summary_to_json(summary), "JSON"), summary);
  }
}

TEST(SummaryFile, IsReadInEitherForm) {
  const testing::TemporaryFolder folder;
  const FlightSummary summary = any_flight();
  for (const std::string& content : {summary_to_bytes(summary), summary_to_json(summary)}) {
    const auto file = folder.path() / "summary";
    std::ofstream(file, std::ios::binary) << content;
    expect_same(read_summary(file), summary);
  }
}

TEST(SummaryFile, OneThatIsNotThereIsNamed) {
  const testing::TemporaryFolder folder;
  for (const auto& file : {folder.path() / "none", folder.path()}) {
    try {
      static_cast<void>(read_summary(file));
      ADD_FAILURE() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()).rfind(file.string() + ": ", 0), 0U) << error.what();
    }
  }
}

TEST(SummaryFile, AnyPieceThatIsMissingIsNoticed) {
  for (const std::string& whole : {summary_to_bytes(any_flight()), summary_to_bytes(any_part())}) {
    for (std::size_t size = 0; size < whole.size(); ++size)
      EXPECT_NE(fault_of(whole.substr(0, size)), "") << size;
    EXPECT_NE(fault_of(whole + "x"), "");
  }
}

TEST(SummaryFile, AnyBitThatIsDamagedIsNoticed) {
  const std::string whole = summary_to_bytes(any_flight(2));
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    std::string damaged = whole;
    damaged[bit / 8] = static_cast<char>(damaged[bit / 8] ^ (1 << (bit % 8)));
    EXPECT_NE(fault_of(damaged), "") << bit;
  }
}

TEST(SummaryFile, ReasonsAreNamed) {
  const std::string good = summary_to_bytes(any_flight());
  EXPECT_EQ(fault_of(""), "some file: is empty");
  EXPECT_EQ(fault_of("what is this, perhaps a picture?"), "some file: is not a flight summary");
  EXPECT_NE(fault_of(with_number(good, 8, std::uint32_t{3}))
                .find("format version 3; this program reads versions 1 and 2"),
            std::string::npos);
  EXPECT_NE(fault_of(with_number(good, 8, std::uint32_t{2})), "");  // the part is missing
  EXPECT_NE(fault_of(with_number(good, 12, std::uint32_t{30'000})).find("30000 objects"), std::string::npos);
  EXPECT_NE(fault_of(with_number(good, 16, std::uint32_t{600})).find("600 shared errors"), std::string::npos);
  EXPECT_NE(fault_of(with_number(good, 20, std::uint32_t{99'999})).find("99999 pairs apart"),
            std::string::npos);
  EXPECT_NE(fault_of(with_number(good, 12, std::uint32_t{6})).find("not as long as its counts say"),
            std::string::npos);
  FlightSummary indefinite = any_flight();
  indefinite.objects[2].own_covariance(0, 1) = indefinite.objects[2].own_covariance(1, 0) = 1.0;
  EXPECT_NE(fault_of(summary_to_bytes(indefinite)).find("object 3: own covariance must be"),
            std::string::npos);
  EXPECT_NE(fault_of(summary_to_json(indefinite)).find("object 3: own covariance must be"),
            std::string::npos);
}

TEST(SummaryFile, FaultsOfJsonAreNamedByTheirPlace) {
  const auto good = nlohmann::json::parse(summary_to_json(any_flight()));
  const auto fault = [&](auto spoil) {
    auto spoilt = good;
    spoil(spoilt);
    return fault_of(spoilt.dump());
  };
  EXPECT_EQ(fault([](auto& s) { s.erase("origin"); }), "some file: origin is missing");
  EXPECT_EQ(fault([](auto& s) { s["format"] = "other"; }),
            "some file: format must be \"geoloc flight summary\"");
  EXPECT_NE(fault([](auto& s) { s["version"] = 7; }).find("format version 7"), std::string::npos);
  EXPECT_EQ(fault([](auto& s) { s["objects"][3]["hits"] = "many"; }),
            "some file: objects[3]: hits must be a whole number in its range");
  EXPECT_EQ(fault([](auto& s) { s["objects"][3]["existence"] = nullptr; }),
            "some file: objects[3]: existence must be a number");
  EXPECT_NE(fault([](auto& s) { s["objects"][3]["shared_error_m"][1].erase(0); }).find("must be a list of 4"),
            std::string::npos);
  EXPECT_NE(fault([](auto& s) { s["sequence"] = -1; }).find("sequence must be a whole number"),
            std::string::npos);
  EXPECT_EQ(fault_of("{\"format\":"), "some file: is not JSON, or was cut off");
}

/// A program that knows of no parts reads what is none.
TEST(SummaryFile, AFlightByItselfIsWrittenAsBeforeThereWereParts) {
  std::uint32_t version = 0;
  std::memcpy(&version, &summary_to_bytes(any_flight())[8], sizeof(version));
  EXPECT_EQ(version, 1U);
  std::memcpy(&version, &summary_to_bytes(any_part())[8], sizeof(version));
  EXPECT_EQ(version, 2U);
  EXPECT_EQ(nlohmann::json::parse(summary_to_json(any_flight()))["version"], 1);
  EXPECT_EQ(nlohmann::json::parse(summary_to_json(any_part()))["version"], 2);
}

TEST(SummaryFile, FaultsOfAPartAreNamed) {
  const auto fault = [](auto spoil) {
    FlightSummary spoilt = any_part();
    spoil(*spoilt.part);
    const std::string of_bytes = fault_of(summary_to_bytes(spoilt));
    return of_bytes;
  };
  const auto is_named = [](const std::string& fault, const char* reason) {
    return fault.find(std::string("part of a flight: ") + reason) != std::string::npos;
  };
  using Part = FlightSummary::Part;
  EXPECT_TRUE(is_named(fault([](Part& p) { p.run.whole = "a b"; }), "the whole flight's name"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.run.booted_at = HostTime::max(); }), "its times"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.run.ended_at = VehicleTime::min(); }), "its times"));
  EXPECT_TRUE(
      is_named(fault([](Part& p) { std::swap(p.state.first_node_at, p.state.last_node_at); }), "its times"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.state.drift.ripple_share = 1.5; }), "the drift's"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.state.drift.yaw_time_constant_s = 0.0; }), "the drift's"));
  EXPECT_TRUE(is_named(fault([](Part& p) { std::swap(p.state.unknowns[0], p.state.unknowns[1]); }),
                       "its unknowns must be in their order"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.state.unknowns.back().which = FlightUnknown{17}; }),
                       "its unknowns must be in their order"));
  EXPECT_TRUE(
      is_named(fault([](Part& p) { p.state.unknowns[0].mean = std::nan(""); }), "its unknowns must be"));
  EXPECT_TRUE(
      is_named(fault([](Part& p) { p.state.unknowns[0].prior_sigma = 0.0; }), "its unknowns must be"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.state.shared_error(1, 1) = 1e7; }), "its unknowns must be"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.state.shared_error.row(1) = p.state.shared_error.row(2); }),
                       "its unknowns' covariance"));
  EXPECT_TRUE(is_named(fault([](Part& p) { p.state.shared_error.conservativeResize(Eigen::NoChange, 2); }),
                       "its shared errors"));
}

TEST(SummaryFile, FaultsOfAPartInJsonAreNamed) {
  const auto good = nlohmann::json::parse(summary_to_json(any_part()));
  const auto fault = [&](auto spoil) {
    auto spoilt = good;
    spoil(spoilt["part"]);
    return fault_of(spoilt.dump());
  };
  EXPECT_EQ(fault([](auto& part) { part.erase("drift"); }), "some file: drift is missing");
  EXPECT_EQ(fault([](auto& part) { part["unknowns"] = 3; }), "some file: unknowns must be a list");
  EXPECT_EQ(fault([](auto& part) { part["unknowns"][2]["name"] = "luck"; }),
            "some file: there is no unknown by the name of luck");
  EXPECT_NE(fault([](auto& part) { part["unknowns"][2]["shared_error"].erase(0); }).find("must be a list of"),
            std::string::npos);
  auto partless = good;
  partless.erase("part");
  EXPECT_EQ(fault_of(partless.dump()), "some file: part is missing");
}

TEST(SummaryFile, NothingHostileIsTaken) {
  std::mt19937 random(1);
  for (const std::string& good : {summary_to_bytes(any_flight(3)), summary_to_json(any_flight(3)),
                                  summary_to_bytes(any_part(3)), summary_to_json(any_part(3))}) {
    hostile::read_any_summary(good);
    for (int i = 0; i < 2000; ++i) hostile::read_any_summary(testing::spoilt(good, random));
    const std::string unsealed = good.substr(0, good.size() - sizeof(std::uint64_t));
    for (int i = 0; i < 2000; ++i) hostile::read_any_sealed_summary(testing::spoilt(unsealed, random));
  }
}

}  // namespace
}  // namespace geoloc::io
