// SPDX-License-Identifier: Apache-2.0
#include "sim/images_mode.hpp"

#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>

#include "common/progress_line.hpp"
#include "common/stop_signal.hpp"
#include "sim/option_groups.hpp"

namespace geoloc::sim {

CLI::Option* add_images_options(CLI::App& program, ImagesOptions& options) {
  CLI::Option* const images =
      program.add_option("--images", options.wanted.count, "Write this many labelled pictures");
  images->check(CLI::Range(1, 1000000))->group(kImagesGroup);
  CLI::Option* const out = program.add_option("--out", options.folder, "New folder for them");
  out->group(kImagesGroup);
  images->needs(out);
  const std::map<std::string, ImageSet> sets{{"train", ImageSet::kTraining},
                                             {"held-back", ImageSet::kHeldBack}};
  program
      .add_option("--grounds", options.wanted.variety.set,
                  "train, or held-back: other grounds in another light")
      ->transform(CLI::CheckedTransformer(sets))
      ->needs(images)
      ->group(kImagesGroup);
  program
      .add_option("--range-m", options.wanted.variety.range_m,
                  "Least and greatest distance to the ground along the optical axis, m [4.5 85]")
      ->check(CLI::Range(1.0, 100.0))
      ->needs(images)
      ->group(kImagesGroup);
  program
      .add_flag("--crisp", options.wanted.with_crisp,
                "Also crisp/*.png: the same in grey, by a camera without blur, noise or haze")
      ->needs(images)
      ->group(kImagesGroup);
  return images;
}

int run_images_mode(ImagesOptions options, std::uint64_t seed) {
  options.wanted.seed = seed;
  if (std::filesystem::exists(options.folder)) {
    std::fprintf(stderr, "geoloc_sim: --out %s exists already; name a new folder\n", options.folder.c_str());
    return 2;
  }
  const apps::StopSignal stop;
  apps::ProgressLine line("pictures", static_cast<std::size_t>(options.wanted.count));
  const auto progress = [&](int done) {
    line.show(static_cast<std::size_t>(done));
    return !stop.is_requested();
  };
  try {
    const bool whole = write_labelled_images(options.wanted, options.folder, progress);
    line.finish();
    if (whole)
      std::fprintf(stderr, "%d pictures in %s\n", options.wanted.count, options.folder.c_str());
    else
      std::fputs("interrupted; nothing is left behind\n", stderr);
    return 0;
  } catch (const std::exception& error) {
    line.finish();
    std::fprintf(stderr, "geoloc_sim: %s\n", error.what());
    return 1;
  }
}

}  // namespace geoloc::sim
