// SPDX-License-Identifier: Apache-2.0
#include "last_error.hpp"

namespace geoloc::c {
namespace {

thread_local std::string last_error;

}  // namespace

geoloc_status fail(geoloc_status status, const char* message) noexcept {
  try {
    last_error = message;
  } catch (...) {
    last_error.clear();  // no memory even for the message
  }
  return status;
}

}  // namespace geoloc::c

extern "C" {

const char* geoloc_last_error(void) {
  return geoloc::c::last_error.c_str();
}

const char* geoloc_version(void) {
  return GEOLOC_VERSION;
}
}
