// SPDX-License-Identifier: Apache-2.0
#include "eval/rendered_report.hpp"

#include <fmt/format.h>

#include <iterator>

#include "eval/experiment_report.hpp"

namespace geoloc::apps {

std::string rendered_to_markdown(const std::vector<RenderedRun>& runs) {
  if (runs.empty()) return "";
  std::string text =
      "| flight | scenario | method | frames | found | extra | RMSE m | drawn detections: found | extra | "
      "RMSE m | "
      "RMSE ratio |\n|---|---|---|---|---|---|---|---|---|---|---|\n";
  for (const RenderedRun& run : runs) {
    const RunResult& pictures = run.from_pictures;
    const Score& model = run.from_model.score;
    fmt::format_to(
        std::back_inserter(text), "| {} | {} | {} | {} | {}/{} | {} | {} | {}/{} | {} | {} | {} |\n",
        pictures.flight, pictures.scenario, name_of(pictures.contender), run.frames, pictures.score.found,
        pictures.score.targets, pictures.score.extra, three_decimals(pictures.score.rmse_m), model.found,
        model.targets, model.extra, three_decimals(model.rmse_m), two_decimals(rmse_ratio(run)));
  }
  return text;
}

nlohmann::ordered_json rendered_to_json(const std::vector<RenderedRun>& runs) {
  std::vector<RunResult> from_pictures, from_model;
  for (const RenderedRun& run : runs) {
    from_pictures.push_back(run.from_pictures);
    from_model.push_back(run.from_model);
  }
  return {{"from_pictures", to_json(from_pictures)["runs"]}, {"from_model", to_json(from_model)["runs"]}};
}

}  // namespace geoloc::apps
