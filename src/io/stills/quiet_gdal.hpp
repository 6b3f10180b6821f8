// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cpl_error.h>

namespace geoloc::io {

/// Keeps GDAL's messages off stderr while it lives: they tell of formats and tags that nobody asked for.
class QuietGdal {
 public:
  QuietGdal() { CPLPushErrorHandler(&CPLQuietErrorHandler); }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

}  // namespace geoloc::io
