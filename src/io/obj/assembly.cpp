// SPDX-License-Identifier: Apache-2.0
#include "io/obj/assembly.hpp"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "io/encoding.hpp"
#include "strake/core/seeded_hash.hpp"

namespace strake::io::obj {
namespace {

constexpr std::uint32_t kNoEntry = 0xffffffffU;

class Assembler {
 public:
  void chunk(std::uint32_t number, const Chunk& chunk);
  Assembly take() { return std::move(result_); }

 private:
  void apply(const Statement& statement);
  void segment(Segment run);
  std::uint32_t entry();
  std::uint32_t material_index(const std::string& name);

  Assembly result_;
  std::unordered_map<std::string, std::uint32_t, SeededHash>
      groups_;  ///< entry of each g under this o
  std::unordered_map<std::string, std::uint32_t, SeededHash> materials_;  ///< index of each name
  std::string object_name_, group_name_;
  std::uint32_t object_ = 0;
  std::uint32_t entry_ = kNoEntry;  ///< made with the first face, so that empty groups are none
  std::uint32_t material_ = kNoMaterial;
};

std::uint32_t Assembler::material_index(const std::string& name) {
  const auto next = static_cast<std::uint32_t>(result_.material_names.size());
  const auto [place, is_new] = materials_.try_emplace(name, next);
  if (is_new) result_.material_names.push_back(name);
  return place->second;
}

void Assembler::apply(const Statement& statement) {
  switch (statement.kind) {
    case StatementKind::object:
      object_name_ = TextDecoder()(statement.text);
      group_name_.clear();
      groups_.clear();
      ++object_;
      entry_ = kNoEntry;
      break;
    case StatementKind::group:
      group_name_ = TextDecoder()(statement.text);
      entry_ = kNoEntry;
      break;
    case StatementKind::material:
      material_ = material_index(statement.text);
      break;
    case StatementKind::library:
      result_.libraries.push_back(statement.text);
      break;
    case StatementKind::unread:
      result_.entries[entry()].incomplete = true;
      break;
  }
}

std::uint32_t Assembler::entry() {
  if (entry_ != kNoEntry) return entry_;
  const auto next = static_cast<std::uint32_t>(result_.entries.size());
  const auto [place, is_new] = groups_.try_emplace(group_name_, next);
  if (is_new) result_.entries.push_back({object_name_, group_name_, object_, {}, false});
  return entry_ = place->second;
}

void Assembler::segment(Segment run) {
  if (run.face_begin == run.face_end && run.polyline_begin == run.polyline_end) return;
  run.material = material_;
  result_.entries[entry()].segments.push_back(run);
}

void Assembler::chunk(std::uint32_t number, const Chunk& chunk) {
  std::uint32_t face = 0, polyline = 0;
  for (const Statement& statement : chunk.statements) {
    segment({number, face, statement.face, polyline, statement.polyline, kNoMaterial});
    face = statement.face;
    polyline = statement.polyline;
    apply(statement);
  }
  segment({number, face, chunk.faces.size(), polyline, chunk.polylines.size(), kNoMaterial});
}

}  // namespace

Assembly assemble(const std::vector<Chunk>& chunks) {
  Assembler assembler;
  std::vector<std::uint64_t> vertex_base{0}, line_base{0};
  for (std::size_t i = 0; i < chunks.size(); ++i) {
    assembler.chunk(static_cast<std::uint32_t>(i), chunks[i]);
    vertex_base.push_back(vertex_base.back() + chunks[i].vertices.size());
    line_base.push_back(line_base.back() + chunks[i].lines);
  }
  Assembly result = assembler.take();
  result.vertex_base = std::move(vertex_base);
  result.line_base = std::move(line_base);
  return result;
}

}  // namespace strake::io::obj
