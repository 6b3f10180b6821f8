// SPDX-License-Identifier: Apache-2.0
#include "token_guesses.hpp"

#include <algorithm>
#include <functional>

namespace geoloc::io {

TokenGuesses::Guesser* TokenGuesses::find(const std::string& network, Time now) {
  while (!guessers_.empty() && now - guessers_.front().began_at >= kPeriod) guessers_.pop_front();
  const auto found = std::find_if(guessers_.begin(), guessers_.end(),
                                  [&](const Guesser& guesser) { return guesser.network == network; });
  return found == guessers_.end() ? nullptr : &*found;
}

bool TokenGuesses::may_try(const std::string& network, Time now) {
  const std::lock_guard lock(mutex_);
  const Guesser* const guesser = find(network, now);
  return guesser == nullptr || guesser->wrong < kMostWrong;
}

void TokenGuesses::note_wrong(const std::string& network, const std::string& token, Time now) {
  const std::lock_guard lock(mutex_);
  const std::size_t hash = std::hash<std::string>{}(token);
  Guesser* guesser = find(network, now);
  if (guesser == nullptr) {
    if (guessers_.size() >= kMostNetworks) guessers_.pop_front();
    guesser = &guessers_.emplace_back(Guesser{network, now});
  } else if (guesser->newest == hash) {
    return;
  }
  ++guesser->wrong;
  guesser->newest = hash;
}

}  // namespace geoloc::io
