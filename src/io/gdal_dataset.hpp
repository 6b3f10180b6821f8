// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace geoloc::io {

/// Keeps GDAL's messages off stderr; the first error is the reason of a failure.
class GdalErrors {
 public:
  GdalErrors() { CPLPushErrorHandlerEx(&GdalErrors::note, this); }
  ~GdalErrors() { CPLPopErrorHandler(); }
  GdalErrors(const GdalErrors&) = delete;
  GdalErrors& operator=(const GdalErrors&) = delete;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(first_error_.empty() ? what : what + ": " + first_error_);
  }

 private:
  static void CPL_STDCALL note(CPLErr severity, CPLErrorNum, const char* message) {
    auto& self = *static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
    if (severity >= CE_Failure && self.first_error_.empty()) self.first_error_ = message;
  }

  std::string first_error_;
};

struct GdalCloser {
  void operator()(void* dataset) const { GDALClose(dataset); }
};
using GdalDataset = std::unique_ptr<void, GdalCloser>;

}  // namespace geoloc::io
