// SPDX-License-Identifier: Apache-2.0
// Many flights, one map: summaries of flights in, objects with the flights' common errors taken out.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>

#include "common/command_line.hpp"
#include "common/objects_table.hpp"
#include "fuse/fleet_service.hpp"
#include "fuse/fuse_options.hpp"
#include "geoloc/io/fleet/fused_report.hpp"

int main(int argc, char** argv) {
  using namespace geoloc;
  using namespace geoloc::apps;
  CLI::App cli("Fuses flights into one map: objects that several of them saw, and what each was off by.",
               "geoloc_fuse");
  FuseOptions options;
  add_fuse_options(cli, options);
  if (const auto status = parse(cli, argc, argv)) return *status;

  std::unique_ptr<FleetService> service;
  if (const auto unusable =
          guard("geoloc_fuse", kUnusable, [&] { service = std::make_unique<FleetService>(options); }))
    return *unusable;
  const StopSignal stop;
  io::RunRecord run;
  if (const auto failed = guard("geoloc_fuse", kFailed, [&] { run = service->run(stop); })) return *failed;
  if (!run.fused_map) return kDone;  // stopped before there was anything to fuse
  if (options.outputs.objects.empty()) std::fputs(objects_to_table(run.objects).c_str(), stdout);
  std::fprintf(stderr, "%s%s\n", io::flights_to_table(*run.fused_map).c_str(), run.summary.c_str());
  return service->has_failed() ? kFailed : kDone;
}
