// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace geoloc {

/// Whether the rates that are told with a quantity tell how it moves: some senders leave them 0, and while
/// nothing moves, none can be told from others.
class RateTrust {
 public:
  /// `moved` from one sample to the next, `missed` of it by the rates.
  void learn(double moved, double missed) {
    moved_ += moved * moved;
    missed_ += missed * missed;
    if (++samples_ < kRemembered) return;
    samples_ /= 2;
    moved_ *= 0.5;
    missed_ *= 0.5;
  }

  /// They have told of nine tenths of it, in squares.
  bool is_earned() const { return missed_ < 0.1 * moved_; }

 private:
  static constexpr int kRemembered = 1000;

  double moved_ = 0.0, missed_ = 0.0;
  int samples_ = 0;
};

}  // namespace geoloc
