// SPDX-License-Identifier: Apache-2.0
#include "report/elements.hpp"

#include <algorithm>
#include <cstddef>

#include "strake/clash/identity.hpp"
#include "strake/core/base64.hpp"

namespace strake::report {

Elements::Elements(const model::Model& model) {
  elements_.reserve(model.objects.size());
  for (std::uint32_t o = 0; o < model.objects.size(); ++o)
    elements_.push_back({clash::element_hash(model, model::ObjectId{o}), o});
  std::ranges::sort(elements_, [](const Element& x, const Element& y) {
    return x.hash != y.hash ? x.hash < y.hash : x.object < y.object;
  });
}

void Elements::append_list(std::string& out) const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(elements_.size() * 8);
  for (const Element& e : elements_)
    for (unsigned shift = 0; shift < 64; shift += 8)
      bytes.push_back(static_cast<std::uint8_t>((e.hash >> shift) & 255U));
  append_base64(out, bytes);
}

void Elements::append_members(std::string& out, const std::vector<bool>& member) const {
  std::vector<std::uint8_t> bytes((elements_.size() + 7) / 8, 0);
  for (std::size_t i = 0; i < elements_.size(); ++i)
    if (elements_[i].object < member.size() && member[elements_[i].object])
      bytes[i / 8] = static_cast<std::uint8_t>(bytes[i / 8] | (1U << (i % 8)));
  append_base64(out, bytes);
}

void Elements::append_bytes(std::string& out, const std::vector<std::uint8_t>& of_object) const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(elements_.size());
  for (const Element& e : elements_)
    bytes.push_back(e.object < of_object.size() ? of_object[e.object] : std::uint8_t{0});
  append_base64(out, bytes);
}

}  // namespace strake::report
