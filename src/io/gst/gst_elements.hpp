// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gst/gst.h>

#include <string>

// What every module that uses GStreamer begins with.
namespace geoloc::io {

/// Initialises GStreamer, once. Throws std::runtime_error with its reason.
void init_gstreamer();

bool has_element(const char* name);

/// Throws std::runtime_error naming the element and the package it comes in.
void require_element(const char* name, const char* debian_package);

/// The pipeline owns the element. Throws std::runtime_error if there is no such element.
GstElement* add_element(GstElement* pipeline, const char* name);

/// The reason in an error message.
std::string error_text(GstMessage* message);

}  // namespace geoloc::io
