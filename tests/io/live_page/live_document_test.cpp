// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_document.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "page_frames.hpp"

namespace geoloc::io {
namespace {

using nlohmann::json;
using testing::page_frame;
using testing::page_object;

/// What the page's script does with the changes (page/model.js).
struct Mirror {
  LiveDocument::Cursor cursor;
  std::map<std::uint64_t, json> objects;
  json path = json::array();
  json fixes = json::array();

  json take(const LiveDocument& document) {
    const json change = json::parse(document.changes(cursor));
    if (change.contains("run")) {
      objects.clear();
      path = fixes = json::array();
    }
    for (const json& id : change.value("removed", json::array())) objects.erase(id.get<std::uint64_t>());
    for (const json& object : change["objects"]) objects[object["id"]] = object;
    if (change.contains("ids")) {
      std::map<std::uint64_t, json> living;
      for (const json& id : change["ids"]) living[id] = objects.at(id);
      objects = living;
    }
    if (change.contains("path_begins_anew")) path = json::array();
    path.insert(path.end(), change["path"].begin(), change["path"].end());
    fixes.insert(fixes.end(), change["fixes"].begin(), change["fixes"].end());
    return change;
  }
};

TEST(LiveDocument, ANewPageIsToldEverything) {
  LiveDocument document({"the run", true});
  document.add(page_frame(1, 3));
  Mirror page;
  const json change = page.take(document);
  EXPECT_EQ(change["run"]["name"], "the run");
  EXPECT_EQ(page.objects.size(), 3U);
  EXPECT_EQ(change["view"]["height_m"], 20.0);
  EXPECT_EQ(change["anchor"]["latitude_deg"], 1.0);
}

TEST(LiveDocument, ChangesAddUpToTheWholeHoweverOftenAPageLooks) {
  LiveDocument document({"", true});
  Mirror eager, lazy;
  for (int number = 0; number < 5000; ++number) {  // more than the path's capacity
    OutputFrame frame = page_frame(number, 4);
    frame.objects[1].hits = number;
    if (number % 7 == 3) frame.objects.erase(frame.objects.begin());  // gone, and back
    document.add(frame);
    eager.take(document);
    if (number % 1000 == 0) lazy.take(document);
  }
  lazy.take(document);
  Mirror fresh;
  fresh.take(document);
  for (const Mirror* page : {&eager, &lazy}) {
    EXPECT_EQ(page->objects, fresh.objects);
    EXPECT_EQ(page->path, fresh.path);
    EXPECT_EQ(page->fixes.back(), fresh.fixes.back());
  }
}

TEST(LiveDocument, WhatDidNotChangeIsNotSaidAgain) {
  LiveDocument document({"", true});
  document.add(page_frame(1, 1000));
  Mirror page;
  page.take(document);
  document.add(page_frame(2, 1000));
  const json change = page.take(document);
  EXPECT_TRUE(change["objects"].empty());
  EXPECT_FALSE(change.contains("run"));
  EXPECT_FALSE(change.contains("estimator"));  // it counts nothing in these frames
  EXPECT_TRUE(change.contains("view"));
}

/// An object that is no longer believed is shown as tentative, then not at all, and confirmed where it is
/// back.
TEST(LiveDocument, AnObjectIsShownAsConfirmedOnlyWhileItIs) {
  LiveDocument document({"", true});
  Mirror page;
  enum class Belief { kConfirmed, kTentative, kGone };
  int number = 0;
  for (const Belief belief :
       {Belief::kConfirmed, Belief::kTentative, Belief::kConfirmed, Belief::kTentative, Belief::kGone}) {
    OutputFrame frame = page_frame(++number, 2);
    const ObjectReport second = frame.objects[1];
    if (belief != Belief::kConfirmed) frame.objects.pop_back();
    if (belief == Belief::kTentative) frame.tentative.push_back(second);
    document.add(frame);
    page.take(document);
    ASSERT_EQ(page.objects.count(second.id), belief == Belief::kGone ? 0U : 1U) << number;
    if (belief != Belief::kGone) {
      EXPECT_EQ(page.objects[second.id]["confirmed"], belief == Belief::kConfirmed) << number;
    }
  }
}

/// Pages forget by ids what a few frames removed, and by what is left where they have not looked for long.
TEST(LiveDocument, ManyObjectsThatComeAndGoAreToldRightlyToPagesThatLookNowAndThen) {
  LiveDocument document({"", true});
  Mirror eager, lazy;
  std::mt19937 random(1);
  for (int number = 1; number <= 300; ++number) {
    OutputFrame frame = page_frame(number, 400);
    const auto is_gone = [&](const ObjectReport&) { return random() % 8 == 0; };
    frame.objects.erase(std::remove_if(frame.objects.begin(), frame.objects.end(), is_gone),
                        frame.objects.end());
    document.add(frame);
    eager.take(document);
    if (number % 100 == 0) lazy.take(document);
    ASSERT_EQ(eager.objects.size(), frame.objects.size()) << number;
  }
  Mirror fresh;
  fresh.take(document);
  EXPECT_EQ(eager.objects, fresh.objects);
  EXPECT_EQ(lazy.objects, fresh.objects);
}

TEST(LiveDocument, ObjectsThatHaveNoRoomAreCounted) {
  LiveDocument document({"", true}, 5);
  document.add(page_frame(1, 12));
  Mirror page;
  EXPECT_EQ(page.take(document)["not_shown"], 7);
  EXPECT_EQ(page.objects.size(), 5U);
  document.add(page_frame(2, 5));
  EXPECT_EQ(page.take(document)["not_shown"], 0);
}

TEST(LiveDocument, ManyObjectsAreSentAFewThousandAtATime) {
  constexpr std::size_t kObjects = 10'000;
  LiveDocument document({"", true});
  document.add(page_frame(1, kObjects));
  Mirror page;
  int messages = 0;
  while (document.wait(page.cursor, std::chrono::milliseconds(0))) {
    const json change = page.take(document);
    EXPECT_LE(change["objects"].size(), 4000U);
    if (++messages == 1) document.add(page_frame(2, kObjects));  // of which none has changed
  }
  EXPECT_EQ(messages, 3);
  EXPECT_EQ(page.objects.size(), kObjects);
}

TEST(LiveDocument, StaysBoundedOnALongFlight) {
  LiveDocument document({"", true});
  for (int number = 0; number < 20000; ++number) document.add(page_frame(number, 1));
  Mirror page;
  page.take(document);
  EXPECT_LE(page.path.size(), 4096U);
  EXPECT_LE(page.fixes.size(), 3000U);
}

TEST(LiveDocument, AFleetsMapTellsOfItsFlightsAndFollowsItsFrame) {
  LiveDocument document({"fleet club", true, true});
  RunRecord run;
  run.local_frame.emplace(Geodetic{1.0, 2.0});
  run.objects = page_frame(1, 2).objects;
  run.flights.resize(2);
  run.flights[0].flight = "a";
  run.flights[0].verdict = "fused";
  run.flights[0].places_in_enu = {{1.0, 2.0}, {3.0, 4.0}};
  run.flights[1].verdict = "quarantined";
  run.flights[1].reason = "</script>";
  document.add(run);
  Mirror page;
  json change = page.take(document);
  EXPECT_TRUE(change["run"]["is_fleet"]);
  EXPECT_EQ(page.objects.size(), 2U);
  EXPECT_EQ(change["flights"][0]["at"], json::parse("[[1, 2], [3, 4]]"));
  EXPECT_EQ(change["flights"][1]["reason"], "</script>");
  EXPECT_EQ(change["anchor"]["latitude_deg"], 1.0);
  run.local_frame.emplace(Geodetic{3.0, 2.0});  // another flight is the first now
  document.add(run);
  change = page.take(document);
  EXPECT_EQ(change["anchor"]["latitude_deg"], 3.0);
  EXPECT_FALSE(change.contains("flights")) << "they are as they were";
}

TEST(LiveDocument, HostileNamesStayText) {
  LiveDocument document({"</script>\xff\x01", true});
  OutputFrame frame = page_frame(1, 1);
  frame.objects[0].class_name = "\"]}\n\ndata: {\xc3\x28<img onerror=x>\x01";
  document.add(frame);
  LiveDocument::Cursor cursor;
  const std::string text = document.changes(cursor);
  EXPECT_EQ(text.find('\n'), std::string::npos);  // an event is one line
  const json change = json::parse(text);
  EXPECT_NE(change["objects"][0]["name"].get<std::string>().find("<img onerror=x>"), std::string::npos);
}

TEST(LiveDocument, WhatIsNotFiniteIsLeftOut) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  LiveDocument document({"", true});
  OutputFrame frame = page_frame(1, 2);
  frame.objects[0].position_in_enu.x() = nan;
  frame.objects[1].ellipse.sigma_major_m = nan;
  frame.view->vehicle_in_enu.x() = nan;
  frame.fixes[0].ground.position_in_enu.y() = std::numeric_limits<double>::infinity();
  document.add(frame);
  Mirror page;
  page.take(document);
  ASSERT_EQ(page.objects.size(), 1U);
  EXPECT_TRUE(page.objects.at(2)["major_m"].is_null());
  EXPECT_TRUE(page.path.empty());
  EXPECT_TRUE(page.fixes.empty());
  EXPECT_TRUE(json::accept(*document.object(2)));
}

TEST(LiveDocument, AnObjectTellsItsPlaceAndItsHistory) {
  LiveDocument document({"", true});
  for (int number = 1; number <= 1000; ++number) {
    OutputFrame frame = page_frame(number, 1);
    frame.objects[0].hits = number;
    frame.objects[0].ellipse.sigma_major_m = 1.0 / number;
    document.add(frame);
  }
  const json details = json::parse(*document.object(1));
  EXPECT_EQ(details["coordinates"]["degrees"], "1.00000000, 2.00000100");
  EXPECT_LE(details["history"].size(), 128U);
  EXPECT_EQ(details["history"].front()[1], 1);
  EXPECT_EQ(details["history"].back()[1], 1000);
  EXPECT_FALSE(document.object(99));
}

TEST(LiveDocument, ABetterPictureOfAnObjectIsTold) {
  LiveDocument document({"", true});
  document.show_object(2, "JPEG one");  // it may come before the object
  document.add(page_frame(1, 2));
  Mirror page;
  page.take(document);
  EXPECT_FALSE(page.objects.at(1).contains("picture"));
  const json first = page.objects.at(2)["picture"];
  document.show_object(2, "JPEG two");
  page.take(document);
  EXPECT_NE(page.objects.at(2)["picture"], first);
  EXPECT_EQ(*document.picture_of(2), "JPEG two");
  EXPECT_EQ(document.picture_of(1), nullptr);
}

TEST(LiveDocument, AForgottenPictureIsGoneAndItsObjectHasNone) {
  LiveDocument document({"", true});
  document.add(page_frame(1, 2));
  document.show_object(2, "JPEG");
  document.show_object(3, "JPEG of what no frame has");
  Mirror page;
  page.take(document);
  ASSERT_TRUE(page.objects.at(2).contains("picture"));
  for (const std::uint64_t id : {1, 2, 3}) document.forget_picture(id);
  page.take(document);
  EXPECT_FALSE(page.objects.at(2).contains("picture"));
  for (const std::uint64_t id : {1, 2, 3}) EXPECT_EQ(document.picture_of(id), nullptr);
}

TEST(LiveDocument, HasRoomForANewPictureHoweverManyWereForgotten) {
  LiveDocument document({"", true});
  for (std::uint64_t id = 1; id <= 10'000; ++id) {
    document.show_object(id, "JPEG");
    ASSERT_NE(document.picture_of(id), nullptr) << id;
    document.forget_picture(id);
  }
}

TEST(LiveDocument, WhatARunEndsWithIsShown) {
  LiveDocument document({"", true});
  document.add(page_frame(1, 3));
  Mirror page;
  page.take(document);
  RunRecord run;
  run.objects = {page_object(1), page_object(3)};
  run.objects[0].hits = 77;
  document.add(run);
  page.take(document);
  EXPECT_EQ(page.objects.size(), 2U);
  EXPECT_EQ(page.objects.at(1)["hits"], 77);
  EXPECT_EQ(document.record().objects.size(), 2U);
}

TEST(LiveDocument, AReplayThatBeginsAnewIsToldAsANewRunThatKeepsItsTargets) {
  LiveDocument document({"the run", false});
  RunRecord run;
  run.targets = {{1.0, 2.0}};
  document.add(run);
  document.add(page_frame(1, 3));
  document.end();
  Mirror page;
  page.take(document);
  document.begin_anew();
  document.add(page_frame(1, 1));
  const json change = page.take(document);
  EXPECT_EQ(change["run"]["name"], "the run");  // at which a page forgets all that it knew
  EXPECT_EQ(change["targets"].size(), 1U);
  EXPECT_FALSE(change.contains("ended"));
  EXPECT_EQ(change["objects"].size(), 1U);
  EXPECT_EQ(page.objects.size(), 1U);
  EXPECT_EQ(change["path"].size(), 1U);
  EXPECT_EQ(change["fixes"].size(), 1U);
}

}  // namespace
}  // namespace geoloc::io
