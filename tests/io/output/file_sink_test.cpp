// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/output/file_sink.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

using namespace std::chrono_literals;

class FileSinkTest : public ::testing::Test {
 protected:
  FileSinkTest() {
    sink_.emplace(
        "--out", ResultFile(file_, OldFile::kReplace, [](const std::string&) {}),
        [this](const RunRecord& run) {
          now_ += takes_;
          return run.title;
        },
        [this] { return now_; });
  }

  std::string written(const std::string& title) {
    RunRecord run;
    run.title = title;
    sink_->on_run(run);
    return content();
  }

  std::string content() const {
    std::ifstream input(file_);
    return {std::istreambuf_iterator<char>(input), std::istreambuf_iterator<char>()};
  }

  testing::TemporaryFolder folder_;
  std::filesystem::path file_ = folder_.path() / "run.json";
  FileSink::Clock::time_point now_{1h};
  FileSink::Clock::duration takes_ = 0s;
  std::optional<FileSink> sink_;
};

TEST_F(FileSinkTest, WritesEveryRunThatTakesNoTime) {
  for (const char* title : {"1", "2", "3"}) EXPECT_EQ(written(title), title);
}

TEST_F(FileSinkTest, LeavesRunsOutThatWouldTakeMoreThanATenthOfTheTime) {
  takes_ = 2s;
  int times = 0;
  std::string before;
  for (int run = 0; run < 100; ++run, now_ += 5s) {
    const std::string now = written(std::to_string(run));
    times += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_NEAR(times, 25, 3) << "each 18 s after the one before";
}

TEST_F(FileSinkTest, WritesTheLastRunInAnyCase) {
  takes_ = 2s;
  EXPECT_EQ(written("first"), "first");
  EXPECT_EQ(written("last"), "first");
  sink_->on_end();
  EXPECT_EQ(content(), "last");
}

TEST_F(FileSinkTest, RestsForAMinuteAtMost) {
  takes_ = 1h;  // a disk that stood still
  written("first");
  takes_ = 0s;
  now_ += 59s;
  EXPECT_EQ(written("second"), "first");
  now_ += 2s;
  EXPECT_EQ(written("third"), "third");
}

}  // namespace
}  // namespace geoloc::io
