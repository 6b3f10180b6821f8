// SPDX-License-Identifier: Apache-2.0
#include "calibration/node_history.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <random>
#include <vector>

namespace geoloc {
namespace {

using Vector = NodeHistory::Vector;

/// Every node's value, with the nodes that are left drawn at random and those that are gone as they were
/// replaced.
TEST(NodeHistory, TellsANodeByThoseThatAreLeftWhateverWentBetween) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  const auto draw = [&] { return Vector(normal(random), normal(random), normal(random), normal(random)); };
  NodeHistory history;
  std::vector<std::uint32_t> left;
  std::map<std::uint32_t, NodeHistory::Blend> gone;
  for (int step = 0; step < 600; ++step) {
    left.push_back(history.append());
    if (left.size() <= 6) continue;
    NodeHistory::Blend blend;
    blend.constant = draw();
    const bool is_frozen = step % 10 == 9;
    const std::size_t at = is_frozen ? 0 : 1 + random() % (left.size() - 2);
    if (!is_frozen) {
      const double weight = std::uniform_real_distribution<double>(0.1, 0.9)(random);
      blend.shares = {NodeHistory::Share{left[at - 1], 1.0 - weight},
                      NodeHistory::Share{left[at + 1], weight}};
    }
    history.replace(left[at], blend);
    gone[left[at]] = blend;
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));

    std::map<std::uint32_t, Vector> values;
    for (const std::uint32_t serial : left) values[serial] = draw();
    for (std::uint32_t serial = history.size(); serial-- > 0;) {
      if (values.count(serial) > 0) continue;
      // A node was replaced by nodes that were left then: those are known, or are found the same way.
      const auto value_of = [&](auto&& self, std::uint32_t of) -> Vector {
        if (const auto known = values.find(of); known != values.end()) return known->second;
        Vector value = gone.at(of).constant;
        for (const auto& share : gone.at(of).shares) {
          if (share.weight != 0.0) value += share.weight * self(self, share.serial);
        }
        return values[of] = value;
      };
      value_of(value_of, serial);
    }
    const std::uint32_t oldest = history.size() > 300 ? history.size() - 300 : 0;
    for (std::uint32_t serial = oldest; serial < history.size();
         serial += 1 + static_cast<std::uint32_t>(random() % 40)) {
      const NodeHistory::Blend found = history.resolve(serial);
      Vector value = found.constant;
      for (const auto& share : found.shares) {
        if (share.weight == 0.0) continue;
        ASSERT_EQ(gone.count(share.serial), 0U);
        value += share.weight * values.at(share.serial);
      }
      ASSERT_LT((value - values.at(serial)).norm(), 1e-9) << step << ' ' << serial;
    }
  }
}

/// Nodes stay for hours where they are far from their neighbours; what is asked for is what went not long
/// ago.
TEST(NodeHistory, KnowsWhatIsLeftForHoursFromWhatWasMadeSince) {
  NodeHistory history;
  const std::uint32_t ancient = history.append();
  std::uint32_t before = ancient;
  for (int step = 0; step < 5000; ++step) {
    const std::uint32_t here = history.append(), after = history.append();
    NodeHistory::Blend blend;
    blend.constant.setConstant(1.0);
    blend.shares = {NodeHistory::Share{ancient, 0.25}, NodeHistory::Share{after, 0.75}};
    history.replace(here, blend);
    const auto whole = history.resolve(ancient);
    ASSERT_EQ(whole.shares[0].serial, ancient);
    ASSERT_EQ(whole.shares[0].weight, 1.0);
    if (before != ancient) {
      // Lies between the ancient one and the one before, which went into these two.
      NodeHistory::Blend half;
      half.shares = {NodeHistory::Share{ancient, 0.5}, NodeHistory::Share{after, 0.5}};
      history.replace(before, half);
      const auto found = history.resolve(before - 1);
      ASSERT_EQ(found.shares[0].serial, ancient);
      ASSERT_EQ(found.shares[0].weight, 0.25 + 0.75 * 0.5);
      ASSERT_EQ(found.shares[1].serial, after);
      ASSERT_EQ(found.shares[1].weight, 0.75 * 0.5);
      ASSERT_EQ(found.constant[0], 1.0);
    }
    before = after;
  }
  NodeHistory::Blend frozen;
  frozen.constant.setConstant(2.0);
  history.replace(ancient, frozen);
  EXPECT_EQ(history.resolve(ancient).constant[0], 2.0);
  EXPECT_EQ(history.resolve(ancient).shares[0].weight, 0.0);
  EXPECT_EQ(history.resolve(before - 1).constant[0], 1.0 + 0.25 * 2.0);
}

}  // namespace
}  // namespace geoloc
