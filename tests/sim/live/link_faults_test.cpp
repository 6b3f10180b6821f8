// SPDX-License-Identifier: Apache-2.0
#include "geoloc/sim/live/link_faults.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace geoloc::sim {
namespace {

using Datagram = FaultyLink::Datagram;

HostTime at(double time_s) {
  return HostTime{from_seconds(time_s)};
}

TEST(FaultyLink, WithoutFaultsIsAWire) {
  FaultyLink link({}, 1);
  EXPECT_FALSE(link.receive(at(1.0)));
  link.send({1, 2, 3}, at(1.0));
  EXPECT_EQ(link.receive(at(1.0)), Datagram({1, 2, 3}));
  EXPECT_FALSE(link.receive(at(1.0)));
}

TEST(FaultyLink, LosesTheShareItWasToldTo) {
  FaultyLink link({0.2, 0.0, 0.0}, 1);
  int received = 0;
  for (int i = 0; i < 20'000; ++i) {
    link.send({0}, at(i));
    if (link.receive(at(i))) ++received;
  }
  EXPECT_NEAR(received / 20'000.0, 0.8, 0.01);
}

TEST(FaultyLink, DelaysWithoutOvertaking) {
  FaultyLink link({0.0, 0.05, 0.02}, 1);
  double sum_s = 0.0;
  constexpr int kCount = 5'000;
  for (int i = 0; i < kCount; ++i) {
    link.send({static_cast<std::uint8_t>(i)}, at(i));
    double waited_s = 0.0;
    while (!link.receive(at(i + waited_s))) waited_s += 0.001;
    EXPECT_GE(waited_s, 0.05 - 1e-9);
    sum_s += waited_s;
  }
  EXPECT_NEAR(sum_s / kCount, 0.0705, 0.001);  // and half a step of this test's
  for (int i = 0; i < 200; ++i) link.send({static_cast<std::uint8_t>(i)}, at(1e5 + 1e-4 * i));
  for (int i = 0; i < 200; ++i) EXPECT_EQ(link.receive(at(2e5)), Datagram({static_cast<std::uint8_t>(i)}));
}

TEST(FaultyLink, RefusesFaultsThatCannotBe) {
  EXPECT_THROW(FaultyLink({1.5, 0.0, 0.0}, 1), std::invalid_argument);
  EXPECT_THROW(FaultyLink({0.0, -1.0, 0.0}, 1), std::invalid_argument);
  EXPECT_THROW(FaultyLink({0.0, 0.0, std::nan("")}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace geoloc::sim
