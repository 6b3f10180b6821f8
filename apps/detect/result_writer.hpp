// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/output_files.hpp"
#include "detect/inputs.hpp"
#include "geoloc/camera/detection.hpp"
#include "geoloc/io/partial_file.hpp"
#include "geoloc/io/video/video_file.hpp"

namespace geoloc::apps {

/// A picture or a frame of a video.
struct SeenPicture {
  std::filesystem::path file;
  std::optional<std::uint64_t> frame;  ///< of a video, from 0
  double time_s = 0.0;                 ///< in the video
  cv::Mat bgr;
};

/// Where geoloc_detect leaves what it finds: lines of JSON, pictures and videos with boxes drawn into them,
/// or, without either, lines for a person on stdout. A JSON file or a video that is not finished is not left
/// behind. Throws std::runtime_error naming the file that cannot be written.
class ResultWriter {
 public:
  struct Places {
    std::string json;  ///< a file, "-" for stdout, or empty
    std::string draw;  ///< a folder, or empty
  };

  /// `other_inputs`: files read besides the pictures. Throws also where results would take the place of
  /// inputs or of one another.
  ResultWriter(Places places, const std::vector<DetectInput>& inputs, const NamedFiles& other_inputs,
               std::vector<std::string> class_names);

  /// Draws into the picture.
  void add(SeenPicture& picture, const std::vector<Detection>& detections);

  /// No more frames of the video before will come: its drawn one appears.
  void finish_video();

  /// Gives the JSON file its name: it appears whole.
  void finish();

 private:
  void write_json(const SeenPicture& picture, const std::vector<Detection>& detections);
  void draw(const SeenPicture& picture);
  void draw_frame(const SeenPicture& picture);

  Places places_;
  std::vector<std::string> class_names_;
  std::optional<io::PartialFile> partial_json_;
  std::optional<io::OutputStream> json_;
  std::unique_ptr<io::VideoFile> video_;
};

}  // namespace geoloc::apps
