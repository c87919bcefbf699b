// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

namespace strake::report {

/// The name space of what Strake names by the keys of its results: the UUID of the URL
/// "urn:strake:clash" (RFC 9562, version 5). Another one would give all that was ever handed out
/// another name.
inline constexpr std::string_view kClashNamespace = "f043f960-3b47-5c7d-a701-e36b04ffa1e1";

/// Returns the UUID of a key in a name space (RFC 9562, version 5, by SHA-1), in lower case with
/// hyphens: the same key has the same one on every machine, so that what is written again takes
/// the place of what was there. The name space is a UUID as text, of which digits alone count.
[[nodiscard]] std::string uuid_from_key(std::string_view name_space, std::string_view key);

}  // namespace strake::report
