// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <new>
#include <stdexcept>
#include <string>

#include "geoloc/geoloc.h"

namespace geoloc::c {

/// What the caller gave cannot be: GEOLOC_INVALID_ARGUMENT.
struct BadArgument : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// GEOLOC_INVALID_SETTING.
struct BadSetting : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// Keeps the message for geoloc_last_error(), and returns the status.
geoloc_status fail(geoloc_status status, const char* message) noexcept;

/// The border that no exception crosses: what `body` answers, or the status and message of what it throws.
template <typename Body>
geoloc_status guarded(const Body& body) noexcept {
  try {
    return body();
  } catch (const BadSetting& error) {
    return fail(GEOLOC_INVALID_SETTING, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(GEOLOC_INVALID_ARGUMENT, error.what());
  } catch (const std::bad_alloc&) {
    return fail(GEOLOC_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(GEOLOC_INTERNAL_ERROR, error.what());
  } catch (...) {
    return fail(GEOLOC_INTERNAL_ERROR, "an exception that says nothing");
  }
}

/// What a pointer points to; BadArgument for NULL.
template <typename T>
T& required(T* pointer, const char* name) {
  if (pointer == nullptr) throw BadArgument(std::string(name) + " is NULL");
  return *pointer;
}

}  // namespace geoloc::c
