// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/note_book.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "geoloc/io/output/csv.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/gpx.hpp"
#include "geoloc/io/output/kml.hpp"

namespace geoloc::io {
namespace {

constexpr double kMetre_deg = 9e-6;  // of latitude, about

ObjectReport object_at(std::uint64_t id, double north_m) {
  ObjectReport object;
  object.id = id;
  object.class_name = "target";
  object.position = {45.0 + north_m * kMetre_deg, 7.0};
  object.ellipse = {0.1, 0.1, 0.0};
  return object;
}

NotedObject note_of(std::uint64_t id, double north_m, const std::string& name,
                    Verdict verdict = Verdict::kNone) {
  return {HostTime{}, id, {45.0 + north_m * kMetre_deg, 7.0}, {name, verdict}};
}

TEST(NoteBook, ANoteStaysWithItsObjectAsItsEstimateMoves) {
  NoteBook book;
  book.add(note_of(1, 0.0, "red van", Verdict::kConfirmed));
  std::vector<ObjectReport> objects{object_at(2, 0.1), object_at(1, 3.0)};
  book.apply(objects);
  EXPECT_TRUE(objects[0].note.is_empty());
  EXPECT_EQ(objects[1].note, (ObjectNote{"red van", Verdict::kConfirmed}));
}

TEST(NoteBook, ANoteOfAnObjectThatIsGoneGoesToTheOneInItsPlace) {
  NoteBook book;
  book.add(note_of(1, 0.0, "red van"));
  std::vector<ObjectReport> objects{object_at(1, 50.0), object_at(7, 1.5), object_at(8, 0.5)};
  book.apply(objects);  // id 1 of other settings is another object
  EXPECT_TRUE(objects[0].note.is_empty());
  EXPECT_TRUE(objects[1].note.is_empty());
  EXPECT_EQ(objects[2].note.name, "red van");
}

TEST(NoteBook, ANoteFarFromAllObjectsIsGivenToNone) {
  NoteBook book;
  book.add(note_of(1, 0.0, "red van"));
  std::vector<ObjectReport> objects{object_at(7, 2.5)};
  book.apply(objects);
  EXPECT_TRUE(objects[0].note.is_empty());
}

TEST(NoteBook, TheLastNoteHoldsAndAnEmptyOneTakesItBack) {
  NoteBook book;
  std::vector<ObjectReport> objects{object_at(1, 0.0)};
  book.add(note_of(1, 0.0, "van"));
  book.add(note_of(1, 0.0, "lorry", Verdict::kDismissed));
  book.apply(objects);
  EXPECT_EQ(objects[0].note, (ObjectNote{"lorry", Verdict::kDismissed}));
  book.add(note_of(1, 0.0, ""));
  objects[0].note = {};
  book.apply(objects);
  EXPECT_TRUE(objects[0].note.is_empty());
}

TEST(NoteBook, TellsWhatWasAddedOnceAndNotWhatWasLoaded) {
  NoteBook book;
  book.load({note_of(1, 0.0, "old")});
  book.add(note_of(2, 0.0, "new"));
  const auto added = book.take_added();
  ASSERT_EQ(added.size(), 1U);
  EXPECT_EQ(added[0].note.name, "new");
  EXPECT_TRUE(book.take_added().empty());
}

TEST(NoteBook, StaysBoundedAndSaysSo) {
  NoteBook book;
  int kept = 0;
  for (std::uint64_t id = 0; id < 5000; ++id) kept += book.add(note_of(id, 0.0, "x")) ? 1 : 0;
  EXPECT_EQ(kept, 2000);
  EXPECT_TRUE(book.add(note_of(7, 0.0, "another name")));
}

TEST(NoteBook, KeepsAnyNameShortAndFreeOfControlCharacters) {
  NoteBook book;
  book.add(note_of(1, 0.0, std::string("\n\x1b[31m\xff") + std::string(500, 'a')));
  std::vector<ObjectReport> objects{object_at(1, 0.0)};
  book.apply(objects);
  EXPECT_LE(objects[0].note.name.size(), 70U);
  EXPECT_EQ(objects[0].note.name.find_first_of("\n\x1b\xff"), std::string::npos);
}

TEST(Outputs, TellNotesOfTheObjectsThatHaveOne) {
  ObjectReport noted = object_at(1, 0.0);
  noted.note = {"<b>=1,\"", Verdict::kConfirmed};
  RunRecord run;
  run.objects = {noted, object_at(2, 5.0)};
  run.local_frame.emplace(Geodetic{45.0, 7.0});
  const auto features = nlohmann::json::parse(objects_to_geojson(run.objects, {}))["features"];
  EXPECT_EQ(features[0]["properties"]["operator_name"], noted.note.name);
  EXPECT_EQ(features[0]["properties"]["operator_verdict"], "confirmed");
  EXPECT_FALSE(features[1]["properties"].contains("operator_name"));
  EXPECT_NE(objects_to_csv(run.objects).find(",\"<b>=1,\"\"\",confirmed,\n"), std::string::npos);
  EXPECT_NE(run_to_kml(run).find("<Data name=\"operator_verdict\"><value>confirmed</value>"),
            std::string::npos);
  EXPECT_NE(run_to_kml(run).find("<name>&lt;b&gt;=1,&quot; 1</name>"), std::string::npos);
  EXPECT_NE(run_to_gpx(run).find("<name>&lt;b&gt;=1,&quot; 1</name>"), std::string::npos);
}

TEST(Gpx, HoldsAWaypointPerObjectAndTheTrajectory) {
  RunRecord run;
  run.title = "a & b";
  run.objects = {object_at(1, 0.0), object_at(2, 5.0)};
  run.objects[0].height.msl_m = 12.345;
  run.objects[1].position.latitude_deg = std::numeric_limits<double>::quiet_NaN();
  run.local_frame.emplace(Geodetic{45.0, 7.0});
  run.trajectory = {{HostTime{}, {0.0, 0.0, 20.0}}, {HostTime{}, {std::nan(""), 0.0, 20.0}}};
  const std::string gpx = run_to_gpx(run);
  const auto count = [&gpx](const std::string& what) {
    int found = 0;
    for (std::size_t at = gpx.find(what); at != std::string::npos; at = gpx.find(what, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("<wpt "), 1);
  EXPECT_EQ(count("<trkpt "), 1);
  EXPECT_NE(gpx.find("<wpt lat=\"45.000000000\" lon=\"7.000000000\"><ele>12.35</ele>"), std::string::npos)
      << gpx;
  EXPECT_NE(gpx.find("<name>a &amp; b</name>"), std::string::npos);
  EXPECT_EQ(gpx.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace geoloc::io
