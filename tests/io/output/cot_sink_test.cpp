// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/cot_sink.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

#include "io/output/loopback_socket.hpp"

namespace geoloc::io {
namespace {

using testing::LoopbackSocket;
using testing::receive;

constexpr HostTime kFirstFrame{std::chrono::seconds{1'795'300'000}};

OutputFrame frame_of(std::vector<std::uint64_t> ids) {
  OutputFrame frame;
  frame.captured_at = kFirstFrame;
  for (const std::uint64_t id : ids) {
    ObjectReport object;
    object.id = id;
    object.position = {-22.9, -43.1};
    object.ellipse = {0.2, 0.1, 0.0};
    frame.objects.push_back(object);
  }
  return frame;
}

struct Sent {
  LoopbackSocket receiver{SOCK_DGRAM};
  CotSink sink{receiver.url("udp"), CotConfig{}, [](const std::string&) {}};

  std::string next() const { return receive(receiver.descriptor()); }
  bool is_silent() const { return receive(receiver.descriptor(), MSG_DONTWAIT).empty(); }
};

TEST(CotSink, SendsAnObjectOnceUntilItsPeriodIsOver) {
  Sent sent;
  sent.sink.on_frame(frame_of({}));
  EXPECT_TRUE(sent.is_silent());
  sent.sink.on_frame(frame_of({7}));
  EXPECT_NE(sent.next().find("uid=\"geoloc.1795300000.7\""), std::string::npos);
  for (int i = 0; i < 100; ++i) sent.sink.on_frame(frame_of({7}));
  EXPECT_TRUE(sent.is_silent());
}

TEST(CotSink, AnObjectThatIsGoneIsToldOutOfDate) {
  Sent sent;
  sent.sink.on_frame(frame_of({7, 8}));
  sent.next(), sent.next();
  sent.sink.on_frame(frame_of({8}));
  const std::string event = sent.next();
  EXPECT_NE(event.find("uid=\"geoloc.1795300000.7\""), std::string::npos);
  const auto value = [&event](const std::string& name) {
    const std::size_t begin = event.find(name + "=\"") + name.size() + 2;
    return event.substr(begin, event.find('"', begin) - begin);
  };
  EXPECT_EQ(value("stale"), value("time"));
  EXPECT_TRUE(sent.is_silent());
}

TEST(CotSink, AnObjectThatIsBelievedAgainIsSentAgainAtOnce) {
  Sent sent;
  for (int round = 0; round < 3; ++round) {
    sent.sink.on_frame(frame_of({7}));
    EXPECT_EQ(sent.next().find("retracted"), std::string::npos);
    sent.sink.on_frame(frame_of({}));
    EXPECT_NE(sent.next().find("retracted"), std::string::npos);
    sent.sink.on_frame(frame_of({}));
    EXPECT_TRUE(sent.is_silent());
  }
}

TEST(CotSink, ManyObjectsAreToldAFewAtATime) {
  Sent sent;
  std::vector<std::uint64_t> ids(100);
  std::iota(ids.begin(), ids.end(), 1);
  const auto told_after_a_frame = [&] {
    sent.sink.on_frame(frame_of(ids));
    std::vector<std::string> uids;
    for (std::string event; !(event = receive(sent.receiver.descriptor(), MSG_DONTWAIT)).empty();) {
      const std::size_t begin = event.find(".1795300000.") + 12;
      uids.push_back(event.substr(begin, event.find('"', begin) - begin));
    }
    return uids;
  };
  std::set<std::string> all;
  for (int frame = 0; frame < 2; ++frame) {
    const auto told = told_after_a_frame();
    EXPECT_EQ(told.size(), 30U);
    all.insert(told.begin(), told.end());
  }
  ids.push_back(101);
  for (int frame = 0; frame < 2; ++frame) {
    const auto told = told_after_a_frame();
    all.insert(told.begin(), told.end());
  }
  EXPECT_EQ(all.size(), 101U) << "each once, and none twice before all were";
  EXPECT_TRUE(told_after_a_frame().empty());
}

TEST(CotSink, TellsWhatTheCameraSeesWhereThatIsWanted) {
  OutputFrame frame = frame_of({});
  frame.view.emplace();
  frame.view->image_centre.emplace();
  Sent without;
  without.sink.on_frame(frame);
  EXPECT_TRUE(without.is_silent());

  LoopbackSocket receiver{SOCK_DGRAM};
  CotConfig config;
  config.sensor_period_s = 3600.0;
  CotSink sink{receiver.url("udp"), config, [](const std::string&) {}};
  for (int i = 0; i < 10; ++i) sink.on_frame(frame);
  EXPECT_NE(receive(receiver.descriptor()).find("uid=\"geoloc.1795300000.vehicle\""), std::string::npos);
  EXPECT_NE(receive(receiver.descriptor()).find("uid=\"geoloc.1795300000.spi\""), std::string::npos);
  EXPECT_TRUE(receive(receiver.descriptor(), MSG_DONTWAIT).empty());
}

/// The run's last objects are fewer than the last frame's.
TEST(CotSink, SaysAtTheEndWhatIsGone) {
  Sent sent;
  sent.sink.on_frame(frame_of({7}));
  sent.next();
  sent.sink.on_run({});
  sent.sink.on_end();
  EXPECT_NE(sent.next().find("retracted"), std::string::npos);
  EXPECT_TRUE(sent.is_silent());
}

TEST(CotSink, SendsEveryObjectAgainAtTheEnd) {
  Sent sent;
  sent.sink.on_frame(frame_of({7}));
  sent.next();
  RunRecord run;
  run.objects = frame_of({7, 9}).objects;
  sent.sink.on_run(run);
  sent.sink.on_end();
  EXPECT_NE(sent.next().find(".7\""), std::string::npos);
  EXPECT_NE(sent.next().find(".9\""), std::string::npos);
}

TEST(CotSink, RefusesWhatItCannotReach) {
  EXPECT_THROW(CotSink("udp://nowhere", CotConfig{}, {}), std::invalid_argument);
  CotConfig config;
  config.stale_s = -1.0;
  EXPECT_THROW(CotSink("udp://127.0.0.1:1", config, [](const std::string&) {}), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::io
