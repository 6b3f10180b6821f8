// SPDX-License-Identifier: Apache-2.0
#include "geoloc/io/video/file_source.hpp"

#include <gst/gst.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "collecting_taker.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

using std::chrono::milliseconds;

constexpr HostTime kStart{std::chrono::seconds{1'790'000'000}};
constexpr Duration kPatience = std::chrono::seconds{40};
constexpr int kFrames = 30;
constexpr Duration kPeriod = milliseconds{50};

class FileSourceTest : public ::testing::Test {
 protected:
  /// Encodes what the GStreamer description makes.
  std::filesystem::path encode(const std::string& name, const std::string& elements) const {
    gst_init(nullptr, nullptr);
    const auto file = folder_.path() / name;
    const std::string description = elements + " ! filesink location=" + file.string();
    GstElement* pipeline = gst_parse_launch(description.c_str(), nullptr);
    gst_element_set_state(pipeline, GST_STATE_PLAYING);
    GstBus* bus = gst_element_get_bus(pipeline);
    GstMessage* end = gst_bus_timed_pop_filtered(
        bus, 40 * GST_SECOND, static_cast<GstMessageType>(GST_MESSAGE_EOS | GST_MESSAGE_ERROR));
    EXPECT_TRUE(end != nullptr && GST_MESSAGE_TYPE(end) == GST_MESSAGE_EOS);
    if (end != nullptr) gst_message_unref(end);
    gst_object_unref(bus);
    gst_element_set_state(pipeline, GST_STATE_NULL);
    gst_object_unref(pipeline);
    return file;
  }

  std::filesystem::path video(const std::string& name, const std::string& muxer) const {
    return encode(name, "videotestsrc num-buffers=" + std::to_string(kFrames) +
                            " ! video/x-raw,format=I420,width=160,height=120,framerate=20/1"
                            " ! x264enc speed-preset=ultrafast bframes=2 key-int-max=10 ! h264parse ! " +
                            muxer);
  }

  const testing::TemporaryFolder folder_;
  const HostClock clock_;
};

TEST_F(FileSourceTest, GivesEveryFrameWithItsTimeWhenPacedByTheCaller) {
  for (const auto& file : {video("a.mkv", "matroskamux"), video("b.mp4", "mp4mux")}) {
    FileSource source{file, {Pace::kAsTaken, kStart}, {}, clock_};
    for (int i = 0; i < kFrames; ++i) {
      const auto frame = source.next(kPatience);
      ASSERT_TRUE(frame) << file << " " << i;
      EXPECT_EQ(frame->bgr.size(), cv::Size(160, 120));
      EXPECT_EQ(frame->time_quality, TimeQuality::kFile);
      EXPECT_FALSE(frame->damaged);
      EXPECT_NEAR(seconds(frame->captured_at - kStart), seconds(i * kPeriod), 0.001) << file << " " << i;
    }
    EXPECT_FALSE(source.next(kPatience));
    EXPECT_EQ(source.status().state, VideoState::kEnded);
    EXPECT_EQ(source.status().dropped, 0U);
    EXPECT_EQ(source.status().last_error, "");
  }
}

TEST_F(FileSourceTest, HandsOnThePicturesAsTheyAreInTheFile) {
  for (const auto& file : {video("a.mkv", "matroskamux"), video("b.mp4", "mp4mux")}) {
    const auto taker = std::make_shared<test::CollectingTaker>();
    FileSource source{file, {Pace::kAsTaken, kStart}, {}, clock_, taker};
    while (source.next(kPatience)) {
    }
    ASSERT_EQ(taker->pictures().size(), static_cast<std::size_t>(kFrames)) << file;
    for (const EncodedPicture& picture : taker->pictures()) {
      EXPECT_EQ(picture.format.rfind("video/x-h264", 0), 0U);
      EXPECT_FALSE(picture.bytes.empty());
    }
    ASSERT_EQ(taker->notes().size(), static_cast<std::size_t>(kFrames)) << file;
    for (const auto& note : taker->notes())
      EXPECT_NEAR(seconds(note.captured_at - kStart), seconds(note.shown_at), 1e-6);
    EXPECT_TRUE(taker->knows_all_frames()) << file;
  }
}

TEST_F(FileSourceTest, PlaysLikeACameraInRealTime) {
  const HostTime begun = clock_.now();
  FileSource source{video("a.mkv", "matroskamux"), {}, {}, clock_};
  std::uint64_t taken = 0;
  HostTime last = begun;
  while (source.status().state != VideoState::kEnded) {
    const auto frame = source.next(milliseconds{200});
    if (!frame) continue;
    ++taken;
    EXPECT_GT(frame->captured_at, last);
    last = frame->captured_at;
  }
  EXPECT_GE(clock_.now() - begun, (kFrames - 2) * kPeriod);
  EXPECT_EQ(source.status().frames, taken + source.status().dropped);
}

TEST_F(FileSourceTest, PlaysWhatIsLeftOfAFileCutShort) {
  const auto file = video("a.mkv", "matroskamux");
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  FileSource source{file, {Pace::kAsTaken, kStart}, {}, clock_};
  int frames = 0;
  while (source.next(kPatience)) ++frames;
  EXPECT_GT(frames, 5);
  EXPECT_LT(frames, kFrames);
  EXPECT_EQ(source.status().state, VideoState::kEnded);
}

TEST_F(FileSourceTest, CanBeLeftBeforeItsEnd) {
  const auto file = video("a.mkv", "matroskamux");
  for (const Pace pace : {Pace::kAsTaken, Pace::kRealTime}) {
    FileSource source{file, {pace, kStart}, {}, clock_};
    EXPECT_TRUE(source.next(kPatience));
  }
}

TEST_F(FileSourceTest, RefusesWhatIsNoVideoNamingTheFile) {
  const auto sound = encode("sound.mkv", "audiotestsrc num-buffers=20 ! vorbisenc ! matroskamux");
  for (const auto& file : {folder_.path() / "missing.mkv", folder_.write("empty.mkv", ""),
                           folder_.write("text.mp4", "not a video\n"),
                           folder_.write("noise.mkv", std::string(5000, '\x55')), sound, folder_.path()}) {
    try {
      const FileSource source{file, {}, {}, clock_};
      ADD_FAILURE() << file;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string{error.what()}.find(file.string()), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace geoloc::io
