// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/ground_options.hpp"
#include "common/output_options.hpp"
#include "common/outputs.hpp"
#include "geoloc/io/live_page/live_page.hpp"

namespace geoloc::apps {

/// Opens the page of --http, with the token of --http-token and the map of --map or --ground; nullptr where
/// none is wanted. It is served as long as it is held. `playback` is that of a replay. Throws std::exception
/// saying what is wrong with the endpoint or a file.
std::shared_ptr<io::LivePage> open_live_page(const OutputOptions& options, const GroundOptions& ground,
                                             const io::LivePageConfig& config, const io::LivePageTitle& title,
                                             const std::vector<std::string>& class_names,
                                             const Outputs& outputs,
                                             std::shared_ptr<io::ReplayControl> playback = nullptr);

/// Where the page is, and who else can see it, for the user. A terminal also shows the token, for its reader
/// to open the page, and a QR code of the address for telephones where the page is open to the network; logs
/// get neither.
std::string page_message(const io::LivePage& page, const OutputOptions& options, bool is_terminal);

}  // namespace geoloc::apps
