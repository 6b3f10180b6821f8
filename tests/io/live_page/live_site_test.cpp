// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/live_page/live_site.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "fuzz/hostile_pages.hpp"
#include "page_frames.hpp"
#include "support/source_tree.hpp"

namespace geoloc::io {
namespace {

const std::vector<std::string> kOwnNames{"localhost", "drone", "drone.local"};

class Site : public ::testing::Test {
 protected:
  PageAnswer get(const std::string& path) const {
    return site.answer({"GET", path, "127.0.0.1:8080", "", ""});
  }

  LiveDocument document{{"run", true}};
  PictureBoard board{{"target"}, std::chrono::milliseconds{100}};
  LiveSite site{document, board, {}, kOwnNames};
};

TEST_F(Site, ServesThePageAndItsFiles) {
  EXPECT_EQ(get("/").type, "text/html; charset=utf-8");
  EXPECT_NE(get("/").body.find("<!DOCTYPE html>"), std::string::npos);
  EXPECT_EQ(get("/page.js").type, "text/javascript; charset=utf-8");
  EXPECT_EQ(get("/palette.css").status, 200);
  EXPECT_TRUE(get("/events").is_event_stream);
}

TEST_F(Site, FilesAreThoseOfTheSourceTree) {
  for (const char* name : {"index.html", "page.js", "map.js", "icon.svg"}) {
    std::ifstream file(source_tree() / "src/io/live_page/page" / name, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(get(std::string("/") + name).body, content) << name;
  }
}

TEST_F(Site, KnowsNoOtherPath) {
  for (const char* path : {"", "x", "//", "/../../etc/passwd", "/%2e%2e/etc/passwd", "/index.html/", "/page",
                           "/objects/", "/objects/1", "/objects/-1", "/objects/1x", "/objects/ 1",
                           "/objects/99999999999999999999", "/objects/../settings"})
    EXPECT_EQ(get(path).status, 404) << path;
}

TEST_F(Site, OnlyReads) {
  for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "TRACE", "CONNECT", "", "get"})
    EXPECT_EQ(site.answer({method, "/", "localhost", "", ""}).status, 405) << method;
  EXPECT_EQ(site.answer({"HEAD", "/", "localhost", "", ""}).status, 200);
}

TEST_F(Site, AnswersToItsOwnNamesAndAddressesAlone) {
  for (const char* host : {"localhost", "LocalHost:8080", "127.0.0.1", "[::1]:8080", "192.168.4.1:80",
                           "drone.local", "drone:8080"})
    EXPECT_TRUE(is_own_host(host, kOwnNames)) << host;
  for (const char* host :
       {"", "evil.example", "localhost.evil.example", "127.0.0.1.evil.example", "drone.evil", "[::1", ":8080",
        "127.1.evil", " localhost", "localhost:80@evil", "localhost:@evil", "127.0.0.1:80/../@evil",
        "localhost:8o", "[::1]evil", "[::1]:80@evil", "localhost:80 evil", "localhost:-1"})
    EXPECT_FALSE(is_own_host(host, kOwnNames)) << host;
  EXPECT_FALSE(is_own_host(std::string(5000, '1'), kOwnNames));
  EXPECT_EQ(site.answer({"GET", "/", "evil.example", "", ""}).status, 421);
}

TEST_F(Site, IsNotReadByOtherSitesPages) {
  EXPECT_EQ(site.answer({"GET", "/events", "localhost", "cross-site", "cors"}).status, 403);
  EXPECT_EQ(site.answer({"GET", "/frame", "localhost", "same-site", "no-cors"}).status, 403);
  EXPECT_EQ(site.answer({"GET", "/", "localhost", "cross-site", "navigate"}).status, 200);  // a link
  EXPECT_EQ(site.answer({"GET", "/events", "localhost", "same-origin", "cors"}).status, 200);
}

TEST_F(Site, WithATokenAsksForItWhateverIsWanted) {
  const LiveSite guarded(document, board, {}, kOwnNames, "0123456789abcdef");
  for (const char* const path : {"/", "/page.js", "/events", "/frame", "/settings", "/nowhere"}) {
    const PageAnswer answer = guarded.answer({"GET", path, "localhost", "", ""});
    EXPECT_EQ(answer.status, 401) << path;
    EXPECT_FALSE(answer.is_event_stream) << path;
  }
  EXPECT_EQ(guarded.answer({"POST", "/", "localhost", "", ""}).status, 401);
  EXPECT_FALSE(board.wants_picture());  // nobody is watching
  EXPECT_EQ(guarded.answer({"GET", "/", "localhost", "", "", "", "geoloc_80=0123456789abcdef"}).status, 200);
  EXPECT_EQ(guarded.answer({"GET", "/", "evil.example", "", "", "token=0123456789abcdef"}).status, 421);
}

std::string policy_of(const LiveSite& site) {
  for (const auto& [name, value] : site.headers()) {
    if (name == "Content-Security-Policy") return value;
  }
  return "";
}

TEST_F(Site, LetsThePageRunNothingButItself) {
  EXPECT_EQ(policy_of(site).rfind("default-src 'none'; script-src 'self'; style-src 'self';", 0), 0U);
  EXPECT_EQ(policy_of(site).find("unsafe"), std::string::npos);
  EXPECT_NE(policy_of(site).find("form-action 'none'"), std::string::npos);
  EXPECT_EQ(get("/").body.find("<script>"), std::string::npos);
  LivePageConfig config;
  config.tile_url = "https://tiles.example.org/{z}/{x}/{y}.png";
  const LiveSite with_tiles(document, board, config, kOwnNames);
  EXPECT_NE(policy_of(with_tiles).find("img-src 'self' blob: https://tiles.example.org;"), std::string::npos);
}

TEST_F(Site, GivesTheNewestPictureWithItsBoxes) {
  EXPECT_FALSE(board.wants_picture());
  EXPECT_EQ(get("/frame").status, 204);
  EXPECT_TRUE(board.wants_picture());
  board.show(
      {"JPEG", 640, 480, HostTime{}, {{{1.0, 2.0, 3.0, 4.0}, 0.5, 0}, {{1.0, 2.0, 3.0, 4.0}, 0.5, 7}}});
  EXPECT_FALSE(board.wants_picture());  // not again at once
  const std::string body = get("/frame").body;
  const std::size_t length = static_cast<unsigned char>(body[0]) + 256U * static_cast<unsigned char>(body[1]);
  EXPECT_EQ(body.substr(4 + length), "JPEG");
  EXPECT_NE(body.find("\"name\":\"target\""), std::string::npos);
  EXPECT_NE(body.find("\"name\":\"class 7\""), std::string::npos);
}

TEST(HostilePages, DamagedRequestsAreAnsweredSafely) {
  for (std::string bytes :
       {"GET /objects/17 localhost:8080 cross-site navigate https://a/{z}/{x}/{y} token=0123456789abcdee "
        "geoloc_8080=0123456789abcdee Bearer_0123456789abcdee http://localhost:8080",
        "POST /objects/17/note localhost same-origin cors - name=a%20b&verdict=confirmed - - "
        "http://localhost near",
        "POST /playback localhost same-origin cors - paused=1&speed=2&at=150000 - - http://localhost near"}) {
    hostile::ask_for_pages(bytes);
    for (std::size_t i = 0; i < 4000; ++i) {
      bytes[(i * 7919) % bytes.size()] = static_cast<char>(i * 31);
      hostile::ask_for_pages(bytes);
    }
  }
}

}  // namespace
}  // namespace geoloc::io
