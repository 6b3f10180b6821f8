// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace geoloc::io {

/// Whether it is an RTSP address: rtsp:// (or rtspt, rtspu, rtsps), a host, no spaces or control characters.
bool is_rtsp_url(std::string_view url);

/// The address in a form that can be shown and logged: scheme, host, port and path. User, password, and
/// whatever looks like a parameter are replaced by "…"; some cameras take the password in the path
/// ("/user=admin_password=…").
std::string without_credentials(std::string_view url);

/// `text` with every occurrence of `url` and of the secrets in it replaced, for messages made by other
/// libraries.
std::string without_credentials_of(std::string_view url, std::string text);

}  // namespace geoloc::io
