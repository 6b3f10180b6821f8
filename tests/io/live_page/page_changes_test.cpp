// SPDX-License-Identifier: Apache-2.0
// What pages may change: notes of objects, and how a replay is played.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "form_fields.hpp"
#include "geoloc/io/live_page/live_page.hpp"
#include "geoloc/io/output/geojson.hpp"
#include "geoloc/io/output/gpx.hpp"
#include "loopback_client.hpp"
#include "page_frames.hpp"

namespace geoloc::io {
namespace {

using nlohmann::json;
using testing::page_frame;

PageRequest post(const std::string& path, const std::string& query) {
  PageRequest request{"POST", path, "127.0.0.1:8080", "same-origin", "cors"};
  request.query = query;
  request.origin = "http://127.0.0.1:8080";
  request.is_from_this_computer = true;
  return request;
}

class Changes : public ::testing::Test {
 protected:
  Changes() { document.add(page_frame(1, 3)); }

  int note(const std::string& path, const std::string& query) const {
    return site.answer(post(path, query)).status;
  }
  json object(std::uint64_t id) const { return json::parse(*document.object(id))["object"]; }

  LiveDocument document{{"run", false}};
  PictureBoard board{{"target"}, std::chrono::milliseconds{100}};
  ReplayControl playback{HostTime{std::chrono::seconds{100}}, HostTime{std::chrono::seconds{200}}, 1.0};
  PageActions actions{
      [this](std::uint64_t id, const ObjectNote& its) { return document.note(id, its).has_value(); },
      [this](const ReplayWish& wish) { playback.wish(wish); }};
  LiveSite site{document, board, {}, {"localhost"}, {}, actions};
};

TEST_F(Changes, AnObjectIsNamedConfirmedAndDismissed) {
  EXPECT_EQ(note("/objects/2/note", "name=Red%20van+%26&verdict=confirmed"), 204);
  EXPECT_EQ(object(2)["operator_name"], "Red van &");
  EXPECT_EQ(object(2)["verdict"], "confirmed");
  EXPECT_EQ(note("/objects/2/note", "verdict=dismissed"), 204);
  EXPECT_EQ(object(2)["verdict"], "dismissed");
  EXPECT_FALSE(object(2).contains("operator_name"));
  EXPECT_FALSE(object(1).contains("verdict"));
}

TEST_F(Changes, WhatIsNoNoteIsRefusedAndChangesNothing) {
  EXPECT_EQ(note("/objects/99/note", "verdict=confirmed"), 404);
  EXPECT_EQ(note("/objects/2/note", "verdict=maybe"), 400);
  EXPECT_EQ(note("/objects/2/notes", "verdict=confirmed"), 405);
  EXPECT_EQ(note("/objects/2x/note", "verdict=confirmed"), 405);
  EXPECT_EQ(note("/", ""), 405);
  EXPECT_FALSE(object(2).contains("verdict"));
}

TEST_F(Changes, ANameOfAnyLengthAndContentBecomesAShortText) {
  EXPECT_EQ(note("/objects/2/note", "name=%00%1b%ff" + std::string(4000, 'a')), 204);
  EXPECT_LE(object(2)["operator_name"].get<std::string>().size(), 70U);
}

TEST_F(Changes, AreMadeByThisComputersOwnPagesAndProgramsAlone) {
  EXPECT_EQ(note("/objects/1/note", "verdict=confirmed"), 204);
  PageRequest of_a_program = post("/objects/1/note", "verdict=dismissed");
  of_a_program.fetch_site = of_a_program.fetch_mode = of_a_program.origin = "";
  EXPECT_EQ(site.answer(of_a_program).status, 204);

  PageRequest of_another_computer = post("/objects/2/note", "verdict=dismissed");
  of_another_computer.is_from_this_computer = false;
  PageRequest of_another_site = post("/objects/2/note", "verdict=dismissed");
  of_another_site.fetch_site = "cross-site";
  PageRequest of_a_link = of_another_site;
  of_a_link.fetch_mode = "navigate";
  PageRequest of_an_old_browser = post("/objects/2/note", "verdict=dismissed");
  of_an_old_browser.fetch_site = "";
  of_an_old_browser.origin = "http://evil.example";
  PageRequest of_another_port = of_an_old_browser;
  of_another_port.origin = "http://127.0.0.1:9999";
  for (const PageRequest& request :
       {of_another_computer, of_another_site, of_a_link, of_an_old_browser, of_another_port}) {
    EXPECT_EQ(site.answer(request).status, 403);
  }
  PageRequest by_another_name = post("/objects/2/note", "verdict=dismissed");
  by_another_name.host = "evil.example";
  EXPECT_EQ(site.answer(by_another_name).status, 421);
  EXPECT_FALSE(object(2).contains("verdict"));
}

TEST_F(Changes, WhoHasTheTokenMakesThemFromAnywhere) {
  const std::string token = "0123456789abcdef";
  const LiveSite guarded{document, board, {}, {"localhost"}, token, actions};
  PageRequest request = post("/objects/2/note", "verdict=confirmed");
  EXPECT_EQ(guarded.answer(request).status, 401);
  request.is_from_this_computer = false;
  request.authorization = "Bearer " + token;
  EXPECT_EQ(guarded.answer(request).status, 204);
  request.origin = "http://evil.example";
  request.fetch_site = "";
  EXPECT_EQ(guarded.answer(request).status, 403);
}

TEST_F(Changes, APageKnowsWhetherItMayMakeThem) {
  PageRequest request{"GET", "/settings", "localhost", "same-origin", "cors"};
  EXPECT_EQ(json::parse(site.answer(request).body)["may_change"], false);
  request.is_from_this_computer = true;
  EXPECT_EQ(json::parse(site.answer(request).body)["may_change"], true);
}

TEST_F(Changes, AReplayIsPausedSpedUpAndSoughtWithinTheRecording) {
  EXPECT_EQ(note("/playback", "paused=1&speed=2.5&at=150000"), 204);
  EXPECT_TRUE(playback.state().is_paused);
  EXPECT_EQ(playback.state().speed, 2.5);
  EXPECT_EQ(playback.take_seek(), HostTime{std::chrono::seconds{150}});
  EXPECT_EQ(playback.take_seek(), std::nullopt);
  EXPECT_EQ(note("/playback", "at=7"), 204);
  EXPECT_EQ(playback.take_seek(), HostTime{std::chrono::seconds{100}});
  EXPECT_TRUE(playback.state().is_paused);
}

TEST_F(Changes, WhatIsNoWishOfAReplayIsRefused) {
  for (const char* query :
       {"", "paused", "paused=2", "speed=", "speed=0", "speed=-1", "speed=nan", "speed=inf", "speed=1e9",
        "speed=1x", "at=", "at=-1", "at=1.5", "at=99999999999999999999", "x=1"})
    EXPECT_EQ(note("/playback", query), 400) << query;
  const LiveSite live(document, board, {}, {"localhost"});
  EXPECT_EQ(live.answer(post("/playback", "paused=1")).status, 405);  // nothing is replayed there
}

TEST(FormField, IsDecodedOrAbsent) {
  EXPECT_EQ(form_field("a=1&b=x%20y+z&c=", "b"), "x y z");
  EXPECT_EQ(form_field("a=1&b=x%20y+z&c=", "c"), "");
  for (const char* query : {"", "b", "&&=", "ab=1", "b=%", "b=%4", "b=%4g", "b=%-1", "b=% 1"})
    EXPECT_EQ(form_field(query, "b"), std::nullopt) << query;
}

TEST_F(Changes, TheRunIsDownloadedWithItsNotes) {
  note("/objects/1/note", "name=van&verdict=confirmed");
  const PageAnswer geojson = site.answer({"GET", "/objects.geojson", "localhost", "", ""});
  EXPECT_EQ(geojson.type, "application/geo+json");
  EXPECT_EQ(geojson.body, objects_to_geojson(document.record().objects, document.record().estimator));
  EXPECT_EQ(json::parse(geojson.body)["features"][0]["properties"]["operator_name"], "van");
  EXPECT_EQ(json::parse(geojson.body)["features"].size(), 3U);
  EXPECT_EQ(site.answer({"GET", "/objects.gpx", "localhost", "", ""}).body, run_to_gpx(document.record()));
  EXPECT_NE(site.answer({"GET", "/objects.kml", "localhost", "", ""}).body.find("<kml"), std::string::npos);
}

TEST(PageOfTheLoopback, TakesNotesOverHttp) {
  auto notes = std::make_shared<NoteBook>();
  LivePage page({"127.0.0.1", 0}, {}, {"run", false}, {}, {{}, notes});
  page.add(page_frame(1, 2));
  const std::string url = page.url();
  const auto port = static_cast<std::uint16_t>(std::stoi(url.substr(url.rfind(':') + 1)));
  const auto post_from = [port](const std::string& origin) {
    return testing::ask(
        port, "POST /objects/2/note?name=van&verdict=dismissed HTTP/1.1\r\nHost: 127.0.0.1\r\nOrigin: " +
                  origin + "\r\nContent-Length: 0\r\n\r\n");
  };
  EXPECT_EQ(post_from("http://evil.example").rfind("HTTP/1.1 403", 0), 0U);
  EXPECT_TRUE(notes->take_added().empty());
  EXPECT_EQ(post_from("http://127.0.0.1").rfind("HTTP/1.1 204", 0), 0U);
  const auto added = notes->take_added();
  ASSERT_EQ(added.size(), 1U);
  EXPECT_EQ(added[0].object_id, 2U);
  EXPECT_EQ(added[0].note, (ObjectNote{"van", Verdict::kDismissed}));
  EXPECT_EQ(added[0].position.latitude_deg, 1.0);
}

}  // namespace
}  // namespace geoloc::io
