// SPDX-License-Identifier: Apache-2.0
#include "report/json/json_writer.hpp"

#include "report/text/formatting.hpp"

namespace strake::report {

void append_key(std::string& out, std::string_view name) {
  append_json(out, name);
  out += ": ";
}

void append_identity(std::string& out, std::string_view id, std::string_view name,
                     std::string_view file) {
  out += "\"id\": ";
  append_json(out, id);
  out += ", \"name\": ";
  append_json(out, name);
  out += ", \"file\": ";
  append_json(out, file);
}

void append_counts(std::string& out, std::uint64_t hit, std::uint64_t contact,
                   std::uint64_t clearance_violation, std::optional<std::uint64_t> allowed) {
  out += "\"counts\": {\"HIT\": " + std::to_string(hit) +
         ", \"CONTACT\": " + std::to_string(contact) +
         ", \"CLEARANCE_VIOLATION\": " + std::to_string(clearance_violation);
  if (allowed) out += ", \"ALLOWED\": " + std::to_string(*allowed);
  out += '}';
}

}  // namespace strake::report
