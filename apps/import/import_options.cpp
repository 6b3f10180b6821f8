// SPDX-License-Identifier: Apache-2.0
#include "import/import_options.hpp"

#include <cmath>

namespace geoloc::apps {

namespace {

constexpr const char* kLabelsHelp =
    "In place of a detector: OpenDroneMap's gcp_list.txt, CSV "
    "picture,u,v[,width,height,class_id,confidence], or what geoloc_detect --json wrote";

/// What both commands have: where the objects come from, and where the recording goes.
template <typename Options>
void add_shared_options(CLI::App& command, Options& options) {
  command.add_option("--out", options.out, "The recording to write, a new folder")
      ->type_name("RECORDING")
      ->required();
  CLI::Option* const labels =
      command.add_option("--labels", options.labels_file, kLabelsHelp)->type_name("FILE");
  command
      .add_option("--utc-offset-h", options.utc_offset_h,
                  "What the camera's clock is ahead of UTC, h, where its files do not tell; default: 0")
      ->check(CLI::Range(-14.0, 14.0))
      ->type_name("X");
  command
      .add_option(
          "--take-off-height-m", options.take_off_height_m,
          "The take-off's height, m, as the absolute heights count, where no heights above it are told")
      ->check(CLI::Range(-1000.0, 9000.0))
      ->type_name("X");
  add_detector_options(command, options.detector);
  add_detector_tuning(command, options.tuning);
  for (const char* detector_option : {"--model", "--class-names", "--second-look", "--backend",
                                      "--confidence", "--tiles", "--input-size", "--layout"})
    labels->excludes(command.get_option(detector_option));
}

/// `auto`, or seconds.
std::string check_offset(const std::string& text) {
  double value_s = 0.0;
  if (text == "auto" || (CLI::detail::lexical_cast(text, value_s) && std::abs(value_s) < 1e6)) return {};
  return text + " is neither `auto` nor a number of seconds";
}

}  // namespace

void add_stills_command(CLI::App& program, StillsOptions& options) {
  CLI::App& stills =
      *program.add_subcommand("stills", "Pictures with EXIF and XMP, of one camera and one day");
  stills.add_option("INPUT", options.inputs, "Pictures (JPEG), or folders of pictures")->required();
  stills
      .add_option("--camera", options.camera_file,
                  "Calibration, YAML or camera.json; default: what the pictures tell of their lens")
      ->type_name("FILE");
  stills
      .add_option(
          "--gimbal-pitch-deg", options.gimbal_pitch_deg,
          "The camera's pitch, deg, in pictures that do not tell it: -90 is straight down, the default")
      ->check(CLI::Range(-90.0, 0.0))
      ->type_name("X");
  add_shared_options(stills, options);
}

const CLI::App* add_video_command(CLI::App& program, VideoOptions& options) {
  CLI::App& video = *program.add_subcommand(
      "video", "A video, and the log of the flight it was taken on, unless its frames carry that");
  video.add_option("FILE", options.video, "The video, of any kind that GStreamer plays")->required();
  video
      .add_option(
          "--log", options.log,
          "DJI's subtitles (.SRT), ArduPilot's .BIN, PX4's .ulg, a MAVLink log (.tlog), or a table (.csv) "
          "[the telemetry in the video's frames]")
      ->type_name("FILE");
  video
      .add_option("--log-offset-s", options.log_offset,
                  "When the video began, s after the log's beginning; auto: by what video and log tell")
      ->check(CLI::Validator(check_offset, "X|auto"))
      ->capture_default_str()
      ->needs(video.get_option("--log"))
      ->type_name("");
  video
      .add_option("--camera", options.camera_file,
                  "Calibration and mount, YAML or camera.json; needed unless the log or the video tells the "
                  "focal length")
      ->type_name("FILE");
  video
      .add_option(
          "--gimbal-pitch-deg", options.gimbal_pitch_deg,
          "The pitch, deg, of a camera that is held level by a gimbal of which the log tells nothing: "
          "-90 is straight down; without it, the camera is fixed in the vehicle as --camera says")
      ->check(CLI::Range(-90.0, 0.0))
      ->needs(video.get_option("--log"))
      ->type_name("X");
  add_shared_options(video, options);
  return &video;
}

}  // namespace geoloc::apps
