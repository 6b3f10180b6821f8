// SPDX-License-Identifier: Apache-2.0
#include "import/import_options.hpp"

namespace geoloc::apps {

void add_stills_command(CLI::App& program, StillsOptions& options) {
  CLI::App& stills =
      *program.add_subcommand("stills", "Pictures with EXIF and XMP, of one camera and one day");
  stills.add_option("INPUT", options.inputs, "Pictures (JPEG), or folders of pictures")->required();
  stills.add_option("--out", options.out, "The recording to write, a new folder")
      ->type_name("RECORDING")
      ->required();
  CLI::Option* const labels =
      stills
          .add_option("--labels", options.labels_file,
                      "In place of a detector: OpenDroneMap's gcp_list.txt, CSV "
                      "picture,u,v[,width,height,class_id,confidence], or what geoloc_detect --json wrote")
          ->type_name("FILE");
  stills
      .add_option("--camera", options.camera_file,
                  "Calibration, YAML or camera.json; default: what the pictures tell of their lens")
      ->type_name("FILE");
  stills
      .add_option("--utc-offset-h", options.utc_offset_h,
                  "What the camera's clock is ahead of UTC, h, where the pictures do not tell; default: 0")
      ->check(CLI::Range(-14.0, 14.0))
      ->type_name("X");
  stills
      .add_option("--take-off-height-m", options.take_off_height_m,
                  "The take-off's height, m, as the pictures' absolute heights count, where they do not tell "
                  "their own above it")
      ->check(CLI::Range(-1000.0, 9000.0))
      ->type_name("X");
  stills
      .add_option(
          "--gimbal-pitch-deg", options.gimbal_pitch_deg,
          "The camera's pitch, deg, in pictures that do not tell it: -90 is straight down, the default")
      ->check(CLI::Range(-90.0, 0.0))
      ->type_name("X");
  add_detector_options(stills, options.detector);
  add_detector_tuning(stills, options.tuning);
  for (const char* detector_option :
       {"--model", "--class-names", "--second-look", "--backend", "--confidence", "--tiles", "--input-size"})
    labels->excludes(stills.get_option(detector_option));
}

}  // namespace geoloc::apps
