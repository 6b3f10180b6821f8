// SPDX-License-Identifier: Apache-2.0
#include "io/video/transport_source.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace geoloc::io {
namespace {

std::string edited(const std::string& bytes, std::size_t piece) {
  TransportSource source("192.0.2.7");
  std::string passed;
  for (std::size_t begin = 0; begin < bytes.size(); begin += piece)
    passed += source.edit(bytes.substr(begin, piece));
  return passed;
}

TEST(TransportSource, IsNamedWhereTheServerDoesNotHoweverItsAnswerIsCut) {
  const std::string before = "RTSP/1.0 200 OK\r\nCSeq: 4\r\n", after = "\r\nSession: 1\r\n\r\n";
  const std::string silent = "TRANSPORT: RTP/AVP;unicast;client_port=5000-5001;server_port=6000-6001";
  const std::string open = "Transport: RTP/AVP;unicast;source=198.51.100.1;server_port=6000-6001";
  for (const std::size_t piece : {1U, 2U, 7U, 1000U}) {
    EXPECT_EQ(edited(before + silent + after, piece), before + silent + ";source=192.0.2.7" + after);
    EXPECT_EQ(edited(before + open + after, piece), before + open + after);
  }
}

TEST(TransportSource, PassesEverythingElseAtOnce) {
  TransportSource source("192.0.2.7");
  EXPECT_EQ(source.edit("RTSP/1.0 200 OK\r\nX"), "RTSP/1.0 200 OK\r\nX");
  EXPECT_EQ(source.edit("-Transport: none"), "-Transport: none");
  EXPECT_EQ(source.edit("\ntran"), "\n");
  EXPECT_EQ(source.edit("sit"), "transit");
  const std::string endless = "\nTransport: " + std::string(100'000, 'x');
  EXPECT_EQ(source.edit(endless), endless);
}

TEST(TransportSource, KeepsAnyBytesButForTheHeader) {
  std::mt19937 random{3};
  for (int round = 0; round < 200; ++round) {
    std::string bytes;
    for (int i = 0; i < 300; ++i) bytes += "tTrRanspo:\r\n\n\0;"[random() % 15];
    bytes += "\nend";
    EXPECT_EQ(edited(bytes, 1 + random() % 20), edited(bytes, bytes.size()));
  }
}

}  // namespace
}  // namespace geoloc::io
