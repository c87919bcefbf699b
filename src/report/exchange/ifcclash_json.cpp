// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/number.hpp"
#include "report/clash/contents.hpp"
#include "report/json/json_writer.hpp"
#include "report/text/formatting.hpp"
#include "report/text/ordered_lines.hpp"
#include "strake/report/clash.hpp"

namespace strake::report {
namespace {

using clash::Pair;
using clash::Report;

constexpr double kMillimetresOfMetre = 1000;

/// What ifcclash calls a set of clashes of one class of ours.
struct IfcSetKind {
  clash::Class cls;
  std::string_view mode, suffix, type;
};

constexpr std::array kIfcSetKinds{
    IfcSetKind{clash::Class::hit, "intersection", "", "protrusion"},
    IfcSetKind{clash::Class::contact, "collision", " (contacts)", "collision"},
    IfcSetKind{clash::Class::clearance_violation, "clearance", " (clearance)", "clearance"},
};

/// Returns the objects that share their id with one of another file: ids alone do not tell them
/// apart.
std::vector<bool> shared_ids(const model::Model& model) {
  std::vector<std::uint32_t> by_id(model.objects.size());
  for (std::uint32_t o = 0; o < by_id.size(); ++o) by_id[o] = o;
  const auto id = [&](std::uint32_t o) -> const std::string& { return model.objects[o].id; };
  std::ranges::sort(by_id, [&](std::uint32_t x, std::uint32_t y) {
    return id(x) != id(y) ? id(x) < id(y) : x < y;
  });
  std::vector<bool> shared(by_id.size(), false);
  for (std::size_t i = 1; i < by_id.size(); ++i)
    if (id(by_id[i]) == id(by_id[i - 1])) shared[by_id[i]] = shared[by_id[i - 1]] = true;
  return shared;
}

/// Appends millimetres as metres, to a nanometre.
void append_metres(std::string& out, double mm) {
  constexpr int kNanometres = 9;
  append_fixed(out, mm / kMillimetresOfMetre, kNanometres);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
}

void metre_point(std::string& out, std::string_view key, const geometry::Vec3d& mm) {
  out += ", ";
  append_key(out, key);
  for (int k = 0; k < 3; ++k) {
    out += k == 0 ? "[" : ", ";
    append_metres(out, mm[k]);
  }
  out += ']';
}

void ifc_member(std::string& out, std::string_view key, std::string_view text) {
  append_key(out, key);
  append_json(out, text);
}

/// Returns a text without hyphens, which stand between the two parts of a key: "x-y" and "z" would
/// otherwise be "x" and "y-z". A GlobalId of IFC has none.
std::string without_hyphens(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '-')
      out += "%2D";
    else if (c == '%')
      out += "%25";
    else
      out += c;
  }
  return out;
}

/// Returns what a key has of an object: its id, and where others have it too the file.
std::string key_part(const model::Model& model, const std::vector<bool>& shared,
                     model::ObjectId id) {
  const model::Object& object = model.object(id);
  return without_hyphens(shared[index(id)] ? model.files[object.file].label + ":" + object.id
                                           : object.id);
}

void ifc_clash(std::string& out, const ClashContents& contents, const std::vector<bool>& shared,
               const Pair& pair, std::string_view type) {
  const model::Model& model = contents.model;
  const model::Object &a = model.object(pair.a), &b = model.object(pair.b);
  append_json(out, key_part(model, shared, pair.a) + "-" + key_part(model, shared, pair.b));
  out += ": {";
  ifc_member(out, "a_global_id", a.id);
  out += ", ";
  ifc_member(out, "b_global_id", b.id);
  out += ", ";
  ifc_member(out, "a_ifc_class", stated_text(model, pair.a, "Class").value_or(std::string()));
  out += ", ";
  ifc_member(out, "b_ifc_class", stated_text(model, pair.b, "Class").value_or(std::string()));
  out += ", ";
  ifc_member(out, "a_name", a.name);
  out += ", ";
  ifc_member(out, "b_name", b.name);
  out += ", ";
  ifc_member(out, "type", type);
  metre_point(out, "p1", pair.on_a_mm);
  metre_point(out, "p2", pair.on_b_mm);
  out += ", \"distance\": ";
  append_metres(out, std::fabs(pair.d_mm));
  out += '}';
}

/// Appends the files that have objects of a set, as sources without a selector of ifcclash's own.
void ifc_sources(std::string& out, std::string_view side, const model::Model& model,
                 const std::vector<bool>& in_set) {
  std::vector<bool> used(model.files.size(), false);
  for (std::size_t o = 0; o < std::min(in_set.size(), model.objects.size()); ++o)
    if (in_set[o]) used[model.objects[o].file] = true;
  append_key(out, side);
  out += '[';
  bool first = true;
  for (std::size_t f = 0; f < used.size(); ++f) {
    if (!used[f]) continue;
    out += first ? "{" : ", {";
    first = false;
    ifc_member(out, "file", model.files[f].label);
    out += ", \"mode\": \"a\"}";
  }
  out += ']';
}

/// Appends what a set states before its clashes.
void begin_ifc_set(std::string& out, const model::Model& model, const Report& test,
                   const IfcSetKind& kind) {
  out += '{';
  ifc_member(out, "name", (test.name.empty() ? "Strake" : test.name) + std::string(kind.suffix));
  out += ", ";
  ifc_member(out, "mode", kind.mode);
  const clash::Tolerances& tolerances = test.options.tolerances;
  if (kind.cls == clash::Class::hit) {
    out += ", \"tolerance\": ";
    append_metres(out, tolerances.touch_overlap_mm);
    out += ", \"check_all\": true, ";
  } else if (kind.cls == clash::Class::contact) {
    out += ", \"allow_touching\": true, ";
  } else {
    out += ", \"clearance\": ";
    append_metres(out, tolerances.clearance_mm);
    out += ", \"check_all\": true, ";
  }
  ifc_sources(out, "a", model, test.in_a);
  if (test.in_a != test.in_b) {
    out += ", ";
    ifc_sources(out, "b", model, test.in_b);
  }
  out += ", \"clashes\": {";
}

/// Returns the results of a class that no rule allows.
std::vector<std::uint32_t> pairs_of(const Report& test, clash::Class cls) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t p = 0; p < test.pairs.size(); ++p)
    if (test.pairs[p].cls == cls && test.pairs[p].allowed < 0) numbers.push_back(p);
  return numbers;
}

}  // namespace

Status write_ifcclash_json(const ClashContents& contents, Sink sink,
                           const parallel::Context& context) {
  const std::vector<bool> shared = shared_ids(contents.model);
  BufferedWriter buffer(sink);
  buffer << "[";
  bool first = true;
  for (const Report& test : contents.findings.tests) {
    for (const IfcSetKind& kind : kIfcSetKinds) {
      const std::vector<std::uint32_t> numbers = pairs_of(test, kind.cls);
      if (numbers.empty() && kind.cls != clash::Class::hit) continue;
      buffer << (first ? "\n" : ",\n");
      first = false;
      begin_ifc_set(buffer.text(), contents.model, test, kind);
      const Status status =
          write_lines(context, numbers.size(), buffer, [&](std::size_t i, std::string& out) {
            out += i == 0 ? "\n" : ",\n";
            ifc_clash(out, contents, shared, test.pairs[numbers[i]], kind.type);
          });
      if (!status) return status;
      buffer << "}}";
    }
  }
  buffer << "\n]\n";
  return {};
}

}  // namespace strake::report
