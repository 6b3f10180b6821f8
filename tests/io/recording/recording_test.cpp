// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "geoloc/io/recording/notes_file.hpp"
#include "geoloc/io/recording/recording_reader.hpp"
#include "geoloc/io/recording/recording_writer.hpp"
#include "support/temporary_folder.hpp"

namespace geoloc::io {
namespace {

const std::vector<std::uint8_t> kHeartbeat{0xFE, 9, 0, 1, 1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 0xAA, 0xBB};

HostTime at_us(std::int64_t us) {
  return HostTime{std::chrono::microseconds{us}};
}

RecordedFrame some_frame(std::int64_t time_us) {
  return {at_us(time_us),
          {{{1.25, 2.1, 30.7, 1.0 / 3.0}, 0.87654321, 4, 0.37}, {{5, 6, 7, 8}, 0.5, 1}},
          1,
          0.3,
          "arrival",
          CameraMount{1.0 / 3.0, -45.5, 170.25, 0.1, 0.0, -0.2},
          Eigen::Vector2d(2741.0 / 3.0, 914.01)};
}

void write_recording(const std::filesystem::path& folder) {
  RecordingWriter writer(folder);
  writer.write_camera(CameraConfig{});
  writer.write_config("{}");
  writer.write_class_names({"target", "\xff not UTF-8"});
  writer.write_truth({{7, 2, {-22.906123456789, -43.133987654321}, -1.25}});
  writer.add_telemetry(at_us(1'000'000), kHeartbeat.data(), kHeartbeat.size());
  writer.add_frame(some_frame(1'000'100));
  writer.write_damaged(17);
  writer.add_frame({at_us(1'000'200), {}, std::nullopt});
  EXPECT_FALSE(std::filesystem::exists(folder));  // whole or not at all
  writer.finish();
}

TEST(Recording, WhatIsWrittenIsReadBackToTheBit) {
  const testing::TemporaryFolder temporary;
  const auto folder = temporary.path() / "run";
  write_recording(folder);
  const Recording recording = read_recording(folder);
  ASSERT_EQ(recording.frames.size(), 2U);
  const RecordedFrame expected = some_frame(1'000'100);
  EXPECT_EQ(recording.frames[0].captured_at, expected.captured_at);
  EXPECT_EQ(recording.frames[0].telemetry_records, 1U);
  EXPECT_EQ(recording.frames_damaged, 17U);
  ASSERT_EQ(recording.frames[0].detections.size(), 2U);
  EXPECT_EQ(recording.frames[0].detections[0].sigma_px, 0.37);
  EXPECT_EQ(recording.frames[0].detections[1].sigma_px, 0.0);
  EXPECT_EQ(recording.frames[0].detections[0].box.height, 1.0 / 3.0);
  EXPECT_EQ(recording.frames[0].detections[0].confidence, 0.87654321);
  EXPECT_EQ(recording.frames[0].detections[0].class_id, 4);
  EXPECT_TRUE(recording.frames[1].detections.empty());
  EXPECT_FALSE(recording.frames[1].telemetry_records);
  EXPECT_EQ(recording.frames[0].time_sigma_s, 0.3);
  EXPECT_EQ(recording.frames[0].time_quality, "arrival");
  ASSERT_TRUE(recording.frames[0].mount);
  EXPECT_EQ(recording.frames[0].mount->roll_deg, 1.0 / 3.0);
  EXPECT_EQ(recording.frames[0].mount->yaw_deg, 170.25);
  EXPECT_EQ(recording.frames[0].mount->z_m, -0.2);
  EXPECT_FALSE(recording.frames[1].mount);  // as in camera.json
  EXPECT_EQ(recording.frames[0].focal_px, Eigen::Vector2d(2741.0 / 3.0, 914.01));
  EXPECT_FALSE(recording.frames[1].focal_px);
  EXPECT_EQ(recording.frames[1].time_sigma_s, 0.0);
  EXPECT_EQ(recording.frames[1].time_quality, "");
  ASSERT_EQ(recording.telemetry.records().size(), 1U);
  EXPECT_EQ(recording.telemetry.records()[0].size, kHeartbeat.size());
  ASSERT_EQ(recording.truth.size(), 1U);
  EXPECT_EQ(recording.truth[0].id, TargetId(7));
  EXPECT_DOUBLE_EQ(recording.truth[0].position.latitude_deg, -22.906123456789);
  EXPECT_EQ(recording.truth[0].height_above_home_m, -1.25);
  EXPECT_EQ(recording.class_names.at(0), "target");
  EXPECT_EQ(recording.config_json, "{}\n");
}

TEST(Recording, KeepsNotesAndPicturesOfObjects) {
  const testing::TemporaryFolder temporary;
  const auto folder = temporary.path() / "run";
  const NotedObject noted{at_us(1'000'150), 17, {-22.9, -43.1}, {"red \"van\"\n", Verdict::kConfirmed}};
  const std::string jpeg = "\xff\xd8\xff and so on";
  {
    RecordingWriter writer(folder);
    writer.write_camera(CameraConfig{});
    writer.add_telemetry(at_us(1'000'000), kHeartbeat.data(), kHeartbeat.size());
    writer.add_note(noted);
    writer.write_picture(17, "\xff\xd8\xff worse");
    writer.write_picture(17, jpeg);
    writer.write_picture(18, "no JPEG");
    writer.write_picture(19, jpeg);
    writer.remove_picture(19);
    writer.remove_picture(20);  // there is none
    writer.finish();
  }
  append_notes(folder, {{at_us(1'000'160), 18, {-22.9, -43.1}, {"", Verdict::kDismissed}}});
  const Recording recording = read_recording(folder);
  ASSERT_EQ(recording.notes.size(), 2U);
  EXPECT_EQ(recording.notes[0].at, noted.at);
  EXPECT_EQ(recording.notes[0].object_id, 17U);
  EXPECT_EQ(recording.notes[0].position.longitude_deg, -43.1);
  EXPECT_EQ(recording.notes[0].note, noted.note);
  EXPECT_EQ(recording.notes[1].note.verdict, Verdict::kDismissed);
  ASSERT_EQ(recording.pictures.size(), 1U);
  EXPECT_EQ(recording.pictures.at(17), jpeg);
}

TEST(Recording, ANoteThatWasCutOffCostsNoLaterOne) {
  const testing::TemporaryFolder temporary;
  temporary.write("notes.jsonl", R"({"time_us":1,"obj)");
  append_notes(temporary.path(), {{at_us(2), 18, {-22.9, -43.1}, {"van", Verdict::kNone}}});
  std::ifstream input(temporary.path() / "notes.jsonl");
  std::size_t skipped = 0;
  EXPECT_EQ(read_notes(input, skipped).size(), 1U);
  EXPECT_EQ(skipped, 1U);
}

TEST(Recording, WriterRefusesAFolderInUse) {
  const testing::TemporaryFolder temporary;
  temporary.write("notes.txt", "mine");
  EXPECT_THROW(RecordingWriter{temporary.path()}, std::runtime_error);
  EXPECT_THROW(RecordingWriter(temporary.path(), NameTaken::kNumber), std::runtime_error);
  EXPECT_NO_THROW(RecordingWriter{temporary.path() / "new"});
}

TEST(Recording, WriterLeavesWhatAnotherRunHasWritten) {
  const testing::TemporaryFolder temporary;
  const auto folder = temporary.path() / "run";
  { const RecordingWriter cut_off(folder); }
  const auto left = temporary.write("run.partial/frames.jsonl", "mine");
  EXPECT_THROW(RecordingWriter{folder}, std::runtime_error);
  RecordingWriter next(folder, NameTaken::kNumber);
  EXPECT_EQ(next.folder(), temporary.path() / "run-2");
  EXPECT_EQ(RecordingWriter(folder, NameTaken::kNumber).folder(), temporary.path() / "run-3");
  next.finish();
  EXPECT_TRUE(std::filesystem::exists(temporary.path() / "run-2" / "telemetry.tlog"));
  EXPECT_EQ(RecordingWriter(temporary.path() / "run-2", NameTaken::kNumber).folder().filename(), "run-2-2");
  EXPECT_EQ(std::filesystem::file_size(left), 4U);
}

TEST(Recording, WriterTakesAnotherNameWhereItsOwnIsTakenMeanwhile) {
  const testing::TemporaryFolder temporary;
  const auto folder = temporary.path() / "run";
  for (const auto name_taken : {NameTaken::kRefuse, NameTaken::kNumber}) {
    RecordingWriter writer(folder, name_taken);
    std::filesystem::create_directory(folder);
    temporary.write("run/notes.txt", "mine");
    if (name_taken == NameTaken::kRefuse) {
      EXPECT_THROW(writer.finish(), std::runtime_error);
      std::filesystem::remove_all(folder);
      std::filesystem::remove_all(writer.partial_folder());
    } else {
      writer.finish();
      EXPECT_EQ(writer.folder(), temporary.path() / "run-2");
      EXPECT_TRUE(std::filesystem::exists(writer.folder() / "frames.jsonl"));
    }
  }
  EXPECT_EQ(std::filesystem::file_size(folder / "notes.txt"), 4U);
}

TEST(Recording, WriterReportsAFullDisk) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  const testing::TemporaryFolder temporary;
  RecordingWriter writer(temporary.path() / "run");
  std::filesystem::create_symlink("/dev/full", temporary.path() / "run.partial" / "full.json");
  EXPECT_THROW(writer.write_extra("full.json", "{}"), std::runtime_error);
}

TEST(Recording, ReaderNamesWhatIsMissing) {
  const testing::TemporaryFolder temporary;
  for (const char* name : {"telemetry.tlog", "frames.jsonl", "camera.json"}) {
    const auto folder = temporary.path() / (std::string("without-") + name);
    write_recording(folder);
    std::filesystem::remove(folder / name);
    try {
      read_recording(folder);
      FAIL() << "read without " << name;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
  }
  EXPECT_THROW(read_recording(temporary.path() / "nowhere"), std::runtime_error);
}

TEST(Recording, WithoutCountsHasLeftOutNothingAndWithBadOnesIsRefused) {
  const testing::TemporaryFolder temporary;
  const auto folder = temporary.path() / "run";
  write_recording(folder);
  std::filesystem::remove(folder / "counts.json");
  EXPECT_EQ(read_recording(folder).frames_damaged, 0U);
  for (const char* text : {"", "[]", "{}", R"({"frames_damaged": -1})", R"({"frames_damaged": 0.5})"}) {
    temporary.write("run/counts.json", text);
    EXPECT_THROW(read_recording(folder), std::runtime_error) << text;
  }
}

class BadFrameLine : public ::testing::TestWithParam<const char*> {};

TEST_P(BadFrameLine, IsRefusedByFileLineAndReasonOrSkippedAndCounted) {
  const std::string good = R"({"time_us": 5, "detections": []})";
  std::istringstream strict(good + "\n" + GetParam() + "\n");
  SkippedLines skipped;
  try {
    read_frames(strict, "frames.jsonl", BadLines::kRefuse, skipped);
    FAIL() << "accepted: " << GetParam();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("frames.jsonl:2: ", 0), 0U) << error.what();
  }
  std::istringstream lenient(good + "\n" + GetParam() + "\n" +
                             R"({"time_us": 9, "detections": [], "extra": 1})");
  EXPECT_EQ(read_frames(lenient, "frames.jsonl", BadLines::kSkip, skipped).size(), 2U);
  EXPECT_EQ(skipped.count, 1U);
}

INSTANTIATE_TEST_SUITE_P(
    All, BadFrameLine,
    ::testing::Values("nonsense", "[]", "{}", R"({"time_us": 6})", R"({"time_us": 4, "detections": []})",
                      R"({"time_us": -1, "detections": []})", R"({"time_us": 1e300, "detections": []})",
                      R"({"time_us": 9223372036854775807, "detections": []})",
                      R"({"time_us": 6, "detections": 3})", R"({"time_us": 6, "detections": [3]})",
                      R"({"time_us": 6, "detections": [{"box": [1, 2, 3]}]})",
                      R"({"time_us": 6, "detections": [{"box": [1, 2, 0, 4]}]})",
                      R"({"time_us": 6, "detections": [{"box": [1, 2, 3, -4]}]})",
                      R"({"time_us": 6, "detections": [{"box": [NaN, 2, 3, 4]}]})",
                      R"({"time_us": 6, "detections": [{"box": [1e999, 2, 3, 4]}]})",
                      R"({"time_us": 6, "detections": [{"box": [1, 2, 3, 4], "confidence": 2}]})",
                      R"({"time_us": 6, "detections": [{"box": [1, 2, 3, 4], "class_id": 0.5}]})",
                      R"({"time_us": 6, "detections": [{"box": [1, 2, 3, 4], "class_id": 1e12}]})",
                      R"({"time_us": 6, "detections": [], "mount": 3})",
                      R"({"time_us": 6, "detections": [], "mount": {"pitch_deg": "down"}})",
                      R"({"time_us": 6, "detections": [], "mount": {"pitch_deg": 1e9}})",
                      R"({"time_us": 6, "detections": [], "focal_px": 914})",
                      R"({"time_us": 6, "detections": [], "focal_px": [914]})",
                      R"({"time_us": 6, "detections": [], "focal_px": [914, "914"]})",
                      R"({"time_us": 6, "detections": [], "focal_px": [914, 0]})",
                      R"({"time_us": 6, "detections": [], "focal_px": [-914, 914]})",
                      R"({"time_us": 6, "detections": [], "focal_px": [914, 1e300]})",
                      R"({"time_us": 6, "detections": [], "telemetry_records": -3})"));

TEST(Frames, WhatAPowerCutLeavesAtTheEndIsSkippedAndCounted) {
  using namespace std::string_literals;
  const std::string good = R"({"time_us": 5, "detections": []})";
  for (const std::string& end : {R"({"time_us": 6, "dete)"s, "\0\0\0"s, "{\"time\0\0\0"s, "\0\0}\n"s}) {
    std::istringstream input(good + "\n" + end);
    SkippedLines skipped;
    EXPECT_EQ(read_frames(input, "frames.jsonl", BadLines::kRefuse, skipped).size(), 1U) << end;
    EXPECT_EQ(skipped.count, 1U);
  }
  std::istringstream whole(good + "\n" + good);  // other programs may leave out the last line's end
  SkippedLines skipped;
  EXPECT_EQ(read_frames(whole, "frames.jsonl", BadLines::kRefuse, skipped).size(), 2U);
  EXPECT_EQ(skipped.count, 0U);
}

TEST(Frames, OfBadLinesTheFirstTenAreNamedAndTheOthersCounted) {
  std::string text;
  for (int i = 0; i < 13; ++i) text += "nonsense\n";
  const std::string good = R"({"time_us": 5, "detections": []})";
  std::istringstream strict(text + good + "\n");
  SkippedLines skipped;
  try {
    read_frames(strict, "frames.jsonl", BadLines::kRefuse, skipped);
    FAIL();
  } catch (const std::runtime_error& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("frames.jsonl:10: "), std::string::npos) << message;
    EXPECT_EQ(message.find("frames.jsonl:11: "), std::string::npos) << message;
    EXPECT_NE(message.find("and 3 more bad lines"), std::string::npos) << message;
  }
  std::istringstream lenient(text + good + "\n");
  EXPECT_EQ(read_frames(lenient, "frames.jsonl", BadLines::kSkip, skipped).size(), 1U);
  EXPECT_EQ(skipped.count, 13U);
  ASSERT_EQ(skipped.named.size(), 10U);
  EXPECT_EQ(skipped.named[1], "frames.jsonl:2: not a JSON object");
}

TEST(Truth, IdsAreNumbersOrTextsAndAreWrittenAsTheyWereRead) {
  const auto target = [](const std::string& id) {
    return R"({"features": [{"geometry": {"coordinates": [-43, -22]}, "properties": {"id": )" + id + "}}]}";
  };
  EXPECT_EQ(parse_truth(target("17"), "any")[0].id, TargetId(17));
  const auto named = parse_truth(target(R"("mark 7")"), "any");
  EXPECT_EQ(named[0].id, TargetId("mark 7"));
  EXPECT_EQ(parse_truth(truth_to_geojson(named), "any")[0].id, named[0].id);
  for (const char* id : {"true", "[]", "-1", "0.5", "1e300", "null"})
    EXPECT_THROW(parse_truth(target(id), "any"), std::runtime_error) << id;
}

TEST(Truth, RefusesWhatIsNoPlace) {
  const testing::TemporaryFolder temporary;
  for (const char* text :
       {"", "{}", R"({"features": [{}]})", R"({"features": [{"geometry": {"coordinates": [1]}}]})",
        R"({"features": [{"geometry": {"coordinates": [-43, 99]}}]})", R"({"features": [7]})"}) {
    EXPECT_THROW(read_truth(temporary.write("truth.geojson", text)), std::runtime_error) << text;
  }
}

}  // namespace
}  // namespace geoloc::io
