// SPDX-License-Identifier: Apache-2.0
#include "fuzz/hostile_files.hpp"
#include "support/source_tree.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <random>

namespace geoloc::io {
namespace {

using Reader = void (*)(const std::string&);

/// Overwrites, removes and repeats pieces.
std::string damaged(std::string text, std::mt19937& random) {
  for (int left = 1 + static_cast<int>(random() % 8); left > 0 && !text.empty(); --left) {
    const std::size_t at = random() % text.size();
    const std::size_t length = 1 + random() % 24;
    switch (random() % 4) {
      case 0:
        text[at] = static_cast<char>(random());
        break;
      case 1:
        text[at] = "{}[],:\"0123456789eE+-.\n"[random() % 22];
        break;
      case 2:
        text.erase(at, length);
        break;
      default:
        text.insert(random() % text.size(), text.substr(at, length));
    }
  }
  return text;
}

void damage_and_read(const std::string& good, Reader read) {
  std::mt19937 random(1);
  read("");
  read(good);
  for (int i = 0; i < 3000; ++i) read(damaged(good, random));
  for (int i = 0; i < 1000; ++i) {
    std::string noise(random() % 200, '\0');
    for (char& byte : noise) byte = static_cast<char>(random());
    read(noise);
  }
}

const std::string kDetections =
    R"("detections":[{"box":[1,2.5,3,4],"confidence":0.5,"class_id":1,"sigma_px":0.4}])";

TEST(HostileFiles, Frames) {
  damage_and_read(R"({"time_us":1795313538548799,)" + kDetections + "}\n" +
                      R"({"time_us":1795313538648799,"telemetry_records":7,)" + kDetections + "}\n",
                  &hostile::read_any_frames);
}

TEST(HostileFiles, Telemetry) {
  std::ifstream log(test_data() / "mavlink" / "wire.tlog", std::ios::binary);
  std::string good{std::istreambuf_iterator<char>(log), std::istreambuf_iterator<char>()};
  ASSERT_FALSE(good.empty());
  good.resize(std::min<std::size_t>(good.size(), 1000));
  damage_and_read(good, &hostile::read_any_tlog);
}

TEST(HostileFiles, Cameras) {
  damage_and_read(camera_to_json({}).dump(), &hostile::read_any_camera);
  damage_and_read(
      "image_width: 1280\nimage_height: 720\ndistortion_model: plumb_bob\n"
      "camera_matrix:\n  rows: 3\n  cols: 3\n  data: [914., 0., 639.5, 0., 914., 359.5, 0., 0., 1.]\n"
      "distortion_coefficients:\n  rows: 1\n  cols: 5\n  data: [0.1, -0.05, 0., 0., 0.01]\n",
      &hostile::read_any_camera);
}

TEST(HostileFiles, Settings) {
  damage_and_read(geolocator_to_json({}).dump(), &hostile::read_any_config);
}

TEST(HostileFiles, Truth) {
  damage_and_read(R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":{"type":"Point",)"
                  R"("coordinates":[-43.13,-22.9]},"properties":{"id":3,"class_id":0}}]})",
                  &hostile::read_any_truth);
}

TEST(HostileFiles, Notes) {
  damage_and_read(
      R"({"time_us":1795313538548799,"object":17,"coordinates":[-43.13,-22.9],"name":"van","verdict":)"
      R"("confirmed"})"
      "\n",
      &hostile::read_any_notes);
}

TEST(HostileFiles, Priors) {
  damage_and_read(
      R"({"features":[{"geometry":{"coordinates":[-43.13,-22.9]},"properties":{"id":"a","sigma_m":0.1}}],)"
      R"("calibration":{"boresight_x_deg":{"value":0.5,"sigma":0.1},"boresight_y_deg":{"value":0,"sigma":1},)"
      R"("boresight_z_deg":{"value":0,"sigma":1},"latency_s":{"value":0.1,"sigma":0.01}}})",
      &hostile::read_any_priors);
}

}  // namespace
}  // namespace geoloc::io
